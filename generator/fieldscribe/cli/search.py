"""`fieldscribe search`: words in everything that descriptions name."""

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence

from fieldscribe.cli import common
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.diagnostics import Report, did_you_mean, place_text, visible
from fieldscribe.pipeline import load_analysis
from fieldscribe.search import Entry, Hit, entries_of, near_words, search
from fieldscribe.text import shortened

EXAMPLE = """examples:
  fieldscribe search Hochlaufzeit
  fieldscribe search acceleration time
  fieldscribe search E07
  fieldscribe search error:21h
  fieldscribe search 4.2.40 --device woodward_mpu2s
  fieldscribe search ueberspannung --format json

All WORDs must occur in the texts of one point, command, message or code, in any case and language; ä and ae are the
same. Exact codes and names come first.

ends with 1 when nothing has all words"""

_MOST = 20
_MOST_WORDS = 20


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("words", nargs="+", metavar="WORD", help="a word, a code, a section, or a number with its kind: error:21h")
    common.add_repeated(parser, "--device", "DEVICE", "only this device")
    common.add_descriptions(parser)
    add("--most", type=int, default=_MOST, metavar="N", help=f"print the nearest N, 0 for all (default: {_MOST})")
    common.add_format(parser)


def run(arguments: Namespace) -> int:
    """Search and print the hits; return the exit code."""
    words = [word for text in arguments.words for word in text.split()]
    if not words:
        raise common.StopError("there is no word to search", "give a word, a code or a section")
    if len(words) > _MOST_WORDS:
        raise common.StopError(f"{len(words)} words are too many", f"give at most {_MOST_WORDS}: all must occur")
    entries = _entries(arguments)
    hits = search(entries, words)
    near = [] if hits else near_words(entries, words)
    if arguments.format == "json":
        common.print_json({"words": words, "hits": [_as_data(hit) for hit in hits], "near": near})
    elif hits:
        _print(hits, arguments.most)
    else:
        common.usage_error(f"nothing has `{shortened(' '.join(words))}`", did_you_mean(near))
    return FINE if hits else FINDINGS


def _entries(arguments: Namespace) -> list[Entry]:
    """Return the entries of the chosen devices; those with errors are left out, with a message."""
    folder = arguments.descriptions
    named = {name: common.device_file(Namespace(device=name, descriptions=folder)) for name in arguments.device}
    entries: list[Entry] = []
    for name, file in (named or common.searched_devices(arguments)).items():
        subject = load_analysis(file, Report())
        if subject is None:
            common.usage_error(f"`{name}` has errors and is left out", f"fieldscribe check {name}")
        else:
            entries += entries_of(subject)
    return entries


def _as_data(hit: Hit) -> dict[str, object]:
    matched = []
    for text in hit.texts:
        span = text.place()
        matched.append(
            {"what": text.kind, "text": text.text, "file": span.file, "line": span.line, "column": span.column}
        )
    entry = hit.entry
    return {"device": entry.device, "kind": entry.kind, "name": entry.name, "code": entry.code, "matched": matched}


def _print(hits: Sequence[Hit], most: int) -> None:
    for hit in hits[: most if most > 0 else None]:
        print_lines([[("strong", visible(f"{hit.entry.device} {hit.entry.heading}"))]])
        for text in hit.texts:
            number = "" if text.number is None or text.text == str(text.number) else f" ({text.number})"
            found = f"  {text.kind} `{visible(text.text)}`{number}, "
            print_lines([[("", found), ("place", place_text(text.place()))]])
    if 0 < most < len(hits):
        print_lines([[("hint", f"and {len(hits) - most} more: --most 0 shows all")]])
