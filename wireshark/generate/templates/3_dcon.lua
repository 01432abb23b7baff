-- DCON: bodies <-> fields. A position is that of a character in the body, from 1 on.

local LEADING = "[%%#%$~@!>%?]"
local COMMANDS_BEGIN, RESPONSES_BEGIN = "^[%%#%$~@]", "^[!>%?]"

local function checksum_of(body)
    local sum = 0
    for at = 1, #body do
        sum = sum + body:byte(at)
    end
    return string.format("%02X", sum % 256)
end

-- The fields of a line; those of the old I-7018 firmware have several widths.
local function cut_line(text, format, legacy)
    local fields, at = {}, 1
    local width = format == "hex" and 4 or 7
    while at <= #text do
        local size = width
        if legacy and format == "hex" then
            size = text:match("^[+-]", at) and 5 or 4
        elseif legacy and text:sub(at, at) ~= " " then
            size = (text:find("[+%- ]", at + 1) or #text + 1) - at
        end
        fields[#fields + 1] = text:sub(at, at + size - 1)
        at = at + size
    end
    return fields
end

local SHAPES = {
    engineering = function(text)
        return #text == 7 and text:match("^[+-]%d+%.%d+$") ~= nil and text:find(".", 1, true) <= 6
    end,
    percent = function(text)
        return (text:match("^[+-]%d%d%d%.%d%d$") or text:match("^[+-]9999%.9$")) ~= nil
    end,
    hex = function(text)
        return text:match("^[%dA-F][%dA-F][%dA-F][%dA-F]$") ~= nil
    end,
}
local function has_shape(text, format, legacy)
    return SHAPES[format](text) or text == (format == "hex" and "    " or "       ")
        or legacy and (text == "+9999" or text == "-0000")
end

local ALLOWED = "^[ -~]$"

-- The fault of a character that may not stand in a name or a version, and its place.
local function bad_character(text)
    for at = 1, #text do
        local character = text:sub(at, at)
        if not character:match(ALLOWED) or character:match(LEADING) then
            return "character", at
        end
    end
end

local function read_digits(text)
    local bad = text:find("[^%dA-F]")
    if bad then
        return nil, "character", bad
    end
    return tonumber(text, 16)
end

local function read_code(text, part)
    local number = text:match("^%d$") and tonumber(text)
    if not number or number < part.minimum or number > part.maximum then
        return nil, "value", 1
    end
    return number
end

-- The format of readings: the one that is known, or else the one that a text looks like.
local function format_of(text, part, profile)
    if not part.digits_by then
        return "hex"
    end
    return profile.format or text:match("[^%dA-F ]") and "engineering" or "hex"
end

local function read_readings(text, part, profile)
    local format = format_of(text, part, profile)
    local legacy = is_legacy(profile)
    local fields = cut_line(text, format, legacy)
    local count = part.kind == "reading" and 1 or channels_of(profile)
    if count and #fields ~= count then
        return nil, "length"
    end
    for _, field in ipairs(fields) do
        if not has_shape(field, format, legacy) then
            return nil, format == "hex" and "character" or "number", 1
        end
    end
    return fields
end

local function read_text(text, is_valid)
    local fault, at = bad_character(text)
    if fault then
        return nil, fault, at
    elseif not is_valid then
        return nil, "value", 1
    end
    return text
end

-- How the text of a part becomes a value; or nil, a fault and its place in the text.
local READERS = {
    hex = read_digits,
    code = read_code,
    bool = function(text, part)
        local number, fault, at = read_code(text, part)
        if fault then
            return nil, fault, at
        end
        return number == 1
    end,
    signed_hex = function(text)
        if not text:match("^[+-]") then
            return nil, "number", 1
        end
        local number, fault, at = read_digits(text:sub(2))
        if fault then
            return nil, fault, at + 1
        end
        return text:sub(1, 1) == "-" and -number or number
    end,
    decimal = function(text)
        if not text:match("^[+-]%d%d%d%d%.%d$") then
            return nil, "number", 1
        end
        return tonumber((text:gsub("^%+", "")))
    end,
    name = function(text, _, _, is_response)
        return read_text(text, not (is_response and is_other_answer(text)))
    end,
    version = function(text)
        return read_text(text, text:match("^%u%d%.%d%d?$"))
    end,
    reading = read_readings,
    readings = read_readings,
}

-- The widths that a part may have, as a function of a width.
local function width_fits(part, profile, text)
    local by = part.digits_by
    local model = profile.model
    if part.kind == "readings" or part.kind == "reading" then
        local digits = format_of(text, part, profile) == "hex" and 4 or 7
        local count = part.kind == "reading" and 1 or channels_of(profile)
        if is_legacy(profile) then
            return function()
                return true
            end
        end
        return function(width)
            if count then
                return width == digits * count
            end
            return width > 0 and width % digits == 0
        end
    end
    local only
    if by == "mask_digits" and model then
        only = profile.single_ended and model.mask_digits_single_ended or model.mask_digits
    elseif by == "channel_digits" and model then
        only = profile.single_ended and 2 or 1
    end
    return function(width)
        if only then
            return width == only
        end
        for _, digits in ipairs(part.digits) do
            if width == digits then
                return true
            end
        end
        return false
    end
end

-- Compare a body with the parts of a syntax: the values by name and the places by name; or nil, a fault and its place.
local function fit(parts, body, profile, is_response)
    local fixed, open = 0, nil
    for _, part in ipairs(parts) do
        if part.width then
            fixed = fixed + part.width
        else
            open = part
        end
    end
    local width = #body - fixed
    local text = open and body:sub(open.offset + 1) or ""
    if open and not (width >= 0 and width_fits(open, profile, text)(width)) or not open and width ~= 0 then
        return nil, "length"
    end
    local values, places, at = {}, {}, 1
    for _, part in ipairs(parts) do
        local size = part.width or width
        local text = body:sub(at, at + size - 1)
        if part.literal then
            for offset = 1, size do
                if text:sub(offset, offset) ~= part.literal:sub(offset, offset) then
                    return nil, "character", at + offset - 1
                end
            end
        else
            local value, fault, place = READERS[part.kind](text, part, profile, is_response)
            if fault then
                return nil, fault, place and at + place - 1
            end
            values[part.name], places[part.name] = value, { at, size }
        end
        at = at + size
    end
    return values, places
end

local function candidates_of(body)
    local leading, fourth = body:sub(1, 1), body:sub(4, 4)
    local by_letter = leading:match("[%$~@]")
    local found = {}
    for _, command in ipairs(DCON_COMMANDS) do
        local same = command.syntax:sub(1, 1) == leading
        if same and by_letter then
            if #body <= 3 then
                same = body:sub(1, 2) == "~*" and command.syntax == "~**"
            else
                same = command.syntax:sub(4, 4) == fourth
            end
        end
        if same then
            found[#found + 1] = command
        end
    end
    return found
end

-- Which command a body is: the command, its values and places, and another command that it may be on another model;
-- or nil, a fault, and the command that the model does not have.
local function command_of(body, profile)
    local candidates = candidates_of(body)
    if #candidates == 0 then
        return nil, #body <= 3 and body:match("^[%$~@]") and "length" or "command"
    end
    local found, foreign
    local worst, worst_at, worst_own = "length", 0, false
    local any_own = false
    for _, command in ipairs(candidates) do
        local own = has(command.models, profile)
        any_own = any_own or own
        local values, places, at = fit(command.parts, body, profile, false)
        if values and own and found then
            found[4] = command
        elseif values and own then
            found = { command, values, places }
        elseif values then
            foreign = command
        elseif places ~= "length" and (own and not worst_own or own == worst_own and at > worst_at) then
            worst, worst_at, worst_own = places, at, own
        end
    end
    if found then
        return found[1], found[2], found[3], found[4]
    elseif foreign then
        return nil, "unsupported", foreign
    elseif any_own and not worst_own then
        worst = "length"
    end
    return nil, worst
end

local REFUSED = { name = "Refused", parts = REFUSED_PARTS }

-- What a response to a command is: its message, values and places; or nil and a fault.
local function response_of(body, request, profile)
    local command = request.command
    local leading = body:sub(1, 1)
    local message = { name = command.response, parts = command.response_parts }
    if leading == "?" then
        message = REFUSED
    elseif leading ~= command.response_syntax:sub(1, 1) then
        return nil, "leading"
    end
    local values, places = fit(message.parts, body, profile, true)
    if not values then
        return nil, places
    end
    local expected = request.values.address
    if message ~= REFUSED and command.name == "SetConfiguration" then
        expected = request.values.new_address
    end
    local any = command.name == "ReadConfiguration" and expected == 0 and message ~= REFUSED
    if values.address and values.address ~= expected and not any then
        return nil, "address"
    end
    if values.channel and values.channel ~= request.values.channel then
        return nil, "value"
    end
    return message, values, places
end

-- The message in a frame: a table with message, values and places, or with a fault; and with the checksum, if any.
local function message_of(body, with_checksum, decode)
    local text, sent = body, nil
    if with_checksum then
        if #body < 3 then
            return { fault = "length" }
        end
        text, sent = body:sub(1, -3), body:sub(-2)
    end
    local right = sent and checksum_of(text)
    local found = { checksum = sent, right = right }
    if sent ~= right then
        found.fault = "checksum"
    end
    local message, values, places, other = decode(text)
    if message then
        found.message, found.values, found.places, found.other = message, values, places, other
    else
        found.fault, found.foreign = found.fault or values, places
    end
    return found
end

-- Read a body with the checksum setting of a module; nil decides by what fits.
local function read_body(body, with_checksum, decode)
    if with_checksum ~= nil then
        return message_of(body, with_checksum, decode)
    end
    local with = message_of(body, true, decode)
    if with.message and not with.fault then
        return with
    end
    local without = message_of(body, false, decode)
    return with.message and not without.message and with or without
end

-- The fault of a frame before its body is read, or nil.
local function frame_fault(frame, begin)
    if #frame == 0 or #frame > 256 then
        return "length"
    elseif frame:find("\r", 1, true) ~= #frame then
        return "terminator"
    elseif frame:sub(1, -2):find("[^ -~]") then
        return "character"
    elseif not frame:match(begin) then
        return "leading"
    end
end
