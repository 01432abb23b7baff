-- Preferences, and where the dissectors are called.

local MODEL_CHOICES = { { 1, "unknown", 0 } }
for index, model in ipairs(MODELS) do
    MODEL_CHOICES[#MODEL_CHOICES + 1] = { index + 1, model.name, index }
end
local FORMAT_CHOICES = { { 1, "automatic", 0 }, { 2, "engineering", 1 }, { 3, "percent", 2 }, { 4, "hex", 3 } }
local MODBUS_FORMAT_CHOICES = { { 1, "engineering", 0 }, { 2, "hex", 2 } }
local CHECKSUM_CHOICES = { { 1, "automatic", 0 }, { 2, "disabled", 1 }, { 3, "enabled", 2 } }

i7000.prefs.model = Pref.enum("Model", 0, "The model of the modules; register names and types depend on it",
    MODEL_CHOICES)
i7000.prefs.firmware = Pref.string("Firmware", "", "The firmware of the modules, such as B3.7; empty: the newest")
i7000.prefs.types = Pref.string("Types", "",
    "The type of all channels, such as K, V_10, MA_4_20 or 0F, or one for each with / between; "
    .. "empty: what $AA2 and $AA8Ci returned, or the factory default")
i7000.prefs.format = Pref.enum("DCON format", 0,
    "The format of DCON readings; automatic: what $AA2 returned, or what they look like", FORMAT_CHOICES)
i7000.prefs.modbus_format = Pref.enum("Modbus format", 2, "The format of analog registers, coil 00269",
    MODBUS_FORMAT_CHOICES)
i7000.prefs.checksum = Pref.enum("DCON checksum", 0, "Whether DCON frames have a checksum", CHECKSUM_CHOICES)
i7000.prefs.single_ended = Pref.bool("Single-ended", false, "The inputs of a 7017Z are single-ended")
i7000.prefs.modules = Pref.string("Modules", "",
    "Modules that differ, with blanks between: 1=M-7019R@B3.7,type=K,checksum=true 2=I-7018,format=hex; "
    .. "before the address, the number of an interface and a colon may stand")
i7000.prefs.errata = Pref.bool("Errata", true, "Show where the manual is contradictory or silent")
i7000.prefs.rtu_link_type = Pref.bool("Modbus RTU on link type 147", true,
    "Captures of link type 147 (USER0) are Modbus RTU, as i7000 writes them")

dcon.prefs.tcp_port = Pref.uint("TCP port", 0, "The TCP port of a serial device server; 0: none")
dcon.prefs.link_type = Pref.bool("DCON on link type 148", true,
    "Captures of link type 148 (USER1) are DCON, as i7000 writes them")

local encapsulations, tcp_ports = DissectorTable.get("wtap_encap"), DissectorTable.get("tcp.port")
local before = {}

-- Take a link type, or give it back to whom it belonged to.
local function take(encapsulation, dissector, wanted)
    before[encapsulation] = before[encapsulation] or encapsulations:get_dissector(encapsulation)
    if wanted then
        encapsulations:add(encapsulation, dissector)
    elseif before[encapsulation] then
        encapsulations:add(encapsulation, before[encapsulation])
    end
end

local function take_rtu()
    take(wtap.USER0, Dissector.get("mbrtu"), i7000.prefs.rtu_link_type)
end

function i7000.prefs_changed()
    read_preferences(i7000.prefs)
    take_rtu()
end

local function take_dcon()
    take(wtap.USER1, dcon, dcon.prefs.link_type)
end

local port_before = 0

function dcon.prefs_changed()
    take_dcon()
    if dcon.prefs.tcp_port ~= port_before then
        if port_before ~= 0 then
            tcp_ports:remove(port_before, dcon)
        end
        if dcon.prefs.tcp_port ~= 0 then
            tcp_ports:add(dcon.prefs.tcp_port, dcon)
        end
        port_before = dcon.prefs.tcp_port
    end
end

tcp_ports:add_for_decode_as(dcon)
DissectorTable.get("udp.port"):add_for_decode_as(dcon)
take_dcon()
read_preferences(i7000.prefs)
take_rtu()
register_postdissector(i7000)
