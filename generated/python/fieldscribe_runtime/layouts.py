# SPDX-License-Identifier: 0BSD
"""Words of one read or frame and the points in them: one prebuilt Struct unpacks each layout."""

from __future__ import annotations

import struct
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from .arguments import shown
from .errors import (
    AccessError,
    CodecError,
    MissingRawError,
    RequestError,
    WrongLengthError,
    WrongTypeError,
)
from .fast import bits_of, itself, put_together, taken_apart
from .points import Decoding, Encoding
from .rules import NO_RAWS

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence
    from typing import Never, Protocol

    from .fast import Way
    from .points import Point
    from .rules import Raws
    from .session import Value

    class Fields(Protocol):
        """Unpacks bytes into fields and packs them, like a `struct.Struct`."""

        @property
        def size(self) -> int:
            """The number of bytes."""

        def unpack(self, data: bytes, /) -> tuple[int, ...]:
            """Return the fields; raises struct.error for more or fewer bytes."""

        def pack(self, /, *fields: int) -> bytes:
            """Return the bytes."""


_LETTERS = {16: "H", 32: "I", 64: "Q"}


class Piece(NamedTuple):
    """A point: its fields in the Struct, their decoder, and how they make a raw number.

    `whole`: a single field is the raw number itself.
    """

    point: Point
    at: int | slice
    way: Way
    raw: Callable[[Any], int]
    whole: bool


