"""`fieldscribe units`: the units that need no declaration."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Sequence

    from fieldscribe.language.units import Known

HELP = "list the units that descriptions can use without declaring them"
EXAMPLE = """examples:
  fieldscribe units
  fieldscribe units kVAh mW
  fieldscribe units pressure --format json

A description declares other units under `units`, and may give one of these symbols another meaning there.
ends with 1 when a WORD names no unit"""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_format

    parser.add_argument(
        "words", nargs="*", metavar="WORD", help="a symbol (its case counts), a name or a quantity (default: all units)"
    )
    add_format(parser)


def run(arguments: Namespace) -> int:
    """List them; the exit code."""
    from fieldscribe.cli.common import print_json
    from fieldscribe.language.units import shipped

    known = list(shipped().values())
    found, code = _chosen(known, arguments.words) if arguments.words else (known, 0)
    if arguments.format == "json":
        print_json({"units": [_as_data(one) for one in found]})
    else:
        _print(found, every=bool(arguments.words))
    return code


def _chosen(known: Sequence[Known], words: Sequence[str]) -> tuple[list[Known], int]:
    """The units that the words name, and the exit code; words that name none are told."""
    from fieldscribe.asked import quoted
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import usage_error
    from fieldscribe.language.units import shipped_unit, unit_hint

    found: dict[str, Known] = {}
    code = FINE
    for word in words:
        unit = shipped_unit(word)
        here = [one for one in known if one.unit == unit or (unit is None and word.casefold() in _words(one))]
        found |= {one.unit.symbol: one for one in here}
        if not here:
            code = FINDINGS
            usage_error(f"no unit, name or quantity is `{quoted(word)}`", unit_hint(word, ()))
    return list(found.values()), code


def _words(known: Known) -> tuple[str, str]:
    return known.unit.name.casefold(), known.unit.quantity.casefold()


def _as_data(known: Known) -> dict[str, str]:
    """A unit for JSON; `factor` says exactly how many of `base` it is."""
    unit = known.unit
    described = {"symbol": unit.symbol, "name": unit.name, "quantity": unit.quantity}
    return {**described, "base": known.base, "factor": str(known.factor)}


def _print(found: Sequence[Known], *, every: bool) -> None:
    """One line a unit; units with a prefix stand behind the unit itself unless `every` one was asked for by name."""
    from fieldscribe.cli.terminal import print_lines

    prefixes: dict[str, list[str]] = {}
    for one in found:
        if one.prefix:
            prefixes.setdefault(one.base, []).append(one.unit.symbol)
    shown = [one for one in found if every or not one.prefix]
    width = max((len(one.unit.symbol) for one in shown), default=0)
    for one in shown:
        behind = f" = {one.factor} {one.base}" if one.prefix else ""
        also = "" if every else "".join(f", {symbol}" for symbol in prefixes.get(one.base, ()))
        said = f"{one.unit.name} ({one.unit.quantity}){behind}" + (f"; also {also[2:]}" if also else "")
        print_lines([[("strong", f"{one.unit.symbol:<{width}}"), ("", f"  {said}")]])
