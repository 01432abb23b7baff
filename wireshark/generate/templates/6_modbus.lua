-- Modbus: PDUs <-> fields, and the maps. A place is that of a byte of the frame, where the address is byte 0.

local function xor(a, b)
    local result, bit = 0, 1
    while a > 0 or b > 0 do
        if a % 2 ~= b % 2 then
            result = result + bit
        end
        a, b, bit = math.floor(a / 2), math.floor(b / 2), bit * 2
    end
    return result
end

local CRC_OF_BYTE = {}
for byte = 0, 255 do
    local crc = byte
    for _ = 1, 8 do
        local odd = crc % 2 == 1
        crc = math.floor(crc / 2)
        if odd then
            crc = xor(crc, 0xA001)
        end
    end
    CRC_OF_BYTE[byte] = crc
end

local function crc_of(data)
    local crc = 0xFFFF
    for at = 1, #data do
        crc = xor(math.floor(crc / 256), CRC_OF_BYTE[xor(crc % 256, data:byte(at))])
    end
    return crc
end

local function number_at(data, at, size)
    local number = 0
    for place = at + 1, at + size do
        number = number * 256 + data:byte(place)
    end
    return number
end

-- How a field's bytes become a value; or nil and a fault.
local CONVERTERS = {
    digits = function(data, at, size)
        return (data:sub(at + 1, at + size):gsub(".", function(character)
            return string.format("%02X", character:byte())
        end))
    end,
    signed = function(data, at, size)
        return signed(number_at(data, at, size))
    end,
    bool = function(data, at)
        local number = data:byte(at + 1)
        if number > 1 then
            return nil, "value"
        end
        return number == 1
    end,
    coil = function(data, at)
        local number = number_at(data, at, 2)
        if number ~= 0 and number ~= 0xFF00 then
            return nil, "value"
        end
        return number ~= 0
    end,
    code = function(data, at, _, field)
        local number = data:byte(at + 1)
        if number < field.minimum or number > field.maximum then
            return nil, "value"
        end
        return number
    end,
}

