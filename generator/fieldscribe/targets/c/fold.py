"""No line of generated C is longer than a screen: what is, goes on in the next line."""

from __future__ import annotations

import re

MOST = 120
_DEEPER = "    "
_WHOLE = re.compile(r'"(?:[^"\\]|\\.)*"| ')
"""What may be met on the way along a line: a string, inside of which nothing may be broken, or a space."""


def folded(text: str) -> str:
    """The same C in lines of at most 120 characters; a macro goes on behind a backslash."""
    return "\n".join(part for line in text.split("\n") for part in _parts(line))


def _parts(line: str) -> list[str]:
    """One line as several, those behind the first further in."""
    directive = line.startswith("#")
    most = MOST - 2 if directive else MOST
    inside = " " * (len(line) - len(line.lstrip())) + _DEEPER
    parts: list[str] = []
    while len(line) > MOST and (at := _break(line, most)):
        parts.append(line[:at] + (" \\" if directive else ""))
        line = inside + line[at + 1 :]
    return [*parts, line]


def _break(line: str, most: int) -> int:
    """The last space up to there that is in no string, behind what the line starts with; 0 when there is none."""
    start = len(line) - len(line.lstrip())
    spaces = [match.start() for match in _WHOLE.finditer(line, start) if match[0] == " "]
    return max((at for at in spaces if at <= most), default=0)
