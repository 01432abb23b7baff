"""The generator of the C files: ``python -m c.generate`` writes them from ``spec/``.

Laws: the files depend on ``spec/`` alone, and the same ``spec/`` gives the same bytes. Every value is stated once, as a
`Value`: its C text goes into a header, its bytes into the digest that ``i7000_selftest.c`` compares with.
"""
