"""Writes the table of keys as Markdown: descriptions/KEYS.md."""

from __future__ import annotations

from collections.abc import Iterator

from fieldscribe.language.keys import forms, keys_of
from fieldscribe.language.keys.places import PLACES
from fieldscribe.language.load import flow_text
from fieldscribe.schema_types import BOOLEAN, NOTHING, Kind, Place, Shape, Text, Whole, says_yes_or_no

_FEW = 2


def keys_markdown() -> str:
    """Return the page, with a table for each kind of mapping."""
    lines = ["# All keys of the description language", ""]
    lines += ["Made by `make keys` from the table of keys; `README.md` beside this page shows them at work.", ""]
    lines += ["Whole numbers are written as manuals write them: `4136`, `0x1028`, `1028h`, `H'33F`, `0b0101`.", ""]
    lines += ["`true` and `false` mean the same as `yes` and `no`.", ""]
    for place in PLACES:
        lines += [f"## {place.heading}", "", place.shape.meaning, ""]
        lines += ["| key | type | meaning | example |", "|---|---|---|---|"]
        lines += [f"| {' | '.join(row)} |" for row in _rows(place)]
        lines.append("")
    return "\n".join(lines)


def _rows(place: Place, prefix: str = "") -> Iterator[tuple[str, ...]]:
    """Yield the rows of the keys of a place, and of the keys inside of places that have no table."""
    for name, key in keys_of(place).items():
        if place not in key.places:
            continue  # the key of a place with its own table
        needed = " **Required.**" if place in key.required else ""
        yield f"`{prefix}{name}`", _type(key.shape), _meaning(key.shape) + needed, _example(key.shape)
        if len(key.places) <= _FEW or not _leads_to_a_table(key.shape):
            yield from _inside(key.shape, f"{prefix}{name}.")
    for form, shape in place.by_form.items():
        yield f"`{prefix}{form.sign}`", _type(shape), _meaning(shape), _example(shape)
        yield from _inside(shape, f"{prefix}{form.sign}.")


def _inside(shape: Shape, prefix: str) -> Iterator[tuple[str, ...]]:
    for kind in shape.kinds:
        if isinstance(kind, Place) and not kind.heading and forms.LANGUAGE not in kind.by_form:
            yield from _rows(kind, prefix)


def _leads_to_a_table(shape: Shape) -> bool:
    """Return True if the values inside have a table, so that their keys need not be repeated."""
    inner = [
        kind
        for outer in shape.kinds
        if isinstance(outer, Place)
        for inner in outer.by_form.values()
        for kind in inner.kinds
    ]
    return any(isinstance(kind, Place) and kind.heading for kind in inner)


def _meaning(shape: Shape) -> str:
    return shape.meaning.replace("|", "\\|")


def _type(shape: Shape) -> str:
    kinds = [kind for kind in shape.kinds if kind is not BOOLEAN or not says_yes_or_no(shape)]
    return ", ".join(map(_kind, kinds)) or "any"


def _kind(kind: Kind) -> str:
    if isinstance(kind, Text | Whole) and kind.choices:
        return ", ".join(f"`{choice}`" for choice in kind.choices)
    return "`~`" if kind is NOTHING else kind.words.removeprefix("a ")


def _example(shape: Shape) -> str:
    return f"`{flow_text(shape.examples[0])}`".replace("|", "\\|") if shape.examples else ""
