"""What words of running text tell by themselves: numbers in words, what turns a sentence round, labels in front."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.parting import is_row

if TYPE_CHECKING:
    from collections.abc import Iterable

_NUMBERS = (
    "zwei|two", "drei|three", "vier|four", "f\u00fcnf|five", "sechs|six", "sieben|seven", "acht|eight", "neun|nine",
    "zehn|ten", "elf|eleven", "zw\u00f6lf|twelve", "zwanzig|twenty", "hundert|hundred", "tausend|thousand",
)  # fmt: skip
_PARTS = r"(?:einhalb)?(?:te[nrs]?|fach\w*|mal\w*|tel\w*|th|fold|stellig\w*)?"
_MEANINGS = {
    **{name.partition("|")[2]: f"(?:{name}){_PARTS}" for name in _NUMBERS},
    "one": "eins|one|einmal|once",
    "twice": "doppelt\\w*|twice|double",
    "first": "erste[nrs]?|first|zuerst",
    "third": "dritte[nrs]?|third",
    "not": "nicht|kein\\w*|not|never|nie|niemals|cannot|ohne|without",
    "only": "nur|only|lediglich|ausschlie\u00dflich|solely|exclusively",
    "even": "gerade[nrs]?|even",
    "odd": "ungerade[nrs]?|odd",
    "high": "high|h\u00f6her\\w*|h\u00f6chst\\w*|highest|higher",
    "low": "low|nieder\\w*|lowest|lower",
    "most": "maximal\\w*|h\u00f6chstens|maximum",
    "least": "minimal\\w*|mindestens|minimum",
    "left": "links\\w*|left",
    "right": "rechts\\w*|right",
    "read": "lesen|lesend|gelesen|read",
    "write": "schreiben|schreibend|geschrieben|write|written",
    "s": "s|sekunden?|seconds?",
    "ms": "ms|millisekunden?|milliseconds?",
    "min": "min|minuten?|minutes?",
    "h": "h|stunden?|hours?",
    "Hz": "hz|hertz",
    "kHz": "khz",
    "signed": "signed",
    "unsigned": "unsigned",
    "positive": "positiv\\w*",
    "negative": "negativ\\w*",
    "rising": "steigend\\w*|rising",
    "falling": "fallend\\w*|falling",
}
_MEANING = re.compile("|".join(f"(?P<m{at}>{pattern})" for at, pattern in enumerate(_MEANINGS.values())))
_NAMES = tuple(_MEANINGS)
_FEW = 6
"""What is worded anew in more words than these says too much for a single word to tell."""
_SENTENCE = 7
"""Running text has so many words."""
_LABELLED = 3
"""A sentence that ends with its sign has at least so many."""
_WORD = re.compile(r"[^\W_]+")
_ENTRY = re.compile(r"\s*(?:[-*\u2022]\s+)?(?:[^\W\d_]+\s\d+|\S*\d\S*\s|\S+(?:\s\S+){0,2}\s*=)")
"""What opens an entry of a list: a code or number, a name with a number, a name and `=`."""
_MONTHS = "jan|feb|m\u00e4r|mar|apr|mai|may|jun|jul|aug|sep|okt|oct|nov|de[zc]"
DATE = re.compile(
    r"\b(?:[0-9]{1,2}[./-][0-9]{1,2}[./-](?:[0-9]{2}){1,2}|(?:19|20)[0-9]{2}-[0-9]{2}(?:-[0-9]{2})?"
    rf"|[0-9]{{1,2}}/(?:19|20)[0-9]{{2}}|(?:{_MONTHS})[^\W\d]*\.? (?:19|20)[0-9]{{2}})\b",
    re.IGNORECASE,
)
_EDITION = re.compile(r"\b(?:Edition|Ausgabe|Auflage|Stand|issue|revision)\b[^.;:,]{0,12}$|\u00a9[^.]*$", re.IGNORECASE)
REFERENCE = (
    r"\b(?:Seiten?|S\.|pages?|p\.|Kapitel|Kap\.|Abschnitt|chapter|section|Abbildung|Abb\.|Bild|figure|fig\.)\s*"
    r"(?:\w{1,2}[-\u2010-\u2013.])?"
)
"""What stands before a number that is no fact: of a page, a chapter, a picture; `3-` where chapters count them."""
_REFERENCE = re.compile(f"{REFERENCE}$", re.IGNORECASE)
_TITLE = re.compile(r"[0-9]+[^\W\d_]{4,}")
_ABBREVIATION = re.compile(r"[A-Z]{2,5}")
_CODE = re.compile(r"\w*[0-9]\w*|[A-Z]{2,5}")


def turned(gaps: Iterable[tuple[list[str], list[str]]]) -> list[str]:
    """The words that a changed line has now, or lost, and that tell something else than those in their place."""
    told: list[str] = []
    for was, now in gaps:
        if len(was) <= _FEW and len(now) <= _FEW:
            gone, come = Counter(map(meaning, was)), Counter(map(meaning, now))
            told += [word for word in now if meaning(word) and come[meaning(word)] > gone[meaning(word)]]
            told += [word for word in was if meaning(word) and gone[meaning(word)] > come[meaning(word)]]
            told += now if was != now and all(map(_ABBREVIATION.fullmatch, (*was, *now))) else ()
    return list(dict.fromkeys(told))


def meaning(word: str) -> str:
    """What a word says in either language that must not change; "" if it is no such word. `3` is `drei`."""
    match = _MEANING.fullmatch(word.casefold())
    if match is None or match.lastgroup is None:
        return ""
    parts = "half" if "einhalb" in word.casefold() else ""
    return _NAMES[int(match.lastgroup[1:])] + parts


def is_of_edition(line: str, column: int) -> bool:
    """Whether a number is part of a date, or tells the edition."""
    dates = (match.span() for match in DATE.finditer(line))
    return _EDITION.search(line, 0, column - 1) is not None or any(first < column <= last for first, last in dates)


def is_reference(line: str, column: int) -> bool:
    """Whether a number is that of a page, a chapter, a picture."""
    return _REFERENCE.search(line, 0, column - 1) is not None


def is_title(word: str) -> bool:
    """Whether a word is the title of a section that its number is glued to."""
    return _TITLE.fullmatch(word) is not None


def is_code(word: str) -> bool:
    """Whether a word is a code or an abbreviation."""
    return _CODE.fullmatch(word) is not None


def is_prose(line: str, column: int = 1) -> bool:
    """Whether the words from a column on are running text: no row, no title, no label in front of an entry."""
    if is_row(line):
        return False
    if _ENTRY.match(line):
        end = line.find(". ")
        return 0 <= end < column - 1
    words = len(_WORD.findall(line))
    text = line.strip()
    if text.startswith("#") or words == 0:
        return False
    goes_on = text[0].islower() or text.endswith("-")
    return words >= _SENTENCE or goes_on or (text[-1] in ".!?;," and words >= _LABELLED)
