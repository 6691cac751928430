"""The version of a description: three numbers, and one to compare."""

from __future__ import annotations

from typing import NamedTuple, Self


class Version(NamedTuple):
    """`1.2.3`: what breaks users raises the first number, what is new the second, what they do not notice the third."""

    major: int
    minor: int
    patch: int

    @classmethod
    def of(cls, text: str) -> Self:
        """The version that a text of that form says."""
        return cls(*map(int, text.split(".")))

    @property
    def number(self) -> int:
        """One number that grows with the version; the language's form of versions keeps it below 2 ** 32."""
        return (self.major * 1000 + self.minor) * 1000 + self.patch
