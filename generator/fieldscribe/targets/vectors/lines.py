"""The lines of a file of vectors, in the notation of the table of kinds, counted by kind."""

from __future__ import annotations

from collections import Counter, defaultdict
from types import MappingProxyType
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.kinds import ROWS, SETS, Row, table

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

FORMAT = 2


def rows(further: Mapping[str, str] = MappingProxyType({})) -> dict[str, Row]:
    """Return the writer of each kind's lines; `further` are the kinds of the device's family."""
    return ROWS | {name: Row(name, kind) for name, kind in table(further).items()}


_SETS = {name: Row(name, kind) for name, kind in SETS.items()}
_BEHIND = {name: tuple(SETS)[place + 1 :] for place, name in enumerate(SETS)}


class Lines:
    """Collects vectors in order, and counts them."""

    def __init__(self, rows_of_kinds: Mapping[str, Row] | None = None) -> None:
        self._rows = rows() if rows_of_kinds is None else rows_of_kinds
        self._numbers: defaultdict[str, int] = defaultdict(int)
        self._held: dict[str, str] = {}
        self._wanted: dict[str, str] = {}
        self._open: list[str] = []
        self._chunks: list[str] = []
        self._included: list[Lines] = []
        self._joined: str | None = None

    def set(self, name: str, *values: object) -> None:
        """Set what the following vectors share; the line is written when a vector follows and the set has changed."""
        line = _SETS[name].line(values)
        if self._wanted or line != self._held.get(name, name):
            self._wanted[name] = line

    def add(self, kind: str, *values: object) -> None:
        """Add a vector: the fields of its kind in their order."""
        if self._wanted:
            self._settle()
        self._open.append(self._rows[kind].line(values))
        self._numbers[kind] += 1

    def add_all(self, kind: str, rows_of_fields: Sequence[tuple[object, ...]]) -> None:
        """Add vectors of one kind."""
        self.add_written(kind, [*map(self._rows[kind].line, rows_of_fields)])

    def add_written(self, kind: str, lines: list[str]) -> None:
        """Add vectors of one kind whose lines are finished."""
        if self._wanted and lines:
            self._settle()
        self._open += lines
        self._numbers[kind] += len(lines)

    def apart(self) -> Lines:
        """Return an empty collection of the same kinds, for vectors that are included in several places."""
        return Lines(self._rows)

    def include(self, part: Lines, text: str | None = None) -> None:
        """Add all vectors of a part. A part may override inner sets only. `text` replaces its lines."""
        if part.joined:
            if self._wanted:
                self._settle()
            self._open.append(part.joined if text is None else text)
            self._included.append(part)
        if part._held or part._wanted:
            for name in part._held:
                for key in _BEHIND[name]:
                    self._held.pop(key, None)
            self._held.update(part._held)
            self._wanted.update(part._wanted)

    @property
    def joined(self) -> str:
        """The text of a complete part."""
        if self._joined is None:
            self._joined = "\n".join(self._open)
            self._open.clear()
        return self._joined

    def _counts(self) -> Counter[str]:
        """Return the number of vectors of each kind."""
        counts = Counter(self._numbers)
        for part, times in Counter(self._included).items():
            for kind, number in part._numbers.items():
                counts[kind] += number * times
        return counts

    def _settle(self) -> None:
        """Write the sets that changed; each ends the sets after it in the table."""
        wanted = self._wanted
        for name in wanted if len(wanted) == 1 else [name for name in SETS if name in wanted]:
            line = wanted[name]
            if line != self._held.get(name, name):
                self._open.append(line)
                self._held[name] = line
                for key in _BEHIND[name]:
                    self._held.pop(key, None)
        wanted.clear()

    def gather(self, least: int = 1) -> None:
        """Join the lines added since the last call if there are at least so many: one long string needs less memory."""
        if len(self._open) >= least:
            self._chunks.append("\n".join(self._open))
            self._open.clear()

    def text(self, device: str, version: str, digest: str) -> str:
        """The whole file, with a head that describes its kinds and sets."""
        self.gather()
        chunks, self._chunks = self._chunks, []
        return "\n".join([*self._head(device, version, digest), *chunks, ""])

    def _head(self, device: str, version: str, digest: str) -> Iterator[str]:
        counts = self._counts()
        yield f"vectors\t{FORMAT}\t{device}\t{version}\t{digest}"
        for name, row in _SETS.items():
            yield "\t".join(("set", name, *(f"{key}:{form}" for key, form in row.kind.fields)))
        for name, row in self._rows.items():
            if number := counts[name]:
                fields = (f"{key}:{form}" for key, form in row.kind.fields)
                only = (f"only:{row.kind.only}",) if row.kind.only else ()
                yield "\t".join(("kind", name, str(number), *only, *fields))
