"""The vectors of raw numbers, written once for all points with the same computation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.displayed_texts import shown
from fieldscribe.targets.vectors.floats import floats
from fieldscribe.targets.vectors.integers import bits, fixed, flags, names, specials, whole, words
from fieldscribe.targets.vectors.scaled import Scaled
from fieldscribe.targets.vectors.texts_and_digits import digits, text

if TYPE_CHECKING:
    from collections.abc import Hashable

    from fieldscribe.targets.vectors.computations import Computation, Computations
    from fieldscribe.targets.vectors.lines import Lines
    from fieldscribe.targets.vectors.oracle import Oracle


class SharedVectors:
    """The shared vectors of one device."""

    def __init__(self, lines: Lines, oracle: Oracle, computations: Computations) -> None:
        self._lines, self._oracle, self._computations = lines, oracle, computations
        self._scaled = Scaled(oracle)
        self._written: dict[Computation, Lines] = {}
        self._parts: dict[Hashable, Lines] = {}

    def of(self, computation: Computation) -> Lines:
        """Return the vectors that depend on limits; in depth for the first computation by the same rules."""
        sheet = self._written.get(computation)
        if sheet is None:
            deep = self._computations.is_new(computation)
            sheet = self._lines.apart()
            self._write(sheet, computation, deep=deep)
            if not deep:
                self._written[computation] = sheet
        return sheet

    def _write(self, lines: Lines, computation: Computation, *, deep: bool) -> None:
        shape, oracle = computation.shape, self._oracle
        if shape.form == "scaled":
            self._scaled.add(lines, computation, deep=deep)
        elif shape.form == "float":
            floats(lines, computation, deep=deep)
        elif shape.form == "text":
            text(lines, shape)
        elif shape.form == "digits":
            digits(lines, shape)
        else:
            whole(lines, oracle, computation, deep=deep)
        if shape.display is not None:
            shown(lines, oracle, computation, deep=deep)
        names(lines, shape, deep=deep)

    def of_bits(self, computation: Computation) -> Lines:
        """Return the vectors that do not depend on limits: special codes, flags, bit groups, words."""
        key = id(computation.shape), computation.bits, computation.order
        sheet = self._parts.get(key)
        if sheet is None:
            sheet = self._parts[key] = self._lines.apart()
            specials(sheet, computation.shape)
            flags(sheet, computation.shape)
            fixed(sheet, computation.shape)
            bits(sheet, computation)
            words(sheet, computation)
        return sheet
