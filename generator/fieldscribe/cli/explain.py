"""`fieldscribe explain`: everything about one address, code or name."""

from argparse import ArgumentParser, Namespace
from contextlib import suppress

from fieldscribe.cli.common import StopError, add_device, add_format, add_repeated, print_json
from fieldscribe.cli.frame_options import model_of
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines, print_rows
from fieldscribe.conversation.explanation import Explanation, explain_other_items, explain_point
from fieldscribe.conversation.lookup import Match, advice, find, prefixes
from fieldscribe.conversation.selection import absence
from fieldscribe.families import family
from fieldscribe.grouping import grouped
from fieldscribe.language.units import unit_hint
from fieldscribe.model import Device
from fieldscribe.pasted_numbers import HexError, number_of, parse_hex
from fieldscribe.text import shortened
from fieldscribe.wording import label

Found = tuple[list[str], Explanation]
"""The readings of WHAT, and the explanation of what it means."""

_SHORTEST_FRAME = 4

EXPLAIN_EXAMPLE = """examples:
  fieldscribe explain hitachi_l200 A020
  fieldscribe explain hitachi_l200 0x1028
  fieldscribe explain hitachi_l200 modicon:4137 --as-documented
  fieldscribe explain woodward_mpu2s nr:2
  fieldscribe explain woodward_mpu2s can:321
  fieldscribe explain siemens_mm4 "P2010[1]"
  fieldscribe explain siemens_mm4 error:17
  fieldscribe explain hitachi_l200 unit:Hz
  fieldscribe explain hitachi_l200 d001 --raw 0xFE0C

ends with 2 when nothing has that code, name or address, with 1 when only other variants have it"""


def add_explain_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add_device(parser)
    add(
        "what",
        metavar="WHAT",
        help="a code, a name, or an address (4136, 0x1028, 1028h); [1] after it chooses an element of an array; "
        "wire:, modicon:, code: or name: before it force one reading; can:, task:, response:, error:, function: "
        "look up frames, unit: a unit",
    )
    add_repeated(parser, "--with", "NAME=NUMBER", "a number that addresses depend on, such as slot=3", dest="settings")
    add("--raw", metavar="NUMBER", help="also say what this raw number of the point means: 65036, 0xFE0C, -500")
    add("--as-documented", action="store_true", help="show what the manual alone would say, without errata")
    add_format(parser)


def run_explain(arguments: Namespace) -> int:
    """Print all explanations of WHAT; return the exit code."""
    device, what = model_of(arguments), arguments.what
    if not what.strip():
        raise StopError("there is nothing to explain", "give a code, a name or an address")
    raw = None if arguments.raw is None else _raw_number(arguments.raw)
    found = _points(device, find(device, what), as_documented=arguments.as_documented, raw=raw)
    found += explain_other_items(device, what)
    if not found:
        raise _nothing_found(device, what)
    if arguments.format == "json":
        data = [{"readings": readings, **explanation.as_data()} for readings, explanation in found]
        print_json({"device": device.id, "what": what, "found": data})
        return FINE
    if len(found) > 1:
        print_lines([[("strong", f"`{shortened(what)}` can mean {len(found)} things.")], []])
    for place, (readings, explanation) in enumerate(found):
        if place:
            print_lines([[]])
        print_rows(explanation.heading, [("Found as", "; ".join(readings)), *explanation.rows])
    return FINE


def _raw_number(text: str) -> int:
    """Return a typed raw number. Raises StopError."""
    number = number_of(text.strip().removeprefix("-"))
    if number is None:
        raise StopError(f"--raw {shortened(text)}: this is no whole number", "as in 65036, 0xFE0C, FE0Ch or -500")
    return -number if text.strip().startswith("-") else number


def _points(device: Device, matches: list[Match], *, as_documented: bool, raw: int | None) -> list[Found]:
    """Return the explanation of each matching point. Raises StopError if the chosen variants have none of them."""
    existing = [match for match in matches if not absence(device, match.point)]
    if matches and not existing:
        first = matches[0].point
        raise StopError(f"{label(first)}: {absence(device, first)}", "choose another --variant", FINDINGS)
    readings = grouped((match.point.item, match.reading + (match.word and f": {match.word}")) for match in existing)
    points = {match.point.item: match.point for match in existing}
    return [
        (readings[item], explain_point(device, point, as_documented=as_documented, raw=raw))
        for item, point in points.items()
    ]


def _nothing_found(device: Device, what: str) -> StopError:
    kind, _, rest = what.rpartition(":")
    kind = kind.strip().lower()
    if kind == "unit":
        return StopError(f"there is no unit `{shortened(rest.strip())}`", unit_hint(rest.strip(), ()))
    return StopError(f"{device.id} has no code, name or address `{shortened(what)}`", _advice(device, kind, what))


def _advice(device: Device, kind: str, what: str) -> str:
    """Return advice: a code of this kind, another kind, `decode` for a frame, or similar names."""
    own_family = family(device.family)
    kinds = {codes.kind: codes for codes in own_family.codes}
    if kind in kinds:
        known = ", ".join(str(code.number) for code in device.bus.codes(kinds[kind].section))
        return f"it has {known}" if known else f"the description lists no {kind}"
    before = [*prefixes(device), *kinds, "unit", *([own_family.name] if own_family.lays_out_messages else [])]
    if kind and kind not in before:
        return f"before a colon stands one of {', '.join(before)}"
    if kind == own_family.name:
        return ""
    with suppress(HexError):
        if len(parse_hex(what)) > _SHORTEST_FRAME:
            return f'for a frame there is `fieldscribe decode {device.id} "…"`'
    return advice(device, what)
