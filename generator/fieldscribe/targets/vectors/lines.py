"""The lines of a file of vectors, in the notation of the table of kinds, counted by kind."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from operator import call
from struct import Struct
from types import MappingProxyType
from typing import Any

from fieldscribe.targets.vectors.vector_kinds import KINDS, SETS

FORMAT = 2
ABSENT = "-"
NO_BROADCAST = 0xFFFF
"""The unit number for devices without broadcast: larger than any other."""
_MANY = 500
"""So many new lines are joined at once: one long string takes less memory."""
_BINARY64 = Struct(">d").pack


def text(value: str) -> str:
    """Return a text; unprintable characters, `%`, `,` and `=` become `%` and two hexadecimal digits a byte of UTF-8."""
    if value.isalnum():
        return value
    if value in ("", ABSENT):
        return "%" + "2D" * len(value)
    return "".join(
        character if character.isprintable() and character not in "%,=" else _escaped(character) for character in value
    )


def _escaped(character: str) -> str:
    return "".join(f"%{byte:02X}" for byte in character.encode("utf-8", "surrogatepass"))


def word(value: str) -> str:
    """Return a name; identifiers need no escape."""
    return value if value.isidentifier() and value.isascii() else text(value)


def real(value: float) -> str:
    """Return the pattern of a binary64 in hexadecimal, without zeros at its end; at least one digit."""
    return _BINARY64(value).hex().rstrip("0") or "0"


def _pairs(value: Mapping[str, object]) -> str:
    return ",".join([f"{text(key)}={text(str(part))}" for key, part in value.items()])


def script_text(script: Iterable[tuple[bytes, bytes]]) -> str:
    """Return requests with their answers."""
    return ",".join([f"{sent.hex()}={answer.hex()}" for sent, answer in script])


_FORMS: dict[str, tuple[tuple[type, ...], Callable[[Any], str]]] = {
    "int": ((int,), str),
    "word": ((str,), word),
    "note": ((str,), word),
    "text": ((str,), text),
    "bytes": ((bytes,), bytes.hex),
    "real": ((float,), real),
    "ints": ((tuple, list), lambda numbers: ",".join(map(str, numbers))),
    "names": ((tuple,), lambda names: ",".join(map(text, names))),
    "pairs": ((dict,), _pairs),
    "frames": ((tuple, list), lambda frames: ",".join([f"{number}={data.hex()}" for number, data in frames])),
    "script": ((tuple, list), script_text),
}
"""Each form of field: the types of its values and their notation; lists have commas, items of two parts have `=`."""


class Row:
    """Writes the lines of one kind or set, and checks each value against its field.

    `only` are the languages that have this in code and not only in comments; empty for all.
    """

    def __init__(self, name: str, row: str) -> None:
        forms = dict([part.split(":") for part in row.split()])
        self.name, self.only = name, forms.pop("only", "")
        self.fields = {key: form.removesuffix("?") for key, form in forms.items()}
        self._needed = [(place, key) for place, key in enumerate(forms) if not forms[key].endswith("?")]
        self._writers: dict[tuple[type, ...], Sequence[Callable[[Any], str]]] = {}

    def line(self, values: Sequence[object]) -> str:
        """Return the line of one vector; fields without a value are absent, and left out at the end."""
        types = tuple(map(type, values))
        if types not in self._writers:
            self._writers[types] = [*self._writers_of(types)]
        words = [written or ABSENT for written in map(call, self._writers[types], values)]
        while words and words[-1] == ABSENT:
            words.pop()
        for place, key in self._needed:
            if place >= len(words) or words[place] == ABSENT:
                raise ValueError(f"{self.name} lacks {key}")
        return "\t".join((self.name, *words))

    def _writers_of(self, types: tuple[type, ...]) -> Iterator[Callable[[Any], str]]:
        """Yield what writes values of these types. Raises ValueError or TypeError if the fields do not take them."""
        if len(types) > len(self.fields):
            raise ValueError(f"{self.name} has no more than {len(self.fields)} fields")
        for (key, form), given in zip(self.fields.items(), types, strict=False):
            taken, write = _FORMS[form]
            if given not in taken and given is not type(None):
                names = " or ".join(each.__name__ for each in taken)
                raise TypeError(f"{self.name}: {key} takes {names}, no {given.__name__}")
            yield write if given in taken else lambda _: ABSENT


_ROWS = {name: Row(name, kind) for name, kind in KINDS.items()}
_SETS = {name: Row(name, kind) for name, kind in SETS.items()}
_LATER_SETS = {name: tuple(SETS)[place + 1 :] for place, name in enumerate(SETS)}


class Lines:
    """Collects vectors in order, and counts them; `kinds` are those that only the device's family has."""

    def __init__(self, kinds: Mapping[str, str] = MappingProxyType({})) -> None:
        self._rows = _ROWS | {name: Row(name, kind) for name, kind in kinds.items()}
        self._numbers: defaultdict[str, int] = defaultdict(int)
        self._in_force: dict[str, str] = {}
        self._wanted: dict[str, str] = {}
        self._lines: list[str] = []
        self._chunks: list[str] = []
        self._included: Counter[Lines] = Counter()
        self._has_bases = False

    def set(self, name: str, *values: object) -> None:
        """Set what the vectors from here on share; a line is written only when a vector follows and it changed."""
        line = _SETS[name].line(values)
        self._has_bases = self._has_bases or name == "bases"
        if self._wanted or line != self._in_force.get(name, name):
            self._wanted[name] = line

    def add(self, kind: str, *values: object) -> None:
        """Add a vector: the fields of its kind in their order."""
        self.add_written(kind, (self._rows[kind].line(values),))

    def add_all(self, kind: str, rows: Iterable[tuple[object, ...]]) -> None:
        """Add vectors of one kind."""
        self.add_written(kind, [*map(self._rows[kind].line, rows)])

    def add_written(self, kind: str, lines: Sequence[str]) -> None:
        """Add vectors of one kind whose lines are finished."""
        if self._wanted and lines:
            self._write_sets()
        self._lines += lines
        self._numbers[kind] += len(lines)

    def add_limits(self, **numbers: int) -> None:
        """Add a vector for each constant of the bus."""
        self.add_all("limit", numbers.items())

    def part(self) -> Lines:
        """Return an empty collection with the same kinds, for vectors that are included in several places."""
        part = Lines()
        part._rows = self._rows
        return part

    def include(self, part: Lines) -> None:
        """Add all vectors of a finished part; it may set only what comes after the sets in force."""
        if joined := part._joined():
            if self._wanted:
                self._write_sets()
            self._lines.append(joined)
            self._included[part] += 1
        for name in part._in_force:
            for later in _LATER_SETS[name]:
                self._in_force.pop(later, None)
        self._in_force |= part._in_force
        self._wanted |= part._wanted
        if len(self._lines) > _MANY:
            self._joined()

    def _joined(self) -> str:
        """Join the lines so far, and return the last chunk of them: of a part, all its lines."""
        if self._lines:
            self._chunks.append("\n".join(self._lines))
            self._lines.clear()
        return self._chunks[-1] if self._chunks else ""

    def _write_sets(self) -> None:
        """Write the sets that changed; each ends the sets after it in the table."""
        for name in self._wanted if len(self._wanted) == 1 else [name for name in SETS if name in self._wanted]:
            line = self._wanted[name]
            if line != self._in_force.get(name, name):
                self._lines.append(line)
                self._in_force[name] = line
                for later in _LATER_SETS[name]:
                    self._in_force.pop(later, None)
        self._wanted.clear()

    def text(self, device: str, version: str, digest: str) -> str:
        """Return the whole file, with a head that describes its kinds and sets."""
        self._joined()
        return "\n".join([*self._head(device, version, digest), *self._chunks, ""])

    def _head(self, device: str, version: str, digest: str) -> Iterator[str]:
        counts = Counter(self._numbers)
        for part, times in self._included.items():
            for kind, number in part._numbers.items():
                counts[kind] += number * times
        yield f"vectors\t{FORMAT}\t{device}\t{version}\t{digest}"
        for name, row in _SETS.items():
            if name == "bases" and not self._has_bases:
                continue
            yield "\t".join(("set", name, *(f"{key}:{form}" for key, form in row.fields.items())))
        for name, row in self._rows.items():
            if number := counts[name]:
                only = (f"only:{row.only}",) if row.only else ()
                yield "\t".join(
                    ("kind", name, str(number), *only, *(f"{key}:{form}" for key, form in row.fields.items()))
                )
