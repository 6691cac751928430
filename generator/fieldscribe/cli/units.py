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
    """List them and return the exit code."""
    from fieldscribe.cli.common import print_json
    from fieldscribe.language.units import shipped

    known = list(shipped().values())
    chosen, code = _chosen(known, arguments.words) if arguments.words else (known, 0)
    if arguments.format == "json":
        print_json({"units": [_as_data(known_unit) for known_unit in chosen]})
    else:
        _print(chosen, every=bool(arguments.words))
    return code


def _chosen(known: Sequence[Known], words: Sequence[str]) -> tuple[list[Known], int]:
    """The units that the words name, and the exit code; reports words that name none."""
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import usage_error
    from fieldscribe.language.units import shipped_unit, unit_hint
    from fieldscribe.user_errors import quoted

    chosen: dict[str, Known] = {}
    code = FINE
    for word in words:
        unit = shipped_unit(word)
        here = [
            known_unit
            for known_unit in known
            if known_unit.unit == unit or (unit is None and word.casefold() in _words(known_unit))
        ]
        chosen |= {known_unit.unit.symbol: known_unit for known_unit in here}
        if not here:
            code = FINDINGS
            usage_error(f"no unit, name or quantity is `{quoted(word)}`", unit_hint(word, ()))
    return list(chosen.values()), code


def _words(known: Known) -> tuple[str, str]:
    return known.unit.name.casefold(), known.unit.quantity.casefold()


def _as_data(known: Known) -> dict[str, str]:
    """A unit for JSON; `factor` says exactly how many of `base` it is."""
    unit = known.unit
    described = {"symbol": unit.symbol, "name": unit.name, "quantity": unit.quantity}
    return {**described, "base": known.base, "factor": str(known.factor)}


def _print(chosen: Sequence[Known], *, every: bool) -> None:
    """Print a line for each unit; those with a prefix only behind their base unit, unless `every` is set."""
    from fieldscribe.cli.terminal import print_lines

    prefixes: dict[str, list[str]] = {}
    for known_unit in chosen:
        if known_unit.prefix:
            prefixes.setdefault(known_unit.base, []).append(known_unit.unit.symbol)
    shown = [known_unit for known_unit in chosen if every or not known_unit.prefix]
    width = max((len(known_unit.unit.symbol) for known_unit in shown), default=0)
    for known_unit in shown:
        behind = f" = {known_unit.factor} {known_unit.base}" if known_unit.prefix else ""
        also = "" if every else "".join(f", {symbol}" for symbol in prefixes.get(known_unit.base, ()))
        meaning = f"{known_unit.unit.name} ({known_unit.unit.quantity}){behind}" + (
            f"; also {also[2:]}" if also else ""
        )
        print_lines([[("strong", f"{known_unit.unit.symbol:<{width}}"), ("", f"  {meaning}")]])
