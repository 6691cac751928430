"""Files of conformance vectors: read into maps of fields, and written from such maps by the compiler's own table."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator, Mapping
from typing import Any
from urllib.parse import unquote

Vector = dict[str, Any]


def _text(field: str) -> str:
    return "" if field == "%" else unquote(field, errors="surrogatepass")


def _pairs(field: str) -> dict[str, str]:
    return {_text(key): _text(part) for key, _, part in (pair.partition("=") for pair in field.split(","))}


def _real(field: str) -> float:
    number: float = struct.unpack(">d", bytes.fromhex(field.ljust(16, "0")))[0]
    return number


def _step(pair: str) -> tuple[bytes, bytes]:
    sent, _, received = pair.partition("=")
    return bytes.fromhex(sent), bytes.fromhex(received)


def _frame(pair: str) -> tuple[int, bytes]:
    number, _, data = pair.partition("=")
    return int(number), bytes.fromhex(data)


FORMS: Mapping[str, tuple[Callable[[str], Any], Any]] = {
    "int": (int, None),
    "word": (_text, None),
    "note": (_text, None),
    "text": (_text, None),
    "bytes": (bytes.fromhex, b""),
    "real": (_real, None),
    "ints": (lambda field: [int(number) for number in field.split(",")], []),
    "names": (lambda field: [_text(part) for part in field.split(",")], []),
    "pairs": (_pairs, {}),
    "frames": (lambda field: [_frame(pair) for pair in field.split(",")], []),
    "script": (lambda field: [_step(pair) for pair in field.split(",")], []),
}
"""How a field of each form is read, and what an absent one is."""


class File:
    """The vectors of a text, line by line; `counts` are what its head says."""

    def __init__(self, text: str, language: str = "python") -> None:
        self._language = language
        self.counts: dict[str, int] = {}
        self.head: list[str] = []
        self._shapes: dict[str, list[list[str]]] = {}
        self._sets: list[str] = []
        self._lines = iter(text.split("\n"))

    def __iter__(self) -> Iterator[Vector]:
        """Each vector with the fields of the sets that hold for it."""
        held: dict[str, Vector] = {}
        for line in self._lines:
            name, *fields = line.split("\t")
            if name in {"", "vectors", "set", "kind"}:
                self._declare(name, fields)
            elif name in self._sets:
                keep = self._sets[: self._sets.index(name)]
                held = {**{one: held[one] for one in keep if one in held}, name: self._read(name, fields)}
            else:
                shared = {key: part for one in held.values() for key, part in one.items()}
                yield {"kind": name, **shared, **self._read(name, fields)}

    def _declare(self, what: str, fields: list[str]) -> None:
        if what == "vectors":
            self.head = fields
        elif what == "set":
            self._sets.append(fields[0])
            self._shapes[fields[0]] = [field.split(":") for field in fields[1:]]
        elif what == "kind":
            shape = [field.split(":") for field in fields[2:]]
            only = next((form for key, form in shape if key == "only"), self._language)
            if self._language in only.split("."):
                self.counts[fields[0]] = int(fields[1])
            self._shapes[fields[0]] = [field for field in shape if field[0] != "only"]

    def _read(self, name: str, fields: list[str]) -> Vector:
        shape = self._shapes[name]
        if len(fields) > len(shape):
            raise ValueError(f"{name} has no more than {len(shape)} fields: {fields}")
        padded = fields + ["-"] * (len(shape) - len(fields))
        pairs = zip(shape, padded, strict=True)
        return {key: FORMS[form][1] if field == "-" else FORMS[form][0](field) for (key, form), field in pairs}


def spoil(text: str, language: str = "python") -> tuple[str, dict[str, int]]:
    """The text with the last field of every vector changed to another of its form, and how many there are of a kind."""
    forms: dict[str, list[str]] = {}
    counts: dict[str, int] = {}
    lines = []
    for line in text.split("\n"):
        name, *fields = line.split("\t")
        if name == "kind":
            forms[fields[0]] = [field.split(":")[1] for field in fields[2:] if not field.startswith("only:")]
        elif name in forms and fields:
            counts[name] = counts.get(name, 0) + 1
            if name in ("name", "special_name") and len(fields) == 1:
                fields.append("other")  # a number beside one that has no name may have none either
            if forms[name][len(fields) - 1] == "note":
                fields = fields[:-1]
                while fields[-1] == "-":
                    fields.pop()
            if forms[name][len(fields) - 1] == "script" and len(fields) > 1:
                fields = (
                    fields[:-2] if fields[-2] == "-" else fields[:-1]
                )  # what a point needs is asked for in any order
            if name in {"write", "store"}:
                fields = [fields[0], "other", *fields[2:]]  # constant bits make other numbers the same
                lines.append("\t".join((name, *fields)))
                continue
            fields[-1] = _other(forms[name][len(fields) - 1], fields[-1])
        lines.append("\t".join((name, *fields)))
    ran = counts_of(text, language)
    return "\n".join(lines), {kind: count for kind, count in counts.items() if kind in ran}


def _other(form: str, field: str) -> str:
    """Return another field of the same form."""
    if form == "int":
        return str(int(field) ^ 1)
    more = {"ints": "0", "names": "x", "pairs": "x=0", "script": "00=00", "frames": "1=00"}
    if form in more:
        return f"{field},{more[form]}"
    changed = {"word": "other", "text": "other", "bytes": f"{field}00"}
    return changed[form] if form != "real" else f"{int(field.ljust(16, '0'), 16) ^ 1 << 62:016x}"


def vectors_of(text: str) -> list[Vector]:
    """Return all vectors of a text."""
    return list(File(text))


_SETS_OF_POINTS = ("point", "with")
_SETS_OF_LINES = ("pkw", "pzd", "single_first", "unit", "framing")


def plain(vector: Vector) -> Vector:
    """A vector as tests compare it: without what is absent or about other kinds, numbers and bytes in hexadecimal."""
    about_point = not vector["kind"].startswith(
        ("uss_", "can_build", "can_reply", "block", "build", "reply", "co", "can_taken", "documented")
    )
    found = {key: part for key, part in vector.items() if part not in (None, [], {}, b"")}
    found = {key: part for key, part in found.items() if about_point or key not in _SETS_OF_POINTS}
    if about_point and vector["kind"] not in {"read", "write", "store", "command"}:
        found = {key: part for key, part in found.items() if key not in _SETS_OF_LINES}
    if "with" in found:
        found["with"] = {name: int(raw) for name, raw in found["with"].items()}
    if isinstance(found.get("value"), float):
        found["float"] = struct.pack(">d", found.pop("value")).hex()
    return {key: part.hex() if isinstance(part, bytes) else part for key, part in found.items()}


def counts_of(text: str, language: str = "python") -> dict[str, int]:
    """Return the number of vectors of each kind that the head of a text announces for a language."""
    file = File(text, language)
    list(file)
    return file.counts
