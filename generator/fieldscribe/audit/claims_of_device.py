"""All claims of a description, the printed texts of its errata, and the lines that it passes over."""

import re
from collections.abc import Iterator
from fractions import Fraction
from typing import Any, NamedTuple

from fieldscribe.audit.claims import Bytes, Cited, Claim, ClaimMaker, Label, Number, absolute, cited_lines, numbers_in
from fieldscribe.audit.numbers import Notation
from fieldscribe.audit.point_claims import PointClaims
from fieldscribe.diagnostics import Span
from fieldscribe.families import families, sections_of_codes
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import parse_integer
from fieldscribe.model import About, Named
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.errata import LocatedErratum

_ENTRIES = {"command": "commands", "message": "messages", "telegram": "telegrams"}
"""Sections of named entries, by the word for one."""
_SETTINGS = ("serial", "timing")
"""The keys of the bus that hold settings by name."""
_LINES_NAMED = re.compile(r"\blines?\s+[0-9]+(?:(?:,|\s+and|\s+to|\.\.)\s*[0-9]+)*(?:\s+and\s+[0-9]+)?")
_QUOTED = re.compile('["\u201e\u201c]([^"\u201c\u201d]+)["\u201c\u201d]')
_PARITIES = {
    "none": ("none", "keine", "kein", "ohne", "no"),
    "no parity": ("no parity", "keine", "kein", "ohne", "none"),
    "even": ("even", "gerade"),
    "odd": ("odd", "ungerade"),
}


def claims_of(subject: Analysis) -> list[Claim]:
    """Return the claims of a description, each once: an address printed in three notations is one fact."""
    return list({claim.identity: claim for claim in reversed(list(_all_claims(subject)))}.values())[::-1]


def _all_claims(subject: Analysis) -> Iterator[Claim]:
    notation = Notation(subject.scope.header["documents"])
    shared = _shared_numberings(subject)
    for resolved in subject.resolved:
        yield from PointClaims(resolved.point, resolved.facts, subject.scope.named_enums, notation).all(shared)
    for name, entries in subject.scope.named_enums.items():
        yield from _claims_of_enum(name, entries, notation)
    for file in subject.scope.files:
        for kind, section in _ENTRIES.items():
            for entry in file.get(section, ()):
                yield from claims_of_entry(kind, entry, notation)
        yield from _claims_of_frames(file)
        bus = file.get("bus")
        if isinstance(bus, Map):
            yield from claims_of_settings(bus)
            for kind, section in sections_of_codes().items():
                yield from claims_of_codes(kind, bus.get(section))


def passed_over(subject: Analysis) -> list[tuple[Cited, frozenset[str]]]:
    """Return each line of `looked_through` with its numbers that are not facts; no numbers for a line without facts."""
    return [
        (Cited(line, 0, cited.key), frozenset(map(str, passage.get("numbers", ()))))
        for file in subject.scope.files
        for passage in file.get("looked_through", ())
        for cited in cited_lines(passage["lines"], passage.span("lines"))
        for line in range(cited.first, max(cited.first, cited.last) + 1)
    ]


def _shared_numberings(subject: Analysis) -> frozenset[str]:
    """Return the numberings of which one number belongs to several addresses, such as `mux` of `Mux 3 Word 2`."""
    addresses: dict[tuple[str, object], set[int]] = {}
    for resolved in subject.resolved:
        for place in resolved.point.places:
            for name, number in place.references.items():
                addresses.setdefault((name, number), set()).add(min(place.addresses))
    return frozenset(name for (name, _), places in addresses.items() if len(places) > 1)


def _claims_of_enum(name: str, entries: Map, notation: Notation) -> Iterator[Claim]:
    """Yield the claims of entries of a shared enum that cite a line themselves."""
    for key, entry in entries.items():
        if isinstance(entry, Map) and "line" in entry:
            maker = ClaimMaker.of(f"enum {name}", entries.key_span(key), entry)
            yield from maker.claim("enum", str(key), Number(absolute(numbers_in(key))))
            yield from maker.label("enum", notation.label(entry), entries.key_span(key), adjacent=(numbers_in(key),))


