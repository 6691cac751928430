"""Folds long lines of generated C."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.patterns import blanks

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.render import Render

MOST = 120
_DEEPER = "    "
_WHOLE = re.compile(r'"(?:[^"\\]|\\.)*"| ')
"""A string, which must not be broken, or a space, where a line may be broken."""


def folded(text: str) -> str:
    """The same C in lines of at most 120 characters; a macro goes on behind a backslash."""
    lines = text.split("\n")
    if max(map(len, lines)) <= MOST:
        return text
    return "\n".join([part for line in lines for part in (_parts(line) if len(line) > MOST else (line,))])


def framed(render: Render, template: str, context: Mapping[str, object], texts: Mapping[str, str]) -> str:
    """The template, folded, around texts that are folded already."""
    places = dict(zip(texts, blanks(["_" if text else "" for text in texts.values()]), strict=True))
    result = folded(render(template, {**context, **places}))
    for name, text in texts.items():
        result = text.join(result.split(places[name])) if text else result
    return result


def _parts(line: str) -> list[str]:
    """One line broken into several; those after the first are indented."""
    directive = line.startswith("#")
    most = MOST - 2 if directive else MOST
    inside = " " * (len(line) - len(line.lstrip())) + _DEEPER
    parts: list[str] = []
    while len(line) > MOST and (at := _break(line, most)):
        parts.append(line[:at] + (" \\" if directive else ""))
        line = inside + line[at + 1 :]
    return [*parts, line]


def _break(line: str, most: int) -> int:
    """The last space up to `most` that is in no string and not in the line's indentation; 0 if there is none."""
    start = len(line) - len(line.lstrip())
    spaces = [match.start() for match in _WHOLE.finditer(line, start) if match[0] == " "]
    return max((at for at in spaces if at <= most), default=0)
