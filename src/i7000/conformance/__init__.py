"""Conformance: what is required of a module, and whether one does it; generators without I/O and without a clock.

A check is a statement of ``spec/checks`` and the steps of `checks` that test it. `Subject` is the module under test
with its twin, the device model that has the same settings: it tells which answers are allowed. `run` carries out a plan
of checks. Nothing is sent but through the guard, which refuses what the user has not allowed.
"""