def claims_of_entry(kind: str, entry: Map, notation: Notation) -> Iterator[Claim]:
    """Yield the claims of a command, a message or a telegram: its numbers and its title."""
    maker = ClaimMaker.of(f"{kind} {entry['name']}", entry.span("name"), entry)
    identifiers = tuple(key for family in families() if family.lays_out_messages for key in family.frame_keys)
    for key in ("at", *identifiers, "value", "length", "wears"):
        yield from maker.numbers(key, entry.get(key), entry.span(key))
    # some are computed, such as a complement
    yield from maker.numbers("steps", entry.get("steps"), entry.span("steps"), optional=True)
    yield from maker.label("title", notation.label(entry.get("title")), entry.span("title"))
    layout = entry.get("layout", Map(entry.file, entry.start))
    names = ("Byte", *notation.written("byte"))
    for run, carried in layout.items():
        place, (first, *last) = layout.key_span(run), map(int, numbers_in(run))
        for number in numbers_in(run):
            yield from maker.claim("layout", str(number), Number(absolute((number,)), names=names), place, key="bytes")
        yield from maker.numbers("layout", carried, place, key="bytes")
        for byte in range(first + 1, max(last, default=first)):
            yield from maker.number("layout", Fraction(byte), place, key="bytes", optional=True)


def claims_of_settings(bus: Map) -> Iterator[Claim]:
    """Yield the claims of settings: the bit rate, perhaps in kBaud, the length of identifiers, those under `lines`."""
    maker = ClaimMaker.of("bus", bus.span(), bus)
    for key, unit in (("bitrate", 1000), ("identifier_bits", 1)):
        for number in numbers_in(bus.get(key)):
            evidence = Number(absolute((number, number / unit)))
            yield from maker.claim(key, str(number), evidence, bus.span(key))
    for holder in (bus, *(bus[name] for name in _SETTINGS if name in bus)):
        for key in maker.lines_of_fact:
            if key in holder and key not in ("bitrate", "identifier_bits"):
                yield from _claims_of_setting(maker, key, holder[key], holder.span(key))


def _claims_of_setting(maker: ClaimMaker, key: str, value: Any, place: Span) -> Iterator[Claim]:
    """Yield the claims of a setting: its numbers and its parity; or each code with its meaning."""
    if not isinstance(value, Map):
        yield from maker.numbers(key, value, place)
        if words := _parity_words(value):
            yield from maker.word(key, words, place)
        return
    for code, meaning in value.items():
        run = [*numbers_in(code), *numbers_in(meaning)]
        stated, at = f"{code}: {meaning}", value.span(code)
        if len(run) > 1:
            yield from maker.run(key, stated, [run], at)
        if words := _parity_words(meaning):
            yield from maker.claim(key, stated, Label(words, (absolute(run[-1:]),)), at)


def _parity_words(setting: Any) -> tuple[str, ...]:
    """Return the words of manuals for the parity in a setting."""
    named = next((words for parity, words in _PARITIES.items() if re.search(rf"\b{parity}\b", str(setting))), ())
    return (*named, *map(str.capitalize, named))


def claims_of_codes(kind: str, codes: Any) -> Iterator[Claim]:
    """Yield the claims of function, response and exception codes; several codes may share a row, as in "9 - 12"."""
    rows: dict[int, list[Fraction]] = {}
    for key, entry in codes.items() if isinstance(codes, Map) else ():
        if isinstance(entry, Map) and "line" in entry:
            rows.setdefault(entry["line"], []).extend(numbers_in(key))
    for key, entry in codes.items() if isinstance(codes, Map) else ():
        if isinstance(entry, Map):
            maker = ClaimMaker.of(f"{kind} {key}", codes.key_span(key), entry, Named(kind, parse_integer(key)))
            row = rows.get(entry.get("line", 0), [])
            ends = frozenset((min(row), max(row))) if len(row) > 2 else frozenset()
            for number in numbers_in(key):
                yield from maker.claim("number", str(key), Number(absolute((number,)), ends=ends))
            for fact in ("max", "answers", "refusals"):
                yield from maker.numbers(fact, entry.get(fact), entry.span(fact))
            yield from maker.numbers("printed bytes", entry.get("printed", {}).get("bytes"), entry.span("printed"))


