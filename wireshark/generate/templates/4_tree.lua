-- What both protocols put into the tree.

local SENT, RECEIVED = 0, 1
local interface_field = Field.new("frame.interface_id")

local function interface_of()
    local found = interface_field()
    return found and tostring(found.value) or "0"
end

-- The line that a packet was on: an interface, or a connection.
local function line_of(pinfo)
    if pinfo.src_port == 0 and pinfo.dst_port == 0 then
        return interface_of()
    end
    local source = tostring(pinfo.src) .. " " .. pinfo.src_port
    local destination = tostring(pinfo.dst) .. " " .. pinfo.dst_port
    return source < destination and source .. " " .. destination or destination .. " " .. source
end

local function title(name)
    return (name:sub(1, 1):upper() .. name:sub(2):gsub("_", " "))
end

local BYTE = ProtoField.uint8
local IN_HEX = {
    address = BYTE, new_address = BYTE, type_code = BYTE, line_settings = BYTE, report_settings = BYTE, status = BYTE,
    settings = BYTE, mask = ProtoField.uint24,
}
local MAKERS = {
    bool = ProtoField.bool, coil = ProtoField.bool, decimal = ProtoField.double, name = ProtoField.string,
    version = ProtoField.string, digits = ProtoField.string, signed_hex = ProtoField.int32, signed = ProtoField.int32,
}
local LISTS = { reading = true, readings = true, bits = true, words = true }

local function of_group(prefix, fields, experts)
    local made = { fields = {}, experts = {} }
    for name, field in pairs(fields) do
        made.fields[name] = field
    end
    for name, row in pairs(experts) do
        local kind, level = expert.group[row[3]], expert.severity[row[4]]
        made.experts[name] = ProtoExpert.new(prefix .. ".expert." .. row[1], row[2], kind, level)
    end
    return made
end

local EXPERTS = {
    checksum = { "checksum", "Wrong checksum", "CHECKSUM", "ERROR" },
    refused = { "refused", "The module refused the command", "RESPONSE_CODE", "WARN" },
    out_of_range = { "out_of_range", "A module does not take this value", "PROTOCOL", "WARN" },
    fault = { "fault", "Not a valid frame", "MALFORMED", "ERROR" },
    cut_off = { "cut_off", "The capture does not have the whole frame", "UNDECODED", "WARN" },
    no_request = { "no_request", "No request before this response", "SEQUENCE", "NOTE" },
    ambiguous = { "ambiguous", "It depends on the model what this is", "UNDECODED", "NOTE" },
    no_reading = { "not_of_type", "Not a reading of this type", "PROTOCOL", "WARN" },
    range_status = { "range_status", "Over or under range", "RESPONSE_CODE", "NOTE" },
    access = { "access", "The model does not have this, or not for this access", "PROTOCOL", "WARN" },
    erratum = { "erratum", "The manual is contradictory or silent", "ASSUMPTION", "CHAT" },
    preference = { "preference", "A preference is invalid", "UNDECODED", "ERROR" },
}

-- The fields that both protocols have, and those of messages.
local function group(prefix, messages)
    local fields = {
        message = ProtoField.string(prefix .. ".message", "Message"),
        section = ProtoField.string(prefix .. ".section", "Manual"),
        fault = ProtoField.string(prefix .. ".fault", "Fault"),
        response_to = ProtoField.framenum(prefix .. ".response_to", "Response to", base.NONE, frametype.REQUEST),
        response_in = ProtoField.framenum(prefix .. ".response_in", "Response in", base.NONE, frametype.RESPONSE),
        time = ProtoField.double(prefix .. ".time", "Seconds since the request"),
        erratum = ProtoField.string(prefix .. ".errata", "Erratum"),
        reading = ProtoField.string(prefix .. ".reading", "Reading"),
        reading_channel = ProtoField.uint8(prefix .. ".reading.channel", "Channel"),
        reading_value = ProtoField.double(prefix .. ".reading.value", "Value"),
        reading_unit = ProtoField.string(prefix .. ".reading.unit", "Unit"),
        reading_status = ProtoField.string(prefix .. ".reading.status", "Status"),
    }
    for _, list in ipairs(messages) do
        for _, field in ipairs(list) do
            if field.name and not fields[field.name] and not LISTS[field.kind] then
                local make = MAKERS[field.kind]
                local name = prefix .. "." .. field.name
                if make then
                    fields[field.name] = make(name, title(field.name))
                else
                    local in_hex = IN_HEX[field.name]
                    fields[field.name] = (in_hex or ProtoField.uint32)(name, title(field.name), in_hex and base.HEX)
                end
            end
        end
    end
    return of_group(prefix, fields, EXPERTS)
