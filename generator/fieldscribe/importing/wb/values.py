"""The values of a template: numbers, texts in several languages, and names of numbers."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import Any, TypeAlias

from fieldscribe.importing.draft_text import Names, scalar, snake, titles_text

Labels: TypeAlias = dict[int, str]
"""The names of raw numbers."""


class Texts:
    """The texts of a template, which are English, or keys of its translations."""

    def __init__(self, translations: Any) -> None:
        read = translations if isinstance(translations, dict) else {}
        self._texts = {
            language: texts
            for language, texts in read.items()
            if re.fullmatch("[a-z]{2}", language) and isinstance(texts, dict)
        }

    def english(self, key: str) -> str:
        """Return the English text."""
        return str(self._texts.get("en", {}).get(key, key))

    def others(self, key: str) -> dict[str, str]:
        """Return the texts in other languages."""
        found = {language: texts.get(key) for language, texts in self._texts.items() if language != "en"}
        return {language: str(text) for language, text in found.items() if text and str(text) != self.english(key)}


def objects(value: Any) -> list[dict[str, Any]]:
    """Return the objects of a list; of anything else, none."""
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []


def whole_of(value: Any) -> int | None:
    """Return a whole number of a template; None for what is none."""
    number = number_of(value)
    return None if number is None or number.denominator != 1 else int(number)


def number_of(value: Any) -> Fraction | None:
    """Return a number of a template (5, 0.1, "0x1F"); None for what is none."""
    if isinstance(value, int | Fraction) and not isinstance(value, bool):
        return Fraction(value)
    text = str(value).strip()
    if re.fullmatch("0[xX][0-9a-fA-F]{1,16}", text):
        return Fraction(int(text, 16))
    return Fraction(text) if re.fullmatch(r"-?[0-9]{1,20}(?:\.[0-9]{1,20})?", text) else None


def labels_text(labels: Labels, texts: Texts) -> str:
    """Return the names of numbers as the block of an `enum`."""
    names, lines = Names(), []
    for number, label in labels.items():
        english = texts.english(label)
        name = scalar(names.give(snake(english, "number"), str(abs(number))))
        lines.append(f"\n  {number}: {{name: {name}, {titles_text(english, texts.others(label))[1:]}")
    return "".join(lines)
