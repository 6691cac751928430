"""One changed fact: the text of a manual with another digit, word or byte where it prints the fact."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from random import Random
from typing import NamedTuple

from audit_power.facts import CitedFact

_WORDS = ("Sollwert", "gesperrt", "Pumpe", "Notbetrieb", "Wartung", "Vorlauf", "dritte", "umgekehrt")
_FAR = 12
"""At most so many characters stand between a label and its number."""


class Change(NamedTuple):
    """The fact, the line from 1, its new text, and what was changed in it."""

    fact: CitedFact
    line: int
    text: str
    was: str
    now: str

    def applied(self, lines: Sequence[str]) -> str:
        """Return the whole text with the change."""
        return "\n".join((*lines[: self.line - 1], self.text, *lines[self.line :])) + "\n"


def change_of(fact: CitedFact, lines: Sequence[str], random: Random) -> Change | None:
    """Return a change of the fact where its lines print it first; None if they do not print it as the YAML has it."""
    places = list(_places(fact, lines))
    if not places:
        return None
    line, first, end = random.choice(places)
    old = lines[line - 1]
    was = old[first:end]
    now = _other_label(was, random) if fact.kind == "label" else _other_digit(was, fact.kind, random)
    return Change(fact, line, old[:first] + now + old[end:], was, now)


def _places(fact: CitedFact, lines: Sequence[str]) -> Iterator[tuple[int, int, int]]:
    """Yield line, first and last column of the fact on the first of its lines that prints it."""
    if fact.kind == "bytes":
        yield from _bytes(str(fact.value), fact.lines, lines)
        return
    text = re.escape(str(fact.value))  # extraction may glue a cell to the one before
    pattern = rf"(?<![a-z]){text}(?![a-z])" if fact.kind == "label" else _spellings(fact.value)
    for line in fact.lines:
        text = lines[line - 1] if line <= len(lines) else ""
        spans = [match.span() for match in re.finditer(pattern, text)]
        if fact.beside is not None:
            spans = [span for span in spans if _is_beside(fact.beside, text, span)]
        if spans:
            yield from ((line, *span) for span in spans)
            return


def _is_beside(number: Fraction | str, text: str, span: tuple[int, int]) -> bool:
    near = text[max(0, span[0] - _FAR) : span[0]], text[span[1] : span[1] + _FAR]
    return any(re.search(_spellings(number), part) for part in near)


def _bytes(digits: str, places: Sequence[int], lines: Sequence[str]) -> Iterator[tuple[int, int, int]]:
    """Yield each byte: in one run on a line, or in cells of lines that follow each other."""
    pairs = [digits[at : at + 2] for at in range(0, len(digits), 2)]
    run = re.compile(r"(?:0x)?[\s,h']*(?:0x)?".join(f"({pair})" for pair in pairs), re.IGNORECASE)
    for line in places:
        match = run.search(lines[line - 1]) if line <= len(lines) else None
        if match is not None:
            yield from ((line, *match.span(number)) for number in range(1, len(pairs) + 1))
            return
    found, wanted = [], iter(pairs)
    pair = next(wanted)
    for line in places:
        text = lines[line - 1] if line <= len(lines) else ""
        match = re.search(rf"(?<![\w.])(?:0x)?({pair})h?(?=\s*(?:[|\t]|$))", text)
        if match is not None:
            found.append((line, *match.span(1)))
            pair = next(wanted, "")
            if not pair:
                yield from found
                return


def _spellings(number: Fraction | str) -> str:
    """Return a pattern of a number in decimal or, for integers, in hexadecimal notation."""
    if isinstance(number, str) or number.denominator == 1:
        value = int(number)
        hexadecimal = f"0*{value:X}"
        decimal = _alone(rf"0*{value}(?![.,][0-9])|{hexadecimal}h|H'{hexadecimal}|{hexadecimal} ?\(hex\)")
        return rf"{decimal}|0x{value:04X}|{_alone(f'0x{hexadecimal}')}|(?<=Bit ){value}(?![0-9])"
    whole, _, part = f"{float(number):.10f}".rstrip("0").partition(".")
    return _alone(rf"{whole}[.,]{part}0*")


def _alone(pattern: str) -> str:
    return rf"(?<![\w.,])(?:{pattern})(?!\w)"


def _other_digit(was: str, kind: str, random: Random) -> str:
    digits = "0123456789ABCDEF" if kind == "bytes" else "123456789"
    start = 2 if was.startswith("0x") else 0
    spots = [at for at, char in enumerate(was) if at >= start and char.upper() in digits + "0"]
    at = random.choice(spots)
    return was[:at] + random.choice([digit for digit in digits if digit != was[at].upper()]) + was[at + 1 :]


def _other_label(was: str, random: Random) -> str:
    words = list(re.finditer(r"[^\W\d]{3,}", was))
    word = random.choice(words)
    other = random.choice([other for other in _WORDS if other.lower() not in was.lower()])
    return was[: word.start()] + other + was[word.end() :]
