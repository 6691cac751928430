"""How a fact of a description is changed to another one that could have been written there."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from mutants.facts import Fact, Point

Edits = tuple[tuple[int, int, str], ...]
"""Places in the file and what stands there then."""

TYPES = ("bit", "u8", "s8", "u16", "s16", "u32", "s32", "f32", "u64")
ACCESS = ("r", "w", "rw")
NUMBERS = (
    *("at", "range", "scale", "bits", "default", "default_in_units", "values", "code", "step", "active", "fixed"),
    "special",
)
TRUTH = {"yes": "no", "no": "yes", "true": "false", "false": "true"}
_NUMBER = re.compile(r"(?<![\w.])(0x[0-9A-Fa-f]+|[0-9][0-9A-Fa-f]*h\b|\d+\.\d+|\d+)(?![\w])")
_OPERATOR = re.compile(r" ([-+*/]) ")
_OTHER = {"+": "-", "-": "+", "*": "/", "/": "*"}

Used = Mapping[str, Sequence[str]]
"""The texts that a device uses for a key."""


def changes_of(fact: Fact, neighbours: Sequence[Fact], used: Used) -> list[Edits]:
    """All changes of a fact; it may change places with the next of its neighbours."""
    key = next((one for one in reversed(fact.keys) if not re.match(r"[\d-]", one)), "")
    plain = fact.text.strip("\"'")
    if fact.is_key:
        return [*_numbers(fact), *_exchanged(fact, neighbours)]
    if key in ("type", "access"):
        return _others(fact, {"type": TYPES, "access": ACCESS}[key])
    if plain in TRUTH:
        return [_whole(fact, TRUTH[plain])]
    if key == "name" or (re.match(r"[\d-]", fact.keys[-1]) and re.fullmatch(r"[A-Za-z_]\w*", plain)):
        return [*_exchanged(fact, neighbours), _whole(fact, plain[:-1] + ("x" if plain[-1] != "x" else "y"))]
    counted = [*_numbers(fact), *_operators(fact)]
    if counted and key in NUMBERS:
        return counted
    return _others(fact, used.get(key, ())) or counted or [_whole(fact, plain[:-1] + "x")]


def _whole(fact: Fact, text: str) -> Edits:
    quote = fact.text[0] if fact.text[0] in "\"'" else ""
    return ((fact.start, fact.end, f"{quote}{text}{quote}"),)


def _others(fact: Fact, texts: Sequence[str]) -> list[Edits]:
    return [((fact.start, fact.end, text),) for text in sorted(set(texts)) if text != fact.text]


def siblings(fact: Fact, point: Point) -> list[Fact]:
    """Facts of the same sort in the same point: the names of an enum's other entries, other keys."""
    same = [one for some in point.facts.values() for one in some if one.path == fact.path and one != fact]
    level = len(fact.keys), fact.keys[0], fact.is_key
    return [one for one in same if (len(one.keys), one.keys[0], one.is_key) == level and _sort(one) == _sort(fact)]


def _sort(fact: Fact) -> str:
    return "" if re.match(r"[\d-]", fact.keys[-1]) else fact.keys[-1]


def _exchanged(fact: Fact, others: Sequence[Fact]) -> list[Edits]:
    """The fact and the next of its sort change places."""
    behind = [one for one in others if one.start > fact.end and one.text != fact.text]
    if not behind:
        return []
    other = min(behind, key=lambda one: one.start)
    return [((fact.start, fact.end, other.text), (other.start, other.end, fact.text))]


def _numbers(fact: Fact) -> list[Edits]:
    found: list[Edits] = []
    for number in _NUMBER.finditer(fact.text):
        start = fact.start + number.start()
        found += [((start, start + len(number[0]), text),) for text in _near(number[0])]
    return found


def _near(text: str) -> list[str]:
    """One more, one less, and one digit of it another."""
    if "." in text:
        whole, _, part = text.partition(".")
        return [f"{whole}.{int(part) + 1:0{len(part)}}", f"{whole}.0{part}", f"{int(whole) + 1}.{part}"]
    head, digits, tail, base = ("", text, "", 10)
    if text.startswith("0x"):
        head, digits, base = "0x", text[2:], 16
    elif text.endswith("h"):
        digits, tail, base = text[:-1], "h", 16
    number = int(digits, base)
    wanted = sorted({number + 1, max(number - 1, 0), number ^ 4, number + base} - {number})
    shown = [f"{one:0{len(digits)}X}" if base == 16 else f"{one:0{len(digits)}}" for one in wanted]
    return [f"{head}{'' if one[0].isdigit() or head else '0'}{one}{tail}" for one in shown]


def _operators(fact: Fact) -> list[Edits]:
    return [
        ((fact.start + found.start(1), fact.start + found.end(1), _OTHER[found[1]]),)
        for found in _OPERATOR.finditer(fact.text)
    ]
