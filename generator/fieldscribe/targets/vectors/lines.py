"""The lines of a file of vectors, in the notation of the table of kinds, counted by kind."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.kinds import KINDS, SETS, Shape, table

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

FORMAT = 2

_SETS = {name: Shape(name, kind) for name, kind in SETS.items()}


class Lines:
    """Collects vectors in order, and counts them."""

    def __init__(self, further: Mapping[str, str] = MappingProxyType({})) -> None:
        """`further` are the kinds that only the device's family has."""
        self._kinds = KINDS | table(further)
        self._shapes = {name: Shape(name, kind) for name, kind in self._kinds.items()}
        self.counts: dict[str, int] = dict.fromkeys(self._kinds, 0)
        self._held: dict[str, str] = {}
        self._wanted: dict[str, str] = {}
        self._open: list[str] = []
        self._chunks: list[str] = []

    def set(self, name: str, *values: object) -> None:
        """Set what the vectors from here on share; a line is written only when a vector follows and it changed."""
        self._wanted[name] = _SETS[name].line(values)

    def add(self, kind: str, *values: object) -> None:
        """Add a vector: the fields of its kind in their order."""
        if self._wanted:
            self._settle()
        self.counts[kind] += 1
        self._open.append(self._shapes[kind].line(values))

    def _settle(self) -> None:
        """Write the sets that changed; each ends the sets after it in the table."""
        for name in SETS:
            line = self._wanted.get(name)
            if line is not None and line != self._held.get(name, name):
                self._open.append(line)
                self._held[name] = line
                self._forget_behind(name)
        self._wanted.clear()

    def _forget_behind(self, name: str) -> None:
        behind = list(SETS)[list(SETS).index(name) + 1 :]
        for key in behind:
            self._held.pop(key, None)

    def gather(self) -> None:
        """Join the new lines: one long string takes less memory."""
        if self._open:
            self._chunks.append("\n".join(self._open))
            self._open.clear()

    def text(self, device: str, version: str, digest: str) -> str:
        """The whole file, with a head that describes its kinds and sets."""
        self.gather()
        chunks, self._chunks = self._chunks, []
        return "\n".join([*self._head(device, version, digest), *chunks, ""])

    def _head(self, device: str, version: str, digest: str) -> Iterator[str]:
        yield f"vectors\t{FORMAT}\t{device}\t{version}\t{digest}"
        for name, kind in SETS.items():
            yield "\t".join(("set", name, *(f"{key}:{form}" for key, form in kind.fields)))
        for name, kind in self._kinds.items():
            if self.counts[name]:
                fields = (f"{key}:{form}" for key, form in kind.fields)
                only = (f"only:{kind.only}",) if kind.only else ()
                yield "\t".join(("kind", name, str(self.counts[name]), *only, *fields))
