"""Vectors of whole exchanges: the requests that read or write a point, the answers, and the result.

A family offers a `Wire`: how points travel, and which frames are tried. Helpers here spoil frames.
"""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from fieldscribe.arithmetic.words import joined
from fieldscribe.model import Code, Device, Frame, Point
from fieldscribe.targets.vectors import samples
from fieldscribe.targets.vectors.lines import Lines, script_text
from fieldscribe.targets.vectors.numbers import words_of
from fieldscribe.targets.vectors.oracle import Oracle, admit, as_raw, bits_of, code_of, outer_bounds
from fieldscribe.targets.vectors.samples import PointEncoding, PointEncodings, ascending
from fieldscribe.targets.vectors.texts import letters, typical_date, words_of_text

Script = list[tuple[bytes, bytes]]
"""The requests of an exchange with their answers."""


class Wire(ABC):
    """A way in which a family reads and writes the words of a point, and the frames of its requests and answers.

    A request and an answer are of a type of the family. The kinds of the vectors of frames begin with `PREFIX`.
    """

    PREFIX = ""

    def __init__(self, lines: Lines, device: Device, unit: int) -> None:
        self.lines, self.device, self.bus, self.unit = lines, device, device.bus, unit

    def opens(self) -> None:
        """Set what all exchanges share: the unit and the settings of the line."""
        self.lines.set("unit", self.unit)

    @abstractmethod
    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """Return the exchange that reads these words, in ascending order of address; None if no request can."""

    @abstractmethod
    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """Return the exchange that writes these words; with `keep` permanently, if another request does that."""

    @abstractmethod
    def bad_answers(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """Yield the exchange with bad answers, each with the status that results."""

    @abstractmethod
    def set_request(self, request: Any) -> None:
        """Set the request of the next vectors, and the line on which it travels."""

    @abstractmethod
    def build(self, request: Any) -> tuple[object, ...]:
        """Return the status of a request and its frame, as fields of a vector."""

    @abstractmethod
    def parse(self, request: Any, answer: Any) -> tuple[object, ...]:
        """Return an answer, its status and what is in it, as fields of a vector."""

    def add_builds(self, requests: Iterable[Any], example: str | None = None) -> None:
        """Add the frames of requests, each once; `example` is the name of the manual's frame."""
        for request in dict.fromkeys(requests):
            self.set_request(request)
            self.lines.add(f"{self.PREFIX}build", *self.build(request), example)

    def add_replies(self, request: Any, answers: Iterable[Any], example: str | None = None) -> None:
        """Add the meaning of answers to a request, each once; `example` is the name of the manual's frame."""
        for answer in dict.fromkeys(answers):
            self.set_request(request)
            self.lines.add(f"{self.PREFIX}reply", *self.parse(request, answer), example)

    def add_codes(self, kind: str, what: str, numbers: Iterable[Code]) -> None:
        """Add vectors for named numbers of the protocol: a `code` that is received, or a `constant` for callers."""
        self.lines.add_all(kind, ((what, code.number, code.name) for code in numbers))

    def add_examples(self) -> None:
        """Add the manual's frames: requests are built as they should read, answers are parsed, misprints too."""
        known: dict[str | None, Example] = {}
        for frame in self.device.frames:
            found = self.example(frame, known.get(frame.answers))
            if found is None:
                continue
            wire, request, answers = found
            if frame.direction == "request":
                known[frame.name] = found
                wire.add_builds((request,), frame.name)
            wire.add_replies(request, answers, frame.name)

    def example(self, frame: Frame, answered: "Example | None") -> "Example | None":
        """Return the request that a frame of the manual is or answers, and the answers that it is; None without one.

        `answered` is the request that the frame says it answers.
        """
        del frame, answered
        return None


Example = tuple[Wire, Any, Iterable[bytes]]
"""A request of the manual with its answers, and the line on which it travels."""


def with_flipped(data: bytes, place: int, bits: int = 1) -> bytes:
    """Return the bytes with these bits of one byte flipped."""
    return data[:place] + bytes((data[place] ^ bits,)) + data[place + 1 :]


def single_bit_errors(data: bytes) -> Iterator[bytes]:
    """Yield the bytes with each single bit flipped."""
    for bit in range(8 * len(data)):
        yield with_flipped(data, bit >> 3, 1 << (bit & 7))


def of_other_lengths(data: bytes) -> Iterator[bytes]:
    """Yield the bytes cut at each length, and with more after them."""
    yield from (data[:length] for length in range(len(data)))
    yield from (data + b"\x00", data + data[-2:])


def words_in_bytes(words: Sequence[int]) -> bytes:
    """Return words as bytes, the high one first."""
    return b"".join(word.to_bytes(2, "big") for word in words)


class _Typical(NamedTuple):
    """The contents of exchanges for points with one encoding: raw numbers with their words, and reads of other points.

    `needs` reads the points that these need. Whole words that need no other point can be tried with bad answers.
    """

    encoding: PointEncoding
    settings: dict[str, int]
    needs: Script
    received: list[tuple[int, ...]]
    sent: list[tuple[int, tuple[int, ...]]]


class Exchanges:
    """The exchanges of one device over one wire."""

    def __init__(
        self, lines: Lines, oracle: Oracle, encodings: PointEncodings, points: Mapping[str, Point], wire: Wire
    ) -> None:
        self.lines, self.oracle, self.encodings, self.points, self.wire = lines, oracle, encodings, points, wire
        self.spoiled: set[tuple[str, str]] = set()
        """The kinds and spaces that have vectors with bad answers already."""
        self._typical: dict[PointEncoding, _Typical | None] = {}

    def of_each_space(self) -> None:
        """Add exchanges for the first readable and the first writable point of each space."""
        for point in self.points.values():
            kinds = (("read", point.readable), ("write", point.writable))
            new = {(kind, point.space) for kind, does in kinds if does} - self.spoiled
            if new and point.bits is None and point.text is None and not (point.arguments or point.selects):
                self.lines.set("point", point.item)
                self.of(point, self.encodings.of(point))

    def of(self, point: Point, encoding: PointEncoding) -> None:
        """Add the exchanges of the point that is set: read, write, and write permanently."""
        if encoding not in self._typical:
            self._typical[encoding] = self._of_encoding(encoding)
        typical = self._typical[encoding]
        if typical is None or any(_share_words(point, self.points[name]) for name in typical.settings):
            return
        if typical.settings:
            self.lines.set("with", typical.settings)
        if encoding.shape.readable:
            for sent, received in zip(typical.sent, typical.received, strict=True):
                self._add("read", point, typical, sent, self.wire.reads(point, received))
        if point.write_with:
            if encoding.shape.text is None:
                self.lines.add("alone", typical.sent[0][0], "not_together")
        elif encoding.shape.writable:
            self._writes(point, encoding, typical)

    def _writes(self, point: Point, encoding: PointEncoding, typical: _Typical) -> None:
        """Add the exchanges that write a point, also permanently."""
        for kind in ("write", "store"):
            for raw, words in typical.sent:
                put = words
                if point.write_place is not None:  # if the words may be in another order
                    put = words_of(encoding, ascending(encoding.shape, point.write_place.addresses), raw)
                script = self.wire.writes(point, put, keep=kind == "store")
                if script is not None and encoding.bits is not None:
                    script = self._read_and_write(point, encoding, raw, script)
                self._add(kind, point, typical, (raw, words), script)

    def _of_encoding(self, encoding: PointEncoding) -> _Typical | None:
        """Return the contents of exchanges; None without an address, or if a needed point cannot be read."""
        if encoding.order is None:
            return None
        settings = samples.settings(self.oracle, encoding)[0]
        needs = self._needs(settings)
        raw = None if needs is None else typical(self.oracle, encoding, settings)
        if needs is None or raw is None:
            return None
        shape, order = encoding.shape, encoding.order
        switch = shape.type == "bit" and outer_bounds(shape, encoding.allowed) == (0, 1)
        sent = [(put, words_of(encoding, order, put)) for put in ((raw, 0) if switch else (raw,))]
        received = [words_of(encoding, order, put, received=True) for put, _ in sent]
        return _Typical(encoding, settings, needs, received, sent)

    def _read_and_write(self, point: Point, encoding: PointEncoding, raw: int, script: Script) -> Script | None:
        """Return the exchange that writes a bit group after reading its word."""
        if not encoding.shape.readable:
            return None
        other = as_raw(encoding.shape, ~raw)
        before = self.wire.reads(point, words_of(encoding, (0,), other, received=True))
        return None if before is None else before + script

    def _needs(self, settings: dict[str, int]) -> Script | None:
        """Return the exchanges that read the points that another needs; None if one cannot be read this way."""
        script: Script = []
        for name, raw in settings.items():
            other = self.points.get(name)
            if other is None or not other.readable or not other.addresses or other.scale_arguments:
                return None
            encoding = self.encodings.of(other)
            read = self.wire.reads(other, words_of(encoding, encoding.order or (), raw))
            if read is None:
                return None
            script += read
        return script

    def _selecting(self, point: Point) -> Script:
        """Return the exchanges that write what other points must hold before; clients send them first."""
        script: Script = []
        for name, raw in point.selects:
            other = self.points[name]
            encoding = self.encodings.of(other)
            written = self.wire.writes(other, words_of(encoding, encoding.order or (), raw), keep=False) or []
            script += written if encoding.bits is None else self._read_and_write(other, encoding, raw, written) or []
        return script

    def _add(
        self, kind: str, point: Point, typical: _Typical, sent: tuple[int, tuple[int, ...]], script: Script | None
    ) -> None:
        """Add an exchange, and if it is the first of its kind and space, also with bad answers."""
        if script is None:
            return
        is_text, first = typical.encoding.shape.text is not None, (kind, point.space)
        raw, words = (None, sent[1]) if is_text else (sent[0], None)
        selecting = self._selecting(point) if point.selects else []
        if is_text or typical.needs:
            self.lines.add(kind, selecting + script, "ok", raw, words, typical.needs or None)
        else:  # most exchanges
            self.lines.add_written(kind, (f"{kind}\t{script_text(selecting + script)}\tok\t{raw}",))
        if is_text or typical.encoding.bits is not None or typical.needs or selecting or first in self.spoiled:
            return
        self.spoiled.add(first)
        for status, bad in self.wire.bad_answers(point, script, writes=kind != "read"):
            self.lines.add(kind, bad, status, None if kind == "read" else raw)


def _share_words(point: Point, other: Point) -> bool:
    """Return True if a frame with one point has words of the other: its content is then not free."""
    same = point.space == other.space and point.telegram == other.telegram
    return same and not set(point.addresses).isdisjoint(other.addresses)


def typical(oracle: Oracle, encoding: PointEncoding, settings: dict[str, int]) -> int | None:
    """Return a typical raw number to write: two thirds up the range, odd if possible; None if it has no limits."""
    shape = encoding.shape
    if (text := shape.text) is not None:
        return joined(typical_date(text) if text.parts else words_of_text(text, letters(text)))
    if shape.digits is not None:
        known = sorted(entry.raw for entry in shape.digits.enum.entries if entry.raw < 10)
        digits = [known[place % len(known)] for place in range(shape.digits.count)]
        return int("".join(map(str, digits))) & 0xFFFF
    if shape.form == "float":
        return _typical_pattern(encoding)
    ratio = oracle.ratio(shape, settings) if shape.scale is not None else None
    limits = oracle.limits(shape, encoding.allowed, settings)
    if isinstance(ratio, str) or isinstance(limits, str):
        return None
    low, high = limits[0] if len(limits) == 1 else max(limits, key=lambda limit: limit[1] - limit[0])
    upper = high - (high - low) // 3
    for raw in (upper | 1, upper, *(raw for interval in limits for raw in interval)):
        put = encoding.with_fixed(raw)
        if admit(shape, put, limits) == "ok" and code_of(shape, put) is None:
            return put
    return None


def _typical_pattern(encoding: PointEncoding) -> int:
    low, high = encoding.allowed.units[0] if encoding.allowed.units else (0, 100)
    value = float(low) + (float(high) - float(low)) / 3
    return bits_of(value, encoding.shape.width)
