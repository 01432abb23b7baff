"""A simulated bus to try drivers without hardware (extra ``simulator``).

Parts: `simulator` is the bus and its hosts. `sources` are the input signals, `recordings` the same from CSV files.
`faults` are the faults of the line, and `foreign` finds frames of the wrong protocol. `memory` keeps the EEPROMs in a
file, and `files` opens files safely. `pseudo_terminal`, `tcp` and `rfc2217` (with `telnet`) connect hosts to the bus.
``i7000 simulate`` combines them. From Python, in an event loop: ``async with listen(Simulator(modules)) as place``;
`Simulator.connect` puts other signals on the inputs, `Simulator.power_cycle` switches the power off and on.
Laws: time, randomness and I/O are here; the behaviour of modules is in `i7000.device`.
"""