end

local function list_of(found)
    local made = {}
    for _, one in pairs(found) do
        made[#made + 1] = one
    end
    return made
end

local function add_errata(root, made, errata)
    if not preferences.errata or not errata or #errata == 0 then
        return
    end
    local list = root:add("Errata: " .. table.concat(errata, ", "))
    list:set_generated()
    for _, id in ipairs(errata) do
        local item = list:add(made.fields.erratum, id):set_generated()
        item:append_text(": " .. ERRATA[id].what)
        item:add_proto_expert_info(made.experts.erratum, id .. ": " .. ERRATA[id].reading)
    end
end

local function add_preference_fault(root, made)
    if preferences.fault then
        root:add_proto_expert_info(made.experts.preference, "Preference: " .. preferences.fault)
    end
end

-- Add a field of a message, with what it means.
local function add_field(root, made, field, range, value, values, profile)
    local item = root:add(made.fields[field.name], range, value)
    local words = in_words(field, value, values)
    if words then
        item:append_text(" (" .. words .. ")")
    end
    local meaning = item:add(range, "Meaning: " .. field.meaning)
    if field.minimum and field.maximum then
        meaning:append_text(string.format("; %.10g to %.10g", field.minimum, field.maximum))
    end
    if not is_legal(field, value, values, profile) then
        local of = profile.model and " of the " .. profile.model.name or ""
        item:add_proto_expert_info(made.experts.out_of_range, title(field.name) .. of .. " is out of range")
    end
    return item
end

-- Add the reading of a channel.
local function add_reading(root, made, range, shown, channel, value, unit, status, note)
    local item = root:add(made.fields.reading, range, shown)
    local words = value and string.format("%.10g", value) .. (unit and " " .. unit or "") or title(status)
    item:set_text(string.format("Channel %d: %s (%s)", channel, words, shown))
    item:add(made.fields.reading_channel, range, channel)
    if value then
        item:add(made.fields.reading_value, range, value)
    end
    if unit then
        item:add(made.fields.reading_unit, range, unit)
    end
    item:add(made.fields.reading_status, range, status)
    if note then
        item:add_proto_expert_info(made.experts.no_reading, "Channel " .. channel .. ": " .. note)
    elseif status == "over_range" or status == "under_range" then
        item:add_proto_expert_info(made.experts.range_status, "Channel " .. channel .. ": " .. title(status))
    end
end

-- Which request a response belongs to; found out once, when the packets are read in order.
local function pairing()
    local self = { open = {}, kept = {}, answers = {} }
    function self.clear()
        self.open, self.kept, self.answers = {}, {}, {}
    end
    -- The request for the n-th frame of a packet, or nil.
    function self.request(pinfo, line, n)
        local key = pinfo.number .. " " .. n
        if not pinfo.visited then
            local request = self.open[line]
            self.kept[key] = request and not request.answered and request or nil
        end
        return self.kept[key]
    end
    function self.ask(pinfo, line, request)
        if not pinfo.visited then
            self.open[line] = request
        end
    end
    function self.answer(pinfo, request)
        if not pinfo.visited then
            request.answered = true
            self.answers[request.frame] = pinfo.number
        end
    end
    return self
end

local function add_request(root, made, pinfo, request)
    root:add(made.fields.response_to, request.frame):set_generated()
    root:add(made.fields.time, pinfo.rel_ts - request.time):set_generated()
end

local function add_answer(root, made, pinfo, pairs_of)
    local frame = pairs_of.answers[pinfo.number]
    if frame then
        root:add(made.fields.response_in, frame):set_generated()
    end
end
