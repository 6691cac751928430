"""Plain scalars by the YAML 1.2 core rules: `on`, `NO`, `12:30` are text, `010` is ten, decimals are exact."""

from __future__ import annotations

import re
from decimal import Decimal

MOST_DIGITS = 64

_NUMBER = re.compile(
    r"([-+]?[0-9]+)|(0o[0-7]+|0x[0-9a-fA-F]+)|[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-3]?[0-9]{1,2})?"
)
WORDS: dict[str, bool | None] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_PLAIN = re.compile(r"[^\W_][\w .+*/=()°%;<>!'-]*(?<! )")
_OTHERWISE = frozenset({"on", "off", "yes", "no", "y", "n"})
"""Words that readers of YAML 1.1 do not take for text."""
_NUMBER_STARTS = frozenset("-+.0123456789")
_NUMBER_ENDS = frozenset(".0123456789abcdefABCDEF")


def scalar(text: str) -> int | Decimal | bool | str | None:
    """A plain scalar by the rules of the YAML 1.2 core schema; infinities and overlong numbers stay text."""
    if text[:1] not in _NUMBER_STARTS:
        return WORDS.get(text, text)
    if text[-1] not in _NUMBER_ENDS:
        return text
    number = _NUMBER.fullmatch(text)
    if number is None or len(text) > MOST_DIGITS:
        return text
    if number[1]:
        return int(text)
    return int(text, 0) if number[2] else Decimal(text)


def as_yaml(text: str) -> str:
    """A text as a scalar that stands for it everywhere, in quotes where it needs them."""
    if _PLAIN.fullmatch(text) and scalar(text) == text and text.lower() not in _OTHERWISE:
        return text
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
