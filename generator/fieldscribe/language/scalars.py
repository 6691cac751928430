"""Plain scalars by the YAML 1.2 core rules: `on`, `NO`, `12:30` are text, `010` is ten, decimals are exact."""

from __future__ import annotations

import re
from decimal import Decimal

MOST_DIGITS = 64

_INTEGER = re.compile(r"[-+]?[0-9]+")
_RADIX = re.compile(r"0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-3]?[0-9]{1,2})?")
_WORDS: dict[str, bool | str | None] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_NUMBER_STARTS = frozenset("-+.0123456789")


def scalar(text: str) -> int | Decimal | bool | str | None:
    """A plain scalar by the rules of the YAML 1.2 core schema; infinities and overlong numbers stay text."""
    if text[:1] not in _NUMBER_STARTS:
        return _WORDS.get(text, text)
    if _INTEGER.fullmatch(text):
        return int(text) if len(text) <= MOST_DIGITS else text
    if _RADIX.fullmatch(text) and len(text) <= MOST_DIGITS:
        return int(text, 0)
    if _FLOAT.fullmatch(text) and len(text) <= MOST_DIGITS:
        return Decimal(text)
    return text
