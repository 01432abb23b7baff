-- What is known of modules: the preferences, read into profiles.

local function firmware_number(text)
    local letter, major, minor = text:match("^(%a)(%d+)%.(%d+)$")
    return letter and (letter:upper():byte() * 1000 + tonumber(major)) * 1000 + tonumber(minor)
end

-- Whether a firmware is at least another one; nil is the newest, and "always", like false, any.
local function since(profile, first)
    if not first or first == "always" or not profile.firmware then
        return true
    end
    return profile.firmware >= firmware_number(first)
end

-- Whether a module has what these models have; nil is all models. A module of unknown model has everything.
local function has(models, profile)
    if not models or not profile.model then
        return true
    end
    local first = models[profile.model.name]
    return first ~= nil and since(profile, first)
end

-- How many channels a module has, or nil.
local function channels_of(profile)
    local model = profile.model
    if not model then
        return nil
    end
    if profile.single_ended and model.single_ended_by_command then
        return model.single_ended_channels
    end
    return model.channels
end

-- Whether a module sends the lines of the old I-7018 firmware.
local function is_legacy(profile)
    local model = profile.model
    return model and model.series == "7018" and model.name:sub(1, 2) == "I-" and profile.firmware
        and profile.firmware <= firmware_number(LEGACY_UNTIL) or false
end

-- The type of a channel, or nil.
local function type_of(profile, channel)
    local codes = profile.types
    local code = codes and (#codes == 1 and codes[1] or codes[channel + 1])
    if not codes and profile.model then
        code = profile.model.default_type
    end
    return code and TYPES[code]
end

local TYPE_NAMES = {}
for code, row in pairs(TYPES) do
    TYPE_NAMES[row.key:upper()] = code
    TYPE_NAMES[string.format("%02X", code)] = code
end

local function read_types(text)
    local codes = {}
    for name in text:gmatch("[^/,%s]+") do
        codes[#codes + 1] = TYPE_NAMES[name:upper()]
            or error(name .. " is not a type; examples: K, V_10, MA_4_20, 0F", 0)
    end
    return #codes > 0 and codes or nil
end

local function read_model(text)
    for _, model in ipairs(MODELS) do
        if model.name:upper() == text:upper() then
            return model
        end
    end
    error(text .. " is not a model; example: M-7019R", 0)
end

local function one_of(allowed)
    return function(text)
        local value = allowed[text]
        if value == nil then
            error(text .. " is not a value of this setting", 0)
        end
        return value
    end
end

local TRUTHS = { ["true"] = true, ["yes"] = true, ["1"] = true, ["false"] = false, ["no"] = false, ["0"] = false }
local SETTINGS_OF_A_MODULE = {
    type = { "types", read_types },
    format = { "format", one_of({ engineering = "engineering", percent = "percent", hex = "hex" }) },
    modbus_format = { "modbus_format", one_of({ engineering = "engineering", hex = "hex" }) },
    checksum = { "checksum", one_of(TRUTHS) },
    single_ended = { "single_ended", one_of(TRUTHS) },
}

local function read_firmware(text)
    return firmware_number(text) or error(text .. " is not a firmware; example: B3.7", 0)
end

local preferences = { modules = {}, errata = true }

-- Read [INTERFACE:][ADDRESS=]MODEL[@FIRMWARE][,name=value...].
local function read_module(text, general)
    local profile = {}
    for name, value in pairs(general) do
        profile[name] = value
    end
    profile.types, profile.firmware = nil, nil
    local interface, rest = text:match("^(%d+):(.*)$")
    local address, described = (rest or text):match("^(%w+)=(.*)$")
    if address then
        address = tonumber(address) or error(address .. " is not an address; examples: 26, 0x1A", 0)
    end
    described = described or rest or text
    local head, settings = described:match("^([^,]*),?(.*)$")
    local model, firmware = head:match("^([^@]*)@(.*)$")
    profile.model = read_model(model or head)
    profile.firmware = firmware and read_firmware(firmware)
    for assignment in settings:gmatch("[^,]+") do
        local name, value = assignment:match("^(.-)=(.*)$")
        local setting = SETTINGS_OF_A_MODULE[name or ""]
            or error(assignment .. " is not a setting of a module; examples: type=K, format=hex", 0)
        profile[setting[1]] = setting[2](value)
    end
    return (interface or "*") .. ":" .. (address and string.format("%d", address) or "*"), profile
end

-- Run a reader; keep the message of its error.
local function guarded(read, ...)
    local good, found, more = pcall(read, ...)
    if good then
        return found, more
    end
    preferences.fault = tostring(found)
end

-- The profile of a module.
local function profile_of(interface, address)
    local modules = preferences.modules
    address = address and string.format("%d", address) or "*"
    return modules[interface .. ":" .. address] or modules[interface .. ":*"] or modules["*:" .. address]
        or modules["*:*"]
end

-- A profile with what a line has shown of the module, where nothing else is said.
local function with_learned(profile, learned)
    if not learned or profile.format and profile.types then
        return profile
    end
    local known = {}
    for name, value in pairs(profile) do
        known[name] = value
    end
    known.format = profile.format or learned.format
    known.types = profile.types or learned.types
    return known
end

local FORMATS = { [0] = "engineering", [1] = "percent", [2] = "hex" }

local function read_preferences(prefs)
    preferences.fault = nil
    preferences.errata = prefs.errata
    local general = {
        model = prefs.model > 0 and MODELS[prefs.model] or nil,
        firmware = prefs.firmware ~= "" and guarded(read_firmware, prefs.firmware) or nil,
        types = guarded(read_types, prefs.types),
        format = FORMATS[prefs.format - 1],
        modbus_format = FORMATS[prefs.modbus_format],
        single_ended = prefs.single_ended,
    }
    if prefs.checksum > 0 then
        general.checksum = prefs.checksum == 2
    end
    preferences.modules = { ["*:*"] = general }
    for text in prefs.modules:gmatch("[^;%s]+") do
        local key, profile = guarded(read_module, text, general)
        if key then
            preferences.modules[key] = profile
        end
    end
end
