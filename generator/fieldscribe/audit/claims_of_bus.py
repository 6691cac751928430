"""What commands, messages, telegrams, the bus and its frames take from their manual."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.audit.citing import Citing, Claim, numbers_in
from fieldscribe.families import families
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import parse_integer
from fieldscribe.model import Named

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.wordings import Wordings
    from fieldscribe.diagnostics import Span

SETTINGS = ("serial", "timing")
"""The keys of the bus that hold settings by name."""
_PARITIES = {
    "none": ("none", "keine", "kein", "ohne", "no"),
    "no parity": ("no parity", "keine", "kein", "ohne", "none"),
    "even": ("even", "gerade"),
    "odd": ("odd", "ungerade"),
}


def claims_of_entry(kind: str, entry: Map, wordings: Wordings) -> Iterator[Claim]:
    """The numbers of a command, a message or a telegram."""
    citing = Citing(f"{kind} {entry['name']}", entry.span("name"), entry.get("line"), entry.get("lines"))
    identifiers = tuple(key for family in families() if family.lays_out_messages for key in family.frame_keys)
    for key in ("at", *identifiers, "value", "length", "wears"):
        for number in numbers_in(entry.get(key)):
            yield from citing.numbers(key, str(number), (number,), place=entry.span(key))
    layout = entry.get("layout", Map(entry.file, entry.start))
    names = ("Byte", *wordings.code("byte"))
    for place, carried in layout.items():
        at, (first, *last) = layout.key_span(place), map(int, numbers_in(place))
        for number in numbers_in(place):
            yield from citing.numbers("layout", str(number), (number,), "bytes", names=names, place=at)
        for number in numbers_in(carried):
            yield from citing.numbers(
                "layout", str(number), (number,), "bytes", under=frozenset((Fraction(first),)), place=at
            )
        for byte in range(first + 1, max(last, default=first)):
            yield from citing.numbers("layout", str(byte), (Fraction(byte),), "bytes", optional=True, place=at)
    run = [Fraction(byte) for byte in range(max(map(int, numbers_in(list(layout))), default=-1) + 1)]
    if run:
        shown, at = f"bytes 0 to {len(run) - 1}", layout.span()
        yield from citing.in_order("layout", shown, [run], "bytes", optional=True, place=at)
        yield from citing.in_order("layout", shown, [run], "bytes", optional=True, closing=True, place=at)
    yield from citing.label("title", wordings.label(entry.get("title")), place=entry.span("title"))


def claims_of_line_settings(bus: Map) -> Iterator[Claim]:
    """The bit rate, which may be printed in kBaud, the length of identifiers, and whatever `lines` names a place of."""
    citing = Citing("bus", bus.span(), bus.get("line"), bus.get("lines"))
    for key, unit in (("bitrate", 1000), ("identifier_bits", 1)):
        for number in numbers_in(bus.get(key)):
            yield from citing.numbers(key, str(number), (number, number / unit), place=bus.span(key))
    for holder in (bus, *(bus[name] for name in SETTINGS if name in bus)):
        for key in citing.lines_of_fact:
            if key in holder and key not in ("bitrate", "identifier_bits"):
                yield from _claims_of_setting(citing, key, holder[key], holder.span(key))


def _claims_of_setting(citing: Citing, key: str, value: Any, place: Span) -> Iterator[Claim]:
    """A setting: its numbers and its parity; of codes with meanings, each code with what it means."""
    if isinstance(value, Map):
        for code, meaning in value.items():
            run = [*numbers_in(code), *numbers_in(meaning)]
            shown, at = f"{code}: {meaning}", value.span(code)
            words = parity_words(meaning)
            if len(run) > 1:
                yield from citing.in_order(key, shown, [run], place=at)
            if words and len(run) > 1:
                alike = "codes with their parity"
                yield from citing.in_order(key, shown, [run], optional=True, words=words, alike=alike, place=at)
            if words:
                yield from citing.label(key, words, beside=run if len(run) == 1 else (), place=at)
    else:
        for number in numbers_in(value):
            yield from citing.numbers(key, str(number), (number,), place=place)
        if words := parity_words(value):
            yield from citing.words(key, *words, place=place)


def parity_words(setting: Any) -> tuple[str, ...]:
    """How manuals write the parity that a setting names."""
    named = next((words for parity, words in _PARITIES.items() if re.search(rf"\b{parity}\b", str(setting))), ())
    return (*named, *map(str.capitalize, named))


def claims_of_codes(kind: str, codes: Any) -> Iterator[Claim]:
    """The numbers of function, response and exception codes; several codes may share a row, as in "9 - 12"."""
    rows: dict[int, list[Fraction]] = {}
    for key, entry in codes.items() if isinstance(codes, Map) else ():
        if isinstance(entry, Map) and "line" in entry:
            rows.setdefault(entry["line"], []).extend(numbers_in(key))
    for key, entry in codes.items() if isinstance(codes, Map) else ():
        if isinstance(entry, Map):
            about = Named(kind, parse_integer(key))
            citing = Citing(f"{kind} {key}", codes.key_span(key), entry.get("line"), entry.get("lines"), about)
            row = rows.get(entry.get("line", 0), [])
            ends = frozenset((min(row), max(row))) if len(row) > 2 else frozenset()
            for number in numbers_in(key):
                yield from citing.numbers("number", str(key), (number,), anchor=True, between=ends, first=True)
            for fact in ("max", "answers", "refusals"):
                for number in numbers_in(entry.get(fact)):
                    yield from citing.numbers(fact, str(number), (number,), place=entry.span(fact))
            for number in numbers_in(entry.get("printed", {}).get("bytes")):
                yield from citing.numbers("printed bytes", str(number), (number,), place=entry.span("printed"))


def claims_of_frames(file: Map) -> Iterator[Claim]:
    """The bytes of the worked frames, and the numbers that they are said to carry."""
    for frame in file.get("frames", ()):
        about = Named("frame", frame["name"])
        citing = Citing(f"frame {frame['name']}", frame.span("name"), frame.get("line"), frame.get("lines"), about)
        digits = "".join(str(frame["bytes"]).split()).upper()
        if citing.own_line:
            cited = citing.lines_of_fact.get("bytes", citing.own_line)
            place = frame.span("bytes")
            yield Claim(citing.subject, "bytes", digits, frozenset(), (), cited, place, about=about)
            for byte in range(1, len(digits) // 2 + 1):  # tables count the bytes
                yield from citing.numbers(
                    "place of a byte", str(byte), (Fraction(byte),), "bytes", optional=True, first=True
                )
        said = numbers_in(frame.get("says"))
        for number in dict.fromkeys(said):  # beside the bytes, or not at all
            printed_apart = "printed" in citing.lines_of_fact
            yield from citing.numbers(
                "says",
                str(number),
                (number,),
                "printed",
                optional=not printed_apart,
                times=said.count(number),
                place=frame.span("says"),
            )
