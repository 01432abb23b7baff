"""Fuzz targets: functions of bytes that raise if a property of the library does not hold.

`targets` lists them, `engine` runs one under Atheris, `campaign` runs them all and keeps the ledger. `seeds` makes
their first inputs from ``spec/vectors``. Every file in ``regressions`` is run by pytest. ``docs/fuzzing.md`` is the
guide.
"""
