"""Mutation tests: one small change at a time to the code or to a cell of ``spec/``, and whether a test notices.

``python -m tests.mutation --help`` shows the options.
"""
