"""Names for numbers in cells: `00 .. off`, `0 = off`, `1: on`, as lines or one behind the other."""

from __future__ import annotations

import re

from fieldscribe.audit.editions.tables.cell_text import without_footnotes

_ENTRY = re.compile(
    r"^[ \t>(]*(?P<number>0x[0-9A-Fa-f]{1,4}|\d{1,5})\)?\s*(?:\.{2,}|…|:|=(?!=)|[-–](?=\s)|\s(?=\())\s*(?P<label>\S.*)$"
)
_BEHIND = re.compile(
    r"(?:^|(?<=[,;)\s]))(?P<number>\d{1,5})\s*(?:=|:)\s*(?P<label>.+?)(?=[,;]?\s+\d{1,5}\s*(?:=|:)|[,;]?\s*$)"
)
_ENCLOSED = re.compile(r"(\d{1,5})\s*\(([^()]*[^()\d\s][^()]*)\)")
_ALL_ENCLOSED = re.compile(rf"(?:{_ENCLOSED.pattern}[,;\s]*){{2,}}")
_COUNT = re.compile(
    r"^\s*(\d{1,3})\s+(?:\w+möglichkeiten|\w*[Oo]ption(?:s|en)|choices|\w*[Ee]instellungen|\w*[Ss]ettings)"
)
_MOST = 512


def labels_in(text: str) -> dict[int, str]:
    """The numbers that a cell names, in its order; empty if it names fewer than two."""
    entries = {} if _ALL_ENCLOSED.fullmatch(" ".join(text.split())) else _lines(text)
    if len(entries) < 2:
        entries = _one_behind_the_other(text)
    return entries if len(entries) >= 2 else {}


def choices_in(text: str) -> int | None:
    """How many choices a cell says that there are."""
    found = _COUNT.match(text)
    return int(found[1]) if found else None


def without_labels(text: str) -> str:
    """The text of a cell without what names numbers: in that, numbers are no ranges."""
    if len(_lines(text)) >= 2 or (choices_in(text) is not None and _lines(text)):
        return "\n".join(line for line in text.split("\n") if not _ENTRY.match(line))
    if labels_in(text):
        first = _BEHIND.search(" ".join(text.split()))
        return " ".join(text.split())[: first.start()] if first else ""
    return text


def first_labels(text: str) -> dict[int, str]:
    """As `labels_in`, also of a single entry: the rest may stand in the row below."""
    return _lines(text)


def _lines(text: str) -> dict[int, str]:
    entries: dict[int, str] = {}
    last: int | None = None
    for line in text.split("\n"):
        found = _ENTRY.match(line)
        if found:
            last = int(found["number"], 0) if found["number"].startswith("0x") else int(found["number"])
            if last in entries or len(entries) >= _MOST:
                return {}
            entries[last] = found["label"]
        elif last is not None and line.strip() and not line.isupper() and "!" not in line:
            entries[last] = _joined(entries[last], line)
    labels = {number: _label(label) for number, label in entries.items()}
    return {number: label for number, label in labels.items() if label}


def _joined(label: str, line: str) -> str:
    broken = re.search(r"[a-zäöüß]-$", label) and line.strip()[:1].islower()
    return label[:-1] + line.strip() if broken else f"{label} {line.strip()}"


def _one_behind_the_other(text: str) -> dict[int, str]:
    """`0 = off, 1 = on` or `00 (off), 01 (on)`."""
    whole = " ".join(text.split())
    form = _ENCLOSED if _ALL_ENCLOSED.fullmatch(whole) else _BEHIND
    entries: dict[int, str] = {}
    for found in form.finditer(whole):
        number = int(found[1])
        if number in entries or len(entries) >= _MOST:
            return {}
        entries[number] = _label(found[2])
    return {number: label for number, label in entries.items() if label}


def _label(text: str) -> str:
    plain = without_footnotes(text).strip(" ,;.-–")
    if plain.startswith("(") and plain.endswith(")") and plain.count("(") == 1:
        plain = plain[1:-1]
    return plain[:120]
