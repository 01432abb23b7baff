"""Conformance: what the protocols require of modules, drivers and lines, and the judgement whether they do it."""
