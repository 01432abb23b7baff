-- What these modules mean by Modbus: behind Wireshark's dissectors of Modbus RTU and Modbus/TCP.

local i7000 = Proto("i7000", "ICP DAS M-7000 (Modbus)")
local modbus_lists = { { EXCEPTION_FIELDS["function"], EXCEPTION_FIELDS.exception_code } }
for _, rows in ipairs({ FUNCTIONS, MODULE_SETTINGS }) do
    for _, row in pairs(rows) do
        modbus_lists[#modbus_lists + 1] = list_of(row.request_fields)
        modbus_lists[#modbus_lists + 1] = list_of(row.response_fields)
    end
end
local modbus_made = group("i7000", modbus_lists)
modbus_made.fields.address = ProtoField.uint8("i7000.address", "Address")
modbus_made.fields.value = ProtoField.uint32("i7000.value", "Value")
modbus_made.fields.item = ProtoField.string("i7000.item", "Item")
modbus_made.fields.item_name = ProtoField.string("i7000.item.name", "Name")
modbus_made.fields.item_value = ProtoField.double("i7000.item.value", "Value")
modbus_made.fields.item_unit = ProtoField.string("i7000.item.unit", "Unit")
i7000.fields = list_of(modbus_made.fields)
i7000.experts = list_of(modbus_made.experts)

local rtu_unit, tcp_unit = Field.new("mbrtu.unit_id"), Field.new("mbtcp.unit_id")
local encapsulation_field = Field.new("frame.encap_type")
local tcp_length, tcp_transaction = Field.new("mbtcp.len"), Field.new("mbtcp.trans_id")

local modbus_pairs = pairing()
local hosts = {}

function i7000.init()
    modbus_pairs.clear()
    hosts = {}
end

local function add_register(root, range, area, address, word, next_word, map, profile, is_write)
    local shown = string.format("%s%04d", area[2], address + 1)
    local row = map and register_at(map, area[1], address, profile)
    local item = root:add(modbus_made.fields.item, range, shown)
    if not map then
        item:append_text(string.format(" = %d", word))
        return
    end
    if not row or not row.access:find(is_write and "W" or "R", 1, true) then
        local text = row and row.name .. " is not for this access" or "not in the map of the " .. profile.model.name
        item:add_proto_expert_info(modbus_made.experts.access, shown .. ": " .. text)
    end
    if not row then
        return
    end
    item:append_text(" " .. row.name)
    if row.count > 1 and row.type ~= "uint32" then
        item:append_text(string.format("[%d]", address - row.address))
    end
    item:add(modbus_made.fields.item_name, range, row.name):append_text(": " .. row.meaning)
    local channel = channel_at(row, address)
    if channel then
        local value, unit, status = reading_of_register(word, profile.modbus_format, type_of(profile, channel))
        add_reading(item, modbus_made, range, string.format("%d", word), channel, value, unit, status)
        item:append_text(" = " .. (value and string.format("%.10g %s", value, unit) or word .. " " .. status))
        return
    end
    local number, is_second = number_of(row, address, word, next_word)
    if not number then
        item:append_text(string.format(" = %d (%s word)", word, is_second and "high" or "low"))
        return
    end
    item:add(modbus_made.fields.item_value, range, number * (row.scale or 1))
    if row.unit then
        item:add(modbus_made.fields.item_unit, range, row.unit)
    end
    local words = item_in_words(row, number)
    item:append_text(string.format(" = %.10g", number) .. (words and " (" .. words .. ")" or ""))
    if not item_is_legal(row, number, profile) and (is_write or type(row.legal) == "string") then
        item:add_proto_expert_info(modbus_made.experts.out_of_range, title(row.name) .. " is out of range")
    end
end

-- Add the coils or registers that a frame has.
local function add_registers(root, data, range_of, place, start, count, profile)
    local code = data:byte(2)
    local area, map = AREAS[code], map_of(profile)
    local is_bits = area[1] == "coil" or area[1] == "discrete_input"
    for index = 0, count - 1 do
        local address = start + index
        local at, size, word, next_word
        if code == 5 or code == 6 then
            at, size = place[2], 2
            word = number_at(data, at, 2)
            word = code == 5 and (word == 0 and 0 or 1) or word
        elseif is_bits then
            at, size = place[2] + math.floor(index / 8), 1
            word = bits(data:byte(at + 1), index % 8, 1)
        else
            at, size = place[2] + 2 * index, 2
            word = number_at(data, at, 2)
            next_word = index + 1 < count and number_at(data, at + 2, 2) or nil
        end
        add_register(root, range_of(at, size), area, address, word, next_word, map, profile, WRITES[code])
    end
end

-- Add the first coil or register of a request to read that a module does not have.
local function add_missing(root, data, start, count, profile)
    local area, map = AREAS[data:byte(2)], map_of(profile)
    for address = start, map and start + count - 1 or -1 do
        local row = register_at(map, area[1], address, profile)
        if not row or not row.access:find("R", 1, true) then
            local shown = string.format("%s%04d", area[2], address + 1)
            local text = shown .. ": cannot be read on the " .. profile.model.name
            root:add_proto_expert_info(modbus_made.experts.access, text)
            return
        end
    end
end

local function add_pdu(root, data, row, values, places, side, request, range_of, profile)
    root:add(modbus_made.fields.message, range_of(1, data:byte(2) == 0x46 and 2 or 1), row.name)
    local described = request and request.row or row
    if described.section then
        local section = root:add(modbus_made.fields.section, described.section):set_generated()
        section:append_text(": " .. described.description)
    end
    local context = {}
    for name, value in pairs(request and request.values or {}) do
        context[name] = value
    end
    for name, value in pairs(values) do
        context[name] = value
    end
    for _, place in ipairs(places) do
        local field = row[side .. "_fields"][place[1]]
        local is_item = AREAS[data:byte(2)] and (place[1] == "values" or place[1] == "value")
        local start = context.start or context.coil or context.register
        if is_item and start then
            local count = place[1] == "value" and 1 or context.count
            add_registers(root, data, range_of, place, start, count, profile)
        elseif field and not LISTS[field.kind] then
            local value = values[place[1]]
            local item = add_field(root, modbus_made, field, range_of(place[2], place[3]), value, context, profile)
            if place[1]:match("result$") and value ~= 0 then
                item:add_proto_expert_info(modbus_made.experts.refused, "The module reports an error")
            end
        end
    end
    if side == "request" and not has(row.models, profile) then
        local text = "The " .. profile.model.name .. " does not have " .. row.name
        root:add_proto_expert_info(modbus_made.experts.access, text)
    elseif side == "request" and AREAS[data:byte(2)] and not WRITES[data:byte(2)] then
        add_missing(root, data, values.start, values.count, profile)
    end
    if row == EXCEPTION then
        local why = described.exceptions and described.exceptions[values.exception_code]
        root:add_proto_expert_info(modbus_made.experts.refused, string.format("Refused: %s, exception %d%s",
            described.name or "unknown", values.exception_code, why and ": " .. why or ""))
    end
end

-- Whether a frame, here without CRC, is a response: by the direction of the packet, the port, who spoke first, or what
-- was asked. A host may repeat a request that nobody answered.
local function is_from_module(pinfo, line, body, request, profile)
    if pinfo.p2p_dir == SENT or pinfo.p2p_dir == RECEIVED then
        return pinfo.p2p_dir == RECEIVED
    elseif pinfo.src_port ~= 0 then
        local port = 502
        if pinfo.src_port == port or pinfo.dst_port == port then
            return pinfo.src_port == port
        end
        local sender = tostring(pinfo.src) .. " " .. pinfo.src_port
        hosts[line] = hosts[line] or sender
        return hosts[line] ~= sender
    end
    if not request or body:byte(1) ~= request.data:byte(1) or body:byte(2) % 128 ~= request.data:byte(2) then
        return false
    end
    return response_to(body, request, profile) ~= nil or request_of(body, profile) == nil
end

local function dissect_adu(tvb, start, data, transaction, pinfo, tree, n)
    local root = tree:add(i7000, tvb:range(start, #data))
    local function range_of(at, size)
        return tvb:range(start + at, size)
    end
    add_preference_fault(root, modbus_made)
    local line = line_of(pinfo)
    local key = line .. (transaction and " " .. transaction or "")
    local request = modbus_pairs.request(pinfo, key, n)
    local body = transaction and data or data:sub(1, -3)
    local profile = profile_of(interface_of(), #data > 0 and data:byte(1) or nil)
    local from_module = #body >= 2 and is_from_module(pinfo, line, body, request, profile)
    request = from_module and request or nil
    local fault
    if #data < (transaction and 2 or from_module and 5 or 4) or #data > 256 + (transaction and 4 or 0) then
        fault = "length"
    elseif not transaction and crc_of(data) ~= 0 then
        fault = "crc"
    end
    local row, values, places
    if not fault then
        if from_module then
            row, values, places = response_to(body, request, profile)
        else
            row, values, places = request_of(body, profile)
        end
        fault = not row and values or nil
    end
    local side = from_module and "response" or "request"
    local name = fault and FAULTS[fault] or from_module and row.response_name or row.name
    if row then
        root:add(modbus_made.fields.address, range_of(0, 1), body:byte(1))
        local shown = setmetatable({ name = name }, { __index = row })
        add_pdu(root, body, row == EXCEPTION and row or shown, values, places, side, request, range_of, profile)
    else
        add_fault(root, modbus_made, fault)
    end
    if request then
        add_request(root, modbus_made, pinfo, request)
        if row then
            modbus_pairs.answer(pinfo, request)
        end
    elseif from_module then
        root:add_proto_expert_info(modbus_made.experts.no_request)
    else
        add_errata(root, modbus_made, row and row.errata)
        add_answer(root, modbus_made, pinfo, modbus_pairs)
        modbus_pairs.ask(pinfo, key, (row or fault ~= "crc" and #body >= 2) and {
            row = row, values = row and values or {}, data = body, frame = pinfo.number, time = pinfo.rel_ts,
        } or nil)
    end
    root:append_text(", " .. name)
    local shown = (from_module and "<- " or "-> ") .. name .. (#body > 0 and ", address " .. body:byte(1) or "")
    if n == 1 and (#body < 2 or not transaction or body:byte(2) % 0x80 == 0x46) then
        pinfo.cols.info = shown
    else
        pinfo.cols.info:append(" | " .. shown)
    end
end

-- The frames of a packet, as Wireshark found them: the bytes, where they are, and the transaction of Modbus/TCP.
local function adus()
    local found = {}
    local units = { rtu_unit() }
    for index, unit in ipairs(units) do
        local after = units[index + 1]
        local stop = unit.source:len()
        if after and after.offset > unit.offset then
            stop = after.offset
        end
        found[#found + 1] = { unit.source, unit.offset, stop }
    end
    local lengths, transactions = { tcp_length() }, { tcp_transaction() }
    for index, unit in ipairs({ tcp_unit() }) do
        local length, transaction = lengths[index], transactions[index]
        if length and transaction then
            local stop = math.min(unit.offset + length.value, unit.source:len())
            found[#found + 1] = { unit.source, unit.offset, stop, transaction.value }
        end
    end
    return found
end

local function add_cut_off(tree, range)
    tree:add(i7000, range):add_proto_expert_info(modbus_made.experts.cut_off)
end

-- Whether a frame on a network is for these modules: of function 46h, or of any if the model is known.
local function is_ours(data)
    return profile_of(interface_of(), data:byte(1)).model or (data:byte(2) or 0) % 0x80 == 0x46
end

-- Every packet of a serial line is a frame, also those that Wireshark does not take for Modbus.
function i7000.dissector(tvb, pinfo, tree)
    local encapsulation = encapsulation_field()
    if i7000.prefs.rtu_link_type and encapsulation and encapsulation.value == wtap.USER0 and tvb:len() > 0 then
        pinfo.cols.protocol = "Modbus RTU"
        if tvb:reported_len() > tvb:len() then
            add_cut_off(tree, tvb:range())
        else
            dissect_adu(tvb, 0, tvb:raw(), nil, pinfo, tree, 1)
        end
        return
    end
    for n, adu in ipairs(adus()) do
        local source, start, stop, transaction = adu[1], adu[2], adu[3], adu[4]
        local data = stop > start and source:raw(start, stop - start)
        if data and is_ours(data) then
            if source:reported_len() > source:len() then
                add_cut_off(tree, source:range(start))
            else
                dissect_adu(source, start, data, transaction, pinfo, tree, n)
            end
        end
    end
end
