"""The table of all kinds of vectors, and the notation of the fields of their lines.

A file has lines of fields, separated by tabs. Its head names the device, then every set and every kind in it, with the
fields and their forms, so that no runner needs a list of its own. A set is what the vectors below it share until it is
set anew; it ends the sets that come after it in the table. An absent field is a hyphen, or left out at the end of a
line. A runner compares every field with something, except notes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.targets.vectors.numbers import bits64

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

ABSENT = "-"


@dataclass(frozen=True, slots=True)
class Kind:
    """The fields of a line in order, each with its form."""

    fields: tuple[tuple[str, str], ...]
    optional: frozenset[str]
    """Fields that may be absent; in the table they end in a question mark."""
    only: str = ""
    """The languages that have this in code and not only in comments; empty for all."""


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


def _int(value: object) -> str:
    if type(value) is not int:
        raise TypeError(f"{value!r} is no integer")
    return str(value)


def _word(value: object) -> str:
    """A name; it must not need an escape."""
    return value if isinstance(value, str) and value.isidentifier() and value.isascii() else text(value)


def text(value: object) -> str:
    """A text; unprintable characters, `%`, `,` and `=` become `%` and two hexadecimal digits a byte of UTF-8."""
    if not isinstance(value, str):
        raise TypeError(f"{value!r} is no text")
    if value in ("", ABSENT):
        return "%" + "2D" * len(value)
    return "".join(
        character if character.isprintable() and character not in "%,=" else _escaped(character) for character in value
    )


def _escaped(character: str) -> str:
    return "".join(f"%{byte:02X}" for byte in character.encode("utf-8", "surrogatepass"))


def _bytes(value: object) -> str:
    if not isinstance(value, bytes):
        raise TypeError(f"{value!r} is no bytes")
    return value.hex()


def _real(value: object) -> str:
    """The pattern of a binary64 in hexadecimal, without zeros at its end; at least one digit."""
    if not isinstance(value, float):
        raise TypeError(f"{value!r} is no float")
    return f"{bits64(value):016x}".rstrip("0") or "0"


def _ints(value: object) -> str:
    if not isinstance(value, (tuple, list)):
        raise TypeError(f"{value!r} is no list")
    return ",".join(map(_int, value))


def _names(value: object) -> str:
    if not isinstance(value, tuple):
        raise TypeError(f"{value!r} is no list")
    return ",".join(map(text, value))


def _pairs(value: object) -> str:
    if not isinstance(value, dict):
        raise TypeError(f"{value!r} is no map")
    return ",".join(f"{text(key)}={text(str(part))}" for key, part in value.items())


def _frames(value: object) -> str:
    if not isinstance(value, (tuple, list)):
        raise TypeError(f"{value!r} is no list")
    return ",".join(f"{number}={_bytes(data)}" for number, data in value)


def _script(value: object) -> str:
    if not isinstance(value, (tuple, list)):
        raise TypeError(f"{value!r} is no list")
    return ",".join(f"{_bytes(sent)}={_bytes(received)}" for sent, received in value)


FORMS: dict[str, Callable[[object], str]] = {
    "int": _int,
    "word": _word,
    "note": _word,
    "text": text,
    "bytes": _bytes,
    "real": _real,
    "ints": _ints,
    "names": _names,
    "pairs": _pairs,
    "frames": _frames,
    "script": _script,
}
"""The notation of each form of field: lists with commas; `pairs`, `frames` and `script` have items of two parts."""


class Shape:
    """Writes the lines of one kind or set, and checks each value against its field."""

    def __init__(self, name: str, kind: Kind) -> None:
        self.name = name
        self._fields = [(key, FORMS[form], key in kind.optional) for key, form in kind.fields]

    def line(self, values: Iterable[object]) -> str:
        """The line of one vector; fields without a value are absent."""
        parts = [self.name]
        remaining = iter(values)
        for key, write, optional in self._fields:
            value = next(remaining, None)
            if value is None or (not value and value not in (0, "")):
                if not optional:
                    raise ValueError(f"{self.name} lacks {key}")
                parts.append(ABSENT)
            else:
                parts.append(write(value))
        if next(remaining, None) is not None:
            raise ValueError(f"{self.name} has no more than {len(self._fields)} fields")
        while parts[-1] == ABSENT:
            parts.pop()
        return "\t".join(parts)
