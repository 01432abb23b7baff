"""Drivers as people write them, each with the usual slips: they fail, and the tests say in which scenarios."""
