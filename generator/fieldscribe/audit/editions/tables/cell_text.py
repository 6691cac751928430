"""The text of a cell without what a text extraction leaves in it: tags, emphasis, marks of footnotes, TeX."""

from __future__ import annotations

import html
import re

_BREAKS = re.compile(r"\s*<\s*(?:br|/?li|/?ul|/?p)\b[^<>]{0,40}>\s*", re.IGNORECASE)
_TAGS = re.compile(r"<\s*/?\s*[a-zA-Z][^<>]{0,80}>")
_EMPHASIS = re.compile(r"\*\*|__|(?<!\S)\*(?=\S)(?!\d)|(?<=\S)(?<!\d)\*(?!\S)")
_FOOTNOTE = re.compile(r"(?:(?<=\s)|^|(?<=[\w)%]))\*\d\b")
_FRACTION = re.compile(r"\\d?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}")
_TEX = ((r"\cdot", "*"), (r"\times", "*"), (r"\,", " "), (r"\%", "%"), ("$", ""))
_TEX_TEXT = re.compile(r"\\(?:text|mathrm|mathit)\s*\{([^{}]*)\}")
_SPACES = re.compile(r"[ \t\u00a0\u2007\u202f]+")
_HYPHEN = re.compile(r"(?<=[a-zäöüß])-\s*\n\s*(?=[a-zäöüß])|(?<=[a-zäöüß])- (?=[a-zäöüß]{3})(?!und |oder )")


def clean(cell: str) -> str:
    """The cell as plain text; line breaks inside it stay."""
    text = _SPACES.sub(" ", cell).strip()
    if "<" in text:
        text = _TAGS.sub("", _BREAKS.sub("\n", text))
    if "&" in text:
        text = html.unescape(text)
    if "*" in text or "__" in text:
        text = _EMPHASIS.sub("", text)
    if "\\" in text or "$" in text:
        text = _without_tex(text)
    return _SPACES.sub(" ", text).strip()


def one_line(cell: str) -> str:
    """The cell on one line, with words joined that were parted at the end of a line, and without footnote marks."""
    joined = _HYPHEN.sub("", cell)
    return " ".join(without_footnotes(joined).split())


def without_footnotes(text: str) -> str:
    """The text without marks such as `*1`."""
    return _FOOTNOTE.sub("", text).strip() if "*" in text else text


def _without_tex(text: str) -> str:
    for _ in range(4):
        text, count = _TEX_TEXT.subn(r"\1", text)
        text, more = _FRACTION.subn(r"(\1/\2)", text)
        if not count + more:
            break
    for sign, plain in _TEX:
        text = text.replace(sign, plain)
    return text
