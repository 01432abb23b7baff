-- What fields mean: readings, settings in words, and which numbers a module takes.

-- The special reading that a text (or a register) is, or nil.
local function special(value, format, code, legacy)
    for _, row in ipairs(SENTINELS) do
        if row.format == format and row.value == value and (not row.types or row.types[code]) then
            local other = row.legacy and not legacy or row.not_legacy and legacy
            if not other then
                return row.status
            end
        end
    end
end

local function signed(word)
    return word >= 0x8000 and word - 0x10000 or word
end

local function value_of_word(word, kind)
    if not kind.hex_signed then
        return kind.minimum + word * (kind.maximum - kind.minimum) / 65535
    end
    local number = signed(word)
    return number * kind.max / (number >= 0 and 32767 or 32768)
end

-- The special texts of either format are special in both (E48).
local OTHER_TEXT_FORMAT = { engineering = "percent", percent = "engineering" }

-- Read the text of a channel: its value, unit and status, or a note instead. The value of an unknown type is what the
-- text says, without unit.
local function reading_of_text(text, format, kind, legacy)
    local blanks = text:match("^ +$") and "disabled"
    local other = OTHER_TEXT_FORMAT[format]
    local status = blanks or kind and (special(text, format, kind.code, legacy)
        or other and special(text, other, kind.code, legacy))
    if status then
        return nil, kind and kind.unit, status
    end
    local number = tonumber((text:gsub("^%+", "")))
    if not kind then
        return format ~= "hex" and number or nil, format == "percent" and "%" or nil, "ok"
    elseif format == "hex" then
        number = value_of_word(tonumber(text, 16), kind)
    elseif format == "percent" then
        local span = kind.hex_signed and kind.max or kind.maximum - kind.minimum
        number = (kind.hex_signed and 0 or kind.minimum) + number * span / 100
    elseif #text:match("%.?(%d*)$") ~= kind.engineering_decimals then
        return number, nil, "ok", "the decimals are not those of " .. kind.name
    end
    local margin = kind.max / 10 * (1 + 1e-12)
    if number < kind.minimum - margin or number > kind.maximum + margin then
        return number, nil, "ok", "out of the range of " .. kind.name
    end
    return number, kind.unit, "ok"
end

-- Read a register of an analog input.
local function reading_of_register(word, format, kind)
    if not kind then
        return nil, nil, "ok"
    end
    local number = signed(word)
    local status = special(format == "hex" and word or number, "modbus_" .. format, kind.code, false)
    if status then
        return nil, kind.unit, status
    end
    if format == "hex" then
        return value_of_word(word, kind), kind.unit, "ok"
    end
    return number / kind.modbus_counts_per_unit, kind.unit, "ok"
end

local function bits(byte, low, count)
    return math.floor(byte / 2 ^ low) % 2 ^ count
end

-- A setting's row holds for a module: by its firmware, and by what the model needs.
local function setting_holds(row, profile)
    local model = profile.model
    if not model then
        return true
    end
    if row.needs and not model[row.needs] then
        return false
    end
    local first = row.firmware and (row.firmware[model.name] or row.firmware[model.name:sub(3)]
        or row.firmware[model.series])
    return since(profile, first)
end

-- The settings in a byte, in words; and whether a module has them all.
local function settings_in(byte, letters, profile)
    local words, good, known = {}, true, 0
    for _, row in ipairs(BIT_SETTINGS) do
        local code = row.letters == letters and bits(byte, row.low_bit, row.bits)
        if code and not row.code then
            good = good and code == 0
        elseif code and code == row.code then
            words[#words + 1] = row.name
            known = known + 1
            good = good and setting_holds(row, profile)
        end
    end
    return table.concat(words, ", "), good and known == BIT_GROUPS[letters]
end

local function channels_in(mask)
    local found = {}
    for channel = 0, 23 do
        if bits(mask, channel, 1) == 1 then
            found[#found + 1] = tostring(channel)
        end
    end
    return #found == 0 and "no channel" or "channels " .. table.concat(found, ", ")
end

local LETTERS = { line_settings = "CC", report_settings = "FF" }

-- A value in words, or nil if the number says it all.
local function in_words(field, value, values)
    if LETTERS[field.name] then
        return (settings_in(value, LETTERS[field.name], {}))
    elseif field.name == "mask" then
        return channels_in(value)
    elseif field.name == "type_code" then
        return TYPES[value] and TYPES[value].name or value == 0xFF and "the channels differ" or "undefined"
    elseif CODE_NAMES[field.name] then
        return CODE_NAMES[field.name][value]
    elseif field.legal == "offset_channels" then
        return value == 0 and "module" or value >= 0x80 and string.format("channel %d", value - 0x80) or nil
    elseif field.unit and type(value) == "number" then
        local of_channel = (values.channel or 0) >= 0x80
        local scales = field.scale or { 1 }
        local scale = of_channel and scales[2] or scales[1]
        return string.format("%.10g %s", value * scale, field.unit)
    end
end

-- Whether a name could be the text of another response.
local function is_other_answer(name)
    if name:match("^[+-]%x%x%x%x$") and not name:match("%l") or name:match("^[012]$")
        or name:match("^%u%d%.%d%d?$") or name:match("^C[%dA-F][%dA-F]?R[%dA-F][%dA-F]$") then
        return true
    end
    if not name:match("^[%dA-F]+$") then
        return false
    end
    local is_series = #name >= 4 and SERIES[name:sub(1, 4)]
    return #name == 2 or (#name == 4 or #name == 6) and not is_series or #name == 3 and name:match("^[01]") ~= nil
end

local function is_type(code, profile)
    local model = profile.model
    if not model then
        return TYPES[code] ~= nil
    end
    local first = model.types[code]
    return first ~= nil and since(profile, first)
end

local RULES = {
    types = is_type,
    types_or_mixed = function(code, profile)
        local mixed = profile.model and profile.model.mixed_types
        return mixed == "ignored" or is_type(code, profile)
            or code == 0xFF and (not profile.model or mixed and since(profile, mixed)) or false
    end,
    channels = function(channel, profile)
        return channel < (channels_of(profile) or 20)
    end,
    type_channels = function(channel, profile)
        local each = not profile.model or profile.model.individually_configurable
        return channel < (each and since(profile, each) and (channels_of(profile) or 20) or 1)
    end,
    offset_channels = function(channel, profile)
        return channel == 0 or channel >= 0x80 and channel - 0x80 < (channels_of(profile) or 20)
    end,
    offsets = function(offset, _, values, field)
        if (values.channel or 0) >= 0x80 then
            return offset >= 0 and offset <= 255
        end
        return offset >= field.minimum and offset <= field.maximum
    end,
    channel_bits = function(mask, profile)
        return mask < 2 ^ (channels_of(profile) or 20)
    end,
}

-- Whether a module takes a number, or sends it.
local function is_legal(field, value, values, profile)
    if field.kind == "name" then
        return not is_other_answer(value)
    elseif type(value) ~= "number" then
        return true
    elseif LETTERS[field.name] then
        local _, good = settings_in(value, LETTERS[field.name], profile)
        return good
    elseif field.name == "settings" then
        local _, good = settings_in(value, "FF", profile)
        return good and field.legal[value] ~= nil
    elseif type(field.legal) == "string" then
        return RULES[field.legal](value, profile, values, field)
    elseif field.legal then
        return field.legal[value] ~= nil
    end
    return (not field.minimum or value >= field.minimum) and (not field.maximum or value <= field.maximum)
end
