-- The dissector of DCON.

local dcon = Proto("dcon", "DCON (ICP DAS I-7000)")
local dcon_lists = {}
for _, command in ipairs(DCON_COMMANDS) do
    dcon_lists[#dcon_lists + 1] = command.parts
    dcon_lists[#dcon_lists + 1] = command.response_parts
end
local dcon_made = group("dcon", dcon_lists)
dcon_made.fields.checksum = ProtoField.string("dcon.checksum", "Checksum")
dcon_made.fields.noise = ProtoField.bytes("dcon.noise", "Noise")
dcon_made.fields.data = ProtoField.string("dcon.data", "Data")
dcon.fields = list_of(dcon_made.fields)
dcon.experts = list_of(dcon_made.experts)

local dcon_pairs = pairing()

local learned_of = {}

function dcon.init()
    dcon_pairs.clear()
    learned_of = {}
end

local function learned_key(line, address)
    return line .. "/" .. tostring(address)
end

-- Keep what a response shows of a module: the format of its readings, its types. What a module acknowledges is in the
-- command. A table once kept never changes, so that every packet is read with what was known at its time.
local function learn(line, key, found, request, profile)
    local name, values, before = found.message.name, found.values, learned_of[key] or {}
    if name == "Acknowledged" then
        name, values = request.command.name, request.values
    end
    if name == "Configuration" or name == "SetConfiguration" then
        local one = TYPES[values.type_code] and not (profile.model and profile.model.mixed_types == "ignored")
        learned_of[key] = nil
        learned_of[values.new_address and learned_key(line, values.new_address) or key] = {
            format = FORMATS[bits(values.report_settings, 0, 2)] or before.format,
            types = one and { values.type_code } or before.types,
        }
    elseif (name == "ChannelTypeCode" or name == "SetChannelTypeCode") and TYPES[values.type_code] then
        local types = {}
        for channel = 0, (channels_of(profile) or 20) - 1 do
            local old = type_of({ model = profile.model, types = before.types }, channel)
            types[channel + 1] = channel == values.channel and values.type_code or old and old.code or false
        end
        learned_of[key] = { format = before.format, types = types }
    end
end

local function add_readings(root, field, range_of, place, fields, request, profile)
    local values = request and request.values or {}
    local first = field.kind == "reading" and values.channel or 0
    local at = place[1]
    local format = format_of(table.concat(fields), field, profile)
    local legacy = is_legacy(profile)
    for index, text in ipairs(fields) do
        local channel = first + index - 1
        local kind = type_of(profile, channel)
        local value, unit, status, note = reading_of_text(text, format, kind, legacy)
        add_reading(root, dcon_made, range_of(at, #text), text, channel, value, unit, status, note)
        at = at + #text
    end
end

-- Add a decoded body to the tree.
local function add_message(root, found, range_of, request, profile)
    local row = request and request.command or found.message
    root:add(dcon_made.fields.message, range_of(1, 1), found.message.name)
    root:add(dcon_made.fields.section, row.section):append_text(": " .. row.description):set_generated()
    for _, part in ipairs(found.message.parts) do
        local place = part.name and found.places[part.name]
        local value = part.name and found.values[part.name]
        if place and LISTS[part.kind] then
            add_readings(root, part, range_of, place, value, request, profile)
        elseif place then
            add_field(root, dcon_made, part, range_of(place[1], place[2]), value, found.values, profile)
        end
    end
    if found.message == REFUSED then
        root:add_proto_expert_info(dcon_made.experts.refused, "Refused: " .. row.name)
    end
    if found.other then
        root:add_proto_expert_info(dcon_made.experts.ambiguous, "On other models this is " .. found.other.name)
    end
end

local FAULTS = {
    length = "Too long or too short", terminator = "No CR at the end, or one before it",
    character = "A character that may not stand there", leading = "No frame of this direction begins so",
    checksum = "Wrong checksum", command = "No command", unsupported = "The model does not have the command",
    value = "A value that is not defined", number = "Not a number of this format",
    address = "Not the address of the request", ["function"] = "Not a function of these modules",
    sub_function = "Not a sub-function of these modules", crc = "Wrong CRC", range = "The count is out of range",
    count = "The byte count is not that of the count", reserved = "A reserved byte is not 0",
    echo = "Not what the request has",
}

local function add_fault(root, made, fault, detail)
    root:add(made.fields.fault, fault):set_generated()
    local kind = (fault == "checksum" or fault == "crc") and made.experts.checksum or made.experts.fault
    root:add_proto_expert_info(kind, FAULTS[fault] .. (detail and ": " .. detail or ""))
end

-- A response whose command is not in the capture: readings can be read all the same.
local function add_unpaired(root, body, range_of, profile)
    root:add_proto_expert_info(dcon_made.experts.no_request)
    local values = READINGS_PART
    local fields = body:sub(1, 1) == ">" and width_fits(values, profile, body:sub(2))(#body - 1)
        and read_readings(body:sub(2), values, profile)
    if fields then
        root:add(dcon_made.fields.message, range_of(1, 1), "AnalogInputs"):append_text(" (assumed)")
        add_readings(root, values, range_of, { 2, #body - 1 }, fields, nil, profile)
    elseif body:match("^[!%?][%dA-F][%dA-F]") then
        root:add(dcon_made.fields.address, range_of(2, 2), tonumber(body:sub(2, 3), 16))
        if body:sub(1, 1) == "?" then
            root:add_proto_expert_info(dcon_made.experts.refused)
        elseif #body > 3 then
            root:add(dcon_made.fields.data, range_of(4, #body - 3), body:sub(4))
        end
    end
end

local function add_checksum(root, found, range_of, body)
    if found.checksum then
        root:add(dcon_made.fields.checksum, range_of(#body - 1, 2), found.checksum)
            :append_text(found.checksum == found.right and " (right)" or " (wrong, should be " .. found.right .. ")")
    end
end

-- Dissect a frame that begins at a place of a packet; `n` counts the frames of the packet.
local function dissect_frame(tvb, start, frame, pinfo, tree, n)
    local root = tree:add(dcon, tvb:range(start, #frame))
    local function range_of(at, size)
        return tvb:range(start + at - 1, size)
    end
    local line, interface = line_of(pinfo), interface_of()
    local is_response = frame:match(RESPONSES_BEGIN) ~= nil
    if pinfo.p2p_dir == SENT or pinfo.p2p_dir == RECEIVED then
        is_response = pinfo.p2p_dir == RECEIVED
    end
    local body = frame:gsub("\r$", "")
    local request = is_response and dcon_pairs.request(pinfo, line, n) or nil
    local address = request and request.values.address or tonumber(body:match("^.(%x%x)") or "", 16)
    local learned = learned_key(line, address)
    local given = profile_of(interface, address)
    local profile = with_learned(given, request and request.learned)
    add_preference_fault(root, dcon_made)
    local found = { fault = frame_fault(frame, is_response and RESPONSES_BEGIN or COMMANDS_BEGIN) }
    if not found.fault and is_response and not request then
        local text = body
        local right = #body > 2 and checksum_of(body:sub(1, -3))
        if right and (profile.checksum or profile.checksum == nil and right == body:sub(-2)) then
            found = { checksum = body:sub(-2), right = right }
            text = body:sub(1, -3)
            found.fault = found.checksum ~= found.right and "checksum" or nil
        end
        add_unpaired(root, text, range_of, profile)
    elseif not found.fault then
        local with = profile.checksum
        if with == nil and request then
            with = request.with_checksum
        end
        local function read(known)
            return read_body(body, with, function(text)
                if is_response then
                    return response_of(text, request, known)
                end
                return command_of(text, known)
            end)
        end
        found = read(profile)
        -- What was learned may be out of date, so it is no reason for a fault.
        local fresh = found.fault and profile ~= given and read(given)
        if fresh and not fresh.fault then
            found, profile = fresh, given
            if not pinfo.visited then
                learned_of[learned] = nil
            end
        end
    end
    if found.message then
        add_message(root, found, range_of, request, profile)
    end
    add_checksum(root, found, range_of, body)
    if found.fault then
        add_fault(root, dcon_made, found.fault, found.foreign and found.foreign.name)
    end
    if request then
        add_request(root, dcon_made, pinfo, request)
        if not found.fault then
            dcon_pairs.answer(pinfo, request)
            if not pinfo.visited then
                learn(line, learned, found, request, profile)
            end
        end
    elseif not is_response then
        local command = not found.fault and found.message
        add_errata(root, dcon_made, command and command.errata)
        add_answer(root, dcon_made, pinfo, dcon_pairs)
        dcon_pairs.ask(pinfo, line, command and command.response and {
            command = command, values = found.values, frame = pinfo.number, time = pinfo.rel_ts,
            with_checksum = found.checksum ~= nil, learned = learned_of[learned],
        } or nil)
    end
    local name = found.message and found.message.name or found.fault and FAULTS[found.fault] or "Response"
    local shown = body:gsub("[^ -~]", "."):sub(1, 80)
    root:append_text(", " .. name .. ": " .. shown)
    pinfo.cols.info:append((n > 1 and "; " or "") .. (is_response and "<- " or "-> ") .. name .. "  " .. shown)
end

-- Cut a packet into frames: each the place and the bytes. Of a stream, noise is cut off too, and the rest is kept.
local function frames_of(data, in_stream)
    local found, at = {}, 1
    while at <= #data do
        local stop = data:find("\r", at, true)
        local size = (stop or #data) - at + 1
        found[#found + 1] = { at - 1, data:sub(at, at + size - 1), whole = stop ~= nil }
        at = at + size
    end
    for _, frame in ipairs(found) do
        if not in_stream and not frame[2]:match("^" .. LEADING) then
            return { { 0, data, whole = true } }
        end
    end
    return found
end

function dcon.dissector(tvb, pinfo, tree)
    pinfo.cols.protocol = "DCON"
    pinfo.cols.info = ""
    local data = tvb:raw()
    local in_stream = pinfo.can_desegment > 0
    if tvb:reported_len() > #data then
        local root = tree:add(dcon, tvb:range())
        root:add_proto_expert_info(dcon_made.experts.cut_off)
        return #data
    end
    for n, frame in ipairs(frames_of(data, in_stream)) do
        local start, text = frame[1], frame[2]
        if in_stream and not frame.whole and #text < 256 then
            pinfo.desegment_offset = start
            pinfo.desegment_len = DESEGMENT_ONE_MORE_SEGMENT
            return #data
        end
        local before = in_stream and text:match("^(.*)" .. LEADING .. "[^%%#%$~@!>%?]*$")
        if before and #before > 0 then
            tree:add(dcon_made.fields.noise, tvb:range(start, #before))
            start, text = start + #before, text:sub(#before + 1)
        end
        dissect_frame(tvb, start, text, pinfo, tree, n)
    end
    return #data
end
