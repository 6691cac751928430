"""`fieldscribe units`: the units that need no declaration."""

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence

from fieldscribe.cli.common import add_format, print_json, usage_error
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.grouping import grouped
from fieldscribe.language.units import Known, shipped, shipped_unit, unit_hint
from fieldscribe.text import shortened

EXAMPLE = """examples:
  fieldscribe units
  fieldscribe units kVAh mW
  fieldscribe units pressure --format json

A description declares other units under `units`, and may give one of these symbols another meaning there.

ends with 1 when a WORD names no unit"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument(
        "words", nargs="*", metavar="WORD", help="a symbol (its case counts), a name or a quantity (default: all units)"
    )
    add_format(parser)


def run(arguments: Namespace) -> int:
    """List the units; return the exit code."""
    chosen: dict[str, Known] = {} if arguments.words else dict(shipped())
    code = FINE
    for word in arguments.words:
        found = _named(word)
        chosen |= {known.unit.symbol: known for known in found}
        if not found:
            code = FINDINGS
            usage_error(f"no unit, name or quantity is `{shortened(word)}`", unit_hint(word, ()))
    if arguments.format == "json":
        print_json({"units": [_as_data(known) for known in chosen.values()]})
    else:
        _print(list(chosen.values()), with_prefixes=bool(arguments.words))
    return code


def _named(word: str) -> list[Known]:
    """Return the unit with this symbol, else all units with this name or quantity."""
    unit, name = shipped_unit(word), word.casefold()
    if unit is not None:
        return [known for known in shipped().values() if known.unit == unit]
    return [
        known for known in shipped().values() if name in (known.unit.name.casefold(), known.unit.quantity.casefold())
    ]


def _as_data(known: Known) -> dict[str, str]:
    """Return a unit for JSON; `factor` is its exact size in `base`."""
    unit = known.unit
    described = {"symbol": unit.symbol, "name": unit.name, "quantity": unit.quantity}
    return {**described, "base": known.base, "factor": str(known.factor)}


def _print(chosen: Sequence[Known], *, with_prefixes: bool) -> None:
    """Print a line for each unit; prefixed units have their own only `with_prefixes`, else they follow their base."""
    prefixed = grouped((known.base, known.unit.symbol) for known in chosen if known.prefix)
    listed = [known for known in chosen if with_prefixes or not known.prefix]
    width = max((len(known.unit.symbol) for known in listed), default=0)
    for known in listed:
        text = f"{known.unit.name} ({known.unit.quantity})"
        if known.prefix:
            text += f" = {known.factor} {known.base}"
        elif not with_prefixes and known.base in prefixed:
            text += f"; also {', '.join(prefixed[known.base])}"
        print_lines([[("strong", f"{known.unit.symbol:<{width}}"), ("", f"  {text}")]])
