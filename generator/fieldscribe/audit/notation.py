"""The manual's notation: how it writes what a description writes otherwise, from the keys of the documents."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from fieldscribe.language.nodes import Map

USUAL_ACCESS: Final = {
    "r": ("R", "RO", "R/O", "r", "ro"),
    "w": ("W", "WO", "W/O", "w", "wo"),
    "rw": ("R/W", "RW", "r/w", "rw"),
}
"""How tables print access in cells of their own, where the description does not say how this manual does."""
USUAL_TYPES: Final = {
    "bit": ("BIT", "Bit", "BOOL", "Bool", "bool"),
    "u8": ("UINT8", "uint8", "U8", "u8", "BYTE", "Byte"),
    "s8": ("INT8", "int8", "S8", "s8", "I8", "SINT"),
    "u16": ("UINT16", "uint16", "U16", "u16", "UINT", "WORD", "Word", "Wort"),
    "s16": ("INT16", "int16", "S16", "s16", "I16", "INT", "SHORT"),
    "u32": ("UINT32", "uint32", "U32", "u32", "UDINT", "ULONG", "DWORD", "Doppelwort"),
    "s32": ("INT32", "int32", "S32", "s32", "I32", "DINT", "LONG"),
    "f32": ("FLOAT32", "float32", "F32", "f32", "FLOAT", "Float", "float", "REAL"),
    "f64": ("FLOAT64", "float64", "F64", "f64", "DOUBLE", "Double", "LREAL"),
}
"""How tables usually print types."""


class Notation:
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

    def written(self, text: object) -> tuple[str, ...]:
        """Return the manual's words for the letters of a code, the name of a numbering, a number, or `default`."""
        return tuple(self._words.get(str(text), ()))

    def bits(self, high: int, low: int) -> tuple[str, ...]:
        """Return the manual's names for a part of a word: `Highbyte` for 15..8."""
        return self.written(f"{high}..{low}")

    def label(self, titles: Mapping[str, Any] | str | None) -> tuple[str, ...]:
        """Return a title as the manual prints it, in its language; empty where `writes` says that it prints none."""
        text = titles.get(self.language) if isinstance(titles, dict) else titles if self.language == "en" else None
        if text is None or not any(map(str.isalpha, str(text))):
            return ()
        return tuple(self._words.get(str(text), (str(text),)))


def joined(name: str, number: object) -> tuple[str, ...]:
    """Return how a manual writes a name and a number as one word: `PZD2`, `Bit13`."""
    return tuple(f"{name}{number}" for name in (name, name.capitalize(), name.upper()))
