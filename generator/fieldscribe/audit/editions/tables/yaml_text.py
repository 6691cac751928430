"""The one place where text from a file becomes YAML: whatever a cell holds, it stays a text, or inside its comment."""

from __future__ import annotations

import re

from fieldscribe.language.load import as_yaml
from fieldscribe.text import line

_NUMBERS = re.compile(r"-?\d+(?:\.\d+)?")
_LONGEST_COMMENT = 220


def text(value: str) -> str:
    """A text from a file as a scalar, on one line and without control characters."""
    return as_yaml(line(value))


def question(value: str) -> str:
    """A comment that asks: one line, without what could end it."""
    cleaned = line(value)
    return f"# ? {cleaned if len(cleaned) <= _LONGEST_COMMENT else cleaned[:_LONGEST_COMMENT] + ' …'}"


def printed(value: str) -> str:
    """What is printed, as we wrote it: a number stays one (`4136`), all else is a text (`1028h`, `0.1 %`)."""
    return value if _NUMBERS.fullmatch(value) else text(value)
