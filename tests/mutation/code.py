"""Mutants of Python files.

The changes are those of mutmut: its table of operators, applied by libcst. The rest of mutmut is not used: it changes
the bodies of undecorated functions alone, and what this package states in class bodies, in annotations of fields, in
tables and in properties (a third of all places) would never be changed.

Laws: every mutant can be parsed, and differs from the file in its syntax tree. Left out is what only a type checker
reads (annotations but those of a class's fields, the names of type variables, casts) and ``__all__``.
"""

from __future__ import annotations

import ast
from functools import cached_property
from typing import TYPE_CHECKING

import libcst as cst
from mutmut.mutation.mutators import mutation_operators

from tests.mutation.mutant import Mutant

if TYPE_CHECKING:
    from collections.abc import Iterator

NOT_CHANGED = frozenset({"cast", "len", "isinstance"})
"""Calls whose arguments stay, as in mutmut but for the first: they raise at once with any others."""


class CodeMutant(Mutant):
    """A Python file with one node replaced."""

    def __init__(self, file: str, text: str, module: cst.Module, old: cst.CSTNode, new: cst.CSTNode) -> None:
        super().__init__(file, text)
        self._module, self._old, self._new = module, old, new

    @cached_property
    def after(self) -> str:
        """The whole text of the file with the change."""
        changed = self._module.deep_replace(self._old, self._new)
        assert isinstance(changed, cst.Module)
        return changed.code


def code_mutants(file: str, text: str) -> list[CodeMutant]:
    """Every mutant of one Python file, in the order of the text."""
    module = cst.parse_module(text)
    visitor = _Visitor()
    module.visit(visitor)
    return [CodeMutant(file, text, module, old, new) for old, new in visitor.found]


def is_different(mutant: Mutant) -> bool:
    """Return whether Python reads the mutant, and reads another program there than in the file."""
    try:
        return ast.dump(ast.parse(mutant.after)) != ast.dump(ast.parse(mutant.before))
    except SyntaxError:
        return False


class _Visitor(cst.CSTVisitor):
    """Collects a pair of nodes for every change."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[tuple[cst.CSTNode, cst.CSTNode]] = []
        self._functions = 0

    def on_visit(self, node: cst.CSTNode) -> bool:
        """Collect the changes of this node; return whether to go on into it."""
        if self._is_left_out(node):
            return False
        if isinstance(node, cst.FunctionDef):
            self._functions += 1
        self.found += ((node, new) for new in changes(node))
        return True

    def on_leave(self, original_node: cst.CSTNode) -> None:
        if isinstance(original_node, cst.FunctionDef) and not self._is_left_out(original_node):
            self._functions -= 1

    def _is_left_out(self, node: cst.CSTNode) -> bool:
        match node:
            case cst.Annotation():
                return bool(self._functions)
            case cst.Call(func=cst.Name(value=name)):
                return name in NOT_CHANGED
            case (
                cst.Assign(targets=[cst.AssignTarget(target=cst.Name(value="__all__"))])
                | cst.Assign(value=cst.Call(func=cst.Name(value="TypeVar")))
                | cst.FunctionDef(decorators=[cst.Decorator(decorator=cst.Name(value="overload")), *_])
                | cst.If(test=cst.Name(value="TYPE_CHECKING"))
            ):
                return True
            case _:
                return False


def changes(node: cst.CSTNode) -> Iterator[cst.CSTNode]:
    """Yield what mutmut replaces a node by."""
    for kind, operator in mutation_operators:
        if isinstance(node, kind):
            yield from operator(node)
