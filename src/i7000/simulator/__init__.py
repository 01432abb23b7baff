"""A simulated bus for drivers to be tried against, without hardware (extra ``simulator``).

Parts: `simulator` is the bus and its hosts, `sources` what is on the inputs, `recordings` the same from CSV files,
`faults` what the line does, `foreign` finds frames of the protocol that a module does not speak, `memory` the EEPROMs
in a file, `files` which files are opened; `pseudo_terminal`, `tcp` and `rfc2217`, on top of `telnet`, lead hosts to the
bus. ``i7000 simulate`` puts them together.
From Python, in an event loop: ``async with listen(Simulator(modules)) as place``; `Simulator.connect` puts other
signals on the inputs, `Simulator.power_cycle` takes the power away.
Laws: time, chance and I/O are here; how modules behave is in `i7000.device`.
"""
