"""Tables amid the text of a manual: Markdown rows between bars, and lines parted by tabs."""

from __future__ import annotations

import re

from fieldscribe.audit.editions.tables.cell_text import clean, one_line
from fieldscribe.audit.editions.tables.tables import Gathered, Table, UnreadableError

_BARS = re.compile(r"\s*\|.*\|\s*")
_RULE = frozenset(" \t|:+=-")
_CELLS = re.compile(r"(?<!\\)\|")
_HEADING = re.compile(r"\s{0,3}(?:(#{1,6})\s+)?(?:(\d{1,3}(?:\.\d{1,3}){1,5})\.?\s*(?=\s|[^\W\d]))?(\S.*)")
_CONTENTS = re.compile(r".*\.{3,}[\s|]*\d*\s*|\d{1,3}(?:\.\d{1,3})+\t[^\t]*\t\d+\s*")
_LONGEST_HEADING, _LONGEST_LINE = 160, 100_000
_RUN_TOGETHER = re.compile(
    r"(?:(0x[0-9A-Fa-f]{4}|[0-9A-Fa-f]{4}h)\s*([A-Z]{3,6}\d{0,2}|(?:[Ff]loat|[Ii]nt|[Ll]ong|[Ww]ord)\d{0,2})"
    r"|()(Bit \d{1,2}))\s*(R/?O|R/?W|W/?O)\s*(\S.*)"
)
"""A row whose cells the extraction has run together: address (or bit), type, access, title."""
_HEADS = ["Address", "Type", "Access", "Name"]


def read_text(text: str) -> list[Table]:
    """The tables of a text, each with the heading above it."""
    gathered, heading, section, form = Gathered(), "", "", ""
    sections: dict[str, str] = {}
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > _LONGEST_LINE:
            raise UnreadableError(
                f"the line has more than {_LONGEST_LINE} characters: this is no manual's text", number
            )
        kind = _form(line)
        if kind != form and not (form == "run" and not kind and not _titled(line)):
            gathered.close(heading, section, sections.get(section.rpartition(".")[0], ""))
            if kind == "run":
                gathered.add(number, _HEADS)
            form = kind
        if kind:
            if not _RULE.issuperset(line):
                gathered.add(number, _cells(line, kind))
        elif titled := _titled(line):
            heading, section = one_line(clean(titled[3])), titled[2] or ""
            sections[section] = heading
    gathered.close(heading, section, sections.get(section.rpartition(".")[0], ""))
    return gathered.tables


def _titled(line: str) -> re.Match[str] | None:
    """A heading: with signs, or with a number of at least two parts."""
    titled = _HEADING.fullmatch(line) if len(line) < _LONGEST_HEADING else None
    return titled if titled and (titled[1] or titled[2]) else None


def _form(line: str) -> str:
    """How the cells of a line are parted: `|`, a tab, `run` together; nothing for prose and tables of contents."""
    if len(line) < 2 * _LONGEST_HEADING and _RUN_TOGETHER.fullmatch(line):
        return "run"
    if "|" in line and _BARS.fullmatch(line):
        return "|"
    is_contents = len(line) < 2 * _LONGEST_HEADING and _CONTENTS.fullmatch(line)
    return "\t" if "\t" in line.strip() and not is_contents else ""


def _cells(line: str, form: str) -> list[str]:
    if form == "run":
        found = _RUN_TOGETHER.fullmatch(line)
        return [clean(cell or "") for cell in (found[1], found[2] or found[4], found[5], found[6])] if found else []
    if form == "\t":
        return [clean(cell) for cell in line.split("\t")]
    inner = line.strip()[1:-1]
    return [clean(cell.replace("\\|", "|")) for cell in _CELLS.split(inner)]
