"""`fieldscribe search`: words in everything that descriptions name."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Sequence

    from fieldscribe.search.entries import Thing
    from fieldscribe.search.matching import Hit

HELP = "find words in titles, codes, sections, names, flags, labels and numbers of all devices"
EXAMPLE = """examples:
  fieldscribe search Hochlaufzeit
  fieldscribe search acceleration time
  fieldscribe search E07
  fieldscribe search error:21h
  fieldscribe search 4.2.40 --device woodward_mpu2s
  fieldscribe search ueberspannung --format json

All WORDS must occur in the texts of one thing, in any case and language; ä and ae are the same.
Exact codes and names come first. ends with 1 when nothing has them"""

_MOST = 20


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_descriptions, add_format

    parser.add_argument(
        "words", nargs="+", metavar="WORD", help="a word, a code, a section, or a number with its kind: error:21h"
    )
    parser.add_argument(
        "--device", action="append", default=[], metavar="DEVICE", help="only this device; may be repeated"
    )
    add_descriptions(parser)
    parser.add_argument(
        "--most", type=int, default=_MOST, metavar="N", help=f"show the nearest N, 0 for all (default: {_MOST})"
    )
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Search; the exit code."""
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import print_json, usage_error
    from fieldscribe.search.matching import near_words, search
    from fieldscribe.user_errors import did_you_mean, quoted

    things = _things(arguments)
    words = [word for text in arguments.words for word in text.split()]
    hits = search(things, words) if words else []
    near = [] if hits else near_words(things, words)
    if arguments.format == "json":
        print_json({"words": words, "hits": [_as_data(hit) for hit in hits], "near": near})
    elif hits:
        _print(hits, arguments.most)
    else:
        usage_error(f"nothing has `{quoted(' '.join(words))}`", did_you_mean(near))
    return FINE if hits else FINDINGS


def _things(arguments: Namespace) -> list[Thing]:
    """Everything that has a name in the devices that are meant; those with findings are left out, and named."""
    from argparse import Namespace as Chosen

    from fieldscribe.cli.common import device_file, devices_asked, usage_error
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import load_analysis
    from fieldscribe.search.entries import things_of

    folder = arguments.descriptions
    named = {name: device_file(Chosen(device=name, descriptions=folder)) for name in arguments.device}
    things: list[Thing] = []
    for name, file in (named or devices_asked(arguments)).items():
        subject = load_analysis(file, Report())
        if subject is None:
            usage_error(f"`{name}` has findings and is left out", f"fieldscribe check {name}")
        else:
            things += things_of(subject)
    return things


def _as_data(hit: Hit) -> dict[str, object]:
    thing = hit.thing
    matched = []
    for fact in hit.facts:
        span = fact.place()
        matched.append(
            {"what": fact.kind, "text": fact.text, "file": span.file, "line": span.line, "column": span.column}
        )
    return {"device": thing.device, "kind": thing.kind, "name": thing.name, "code": thing.code, "matched": matched}


def _print(hits: Sequence[Hit], most: int) -> None:
    from fieldscribe.cli.terminal import print_lines
    from fieldscribe.report import place_text, visible

    for hit in hits[: most or None]:
        print_lines([[("strong", visible(f"{hit.thing.device} {hit.thing.heading}"))]])
        for fact in hit.facts:
            said = f"{fact.kind} `{visible(fact.text)}`"
            number = "" if fact.number is None or fact.text == str(fact.number) else f" ({fact.number})"
            print_lines([[("", f"  {said}{number}, "), ("place", place_text(fact.place()))]])
    if most and len(hits) > most:
        print_lines([[("hint", f"and {len(hits) - most} more: --most 0 shows all")]])
