"""`fieldscribe explain`: everything about one address, code or name."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.conversation.explanation import Explanation
    from fieldscribe.conversation.lookup import Match
    from fieldscribe.model import Device

HELP = "say everything about one address, code or name"
EXAMPLE = """examples:
  fieldscribe explain hitachi_l200 A020
  fieldscribe explain hitachi_l200 0x1028
  fieldscribe explain hitachi_l200 modicon:4137 --as-documented
  fieldscribe explain woodward_mpu2s nr:2
  fieldscribe explain woodward_mpu2s can:321
  fieldscribe explain siemens_mm4 "P2010[1]"
  fieldscribe explain siemens_mm4 error:17
  fieldscribe explain hitachi_l200 unit:Hz

ends with 2 when nothing has that code, name or address, with 1 when the chosen variants do not have it"""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_device, add_format

    add_device(parser)
    parser.add_argument(
        "what",
        metavar="WHAT",
        help="a code, a name, or an address (4136, 0x1028, 1028h), [1] behind it for one element of an array; "
        "wire:, modicon:, code: or name: force one reading; can:, task:, response:, error:, function: ask for frames, "
        "unit: for a unit",
    )
    parser.add_argument(
        "--as-documented", action="store_true", help="show what the manual alone would say, without errata"
    )
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Explain; the exit code."""
    from fieldscribe.cli import FINE
    from fieldscribe.cli.common import StopError, open_device, print_json
    from fieldscribe.conversation.explain_other_items import explain_others
    from fieldscribe.conversation.lookup import near
    from fieldscribe.pasted_numbers import number_of
    from fieldscribe.user_errors import did_you_mean, quoted

    device = open_device(arguments)
    matches = _matches(device, arguments.what)
    explanations = _told(device, matches, as_documented=arguments.as_documented)
    explanations += explain_others(device, arguments.what)
    if not explanations:
        if arguments.what.strip().lower().startswith("unit:"):
            raise StopError(*_no_unit(arguments.what.partition(":")[2].strip()))
        hint = did_you_mean(near(device, arguments.what))
        if number_of(arguments.what.rpartition(":")[2].strip()) is not None:
            hint = hint.replace("did you mean", "described near it:").rstrip("?")
        raise StopError(f"{device.id} has no code, name or address `{quoted(arguments.what)}`", hint)
    if arguments.format == "json":
        readings = [{"readings": readings, **explanation.as_data()} for readings, explanation in explanations]
        print_json({"device": device.id, "what": arguments.what, "found": readings})
    else:
        _print(explanations, arguments.what)
    return FINE


def _no_unit(symbol: str) -> tuple[str, str]:
    """The message and the hint for a unit that is neither the description's nor a shipped one."""
    from fieldscribe.language.units import unit_hint
    from fieldscribe.user_errors import quoted

    return f"there is no unit `{quoted(symbol)}`", unit_hint(symbol, ())


def _matches(device: Device, what: str) -> list[Match]:
    """Every matching point that the chosen variants have. Raises StopError if they have none of the matches."""
    from fieldscribe.cli import FINDINGS
    from fieldscribe.cli.common import StopError
    from fieldscribe.conversation.lookup import find
    from fieldscribe.conversation.selection import absence
    from fieldscribe.wording import label

    matches = find(device, what)
    existing = [match for match in matches if not absence(device, match.point)]
    if matches and not existing:
        first = matches[0].point
        raise StopError(f"{label(first)}: {absence(device, first)}", "choose another --variant", FINDINGS)
    return existing


def _told(device: Device, matches: list[Match], *, as_documented: bool) -> list[tuple[list[str], Explanation]]:
    """The explanation of each matching point, with all readings of the question that lead to it."""
    from fieldscribe.conversation.explanation import explain_point

    readings: dict[str, list[str]] = {}
    points = {}
    for match in matches:
        word = f": {match.word}" if match.word else ""
        readings.setdefault(match.point.item, []).append(match.reading + word)
        points[match.point.item] = match.point
    return [
        (readings[item], explain_point(device, point, as_documented=as_documented)) for item, point in points.items()
    ]


def _print(explanations: list[tuple[list[str], Explanation]], what: str) -> None:
    from fieldscribe.cli.terminal import print_lines, print_rows
    from fieldscribe.user_errors import quoted

    if len(explanations) > 1:
        print_lines([[("strong", f"`{quoted(what)}` can mean {len(explanations)} things.")], []])
    for place, (readings, explanation) in enumerate(explanations):
        if place:
            print_lines([[]])
        print_rows(explanation.heading, [("Found as", "; ".join(readings)), *explanation.rows])
