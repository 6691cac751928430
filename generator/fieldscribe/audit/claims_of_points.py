"""What a point takes from its manual."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.audit.citing import OWN_PRINTED, Citing, numbers_in
from fieldscribe.audit.claims_of_flags import claims_of_flags
from fieldscribe.audit.wordings import joined
from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.wordings import Wordings
    from fieldscribe.model import Point
    from fieldscribe.resolve.point_facts import PointFacts

_INDEX_BEHIND_CODE = re.compile(r"\[.*|\(.*")
_LETTERS_AND_DIGITS = re.compile("([A-Za-z]+)([0-9]+)")
_NUMBERS = re.compile(r"\b0x[0-9A-Fa-f]+\b|\b[0-9][0-9A-Fa-f]*h\b")
_KEY_IN_LINES = {"range_in_units": "range", "pairs": "printed"}
"""The keys of `printed` whose place `lines` names by another key."""


def claims_of_point(
    point: Point, draft: PointFacts, enums: Mapping[str, Map], wordings: Wordings, parts: frozenset[str]
) -> Iterator[Claim]:
    """Everything that a point says itself: code, section, address, title, numbers, enum, flags, printed facts.

    `parts` are the numberings that tell an address only together with another one.
    """
    citing = Citing(point.item, draft.span(), point.source.line, draft.get("lines"), point.name)
    code = None if point.code is None else _INDEX_BEHIND_CODE.sub("", point.code).strip()
    if code:
        yield from citing.words("code", *_codes_of(code, wordings), str(point.code), place=draft.span("code"))
    if _says_itself(draft, "section"):
        yield from citing.words("section", str(draft.get("section")), place=draft.span("section"))
    yield from _address(citing, point, draft, code or "", parts)
    yield from citing.label("title", wordings.label(_titles_of(draft)), place=draft.span("title"))
    yield from _access(citing, draft, wordings)
    yield from _numbers_of(citing, point, draft, wordings)
    yield from _enum_of(citing, point, draft, enums, wordings)
    yield from _special_codes(citing, draft, wordings)
    yield from _default(citing, point, draft, wordings)
    yield from claims_of_flags(citing, point, draft, wordings)
    yield from _printed(citing, draft, wordings)


def _titles_of(draft: PointFacts) -> Any:
    """The title of the row; of a further set, whose row the manual prints too, with what tells it apart."""
    made_of_the_first = {language: text for language, text in draft.title.items() if language != "en"}
    return draft.get("title", made_of_the_first)


def _access(citing: Citing, draft: PointFacts, wordings: Wordings) -> Iterator[Claim]:
    """How the manual prints who may write; rows that print nothing of it say nothing, and are right for `none`."""
    access = str(draft.get("access"))
    words = wordings.access.get(access, [])
    rivals = [word for other, words in wordings.access.items() if other != access for word in words]
    if words or (access == "none" and rivals):
        yield from citing.access(access, tuple(words), tuple(rivals), draft.span("access"))


def _codes_of(code: str, wordings: Wordings) -> tuple[str, ...]:
    """How a manual may write a code: `P601`, `P 601`, `Parameter 601`."""
    match = _LETTERS_AND_DIGITS.fullmatch(code)
    if match is None:
        return (code,)
    letters, digits = match.groups()
    return (code, f"{letters} {digits}", *(f"{word} {digits}" for word in wordings.code(letters)))


def _address(citing: Citing, point: Point, draft: PointFacts, code: str, parts: frozenset[str]) -> Iterator[Claim]:
    if point.address is None:
        return
    at = draft.get("at")
    by_rule = (draft.element is not None or "addressing" in draft.group) and str(at).isdigit()
    rule = [Fraction(int(at))] if by_rule else []
    for number in (*rule, *map(Fraction, filter(None, (point.set, point.index)))):
        yield from citing.numbers("number", str(number), (number,), "code", optional=True, place=draft.span("at"))
    if code and any(str(number) in code for number in (point.address, *map(int, rule))):
        return  # the code is the number
    if point.text is not None:
        ends = frozenset(map(Fraction, (point.addresses[0], point.addresses[-1])))
        for address in map(Fraction, point.addresses):
            inner = ends if address not in ends else frozenset()
            yield from citing.numbers(
                "address", str(address), (address,), anchor=not inner, between=inner, place=draft.span("at")
            )
        return
    for place in point.places:
        told = {name: number for name, number in place.references.items() if name not in parts}
        references = [Fraction(number) for number in told.values() if isinstance(number, int)]
        yield from citing.numbers(
            "address",
            f"{min(place.addresses):04X}h",
            (Fraction(min(place.addresses)), *references, *rule),
            anchor=place is point.place,
            words=tuple(word for name, number in told.items() for word in joined(name, number)),
            place=draft.span("at"),
        )


def _numbers_of(citing: Citing, point: Point, draft: PointFacts, wordings: Wordings) -> Iterator[Claim]:
    """The limits, the bits of the word, the characters of a text and the scale."""
    for key in ("range", "range_in_units"):
        if _says_itself(draft, key) and not point.flags:  # the flags of a word say which numbers it holds
            for shown, numbers in _runs_of(draft.get(key)):
                ways = _in_both_units(point, numbers, in_units=key == "range_in_units")
                if _prints_units(draft):  # which is another claim
                    del ways[1:]
                yield from citing.in_order(
                    "range", shown, ways, apart=_is_parted(draft.get(key)), place=draft.span(key)
                )
    yield from _bits_of(citing, point, draft, wordings)
    if point.text is not None and _says_itself(draft, "characters"):
        characters = point.text.characters
        yield from citing.numbers(
            "characters", str(characters), (Fraction(characters),), "range", place=draft.span("characters")
        )
    if _says_itself(draft, "scale"):
        for number in _scale_numbers(draft.get("scale")):
            yield from citing.numbers("scale", str(number), (number, 1 / number), place=draft.span("scale"))


def _prints_units(draft: PointFacts) -> bool:
    """Whether the description says that the limits are printed in the unit, too."""
    printed = draft.get("printed")
    return isinstance(printed, Map) and "range_in_units" in printed and draft.layer("range") is not None


def _in_both_units(point: Point, numbers: list[Fraction], *, in_units: bool) -> list[list[Fraction]]:
    """Limits as raw numbers and in the unit; only as they are written where the scale has cases or factors."""
    cases = point.scale or ()
    if len(cases) != 1 or cases[0].rule.factors:
        return [numbers]
    rule = cases[0].rule
    if in_units:
        return [numbers, [number * rule.ratio + rule.offset for number in numbers]]
    return [numbers, [(number - rule.offset) / rule.ratio for number in numbers]]


def _scale_numbers(raw: Any) -> list[Fraction]:
    texts = [raw] if isinstance(raw, str) else [case["rule"] for case in raw or ()]
    return [number for text in texts for number in numbers_in(text) if number not in (0, 1)]


def _bits_of(citing: Citing, point: Point, draft: PointFacts, wordings: Wordings) -> Iterator[Claim]:
    """The bits of the word that the point takes, and the bits that are always written alike."""
    if point.bits is not None:
        words = tuple(wordings.bits(*point.bits))
        for place in range(point.bits[1], point.bits[0] + 1):
            inner = place not in point.bits
            names = tuple(wordings.code("bits")) if place == point.bits[0] else ()
            yield from citing.numbers(
                "bits",
                str(place),
                (Fraction(place),),
                words=words,
                optional=inner,
                names=names,
                place=draft.span("bits"),
            )
        if point.bits[0] - point.bits[1] > 1:
            run = [Fraction(place) for place in range(point.bits[0], point.bits[1] - 1, -1)]
            shown = f"{point.bits[0]} to {point.bits[1]}"
            yield from citing.in_order("bits", shown, [run], optional=True, place=draft.span("bits"))
    fixed: Any = draft.get("fixed") if _says_itself(draft, "fixed") else None
    for bits, constant in fixed.items() if isinstance(fixed, Map) else ():
        place_of_bits = fixed.key_span(bits)
        ends = numbers_in(bits)
        for bit in ends:
            numbers = (bit, Fraction(1 << int(bit))) if len(ends) == 1 else (bit,)
            yield from citing.numbers("fixed bits", str(bit), numbers, "bits", place=place_of_bits)
        for number in numbers_in(constant):
            yield from citing.numbers(
                "fixed bits",
                f"= {number}",
                (number,),
                "bits",
                words=tuple(wordings.number(number)),
                behind=tuple(frozenset((bit,)) for bit in numbers_in(bits)),
                place=place_of_bits,
            )


def _is_parted(raw: Any) -> bool:
    """Whether codes, factors or other intervals stand between the numbers of a range."""
    return any(char.isalpha() or char in "*|" for char in _NUMBERS.sub("", str(raw)))


def _runs_of(raw: Any) -> Iterator[tuple[str, list[Fraction]]]:
    """What is printed in one piece: each interval, or a list of single numbers."""
    texts = [str(item) for item in raw] if isinstance(raw, list) else [str(raw)]
    parts = [part.strip() for text in texts for part in text.split(",")]
    singles = [part for part in parts if ".." not in part]
    runs = [part for part in parts if ".." in part] + [", ".join(singles)] * bool(singles)
    yield from ((run, numbers_in(run)) for run in runs if numbers_in(run))


def _enum_of(
    citing: Citing, point: Point, draft: PointFacts, enums: Mapping[str, Map], wordings: Wordings
) -> Iterator[Claim]:
    """The numbers and labels of the point's enum, but for entries of a shared enum that cite a line themselves."""
    key = "digits" if point.digits else "enum"
    said: Any = draft.get(key)
    if not _says_itself(draft, key) or said is None:
        return
    said = said["enum"] if point.digits else said
    entries: Map = enums[said] if isinstance(said, str) else said
    numbers = [numbers_in(number)[0] for number in entries]
    shown = ", ".join(map(str, numbers))
    yield from citing.in_order("enum", shown, [numbers], optional=True, place=draft.span(key))
    for position, (number, entry) in enumerate(entries.items()):
        if isinstance(entry, Map) and "line" in entry and entries is not said:
            continue
        place, numbers = entries.key_span(number), numbers_in(number)
        label = wordings.label(entry) if isinstance(entry, Map) else ()
        yield from citing.label("enum", label, beside=numbers, entry=(position, 0), place=place)
        quantity = numbers_in(entry.get("quantity")) if isinstance(entry, Map) else []
        if quantity and numbers:
            shown = f"{number} = {entry['quantity']}"
            yield from citing.in_order("enum", shown, [(numbers[0], quantity[0])], place=place)
        elif not label:
            yield from citing.numbers("enum", str(number), numbers, place=place)


