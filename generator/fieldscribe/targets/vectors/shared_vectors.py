"""The vectors of the raw numbers of a point, written once for all points with the same encoding."""

from __future__ import annotations

from collections.abc import Hashable

from fieldscribe.targets.vectors.floats import floats
from fieldscribe.targets.vectors.integers import bits, fixed, flags, names, specials, whole, words
from fieldscribe.targets.vectors.lines import Lines
from fieldscribe.targets.vectors.oracle import Oracle
from fieldscribe.targets.vectors.samples import PointEncoding, PointEncodings
from fieldscribe.targets.vectors.scaled import Scaled
from fieldscribe.targets.vectors.texts import digits, displayed, text


class SharedVectors:
    """The shared vectors of one device, in two parts: those that depend on limits, and the others."""

    def __init__(self, lines: Lines, oracle: Oracle, encodings: PointEncodings) -> None:
        self._lines, self._oracle, self._encodings = lines, oracle, encodings
        self._scaled = Scaled(oracle)
        self._within_limits: dict[PointEncoding, Lines] = {}
        self._beside_limits: dict[Hashable, Lines] = {}

    def within_limits(self, encoding: PointEncoding) -> Lines:
        """Return conversions, checks and names; they are deep for the first point that is computed in this way."""
        part = self._within_limits.get(encoding)
        if part is None:
            deep = self._encodings.is_new(encoding)
            part = self._lines.part()
            self._convert(part, encoding, deep=deep)
            if not deep:
                self._within_limits[encoding] = part
        return part

    def _convert(self, lines: Lines, encoding: PointEncoding, *, deep: bool) -> None:
        shape, oracle = encoding.shape, self._oracle
        if shape.form == "scaled":
            self._scaled.add(lines, encoding, deep=deep)
        elif shape.form == "float":
            floats(lines, encoding, deep=deep)
        elif shape.form == "text":
            text(lines, shape)
        elif shape.form == "digits":
            digits(lines, shape)
        else:
            whole(lines, oracle, encoding, deep=deep)
        if shape.display is not None:
            displayed(lines, oracle, encoding, deep=deep)
        names(lines, shape, deep=deep)

    def beside_limits(self, encoding: PointEncoding) -> Lines:
        """Return what no limits decide about: special codes, flags, groups of bits, words."""
        key = id(encoding.shape), encoding.bits, encoding.order
        part = self._beside_limits.get(key)
        if part is None:
            part = self._beside_limits[key] = self._lines.part()
            specials(part, encoding.shape)
            flags(part, encoding.shape)
            fixed(part, encoding.shape)
            bits(part, encoding)
            words(part, encoding)
        return part