-- Take a frame apart by the tokens of its PDU: row, values, places (of fields), or nil and a fault. `check` looks at
-- the values that the order of checks has before reserved bytes.
local function take_apart(row, side, data, profile, check)
    local at, places, values, reserved = 1, {}, {}, false
    local numbers = {}
    for token in row[side]:gmatch("%S+") do
        local name, width = token:match("^(%l[%l_]*):?(%w*)$")
        local size = tonumber(width) or 1
        if width == "mask" then
            local channels = channels_of(profile)
            size = channels and math.floor((channels + 7) / 8) or math.min(math.max(#data - at, 1), 3)
        elseif width == "bits" or width == "words" then
            size = numbers.bytes
        end
        if at + size > #data then
            return nil, "length"
        end
        if not name then
            reserved = reserved or token == "00" and at > 2 and data:byte(at + 1) ~= 0
        else
            if width ~= "bits" and width ~= "words" then
                numbers[name] = number_at(data, at, size)
            end
            places[#places + 1] = { name, at, size }
        end
        at = at + size
    end
    if at ~= #data then
        return nil, "length"
    end
    local fault = check(numbers) or reserved and "reserved"
    if fault then
        return nil, fault
    end
    for _, place in ipairs(places) do
        local field = row[side .. "_fields"][place[1]]
        local convert = field and CONVERTERS[field.kind]
        if convert then
            values[place[1]], fault = convert(data, place[2], place[3], field)
            if fault then
                return nil, fault
            end
        else
            values[place[1]] = numbers[place[1]]
        end
    end
    return row, values, places
end

local function bytes_needed(row, count)
    local is_bits = row.request:match(":bits") or row.response:match(":bits")
    return is_bits and math.floor((count + 7) / 8) or 2 * count
end

-- The row of a function, and of 46h of its sub-function; or nil and a fault.
local function row_of(data)
    local code = data:byte(2)
    if code == 0x46 then
        if #data < 3 then
            return nil, "length"
        end
        local row = MODULE_SETTINGS[data:byte(3)]
        return row, not row and "sub_function" or nil
    end
    local row = FUNCTIONS[code]
    return row, not row and "function" or nil
end

-- What a request is, without CRC: its row, values and places; or nil and a fault.
local function request_of(data, profile)
    local row, fault = row_of(data)
    if data:byte(1) > 247 then
        return nil, "address"
    elseif not row then
        return nil, fault
    elseif data:byte(1) == 0 and not row.broadcast then
        return nil, "address"
    end
    return take_apart(row, "request", data, profile, function(numbers)
        local count = numbers.count
        if count and (count < row.minimum_count or count > row.maximum_count or numbers.start + count > 65536) then
            return "range"
        end
        return count and numbers.bytes and numbers.bytes ~= bytes_needed(row, count) and "count" or nil
    end)
end

local EXCEPTION = {
    name = "ExceptionResponse", response = "function exception_code", response_fields = EXCEPTION_FIELDS,
}

-- Whether a response has bits that are reserved: of channels that the module does not have, of settings that no module
-- has, or above the byte that the offset of a channel is.
local function has_reserved_bits(row, numbers, asked, profile)
    local channels = channels_of(profile)
    if numbers.mask then
        return channels ~= nil and numbers.mask >= 2 ^ channels
    elseif numbers.settings then
        return row.response_fields.settings.legal[numbers.settings] == nil
    end
    return numbers.offset and asked and asked.channel and asked.channel >= 0x80 and numbers.offset > 0xFF
end

-- What a response is, without CRC; the request may be unknown.
local function response_to(data, request, profile)
    local code = data:byte(2)
    if data:byte(1) == 0 or request and data:byte(1) ~= request.data:byte(1) then
        return nil, "address"
    elseif request and code % 128 ~= request.data:byte(2) % 128 then
        return nil, "function"
    elseif code >= 0x80 then
        if #data ~= 3 then
            return nil, "length"
        end
        local values = { ["function"] = code - 0x80, exception_code = data:byte(3) }
        return EXCEPTION, values, { { "function", 1, 1 }, { "exception_code", 2, 1 } }
    end
    local row, fault = row_of(data)
    if not row then
        return nil, fault
    elseif request and request.row and row ~= request.row then
        return nil, "sub_function"
    end
    local asked = request and request.row and request.values
    return take_apart(row, "response", data, profile, function(numbers)
        if asked and numbers.bytes and numbers.bytes ~= bytes_needed(row, asked.count) then
            return "count"
        end
        if asked and not numbers.bytes and code ~= 0x46 and data:sub(3) ~= request.data:sub(3, #data) then
            return "echo"
        end
        return has_reserved_bits(row, numbers, asked, profile) and "reserved" or nil
    end)
end

local AREAS = {
    [1] = { "coil", "0" }, [2] = { "discrete_input", "1" }, [3] = { "holding_register", "4" },
    [4] = { "input_register", "3" }, [5] = { "coil", "0" }, [6] = { "holding_register", "4" },
    [15] = { "coil", "0" }, [16] = { "holding_register", "4" },
}
local WRITES = { [5] = true, [6] = true, [15] = true, [16] = true }

local function map_of(profile)
    for _, map in ipairs(MAPS) do
        if profile.model and map.models[profile.model.name] then
            return map
        end
    end
end

-- The row of a map that has an address, or nil.
local function register_at(map, area, address, profile)
    for _, row in ipairs(map.rows) do
        if row.area == area and address >= row.address and address < row.address + row.count
            and (not row.models or row.models[profile.model.name]) and since(profile, row.firmware) then
            return row
        end
    end
end

-- Which channel a register has a reading of, or nil.
local function channel_at(row, address)
    local offset = address - row.address
    if row.type == "reading" then
        return offset
    elseif row.type == "record" and offset % 18 < 16 then
        return offset % 18
    end
end

-- The number of an item, from one or two words; and whether it is the second word of it.
local function number_of(row, address, word, next_word)
    if row.type == "uint32" or row.type == "record" then
        local is_second = (address - row.address) % 2 == 1
        if is_second or not next_word then
            return nil, is_second
        end
        return word + 65536 * next_word
    elseif row.type == "int16" then
        return signed(word)
    elseif row.type == "int8" then
        return word >= 0x80 and word < 0x100 and word - 0x100 or word
    end
    return word
end

local function item_in_words(row, number)
    local named = row.values and row.values[number]
    if named then
        return named
    elseif row.legal == "types" then
        return TYPES[number] and TYPES[number].name or "undefined"
    elseif row.legal == "channel_bits" then
        return channels_in(row.name == "channel_mask_high" and number * 0x10000 or number)
    elseif row.name == "line_settings" then
        return (settings_in(number, "CC", {}))
    elseif row.unit then
        return string.format("%.10g %s", number * (row.scale or 1), row.unit)
    end
end

local function item_is_legal(row, number, profile)
    if row.name == "line_settings" then
        local _, good = settings_in(number, "CC", profile)
        return good
    elseif row.legal == "types" then
        return is_type(number, profile)
    elseif type(row.legal) == "table" then
        return row.legal[number] ~= nil
    end
    return (not row.minimum or number >= row.minimum) and (not row.maximum or number <= row.maximum)
end
