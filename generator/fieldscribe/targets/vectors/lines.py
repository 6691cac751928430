"""The lines of a file of vectors, in the notation of the table of kinds, counted by kind.

A file has lines of fields, separated by tabs. Its head names the device, then every set and every kind in it, with the
fields and their forms, so that no runner needs a list of its own. A set is context that the vectors below share until
it is set again; it ends the sets after it in the table. An absent field is a hyphen, or left out at the end of a line.
A runner compares every field with something, except notes.

A row of the tables here has the fields of a line in order, each with its form; one that may be absent ends in a
question mark. `only` names the languages that have this in code and not only in comments; without it, all have it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from operator import call
from struct import Struct
from types import MappingProxyType
from typing import Any

_REQUEST = "framing:word unit:int transaction:int function:int address:int count:int values:ints?"

_EXCHANGE = "script:script status:word raw:int? words:ints? needs:script?"

SETS = {
    "unit": "unit:int framing:word?",
    "bases": "starts:pairs lasts:pairs",
    "link": "pkw:int pzd:int single_first:int?",
    "point": "point:word",
    "with": "with:pairs?",
    "request": _REQUEST,
    "message": "message:word unit:int address:int raw:int",
    "telegram": "telegram:word unit:int",
    "task": "unit:int task:int parameter:int index:int width:int value:int words:ints?",
}
"""The sets: the unit, its line, bases of addresses, the point, what it needs, a request, message or task."""

KINDS = {
    # conversions between raw number, value (binary64) and count, and whether a raw number may be written
    "decode": "raw:int status:word value:real? special:word?",
    "encode": "value:real status:word raw:int?",
    "encode_refused": "only:python.typescript value:real status:word",  # of points whose values are only decoded
    "decode_count": "raw:int status:word count:int? special:word?",
    "encode_count": "count:int status:word raw:int?",
    "f32_decode_count": "only:c raw:int status:word count:int?",
    "f32_encode_count": "only:c count:int status:word raw:int?",
    "f32_decimals": "only:c decimals:int",
    "check": "raw:int status:word",
    # names of numbers, special codes, flags, and the numbers of flags of several bits
    "name": "raw:int name:text?",
    "special": "special:text low:int high:int",
    "special_name": "raw:int name:text? no_value:int?",
    "flag": "flag:text raw:int number:int truth:int?",
    "flag_name": "flag:text raw:int name:text",
    # bit groups out of their words and into them, words of a number, texts and digits
    "bits": "word:int raw:int replaced:int result:int",
    "words": "raw:int words:ints",
    "text_decode": "words:ints text:bytes?",
    "text_encode": "text:bytes? status:word words:ints?",
    "unicode_decode": "words:ints status:word text:bytes?",
    "unicode_encode": "text:bytes? status:word words:ints?",
    "bytes_decode": "only:c.rust words:ints bytes:bytes",
    "bytes_encode": "only:c.rust bytes:bytes words:ints",
    "date_decode": "words:ints status:word numbers:ints?",
    "date_encode": "numbers:ints status:word words:ints?",
    "notation": "only:python.typescript words:ints text:text",
    "digits": "raw:int status:word digits:ints? special:word?",
    "digits_encode": "digits:ints status:word raw:int?",
    # facts of a point apart from its conversions
    "address": "space:word address:int words:int code:text? raw_min:int? raw_max:int? decimals:int? references:pairs?",
    "place": "addresses:ints index:int? telegram:word?",
    "write_address": "only:c.rust address:int",
    "fixed": "mask:int bits:int",
    # whole exchanges with a point: requests, answers and result; also for writing permanently
    "read": _EXCHANGE,
    "write": _EXCHANGE,
    "store": _EXCHANGE,
    # what nothing is sent for: a point that the device takes only with others; C has no function that writes it
    "alone": "only:python.rust.typescript raw:int status:word",
    # facts that only Python has in code: in C and Rust they are comments, which no program can check
    "facts": "only:python.typescript group:word name:word type:word symbol:text? default:real? changes:word? "
    "changes_with:names? variant:text? only_for:names? uncertain:int? keeps:word? conditions:names? write_space:word? "
    "write_addresses:ints?",
    # what identifies the device and its variants, each alternative alone
    "identification": "name:word of:word raw:int? text:text? variant:pairs?",
    # old names of a point
    "alias": "only:c.python.typescript old:word new:word",
    # the values of an axis of variants, and what is only documented
    "variant": "only:python.typescript axis:word choices:names",
    "left_out": "only:python.typescript names:names codes:names",
    # the number of decimals that people see, the date of a time as seconds after 1970-01-01, and the texts of values
    "display": "decimals:int",
    "epoch": "seconds:int",
    "told": "only:python.rust.typescript raw:int status:word text:text?",
    # the symbol of a point's unit
    "symbol": "only:rust symbol:text",
    # the addresses of points that are only documented
    "documented": "name:word space:word address:int words:int index:int?",
    # the reads of a group's words; not in Rust, which reads points one by one
    "group": "only:c.python.typescript group:word addresses:ints",
    # the contents of tables of constants: functions or tasks in order, limits, lengths of tables
    "function": "only:c index:int number:int most:int? broadcast:int? answers:int?",
    "limit": "only:c what:word number:int",
    "size": "only:c what:word of:text? number:int",
    # named numbers of the protocol, and commands
    "code": "what:word number:int name:text",
    "constant": "only:c.rust what:word number:int name:text",
    "command": "command:word value:int script:script status:word",
}
"""The kinds of vectors of all families: the fields of their lines. The current sets apply to every line."""


FORMAT = 2
ABSENT = "-"
NO_BROADCAST = 0xFFFF
"""The unit number for devices without broadcast: larger than any other."""
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
    """Return the pattern of a binary64 in hexadecimal, without trailing zeros; at least one digit."""
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
        self.name, self.in_head = name, row.replace("?", "").split()
        self.only = forms.pop("only", "")
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
        """Yield functions that write values of these types. Raises ValueError or TypeError if the fields do not fit."""
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


def _put(sets: dict[str, str], name: str, line: str) -> None:
    """Put the line of a set in place of those that it ends: its own, and those after it in the table."""
    sets[name] = line
    for later in _LATER_SETS[name]:
        sets.pop(later, None)


class Lines:
    """Collects vectors in order, and counts them; `kinds` are those that only the device's family has."""

    def __init__(self, kinds: Mapping[str, str] = MappingProxyType({})) -> None:
        self._rows = _ROWS | {name: Row(name, kind) for name, kind in kinds.items()}
        self._counts: Counter[str] = Counter()
        self._in_force: dict[str, str] = {}
        self._wanted: dict[str, str] = {}
        self._lines: list[str] = []

    def set(self, name: str, *values: object) -> None:
        """Set context for the following vectors; its line is written only if it changed and a vector follows."""
        line = _SETS[name].line(values)
        if self._wanted or line != self._in_force.get(name):
            _put(self._wanted, name, line)

    def add(self, kind: str, *values: object) -> None:
        """Add a vector: the fields of its kind in their order."""
        self.add_written(kind, (self._rows[kind].line(values),))

    def add_all(self, kind: str, rows: Iterable[tuple[object, ...]]) -> None:
        """Add vectors of one kind."""
        self.add_written(kind, [*map(self._rows[kind].line, rows)])

    def add_answers(
        self, kind: str, answer: Callable[[Any], str], questions: Iterable[Any], written: Callable[[Any], str] = str
    ) -> None:
        """Add a vector of what is asked, each once, with its answer: `written` fields. None for an empty answer."""
        fields = {written(each): each for each in questions}
        self.add_written(
            kind, [f"{kind}\t{text}\t{result}" for text, each in fields.items() if (result := answer(each))]
        )

    def add_written(self, kind: str, lines: Sequence[str]) -> None:
        """Add vectors of one kind whose lines are finished."""
        if lines:
            if self._wanted:
                self._write_sets()
            self._lines += lines
            self._counts[kind] += len(lines)

    def add_limits(self, **numbers: int) -> None:
        """Add a vector for each constant of the bus."""
        self.add_all("limit", numbers.items())

    def part(self) -> Lines:
        """Return an empty collection with the same kinds, for vectors that are included in several places."""
        part = Lines()
        part._rows = self._rows
        return part

    def include(self, part: Lines) -> None:
        """Add all vectors of a finished part, which may override only inner contexts."""
        if part._lines:
            if self._wanted:
                self._write_sets()
            self._lines += part._lines
            for kind, number in part._counts.items():
                self._counts[kind] += number
            self._in_force |= part._in_force

    def _write_sets(self) -> None:
        """Write the sets that changed; each ends the sets after it in the table."""
        for name, line in self._wanted.items():
            if line != self._in_force.get(name):
                self._lines.append(line)
                _put(self._in_force, name, line)
        self._wanted.clear()

    def text(self, device: str, version: str, digest: str) -> str:
        """Return the whole file, with a head that describes its kinds and sets."""
        head = [f"vectors\t{FORMAT}\t{device}\t{version}\t{digest}"]
        head += ["\t".join(("set", row.name, *row.in_head)) for row in _SETS.values()]
        rows = [row for name, row in self._rows.items() if self._counts[name]]
        head += ["\t".join(("kind", row.name, str(self._counts[row.name]), *row.in_head)) for row in rows]
        return "\n".join([*head, *self._lines, ""])
