"""Imports the compiler from memory: with one changed module, or with functions that record their calls."""

from __future__ import annotations

import ast
import builtins
import sys
from collections.abc import Sequence
from functools import cache
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from types import CodeType, ModuleType

from mutants.rooms import HOUSE, MODULE, PACKAGE, functions_of

SEEN: set[str] = set()
"""The functions that were entered, as `path::name`, where they tell."""
_TELLS = "__fieldscribe_was_entered__"


def compiled() -> dict[str, CodeType]:
    """The code of each module, by its path."""
    texts = {path: path.read_text("utf-8") for path in PACKAGE.rglob("*.py")}
    return {str(path): compile(text, path, "exec", dont_inherit=True) for path, text in texts.items()}


@cache
def telling() -> dict[str, CodeType]:
    """Return the code of each module, with functions that record in SEEN that they were entered."""
    setattr(builtins, _TELLS, SEEN.add)
    found = {}
    for path in PACKAGE.rglob("*.py"):
        tree = ast.parse(path.read_text("utf-8"))
        name = path.relative_to(HOUSE).as_posix()
        bodies = [(node.body, inner) for node, inner in functions_of(tree)]
        for body, inner in [*bodies, (tree.body, MODULE)]:
            body.insert(_first(body), _note(f"{name}::{inner}"))
        found[str(path)] = compile(ast.fix_missing_locations(tree), path, "exec", dont_inherit=True)
    return found


def _note(name: str) -> ast.stmt:
    return ast.parse(f"{_TELLS}({name!r})").body[0]


def _first(body: Sequence[ast.stmt]) -> int:
    """The place behind a docstring and what must stand first."""
    return next((at for at, node in enumerate(body) if not _stands_first(node)), len(body))


def _stands_first(node: ast.stmt) -> bool:
    if isinstance(node, ast.ImportFrom):
        return node.module == "__future__"
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str)


class FromMemory:
    """Finds the compiler's modules where they lie, with the given code."""

    def __init__(self, codes: dict[str, CodeType], programs: dict[str, str]) -> None:
        self.codes, self.programs = codes, programs

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """The module with its code; None for the modules of others."""
        if name.partition(".")[0] != PACKAGE.name:
            return None
        spec = PathFinder.find_spec(name, [str(HOUSE)] if path is None else path, target)
        if spec is not None and spec.origin in self.codes:
            spec.loader = _Loader(name, spec.origin, self.codes[spec.origin], self.programs.get(spec.origin))
        return spec


class _Loader(SourceFileLoader):
    def __init__(self, name: str, path: str, code: CodeType, program: str | None) -> None:
        super().__init__(name, path)
        self._code, self._program = code, program

    def exec_module(self, module: ModuleType) -> None:
        """Execute the code; a program is found where its changed text lies."""
        module.__file__ = self._program or module.__file__
        super().exec_module(module)

    def get_code(self, fullname: str) -> CodeType:
        """The given one."""
        del fullname
        return self._code


def use(codes: dict[str, CodeType], programs: dict[str, str] | None = None) -> None:
    """Import the compiler like this from now on; it must not have been imported yet.

    `programs` are modules that others run as a process of its own, each with the file that has its text.
    """
    assert PACKAGE.name not in sys.modules
    sys.meta_path.insert(0, FromMemory(codes, programs or {}))
