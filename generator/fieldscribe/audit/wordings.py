"""The manual's own words: how it writes what a description writes otherwise, from the keys of its documents."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping
    from fractions import Fraction

    from fieldscribe.language.nodes import Map


class Wordings:
    """What `writes`, `access` and `names` of the documents say, and the language that the manual is in."""

    def __init__(self, documents: Map) -> None:
        self._words: dict[str, list[str]] = {}
        self.access: dict[str, list[str]] = {}
        self.names: list[str] = []
        self.language = next((str(document["language"]) for document in documents.values()), "")
        for document in documents.values():
            for written, words in document.get("writes", {}).items():
                self._words.setdefault(str(written), []).extend(map(str, words))
            for access, words in document.get("access", {}).items():
                self.access.setdefault(access, []).extend(map(str, words))
            self.names += map(str, document.get("names", ()))

    def code(self, letters: str) -> list[str]:
        """The words that the manual has for the letters of a code: `Parameter` for `P`."""
        return self._words.get(letters, [])

    def bits(self, high: int, low: int) -> list[str]:
        """The names that the manual has for a part of a word: `Highbyte` for 15..8."""
        return self._words.get(f"{high}..{low}", [])

    def number(self, number: Fraction) -> list[str]:
        """The words that the manual has for a number: `zero` for 0."""
        return self._words.get(str(number), [])

    def label(self, titles: Mapping[str, Any] | str | None) -> tuple[str, ...]:
        """A title as the manual prints it, in its language; nothing where it prints none, as `writes` says."""
        text = titles.get(self.language) if isinstance(titles, dict) else titles if self.language == "en" else None
        if text is None or not any(map(str.isalpha, str(text))):
            return ()
        return tuple(self._words.get(str(text), (str(text),)))


def joined(numbering: str, number: object) -> tuple[str, ...]:
    """How a manual writes a number that is part of a name: `PZD2`, `Bit13`."""
    return tuple(f"{name}{number}" for name in (numbering, numbering.capitalize(), numbering.upper()))
