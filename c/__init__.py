"""The tables and vectors of ``spec/`` for C: headers to take along, an example, and the generator of the headers."""