def _claims_of_frames(file: Map) -> Iterator[Claim]:
    """Yield the claims of the worked frames: their bytes, and the numbers that they carry."""
    for frame in file.get("frames", ()):
        name = frame["name"]
        maker = ClaimMaker.of(f"frame {name}", frame.span("name"), frame, Named("frame", name))
        digits = "".join(str(frame["bytes"]).split()).upper()
        if maker.own_line:
            yield from maker.claim("bytes", digits, Bytes(digits), frame.span("bytes"))
            for byte in range(1, len(digits) // 2 + 1):  # tables count the bytes
                yield from maker.number("place of a byte", Fraction(byte), key="bytes", optional=True)
        values, cited = numbers_in(frame.get("says")), "printed" in maker.lines_of_fact
        for number in dict.fromkeys(values):  # beside the bytes, or not at all
            evidence = Number(absolute((number,)), times=values.count(number))
            yield from maker.claim("says", str(number), evidence, frame.span("says"), key="printed", optional=not cited)


class PrintedErratum(NamedTuple):
    """The text that the manual prints according to an erratum, and its place."""

    id: str
    stated: str
    place: Span
    numbers: tuple[Fraction, ...]
    texts: tuple[str, ...]
    """The quotations in a sentence."""
    cited: tuple[Cited, ...]
    subjects: tuple[About, ...]
    taken: frozenset[Fraction]
    """The numbers that the description has instead, which the manual need not print there."""
    taken_text: str
    """`taken` as the author wrote it: it may name codes that the manual does not print."""
    is_sentence: bool
    """True if `printed` is a sentence, which may speak of text around the cited line too."""


def printed_errata(subject: Analysis) -> list[PrintedErratum]:
    """Return all errata that name a line."""
    return [_printed_erratum(erratum) for erratum in subject.errata if erratum.erratum.source.line is not None]


def _printed_erratum(written: LocatedErratum) -> PrintedErratum:
    node = written.node
    printed, taken, lines = (node.get(key) for key in ("printed", "taken", "lines"))
    cited = list(cited_lines(node["line"], node.span("line")))
    if isinstance(lines, Map):
        cited += [line for key, value in lines.items() for line in cited_lines(value, lines.span(key))]
    texts: list[str] = []
    if isinstance(printed, Map):
        numbers = _numbers_of(printed)
    else:
        sentence = str(printed)
        named = [line for lines in _LINES_NAMED.findall(sentence) for line in re.findall("[0-9]+", lines)]
        cited += [Cited(int(line), 0, node.span("printed")) for line in named]
        texts = [text for text in _QUOTED.findall(sentence) if len(text) > 1]
        numbers = numbers_in(_LINES_NAMED.sub("", sentence))
    return PrintedErratum(
        written.erratum.id,
        written.erratum.printed,
        node.span("id"),
        tuple(map(abs, numbers)),
        tuple(texts),
        tuple(cited),
        written.subjects,
        absolute(_numbers_of(taken) if isinstance(taken, Map) else numbers_in(taken)),
        written.erratum.taken,
        not isinstance(printed, Map),
    )


def _numbers_of(facts: Map) -> list[Fraction]:
    return [number for key, value in facts.items() for number in _printed_numbers(key, value)]


def _printed_numbers(key: str, value: Any) -> Iterator[Fraction]:
    """Return the numbers of a printed fact; a checksum is bytes."""
    if key == "crc":
        yield from map(Fraction, bytes.fromhex("".join(str(value).split())))
    else:
        yield from numbers_in(value)
