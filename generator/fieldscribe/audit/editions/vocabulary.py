"""The words that a description has for each of its subjects: titles, labels, units, notes."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any
from unicodedata import combining, normalize

from fieldscribe.audit.claims_of_bus import parity_words

if TYPE_CHECKING:
    from fieldscribe.resolve.analysis import Analysis

_WORD = re.compile(r"[^\W_]+|[%\u2030\u00b0\u03a9\u2126]")
_SMALL_WORDS = re.compile(
    "an?|and|are|as|at|be|by|for|from|in|is|it|of|on|or|that|the|this|to|was|with|als|am|auf|aus|bei|bis|das|de[mnrs]|die|"
    "eine?[nr]?|ist|im|mit|oder|sind|und|vom|von|wird|zu[mr]?|\u00fcber|f\u00fcr"
)
"""What says nothing by itself; `not`, `nicht` and `kein` do."""
_HYPHEN = re.compile(
    r"(?<=[^\W\d_])\s?[-\u00ad\u2010-\u2013]\s?(?=[^\W\d_])"
    r"|(?<=[0-9])[-\u00ad\u2010-\u2013](?=[^\W\d_]{2})|(?<=[^\W\d_])['\u2019](?=[^\W\d_])"
)
"""What only sets a word: `16-Bit`, `ID's`."""
_DOUBLED = re.compile(r"([^\W\d_])\1+")
_LONG = 6
_STEM, _ENDING = 4, 2
"""Forms of a word have so many letters alike at the start, and differ in length by so many at most."""
_OF_ACCESS = {
    "r": "r ro read only lesen nur lesend",
    "w": "w wo write only schreiben nur schreibend",
    "rw": "r w rw read write lesen schreiben",
}


def is_name(word: str) -> bool:
    """Whether a word or sign says something by itself."""
    return bool(_WORD.fullmatch(word)) and _SMALL_WORDS.fullmatch(word.casefold()) is None


def is_respelled(old: str, new: str) -> bool:
    """Whether two words are one in other spellings or forms: `Anschluß`, `Anschluss`; not `synchron`, `asynchron`."""
    was, now = _spelled(old), _spelled(new)
    if was == now:
        return True
    if not (was.isalpha() and now.isalpha() and was[:_STEM] == now[:_STEM] and min(len(was), len(now)) > _STEM):
        return False
    shorter, longer = sorted((was, now), key=len)
    return len(longer) - len(shorter) <= _ENDING and _is_within(shorter, longer)


def are_respelled(old: str, new: str) -> bool:
    """Whether the same words stand in two pieces of text, in other spellings, or nothing but signs."""
    was, now = _WORD.findall(old), _WORD.findall(new)
    return len(was) == len(now) and all(map(is_respelled, was, now))


def is_one_spelling(old: str, new: str) -> bool:
    """Whether two pieces of text differ in spelling alone: hyphens within words, capitals, accents, doubled letters."""
    was, now = (_WORD.findall(_HYPHEN.sub("", _spelled(text))) for text in (old, new))
    return bool(was) and list(map(_with_single, was)) == list(map(_with_single, now))


def _with_single(word: str) -> str:
    """A long word with each doubled letter once: `Schiffahrt`, `Schifffahrt`; numbers stay."""
    return _DOUBLED.sub(r"\1", word) if len(word) > _LONG else word


def _spelled(word: str) -> str:
    """A word without what spellings differ in: capitals, accents, ß for ss."""
    return "".join(char for char in normalize("NFKD", word.casefold()) if not combining(char))


def _is_within(shorter: str, longer: str) -> bool:
    """Whether a word is another one with letters left out, or with another ending of two letters."""
    letters = iter(longer)
    has_ending = len(shorter) > _STEM + _ENDING and shorter[:-_ENDING] == longer[: len(shorter) - _ENDING]
    return has_ending or all(letter in letters for letter in shorter)


class Vocabulary:
    """The words of each point and of each shared enum, and those of everything else."""

    def __init__(self, subject: Analysis) -> None:
        self._words_of = {f"enum {name}": _words_in(entries) for name, entries in subject.scope.named_enums.items()}
        self._units: dict[str, tuple[str, str]] = {}
        for resolved in subject.resolved:
            draft = resolved.facts
            words = _words_in([draft.get(key) for key in draft.keys])
            words |= _words_in(subject.scope.named_enums.get(str(draft.get("enum")), ()))
            words |= _words_in(_OF_ACCESS.get(str(draft.get("access")), ""))
            words |= _words_in([erratum.node for erratum in subject.cited.get(resolved.point.name, ())])
            self._words_of[resolved.point.item] = words
            span = draft.span("unit")
            self._units[resolved.point.item] = str(draft.get("unit", "")), f"{span.file}:{span.line}:{span.column}"
        others = [
            value for file in subject.scope.files for key, value in file.items() if key not in ("points", "enums")
        ]
        self._of_others = _words_in(others)
        for bus in (file["bus"] for file in subject.scope.files if "bus" in file):
            self._of_others |= _words_in([parity_words(setting) for setting in _settings_in(bus.get("serial", ()))])

    def unit_of(self, subject: str) -> tuple[str, str]:
        """The unit of a point, and where the description says it."""
        return self._units.get(subject, ("", ""))

    def has(self, word: str, subjects: Iterable[str]) -> bool:
        """Whether the description has a word for one of these subjects."""
        folded = word.casefold()
        return any(folded in self._words_of.get(subject, self._of_others) for subject in subjects)


def _settings_in(value: Any) -> list[Any]:
    """Each setting of a line by itself."""
    if isinstance(value, Mapping):
        return [setting for item in value.values() for setting in _settings_in(item)]
    return list(value) if isinstance(value, Sequence) and not isinstance(value, str) else [value]


def _words_in(value: Any) -> set[str]:
    if isinstance(value, str):
        return {match[0] for match in _WORD.finditer(value.casefold())}
    if isinstance(value, Mapping):
        return _words_in([*value.keys(), *value.values()])
    if isinstance(value, Sequence):
        return set().union(*map(_words_in, value))
    return set()
