"""Guesses what an unreadable scale or condition was meant to be; each guess is itself readable."""

from __future__ import annotations

import re

from fieldscribe.language.formula.errors import FormulaError
from fieldscribe.language.formula.lint import exact_scale
from fieldscribe.language.formula.statements import parse_scale

_LONGEST = 80
_SIGNS = str.maketrans({"\u00d7": "*", "\u00b7": "*", "\u22c5": "*", "\u00f7": "/", "\u2212": "-", "\u2013": "-"})
_NUMBER = r"[0-9]+(?:\.[0-9]+)?"
_SIDES = {
    "value": "value y phys physical eng engineering result scaled actual real display wert",
    "raw": "raw x reg register count counts int integer data word rohwert",
}
_OURS = {word: ours for ours, words in _SIDES.items() for word in words.split()}
_REWRITTEN = (
    (rf"\*\s*({_NUMBER})", r"value = raw * \1"),
    (rf"[xX]\s*({_NUMBER})", r"value = raw * \1"),
    (rf"({_NUMBER})\s*[xX*]?", r"value = raw * \1"),
    (rf"/\s*({_NUMBER})", r"value = raw / \1"),
    (rf"1\s*[:/]\s*({_NUMBER})", r"value = raw / \1"),
    (rf"({_NUMBER})\s*[:/]\s*({_NUMBER})", r"value = raw * \1 / \2"),
    (r"10\s*(?:\*\*|\^)\s*([-+]?[0-9]+)", r"value = raw * 10 ** \1"),
    (rf"({_NUMBER})\s*[^\W\d_]{{1,4}}(?:/bit|/digit|/lsb|/count)?", r"value = raw * \1"),
    (r"([^=]*\braw\b[^=]*)", r"value = \1"),
    (r"([^=]*\bvalue\b[^=]*)", r"raw = \1"),
)


def scale_meant(text: str) -> str | None:
    """The scale that a text probably means, in our notation; None if there is no guess."""
    if len(text) > _LONGEST:
        return None
    plain = _plain(text)
    for pattern, ours in (*_REWRITTEN, (r"(.*=.*)", r"\1")):
        match = re.fullmatch(pattern, plain)
        line = None if match is None else _readable(match.expand(ours))
        if line is not None:
            return line
    return None


def _plain(text: str) -> str:
    """The text with our signs, and with `raw` and `value` for the two sides."""
    plain = re.sub(r"(?<=[0-9]),(?=[0-9])", ".", text.translate(_SIGNS).strip())
    plain = re.sub(r"(?<=[\w)])\s+[xX]\s+(?=[\w(])", " * ", plain)
    plain = re.sub(r"(?<=10)\s*\^\s*", " ** ", plain).replace("==", "=").replace(":=", "=")
    if "=" not in plain and not re.search(r"\b(raw|value)\b", plain):
        return plain
    return re.sub(r"[A-Za-z_]+", lambda word: _OURS.get(word[0].lower(), word[0]), plain)


def _readable(line: str) -> str | None:
    """The line with its cut decimals made exact; None if it is no readable scale."""
    try:
        parse_scale(line)
    except FormulaError:
        return None
    return exact_scale(line)


_CONDITION = (
    (r"^\s*(?:if|only if|when)\s+", ""),
    (r"\|\|", " or "),
    (r"&&?", " and "),
    (r"\bis not\b|<>|\u2260", "!="),
    (r"\bis\b|===|(?<![=!<>])=(?!=)", "=="),
    (r"\bin\s*[\[{]([^\]}]*)[\]}]", r"in (\1)"),
    (r"([A-Za-z]\w*) in ([-+0-9A-Fa-fxh]+)\s*\.\.\s*([-+0-9A-Fa-fxh]+)", r"\1 >= \2 and \1 <= \3"),
)


def condition_meant(text: str) -> str | None:
    """The condition that a text probably means, in our notation; None if there is no guess."""
    from fieldscribe.language.formula.conditions import read_condition

    plain = text[:_LONGEST]
    for pattern, ours in _CONDITION:
        plain = re.sub(pattern, ours, plain)
    plain = re.sub(r"\s+", " ", plain).strip()
    try:
        read_condition(plain)
    except FormulaError:
        return None
    return plain if plain != text and len(text) <= _LONGEST else None