class Layout:
    """Points in words that travel together, big-endian: in a planned read, or in a frame of a telegram.

    Values are by names of points; `size` is the number of bytes of the words. A layout has the points of which it has
    all words. `wanted` names points whose raw numbers other layouts need for scales, `needs` those that scales here
    need. `around` is the number of other bytes before and after the words.
    """

    _full = 0xFFFF
    """All bits of a word."""

    def __init__(
        self, points: Iterable[Point], words: range, wanted: Collection[str] = (), around: tuple[int, int] = (0, 0)
    ) -> None:
        self.words = words
        self._wanted_names, self._around = frozenset(wanted), around
        ordered = sorted(points, key=lambda point: point.facts.at.address)
        self.points = tuple([point for point in ordered if all(at in words for at in addresses_of(point))])
        self._struct, self._pieces = self._cut(around)
        self.size = self._struct.size
        self._read = [piece for piece in self._pieces if isinstance(piece.point, Decoding)]
        self.needs = frozenset([name for piece in self._read for name in piece.point.scale_needs])
        self._own = {piece.point.facts.name: piece for piece in self._pieces if piece.point.facts.name in self.needs}
        self._wanted = {
            piece.point.facts.name: piece for piece in self._pieces if piece.point.facts.name in self._wanted_names
        }
        self.gives = bool(self._wanted)

    def __repr__(self) -> str:
        inside = ", ".join([point.facts.name for point in self.points])
        return f"<{type(self).__name__} of {self.size} bytes: {inside}>"

    def __reduce__(self) -> tuple[Any, ...]:
        """Copy and pickle by the arguments: a Struct cannot be pickled."""
        return type(self), (self.points, self.words, self._wanted_names, self._around)

    def _cut(self, around: tuple[int, int]) -> tuple[Fields, tuple[Piece, ...]]:
        """Return the Struct of the bytes, and the points in its fields."""
        letters, pieces = _cut(self.points, self.words)
        return struct.Struct(f">{around[0]}x{letters}{around[1]}x"), pieces

    def decode(self, data: bytes, raws: Raws = NO_RAWS) -> dict[str, Value]:
        """Return the values in the bytes of the words; `raws` holds raw numbers of other points that scales need.

        Write-only points have no value. Raises WrongLengthError, and what decoding a point raises.
        """
        if not self._own:
            self.__dict__["decode"] = self.decoder  # from the first call on
        if self._own and isinstance(data, (bytes, bytearray)) and len(data) == self.size:
            raws = {**self._known(raws), **self._numbers(self._own, data)}
        values: dict[str, Value] = self.decoder(data, raws)
        return values

    @cached_property
    def decoder(self) -> Way:
        """The decoder, for all raw numbers that scales need."""
        return self._decoder(self._read)

    def _decoder(self, pieces: Sequence[Piece]) -> Way:
        plan = [(piece.point.facts.name, piece.at, piece.way) for piece in pieces]
        return taken_apart(self._struct.unpack, plan, self._refuse)

    def _refuse(self, data: bytes, raws: Raws) -> Never:
        """Raise the error for bytes that are not those of the words."""
        del raws
        try:
            size = len(memoryview(data))
        except TypeError:
            raise WrongTypeError(f"takes {self.size} bytes, not {shown(data)}") from None
        raise WrongLengthError(f"takes {self.size} bytes, not {size}") from None

    def _known(self, raws: Raws) -> Raws:
        """Return the raw numbers; raises WrongTypeError unless they are a mapping by name."""
        if not isinstance(raws, Mapping):
            raise WrongTypeError(f"raws are raw numbers by name, as {{'name': 1}}, not {shown(raws)}")
        return raws

    def decode_known(self, data: bytes, raws: Raws, errors: dict[str, CodecError] | None = None) -> dict[str, Value]:
        """Return the values of points whose scales need nothing unknown; `errors` takes the reasons for the others."""
        known, fields = {**raws, **self._numbers(self._own, data)}, self._struct.unpack(data)
        values: dict[str, Value] = {}
        for piece in self._read:
            if has_needs(piece.point, known, errors):
                with noted(piece.point, errors):
                    values[piece.point.facts.name] = piece.way(fields[piece.at], known)
        return values

    def wanted(self, data: bytes) -> dict[str, int]:
        """Return the raw numbers in the bytes that other layouts need."""
        return self._numbers(self._wanted, data)

    def _numbers(self, pieces: Mapping[str, Piece], data: bytes) -> dict[str, int]:
        fields = self._struct.unpack(data)
        return {name: piece.raw(fields[piece.at]) for name, piece in pieces.items()}

    def encode(self, values: Mapping[str, Any], raws: Raws = NO_RAWS) -> bytes:
        """Return the bytes of the words for a value of every point; `raws` as for decoding, also for limits.

        Raises AccessError if a point cannot be written or some bits belong to no point, RequestError (bad_value) unless
        `values` has exactly the points, and what encoding a point raises.
        """
        quick = self._quick
        try:
            if len(values) == len(self.points):
                data: bytes = quick(values, raws)
                return data
        except (KeyError, TypeError):
            if isinstance(values, Mapping) and values.keys() == self._names:
                raise
        if not isinstance(values, Mapping):
            raise RequestError("bad_value", f"takes values by the names of points, as a dict, not {shown(values)}")
        different = ", ".join(sorted(map(str, values.keys() ^ self._names)))
        raise RequestError("bad_value", f"takes a value for each point and no others: check {different}")

    @property
    def _names(self) -> set[str]:
        return {point.facts.name for point in self.points}

    def _encode(self, values: Mapping[str, Any], raws: Raws) -> bytes:
        """Encode point by point, starting with those that others may need."""
        known = dict(self._known(raws))
        words = dict.fromkeys(self.words, 0)
        for point in sorted(self._written, key=lambda one: bool(one.scale_needs or one.limit_needs)):
            known[point.facts.name] = raw = point.encode(values[point.facts.name], known)
            first = point.facts.at.address
            own = point.to_words(raw) if point.facts.bits is None else (point.insert(words[first], raw),)
            words.update(zip(addresses_of(point), own, strict=True))
        return self._packed(words.values())

    def _packed(self, words: Iterable[int]) -> bytes:
        """Return the bytes of all words."""
        return struct.pack(f">{len(self.words)}H", *words)

    @cached_property
    def _written(self) -> tuple[Encoding[Any], ...]:
        """All points, if they cover every bit of the words; raises AccessError."""
        said = dict.fromkeys(self.words, 0)
        written: list[Encoding[Any]] = []
        for point in self.points:
            if not isinstance(point, Encoding) or point.facts.write_at is not None:
                raise AccessError(f"{point.label} cannot be written with these words")
            fixed = point.wire.ordered([*(point.facts.fixed or (0, 0))])[0]
            bits = self._full if point.facts.bits is None else point.insert(0, -1) | fixed
            said.update({address: said[address] | bits for address in addresses_of(point)})
            written.append(point)
        gaps = ", ".join([str(address) for address, bits in said.items() if bits != self._full])
        if gaps:
            raise AccessError(f"no points cover all bits of the words at {gaps}")
        return tuple(written)

    @cached_property
    def _quick(self) -> Way:
        """The encoder: field by field if each is a point that needs no other."""
        needs = any(point.scale_needs or point.limit_needs for point in self._written)
        if needs or not all(piece.whole for piece in self._pieces):
            return self._encode
        return put_together(self._struct.pack, [(point.facts.name, point.encoder) for point in self._written])


