"""What families say for their vectors: how points travel, and which frames are tried; helpers that spoil frames."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from fieldscribe.model import Code, Device, Frame, Point
from fieldscribe.targets.vectors.lines import Lines

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

    def example(self, frame: Frame, asked: "Example | None") -> "Example | None":
        """Return the request that a frame of the manual is or answers, and the answers that it is; None without one.

        `asked` is the request that the frame says it answers.
        """
        del frame, asked
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
