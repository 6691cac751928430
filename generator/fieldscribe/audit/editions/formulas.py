"""Formulas in TeX as plain text, each sign where it stood: how they are set is layout."""

from __future__ import annotations

import re

_SIGNS = {
    "cdot": "\u00b7", "times": "\u00d7", "leq?": "\u2264", "geq?": "\u2265", "pm": "\u00b1", "Omega": "\u03a9",
    "mu": "\u03bc", "(?:var)?phi": "\u03c6", "Delta": "\u0394", "approx": "\u2248", "infty": "\u221e",
}  # fmt: skip
_SIGN = re.compile("|".join(rf"(\\{name}(?![A-Za-z]))" for name in _SIGNS))
_DEGREE = re.compile(r"\^?\{?\\circ\}?")
_FONT = re.compile(r"(\\(?:text|textrm|textit|textbf|mathrm|mathit|mathbf|operatorname)\s*\{)([^{}]*)\}")
_FRACTION = re.compile(r"(\\[dt]?frac\s*\{)([^{}]*)\}\{([^{}]*)\}")
_SPACE = re.compile(r"\\(?:left|right|quad|qquad)(?![A-Za-z])|\\[,;:! ]")
_ESCAPE = re.compile(r"\\(?=[%_#&])")


def without_setting(line: str) -> str:
    """A line as long as it was, its formulas without what only sets them."""
    if "\\" in line:
        line = _SIGN.sub(lambda match: [*_SIGNS.values()][(match.lastindex or 1) - 1].ljust(len(match[0])), line)
        line = _DEGREE.sub(lambda match: "\u00b0".ljust(len(match[0])), line)
        line = _FONT.sub(lambda match: f"{_blank(match[1])}{match[2]} ", line)
        line = _FRACTION.sub(lambda match: f"{_blank(match[1])}{match[2]}/ {match[3]} ", line)
        line = _SPACE.sub(lambda match: _blank(match[0]), line)
        line = _ESCAPE.sub(" ", line)
    return line if line.count("$") % 2 else line.replace("$", " ")


def _blank(text: str) -> str:
    return " " * len(text)
