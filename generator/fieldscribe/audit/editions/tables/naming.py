"""Names for points, groups and enum numbers, from titles: snake_case, short, and each once."""

from __future__ import annotations

import re
import unicodedata

_GERMAN = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "Ä": "ae", "Ö": "oe", "Ü": "ue", "ß": "ss", "%": " percent "})
_SIGNS = {"°": " deg ", "µ": "u", "φ": "phi", "ϕ": "phi", "Ω": "ohm", "+": " plus ", ">": " above ", "<": " below "}
_FEW = {"the", "a", "an", "of", "and", "for", "der", "die", "das", "dem", "den", "und", "fuer", "zur", "zum", "von"}
_BROKEN = re.compile(r"(?<=[a-zäöüß])-\s+(?=[a-zäöüß])")
LONGEST = 48
"""Longer names are cut at a word: the longest of our descriptions has 47 characters."""


def snake(title: str, otherwise: str = "unnamed") -> str:
    """A title as a name; `otherwise` where nothing is left of it, before what starts with a digit."""
    text = _BROKEN.sub("", title).translate(_GERMAN)
    for sign, spoken in _SIGNS.items():
        text = text.replace(sign, spoken)
    plain = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode().lower()
    words = re.findall(r"[a-z0-9]+", plain)
    kept = [word for word in words if word not in _FEW] or words
    name = ""
    for word in kept:
        if name and len(name) + len(word) >= LONGEST:
            break
        name = f"{name}_{word}" if name else word[:LONGEST]
    if not name:
        return otherwise
    return name if name[0].isalpha() else f"{otherwise}_{name}"[:LONGEST].rstrip("_")


class Names:
    """Names that are given once."""

    def __init__(self) -> None:
        self._given: set[str] = set()

    def give(self, name: str, *suffixes: str) -> str:
        """The name, or else with the first suffix that makes it new, or with a number."""
        candidates = [name, *(f"{name}_{suffix}" for suffix in suffixes if suffix)]
        number = 2
        while candidates and candidates[0] in self._given:
            candidates.pop(0)
            if not candidates:
                candidates.append(f"{name}_{number}")
                number += 1
        self._given.add(candidates[0])
        return candidates[0]
