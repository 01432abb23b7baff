"""Modules on a simulated line: what real ones would answer, to any client that can open it (extra ``simulator``)."""