def has_needs(point: Point, known: Raws, errors: dict[str, CodecError] | None) -> bool:
    """Return True if all that the scale needs is known; otherwise add the error to `errors`."""
    missing = [name for name in point.scale_needs if name not in known]
    if missing and errors is not None:
        error = MissingRawError(f"needs {' and '.join(missing)}, not known yet")
        error.point = point.label
        errors[point.facts.name] = error
    return not missing


@contextmanager
def noted(point: Point, errors: dict[str, CodecError] | None) -> Iterator[None]:
    """Add the error of a point without a value to `errors`, so that the others are decoded."""
    try:
        yield
    except CodecError as error:
        if errors is None or isinstance(error, WrongTypeError):  # the latter is a mistake of the caller
            raise
        errors[point.facts.name] = error


def addresses_of(point: Point) -> Sequence[int]:
    """Return the addresses of all words of a point in ascending order, even if only the first is described."""
    addresses = point.facts.at.addresses
    return sorted(addresses) if len(addresses) > 1 else range(addresses[0], addresses[0] + point.size)


def _is_whole(point: Point) -> bool:
    """Return True if the raw number is its words as they are, the high one first."""
    addresses = point.facts.at.addresses
    in_order = list(addresses) == sorted(addresses)
    plain = point.facts.bits is None and point.wire.plain
    return plain and point.wire.bits in _LETTERS and in_order


def _cut(points: Sequence[Point], words: range) -> tuple[str, tuple[Piece, ...]]:
    """Return the format of the Struct, and the points in the order of its fields."""
    users = Counter(at for point in points for at in addresses_of(point))
    whole = {point.facts.at.address: point for point in points if _is_whole(point)}
    whole = {at: point for at, point in whole.items() if all(users[one] == 1 for one in addresses_of(point))}
    letters: list[str] = []
    fields: dict[int, int] = {}
    inside = {address for at, point in whole.items() for address in addresses_of(point) if address != at}
    for at in words:
        if at in inside:
            continue
        letter = _LETTERS[whole[at].wire.bits] if at in whole else "H"
        if users[at]:
            fields[at] = len(fields)
            letters.append(letter.lower() if at in whole and whole[at].wire.signed else letter)
        else:
            letters.append("2x")
    pieces = [_piece(point, [fields[at] for at in addresses_of(point) if at in fields], whole) for point in points]
    return "".join(letters), tuple(pieces)


def _piece(point: Point, fields: Sequence[int], whole: Mapping[int, Point]) -> Piece:
    """Return the piece of a point."""
    decoder = point.sure_decoder if isinstance(point, Decoding) else itself
    if whole.get(point.facts.at.address) is point:
        return Piece(point, fields[0], decoder, int, True)
    if len(fields) == 1 and point.wire.plain:
        return Piece(point, fields[0], bits_of(*point.bit_field, decoder), bits_of(*point.bit_field, itself), False)
    chosen = [at - fields[0] for at in fields]

    def raw(found: Sequence[int]) -> int:
        return point.joined([found[at] for at in chosen])

    def way(found: Sequence[int], raws: Raws) -> Any:
        return decoder(raw(found), raws)

    return Piece(point, slice(fields[0], fields[-1] + 1), way, raw, False)
