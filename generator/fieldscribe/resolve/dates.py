"""Resolves the parts of a date and time, each with its bits of a word."""

import re
from collections.abc import Iterator, Mapping

from fieldscribe.arithmetic.texts import DATE, DATE_AND_TIME, TIME, first_date
from fieldscribe.arithmetic.words import BCD, mask_of
from fieldscribe.language.nodes import Map
from fieldscribe.model import DatePart, Text
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope
from fieldscribe.resolve.values import WORD_BITS

_PLACE = re.compile(r"(?:bits? (?P<high>[0-9]+)(?:\.\.(?P<low>[0-9]+))?)?(?: of )?(?:word (?P<word>[0-9]+))?")
_PART = re.compile(r"(?P<name>[a-z]+)(?: from (?:(?P<first>sunday|monday) (?P<number>[01])|(?P<year>[0-9]{1,4})))?")
_MONDAY_IS_0 = 6
"""The number of Sunday if Monday is 0."""
_BYTE = 8
_CENTURY = 2000
_OF_DATE = ("year", "month", "day")
_NAMES = frozenset((*_OF_DATE, "weekday", "hour", "minute", "second", "millisecond"))
_NEEDS: Mapping[str, tuple[str, ...]] = {
    **dict.fromkeys((*_OF_DATE, "weekday"), _OF_DATE),
    "minute": ("hour",),
    "second": ("minute",),
    "millisecond": ("minute",),
}
"""The parts that each part requires, so that all of them are a date or a time."""


def layout_of_date(facts: PointFacts, *, per_word: int, low_first: bool) -> Text:
    """Return the places of the parts of a date and time, which `is_date` checks."""
    parts = tuple(_parts_of(facts, per_word))
    names = {part.name for part in parts}
    encoding = DATE if "hour" not in names else DATE_AND_TIME if names.intersection(_OF_DATE) else TIME
    words = max([part.word + 1 for part in parts] + [int(facts.get("length", 1))])
    return Text(2 * words, encoding, low_first=low_first, parts=parts, bcd=facts.get("coding") == BCD)


def _parts_of(facts: PointFacts, per_word: int) -> Iterator[DatePart]:
    stated = facts.get("parts")
    numbers = facts.bit_numbers()
    for position, text in enumerate(stated):
        match = _PART.fullmatch(str(text))
        place = _PLACE.fullmatch(str(stated[text])) if isinstance(stated, Map) else _PLACE.fullmatch("")
        if match is None or place is None or match["name"] not in _NAMES:  # the check of the shape has reported it
            continue
        word, bits = position // per_word, ((15, 0) if per_word == 1 else (7, 0) if position % 2 else (15, 8))
        if isinstance(stated, Map):
            word, bits = int(place["word"] or 1) - 1, (15, 0)
        if place["high"]:
            bits = numbers.bit(int(place["high"])), numbers.bit(int(place["low"] or place["high"]))
        yield DatePart(match["name"], word, bits, _base_of(match, bits))


def _base_of(match: re.Match[str], bits: tuple[int, int]) -> int:
    """Return the year of the number 0, or the number of Sunday; 0 for other parts."""
    if match["name"] == "weekday":
        return int(match["number"] or 0) + (_MONDAY_IS_0 if match["first"] == "monday" else 0)
    if match["name"] != "year":
        return 0
    return int(match["year"]) if match["year"] else _CENTURY * (bits[0] - bits[1] < _BYTE)


def is_date(scope: Scope, facts: PointFacts, layout: Text) -> bool:
    """Return True for a date and time; report parts that do not form one, and impossible places."""
    if facts.get("parts").broken:
        return False
    faults = [*_faults(facts, layout), *_misplaced(facts, layout)]
    if not faults and first_date(layout) is None:
        faults = [(f"`{facts.name}` can hold no date", "give its parts the bits that a date needs", "parts")]
    for message, hint, key in faults:
        scope.report.error("date-parts", message, facts.span(key), hint)
    return not faults


def _faults(facts: PointFacts, layout: Text) -> Iterator[tuple[str, str, str]]:
    names = [part.name for part in layout.parts]
    twice = next((name for name in names if names.count(name) > 1), None)
    missing = next((need for name in names for need in _NEEDS.get(name, ()) if need not in names), None)
    if twice is not None:
        yield f"`{facts.name}` has the part `{twice}` twice", "remove one of them", "parts"
    elif missing is not None:
        message = f"`{facts.name}` has no `{missing}`, without which its parts are no date or time"
        yield message, "a date has year, month and day, a time begins with the hour; other numbers are points", "parts"
    for key, fitting in (("type", "bytes"), ("notation", None), ("coding", BCD)):
        if facts.layer(key) is not facts.group and facts.get(key) not in (None, fitting):
            yield f"`{facts.name}` has `parts`, and `{key}`", "the parts are all that it means: leave it out", key


def _misplaced(facts: PointFacts, layout: Text) -> Iterator[tuple[str, str, str]]:
    taken: dict[int, int] = {}
    for part in layout.parts:
        high, low = part.bits
        fits = 0 <= low <= high < WORD_BITS
        mask = mask_of(part.width, low) if fits else 0
        hint = "" if fits else "a part is some bits of one word, the higher bit first: bits 15..8"
        hint = "a decimal digit takes four bits" if fits and layout.bcd and part.width % 4 else hint
        hint = "another part has some of these bits" if taken.get(part.word, 0) & mask else hint
        if hint:
            yield f"`{part.name}` of `{facts.name}` cannot be there", hint, "parts"
        taken[part.word] = taken.get(part.word, 0) | mask
