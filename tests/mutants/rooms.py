"""The rooms of the compiler, taken from its folders, and the mutants that are drawn from each."""

from __future__ import annotations

import ast
import random
from collections.abc import Iterator
from functools import cache

from mutants.judges import ROOT
from mutants.sources import Mutant, Source, changed, of_kind
from mutants.tokens import line_starts, span

HOUSE = ROOT / "generator"
PACKAGE = HOUSE / "fieldscribe"
TOP = "fieldscribe"
"""The room of the modules that lie in no folder."""
SHARED = ("families", "targets")
"""Folders whose folders are rooms of their own."""

MODULE = ""
"""What the body of a module is called among its functions."""


@cache
def rooms() -> dict[str, list[Source]]:
    """The files of each room."""
    found: dict[str, list[Source]] = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        name = path.relative_to(HOUSE).as_posix()
        room = room_of(path.relative_to(PACKAGE).parts)
        found.setdefault(room, []).append(Source("generator", room, "", name, path.read_text("utf-8")))
    return found


def room_of(parts: tuple[str, ...]) -> str:
    """The room of a module, by its path in the package."""
    depth = 2 if parts[0] in SHARED and len(parts) > 2 else 1
    return "/".join(parts[:depth]) if len(parts) > 1 else TOP


def drawn_in(room: str, sources: list[Source], seed: str) -> Iterator[Mutant]:
    """Different mutants of a room, until there are no more."""
    return of_kind(sources, random.Random(f"{seed} generator {room}"))


@cache
def functions(source: Source) -> list[tuple[int, int, str]]:
    """Where each function of a file stands, and its name, the outer ones first."""
    starts, lines = line_starts(source.text), source.text.encode("utf-8").splitlines(keepends=True)
    return [(*span(node, starts, lines), name) for node, name in functions_of(ast.parse(source.text))]


def functions_of(tree: ast.AST, outer: str = "") -> Iterator[tuple[ast.FunctionDef, str]]:
    """Each function below a node, with its name in the module."""
    for node in ast.iter_child_nodes(tree):
        name = f"{outer}{getattr(node, 'name', '')}"
        if isinstance(node, ast.FunctionDef):
            yield node, name
        inner = f"{name}." if isinstance(node, ast.FunctionDef | ast.ClassDef) else outer
        yield from functions_of(node, inner)


def place_of(mutant: Mutant) -> str:
    """The function that a mutant changes, as `path::name`; the module alone if it is in none."""
    source = next(one for room in rooms().values() for one in room if one.path == mutant.path)
    start, _ = changed(source.text, mutant.text)
    around = [name for first, end, name in functions(source) if first <= start < end]
    return f"{mutant.path}::{around[-1] if around else MODULE}"
