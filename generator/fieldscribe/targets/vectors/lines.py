"""The lines of a vectors file: one JSON object each, keys in a fixed order, counted by kind."""

from __future__ import annotations

from json import JSONEncoder, dumps
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

KINDS = (
    "decode",
    "encode",
    "decode_count",
    "encode_count",
    "check",
    "name",
    "special",
    "flag",
    "flag_name",
    "bits",
    "words",
    "address",
    "build",
    "reply",
    "printed_build",
    "printed_reply",
    "block",
    "place",
    "fixed",
    "text_decode",
    "text_encode",
    "digits",
    "digits_encode",
    "can_build",
    "can_parse",
    "can_telegram",
    "uss_build",
    "uss_broadcast",
    "uss_reply",
    "uss_printed_build",
    "uss_printed_reply",
)

_TEXT = JSONEncoder(ensure_ascii=False)


class Lines:
    """Collects vectors in order, and counts them. `text` is all of them, ready to stand in a JSON array."""

    def __init__(self) -> None:
        self.counts = dict.fromkeys(KINDS, 0)
        self._open: list[str] = []
        self._chunks: list[str] = []

    def add(self, kind: str, rest: str) -> None:
        """One vector: its kind and the JSON text of all that follows the kind."""
        self.counts[kind] += 1
        self._open.append(f'{{"kind": "{kind}", {rest}}}')

    def gather(self) -> None:
        """Joins what was added since: one long string takes less memory than its lines."""
        if self._open:
            self._chunks.append(",\n".join(self._open))
            self._open.clear()

    def text(self, opening: str, closing: str) -> str:
        """All vectors, one per line, between `opening` and `closing`."""
        self.gather()
        chunks, self._chunks = self._chunks, []
        if not chunks:
            return opening + closing
        chunks[0] = opening + chunks[0]
        chunks[-1] += closing  # before joining: one copy of a long text less
        return ",\n".join(chunks)


def subject(item: str) -> str:
    """The JSON text that names a point."""
    return f'"point": {dumps(item)}'


def quoted(text: str) -> str:
    """The JSON text of a string, as UTF-8 will have it."""
    return _TEXT.encode(text)


def with_text(settings: Mapping[str, int]) -> str:
    """The JSON text of run-time numbers, with its comma before it; empty if there are none."""
    return f', "with": {dumps(dict(settings))}' if settings else ""


def array(numbers: Iterable[int]) -> str:
    """The JSON text of integers."""
    return f"[{', '.join(map(str, numbers))}]"
