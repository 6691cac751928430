"""The vectors of the raw numbers of a point, written once for all points whose numbers mean the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.characters import digits, text
from fieldscribe.targets.vectors.floats import floats
from fieldscribe.targets.vectors.scaled import Scaled
from fieldscribe.targets.vectors.shown import shown
from fieldscribe.targets.vectors.whole import bits, fixed, flags, names, specials, whole
from fieldscribe.targets.vectors.words import words

if TYPE_CHECKING:
    from collections.abc import Hashable

    from fieldscribe.targets.vectors.lines import Lines
    from fieldscribe.targets.vectors.meaning import Meaning, Meanings
    from fieldscribe.targets.vectors.oracle import Oracle


class Sheets:
    """The sheets of one device."""

    def __init__(self, lines: Lines, oracle: Oracle, meanings: Meanings) -> None:
        self._lines, self._oracle, self._meanings = lines, oracle, meanings
        self._scaled = Scaled(oracle)
        self._written: dict[Meaning, Lines] = {}
        self._parts: dict[Hashable, Lines] = {}

    def of(self, meaning: Meaning) -> Lines:
        """The sheet of what limits decide about; a deep one for the first point of all that are computed alike."""
        sheet = self._written.get(meaning)
        if sheet is None:
            deep = self._meanings.is_new(meaning)
            sheet = self._lines.apart()
            self._write(sheet, meaning, deep=deep)
            if not deep:
                self._written[meaning] = sheet
        return sheet

    def _write(self, lines: Lines, meaning: Meaning, *, deep: bool) -> None:
        shape, oracle = meaning.shape, self._oracle
        if shape.form == "scaled":
            self._scaled.add(lines, meaning, deep=deep)
        elif shape.form == "float":
            floats(lines, meaning, deep=deep)
        elif shape.form == "text":
            text(lines, shape)
        elif shape.form == "digits":
            digits(lines, shape)
        else:
            whole(lines, oracle, meaning, deep=deep)
        if shape.display is not None:
            shown(lines, oracle, meaning, deep=deep)
        names(lines, shape, deep=deep)

    def of_bits(self, meaning: Meaning) -> Lines:
        """The sheet of what no limits decide about: special codes, flags, groups of bits, words."""
        key = id(meaning.shape), meaning.bits, meaning.order
        sheet = self._parts.get(key)
        if sheet is None:
            sheet = self._parts[key] = self._lines.apart()
            specials(sheet, meaning.shape)
            flags(sheet, meaning.shape)
            fixed(sheet, meaning.shape)
            bits(sheet, meaning)
            words(sheet, meaning)
        return sheet
