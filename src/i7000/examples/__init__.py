"""Example programs: `sync_driver` and `async_driver` on top of `i7000.link`, and `vector_runner` for ``i7000 vectors``.

The drivers read the inputs of a module once: ``python -m i7000.examples.sync_driver /dev/ttyUSB0 --model M-7019R``.
They need pyserial, extra `serial`. Exit code: 0 for a response, 1 without a response, 2 for wrong usage or a port that
cannot be opened or disappears, 130 after Ctrl-C. Ctrl-C during the import of the package `i7000`, before the program
runs, ends it with a traceback.
"""
