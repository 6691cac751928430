"""The table of all kinds of vectors, and the notation of the fields of their lines.

A file has lines of fields, separated by tabs. Its head names the device, then every set and every kind in it with the
fields and their forms, so no runner needs a list of its own. A set holds for the vectors below it until it is set
again; setting it ends the sets that come after it in the table. An absent field is a hyphen, or left out at the end of
a line. A runner compares every field with something, except notes.
"""

from __future__ import annotations

from dataclasses import dataclass
from operator import call
from struct import Struct
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

ABSENT = "-"


@dataclass(frozen=True, slots=True)
class Kind:
    """The fields of a line in order, each with its form."""

    fields: tuple[tuple[str, str], ...]
    optional: frozenset[str]
    """Fields that may be absent: in the table they end in a question mark."""
    only: str = ""
    """The languages that have this in code and not only in comments; empty means all."""


def _kind(row: str) -> Kind:
    pairs = [part.partition(":")[::2] for part in row.split()]
    only = next((form for name, form in pairs if name == "only"), "")
    pairs = [pair for pair in pairs if pair[0] != "only"]
    optional = frozenset(name for name, form in pairs if form.endswith("?"))
    return Kind(tuple((name, form.removesuffix("?")) for name, form in pairs), optional, only)


def table(rows: Mapping[str, str]) -> dict[str, Kind]:
    """Kinds by name, from the fields of their lines."""
    return {name: _kind(row) for name, row in rows.items()}


_REQUEST = "framing:word unit:int transaction:int function:int address:int count:int values:ints?"

_EXCHANGE = "script:script status:word raw:int? words:ints? needs:script?"

SETS = table(
    {
        "unit": "unit:int framing:word?",
        "link": "pkw:int pzd:int single_first:int?",
        "point": "point:word",
        "with": "with:pairs?",
        "request": _REQUEST,
        "message": "message:word",
        "telegram": "telegram:word unit:int",
        "task": "unit:int task:int parameter:int index:int width:int value:int words:ints?",
    }
)
"""What vectors share: the unit and its line, the point, the raw numbers that it needs, a request, a message, a task."""

KINDS = table(
    {
        # conversions between raw number, value (binary64) and count, and whether a raw number may be written
        "decode": "raw:int status:word value:real? special:word?",
        "encode": "value:real status:word raw:int?",
        "decode_count": "raw:int status:word count:int? special:word?",
        "encode_count": "count:int status:word raw:int?",
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
        "digits": "raw:int status:word digits:ints? special:word?",
        "digits_encode": "digits:ints status:word raw:int?",
        # facts of a point beside its conversions
        "address": "space:word address:int words:int code:text? raw_min:int? raw_max:int? decimals:int? "
        "references:pairs?",
        "place": "addresses:ints index:int? telegram:word?",
        "write_address": "only:c.rust address:int",
        "fixed": "mask:int bits:int",
        # whole exchanges with a point: requests, answers and result; also for writing permanently
        "read": _EXCHANGE,
        "write": _EXCHANGE,
        "store": _EXCHANGE,
        # facts that only Python has in code: in C and Rust they are comments, which no program can check
        "facts": "only:python group:word name:word type:word symbol:text? default:real? changes:word? "
        "changes_with:names? variant:text? only_for:names? write_space:word? write_addresses:ints?",
        # old names of a point
        "alias": "only:c.python old:word new:word",
        # the values of an axis of variants, and what is only documented
        "variant": "only:python axis:word choices:names",
        "left_out": "only:python names:names codes:names",
        # the number of decimals that people see, and the texts of values
        "display": "decimals:int",
        "told": "only:python.rust raw:int status:word text:text?",
        # the symbol of a point's unit
        "symbol": "only:rust symbol:text",
        # the addresses of points that are only documented
        "documented": "name:word space:word address:int words:int index:int?",
        # the reads of a group's words; not in Rust, which reads points one by one
        "group": "only:c.python group:word addresses:ints",
        # the contents of tables of constants: functions or tasks in order, limits, lengths of tables
        "function": "only:c index:int number:int most:int? broadcast:int? answers:int?",
        "limit": "only:c what:word number:int",
        "size": "only:c what:word of:text? number:int",
        # named numbers of the protocol, and commands
        "code": "what:word number:int name:text",
        "constant": "only:c.rust what:word number:int name:text",
        "command": "command:word value:int script:script status:word",
    }
)
"""The kinds of vectors of all families: the fields of their lines. The sets in force apply to every line."""


