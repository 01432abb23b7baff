"""The dissector of both protocols for Wireshark: one Lua file, its guide, and the generator of the file."""