def _special_codes(citing: Citing, draft: PointFacts, wordings: Wordings) -> Iterator[Claim]:
    """The raw numbers that are no quantity, each with its name."""
    codes: Any = draft.get("special") if _says_itself(draft, "special") else None
    for position, (number, entry) in enumerate(codes.items() if isinstance(codes, Map) else ()):
        label = wordings.label(entry) if isinstance(entry, Map) else ()
        place, numbers = codes.key_span(number), numbers_in(number)
        yield from citing.label("special", label, beside=numbers, entry=(position, 0), place=place)


def _default(citing: Citing, point: Point, draft: PointFacts, wordings: Wordings) -> Iterator[Claim]:
    """The factory setting, where `lines` says that the manual prints it: behind its name, if it writes one."""
    if "default" in citing.lines_of_fact and point.default_raw is not None:
        numbers = [Fraction(point.default_raw), *([] if point.default is None else [point.default])]
        span = draft.span("default" if draft.layer("default") is not None else "default_in_units")
        names = tuple(wordings.code("default"))
        yield from citing.numbers("default", str(draft.get("default")), numbers, names=names, place=span)


def _printed(citing: Citing, draft: PointFacts, wordings: Wordings) -> Iterator[Claim]:
    printed = draft.get("printed")
    for key, value in printed.items() if isinstance(printed, Map) else ():
        kind = _KEY_IN_LINES.get(key, key if key in OWN_PRINTED else "address")
        place = printed.span(key)
        if key in ("range", "range_in_units"):
            for shown, numbers in _runs_of(value):
                apart = _is_parted(value)
                yield from citing.in_order(f"printed {key}", shown, [numbers], kind, apart=apart, place=place)
            continue
        if key == "pairs":
            for raw, number in value.items():
                pair = [*numbers_in(raw), *numbers_in(number)]
                yield from citing.in_order("printed pairs", f"{raw} = {number}", [pair, pair[::-1]], kind, place=place)
            continue
        unit = "".join(re.findall("[^0-9., ]+", str(value))) if key == "resolution" else ""
        numbers = numbers_in(value)
        names = (*(key, key.capitalize(), key.upper()), *wordings.code(key)) if kind == "address" else ()
        for number in dict.fromkeys(numbers):
            words = joined(key, number) if kind == "address" else ()
            unsaid = key == "resolution" and number == 1  # "resolution: A" means one ampere: no 1 is printed
            yield from citing.numbers(
                f"printed {key}",
                str(number),
                (number,),
                kind,
                words=words,
                optional=unsaid,
                times=numbers.count(number),
                unit=unit,
                names=names,
                place=place,
            )


def _says_itself(draft: PointFacts, key: str) -> bool:
    """Whether the point (or its format, record, set) says a fact itself: what its group says cites no line."""
    layer = draft.layer(key)
    return layer is not None and layer is not draft.group
