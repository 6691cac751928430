"""What a scale or a condition in another notation probably means, in ours: tables of patterns and replacements."""

from __future__ import annotations

import re
from collections.abc import Callable

from fieldscribe.language.formula.conditions import parse_condition
from fieldscribe.language.formula.lint import exact_scale
from fieldscribe.language.formula.parser import parse_scale
from fieldscribe.language.formula.syntax import FormulaError

_SIGNS = str.maketrans({"\u00d7": "*", "\u00b7": "*", "\u22c5": "*", "\u00f7": "/", "\u2212": "-", "\u2013": "-"})
_FACTOR = r"[0-9]+(?:\.[0-9]+)?"
_SIDES = {
    name: side
    for side, names in (
        ("value", "value y phys physical eng engineering result scaled actual real display wert"),
        ("raw", "raw x reg register count counts int integer data word rohwert"),
    )
    for name in names.split()
}
_SCALES = (
    (rf"\*\s*({_FACTOR})", r"value = raw * \1"),
    (rf"[xX]\s*({_FACTOR})", r"value = raw * \1"),
    (rf"({_FACTOR})\s*[xX*]?", r"value = raw * \1"),
    (rf"/\s*({_FACTOR})", r"value = raw / \1"),
    (rf"1\s*[:/]\s*({_FACTOR})", r"value = raw / \1"),
    (rf"({_FACTOR})\s*[:/]\s*({_FACTOR})", r"value = raw * \1 / \2"),
    (r"10\s*(?:\*\*|\^)\s*([-+]?[0-9]+)", r"value = raw * 10 ** \1"),
    (rf"({_FACTOR})\s*[^\W\d_]{{1,4}}(?:/bit|/digit|/lsb|/count)?", r"value = raw * \1"),
    (r"([^=]*\braw\b[^=]*)", r"value = \1"),
    (r"([^=]*\bvalue\b[^=]*)", r"raw = \1"),
    (r"(.*=.*)", r"\1"),
)
"""A pattern of the whole text, with our signs, and the scale that it stands for."""
_CONDITIONS = (
    (r"^\s*(?:if|only if|when)\s+", ""),
    (r"\|\|", " or "),
    (r"&&?", " and "),
    (r"\bis not\b|<>|\u2260", "!="),
    (r"\bis\b|===|(?<![=!<>])=(?!=)", "=="),
    (r"\bin\s*[\[{]([^\]}]*)[\]}]", r"in (\1)"),
    (r"([A-Za-z]\w*) in ([-+0-9A-Fa-fxh]+)\s*\.\.\s*([-+0-9A-Fa-fxh]+)", r"\1 >= \2 and \1 <= \3"),
)
"""What is replaced in a condition, one after the other."""
_LONGEST_FORMULA = 80


def suggest_scale(text: str) -> str | None:
    """Return the scale that a text probably means, in our notation; None if there is no suggestion."""
    if len(text) > _LONGEST_FORMULA:
        return None
    plain = re.sub(r"(?<=[0-9]),(?=[0-9])", ".", text.translate(_SIGNS).strip())
    plain = re.sub(r"(?<=[\w)])\s+[xX]\s+(?=[\w(])", " * ", plain)
    plain = re.sub(r"(?<=10)\s*\^\s*", " ** ", plain).replace("==", "=").replace(":=", "=")
    if "=" in plain or re.search(r"\b(raw|value)\b", plain):
        plain = re.sub(r"[A-Za-z_]+", lambda word: _SIDES.get(word[0].lower(), word[0]), plain)
    for pattern, scale in _SCALES:
        match = re.fullmatch(pattern, plain)
        line = "" if match is None else match.expand(scale)
        if line and _is_read_by(parse_scale, line):
            return exact_scale(line)
    return None


def suggest_condition(text: str) -> str | None:
    """Return the condition that a text probably means, in our notation; None if there is no suggestion."""
    if len(text) > _LONGEST_FORMULA:
        return None
    plain = text
    for pattern, replacement in _CONDITIONS:
        plain = re.sub(pattern, replacement, plain)
    plain = " ".join(plain.split())
    return plain if plain != text and _is_read_by(parse_condition, plain) else None


def _is_read_by(parse: Callable[[str], object], text: str) -> bool:
    try:
        parse(text)
    except FormulaError:
        return False
    return True