class Written(str):
    """A text that is already in the notation of its field."""


def _other(value: object, kind: str) -> str:
    """Return the notation of an absent or already written field. Raises TypeError for any other value."""
    if value is None:
        return ABSENT
    if type(value) is Written:
        return value
    raise TypeError(f"{value!r} is no {kind}")


def _int(value: object) -> str:
    return str(value) if type(value) is int else _other(value, "integer")


def word(value: object) -> str:
    """A name; it must not need an escape."""
    return value if type(value) is str and value.isidentifier() and value.isascii() else text(value)


def text(value: object) -> str:
    """A text; unprintable characters, `%`, `,` and `=` become `%` and two hexadecimal digits a byte of UTF-8."""
    if type(value) is not str:
        return _other(value, "text")
    if value.isalnum():
        return value
    if value in ("", ABSENT):
        return "%" + "2D" * len(value)
    return "".join(
        character if character.isprintable() and character not in "%,=" else _escaped(character) for character in value
    )


def _escaped(character: str) -> str:
    return "".join(f"%{byte:02X}" for byte in character.encode("utf-8", "surrogatepass"))


def _bytes(value: object) -> str:
    return value.hex() or ABSENT if type(value) is bytes else _other(value, "bytes")


def real(value: object) -> str:
    """The pattern of a binary64 in hexadecimal, without zeros at its end; at least one digit."""
    return _BINARY64(value).hex().rstrip("0") or "0" if type(value) is float else _other(value, "float")


_BINARY64 = Struct(">d").pack


def _ints(value: object) -> str:
    if not isinstance(value, (tuple, list)):
        return _other(value, "list")
    return ",".join([_int(item) for item in value]) or ABSENT


def _names(value: object) -> str:
    if not isinstance(value, tuple):
        return _other(value, "list")
    return ",".join([text(item) for item in value]) or ABSENT


def _pairs(value: object) -> str:
    if not isinstance(value, dict):
        return _other(value, "map")
    pairs = [(key, part if isinstance(part, str) else str(part)) for key, part in value.items()]
    return ",".join([f"{text(key)}={text(part)}" for key, part in pairs]) or ABSENT


def _frames(value: object) -> str:
    if not isinstance(value, (tuple, list)):
        return _other(value, "list")
    return ",".join([f"{number}={data.hex()}" for number, data in value]) or ABSENT


def script_text(value: object) -> str:
    """Requests with their answers."""
    if not isinstance(value, (tuple, list)):
        return _other(value, "list")
    return ",".join([f"{sent.hex()}={received.hex()}" for sent, received in value]) or ABSENT


FORMS: dict[str, Callable[[object], str]] = {
    "int": _int,
    "word": word,
    "note": word,
    "text": text,
    "bytes": _bytes,
    "real": real,
    "ints": _ints,
    "names": _names,
    "pairs": _pairs,
    "frames": _frames,
    "script": script_text,
}
"""The notation of each form of field: lists with commas; `pairs`, `frames` and `script` have items of two parts."""


class Row:
    """Writes the lines of one kind or set, and checks each value against its field."""

    def __init__(self, name: str, kind: Kind) -> None:
        self.name, self.kind = name, kind
        self._writers = [FORMS[form] for _, form in kind.fields]
        needed = [place + 1 for place, (key, _) in enumerate(kind.fields) if key not in kind.optional]
        self._least, self._most = max(needed, default=0), len(self._writers)

    def line(self, values: Sequence[object]) -> str:
        """The line of one vector; fields without a value are absent."""
        words = [*map(call, self._writers, values)]
        if ABSENT in words or not self._least <= len(values) <= self._most:
            self._look_at(words, values)
        return "\t".join((self.name, *words))

    def _look_at(self, words: list[str], values: Sequence[object]) -> None:
        """Remove absent fields at the end. Raises ValueError for too many fields or a missing one."""
        if len(values) > self._most:
            raise ValueError(f"{self.name} has no more than {self._most} fields")
        for place, (key, _) in enumerate(self.kind.fields):
            if key not in self.kind.optional and (place >= len(words) or words[place] == ABSENT):
                raise ValueError(f"{self.name} lacks {key}")
        while words and words[-1] == ABSENT:
            words.pop()


ROWS = {name: Row(name, kind) for name, kind in KINDS.items()}


def line_of(kind: str, *values: object) -> str:
    """The line of a vector that every family can have."""
    return ROWS[kind].line(values)
