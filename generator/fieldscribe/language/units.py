"""The shipped units: their symbols, the factors between them, and hints for unknown symbols."""

import re
from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from fieldscribe.diagnostics import Report
from fieldscribe.language.load import load
from fieldscribe.language.nodes import SourceFile
from fieldscribe.model import Unit

LISTED = "`fieldscribe units` lists what is known"
_STEPPED = r"([0-9]{1,9}(?:[.,][0-9]{1,9}|/[0-9]{1,9})?)[ *x]*([^ 0-9*x].*)"
"""A resolution, such as `0.1 Hz`."""
_NO_UNIT = frozenset({"", "-", "--", "1", "none", "n/a", "number", "count", "counts", "raw", "bool", "enum", "hex"})
_SAME = str.maketrans({"\u03bc": "\u00b5", "\u2126": "\u03a9"})
"""Micro and ohm each have two characters that look the same."""
_PREFIX_LETTERS = frozenset("yzafpnµmcdhkMGTPEZY")


class Known(NamedTuple):
    """A shipped unit; 1 of it is `factor` times `base`, the unit without a prefix."""

    unit: Unit
    base: str
    factor: Fraction
    prefix: str
    spellings: tuple[str, ...]
    """Other spellings of it."""


@cache
def shipped() -> Mapping[str, Known]:
    """Return all shipped units by symbol; each is followed by its forms with prefixes."""
    table = _table()
    units: dict[str, Known] = {}
    for symbol, entry in table["units"].items():
        for known in _with_prefixes(symbol, entry, table["prefixes"]):
            if known.unit.symbol in units:
                raise ValueError(f"units.yaml: `{known.unit.symbol}` has two meanings")
            units[known.unit.symbol] = known
    return units


def shipped_unit(symbol: str) -> Unit | None:
    """Return the shipped unit of a symbol, or None; micro may be written with either of its characters."""
    known = shipped().get(symbol.translate(_SAME))
    return None if known is None else known.unit


def factor_between(typed: str, unit: Unit) -> Fraction | None:
    """Return the factor from the `typed` unit to the other; None unless they differ only in the prefix."""
    mine, other = shipped().get(typed.translate(_SAME)), shipped().get(unit.symbol)
    if mine is None or other is None or other.unit != unit or mine.base != other.base:
        return None
    return mine.factor / other.factor


def unit_hint(typed: str, declared: Iterable[str]) -> str:
    """Return the hint for an unknown unit; a unit of another size or quantity is never the only suggestion."""
    if typed.casefold() in _NO_UNIT:
        return "a plain number has no unit: leave `unit` out"
    stepped = re.fullmatch(_STEPPED, typed)
    if stepped is not None and (shipped_unit(stepped[2]) or stepped[2] in declared):
        scale = f"`scale: value = raw * {stepped[1].replace(',', '.')}`"
        return f"write `unit: {stepped[2]}`; what one raw step is worth belongs to the scale: {scale}"
    symbols = _likely_symbols(typed, declared)
    if not symbols:
        return f"declare it under `units`: `units: {{{_as_key(typed)}: {{name: …, quantity: …}}}}`; {LISTED}"
    return f"write {' or '.join(_symbol_with_name(symbol, alone=len(symbols) == 1) for symbol in symbols)}"


def _symbol_with_name(symbol: str, *, alone: bool) -> str:
    """Return a symbol, with its name if there are several to choose from."""
    known = shipped().get(symbol)
    return f"`{symbol}`" if alone or known is None else f"`{symbol}` ({known.unit.name})"


def _as_key(typed: str) -> str:
    """Return a symbol as a YAML key in braces, quoted if necessary."""
    return typed if typed.replace("/", "").isalnum() else f'"{typed}"'


def _likely_symbols(typed: str, declared: Iterable[str]) -> list[str]:
    """Return the symbols that a text probably means; those with another prefix come last."""
    folded = _folded(typed)
    symbols = [symbol for symbol in declared if _folded(symbol) == folded]
    spelled = [known for known in shipped().values() if folded in _spelled(known)]
    near = [known for known in spelled if _same_prefix(typed, known) and not _other_letter(typed, known)]
    if not near:
        return symbols
    exact = [known for known in near if _with_micro(typed) in (known.unit.symbol, *known.spellings)]
    if exact:
        return [known.unit.symbol for known in exact]
    far = [known for known in spelled if known not in near and not _other_letter(typed, known)]
    return list(dict.fromkeys((*symbols, *(known.unit.symbol for known in (*near, *far)))))


def _same_prefix(typed: str, known: Known) -> bool:
    """Return True if the unit has the typed prefix: `MV` is not `mV`, but `KW` can only be `kW`; names always fit."""
    first = typed.translate(_SAME)[:1].replace("u", "µ")
    if not known.prefix or first == known.prefix or first not in _PREFIX_LETTERS:
        return True
    return _folded(typed) in _named(known)


def _other_letter(typed: str, known: Known) -> bool:
    """Return True if the case of the last letter makes it another unit: `M` is no metre, `mh` no henry."""
    letter = typed[-1:]
    if len(known.base) != 1 or letter == known.base or letter.casefold() != known.base.casefold():
        return False
    return letter in shipped() or (len(typed) == 1 and letter.isupper())


@cache
def _named(known: Known) -> frozenset[str]:
    name = known.unit.name.casefold()
    return frozenset({name, f"{name}s"})


@cache
def _spelled(known: Known) -> frozenset[str]:
    return _named(known) | {_folded(spelling) for spelling in (known.unit.symbol, *known.spellings)}


def _folded(text: str) -> str:
    """Return the text in lower case and with one character for micro, for comparing."""
    return _with_micro(text.translate(_SAME).casefold())


def _with_micro(text: str) -> str:
    """Return the text with the proper character for micro; keyboards have `u`."""
    text = text.translate(_SAME)
    return f"µ{text[1:]}" if text[:1] == "u" else text


def _with_prefixes(symbol: str, entry: Mapping[str, Any], prefixes: Mapping[str, Any]) -> Iterator[Known]:
    also = tuple(entry.get("also", ()))
    yield Known(Unit(symbol, entry["name"], entry["quantity"]), symbol, Fraction(1), "", also)
    for prefix in entry.get("prefixes", "").split():
        described = prefixes[prefix]
        unit = Unit(prefix + symbol, described["name"] + entry["name"], entry["quantity"])
        spellings = tuple(prefix + other for other in also)
        yield Known(unit, symbol, Fraction(10) ** int(described["power"]), prefix, spellings)


def _table() -> Mapping[str, Any]:
    path = Path(__file__).with_name("units.yaml")
    report = Report()
    (table,) = load(SourceFile(path.name, path.read_text("utf-8")), report)
    if table is None or report.has_errors:
        raise ValueError(f"units.yaml is broken: {report.findings}")
    return table
