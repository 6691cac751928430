"""The one place where text from a file becomes YAML: whatever a cell holds, it stays a text, or inside its comment."""

from __future__ import annotations

import json
import re

from fieldscribe.text import line

_BARE = re.compile(r"[^\W\d_](?:[\w /()%°+.=-]*[\w)%])?")
_SURPRISES = frozenset(("y", "n", "yes", "no", "on", "off", "true", "false", "null", "nan", "inf"))
_NUMBERLIKE = re.compile(r"[0-9A-Fa-f.]+[hH]?|.*\d[eE][-+]?\d+.*")
_LONGEST_COMMENT = 220


def text(value: str) -> str:
    """A text as a scalar that is right in block and in flow style; quoted wherever a reader might think twice."""
    cleaned = line(value)
    if _BARE.fullmatch(cleaned) and cleaned.casefold() not in _SURPRISES and not _NUMBERLIKE.fullmatch(cleaned):
        return cleaned
    return json.dumps(cleaned, ensure_ascii=False)


def code(value: str) -> str:
    """A short name of the manual, such as `A020`: bare where it can be nothing else."""
    cleaned = line(value)
    return (
        cleaned
        if re.fullmatch(r"[G-Zg-z]\w{0,20}|[A-Za-z]\d+", cleaned) and not _is_number(cleaned)
        else json.dumps(cleaned, ensure_ascii=False)
    )


def _is_number(value: str) -> bool:
    return re.fullmatch(r"[0-9A-Fa-f]+[hH]", value) is not None or value.casefold() in _SURPRISES


def question(value: str) -> str:
    """A comment that asks: one line, without what could end it."""
    cleaned = line(value)
    return f"# ? {cleaned if len(cleaned) <= _LONGEST_COMMENT else cleaned[:_LONGEST_COMMENT] + ' …'}"


def flow_value(value: str) -> str:
    """A value that we made (`0..4000`, `0.1 Hz`, `1028h`): quoted where commas or signs would part it."""
    if re.fullmatch(r"-?[0-9][0-9A-Fa-f]*[hH]?|-?\d+(?:\.\d+)?|-?[\d.]+\.\.-?[\d.]+|[\d.]+ [A-Za-zµ°Ω/]+", value):
        return value
    return json.dumps(line(value), ensure_ascii=False)
