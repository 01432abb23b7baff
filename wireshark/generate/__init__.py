"""The generator of the dissector: ``python -m wireshark.generate`` writes ``i7000.lua`` from ``spec/``.

Laws: the file depends on ``spec/`` and the templates alone, and the same ``spec/`` gives the same bytes. The templates
have the rules of the protocols; every row, name, range and text of a protocol is data from ``spec/``.
"""
