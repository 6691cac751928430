"""The view of the enums module: names for numbers, and words of flags."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.targets.python.identifiers import Identifiers, word_attribute
from fieldscribe.targets.python.layout import Node, call, docstring, laid_out
from fieldscribe.text import python_doc

if TYPE_CHECKING:
    from fieldscribe.model import Device, Entry, Flag, Point, Titles


_WORD_DOC = (
    "",
    "Members are bits as they are on the wire; the names in small letters say what is true.",
)


@dataclass(frozen=True, slots=True)
class Member:
    """One assignment in a class, with its docstring (empty where the name says it all)."""

    name: str
    value: str
    doc: str


@dataclass(frozen=True, slots=True)
class Composer:
    """The function that makes a word of flags: its parameters (`on: bool = False`) and the returned expression."""

    parameters: tuple[str, ...]
    result: str


@dataclass(frozen=True, slots=True)
class EnumClass:
    """A class: its head (`class Name(...):`), the lines of its docstring, and its members.

    Words of flags also have readers of each flag, and a composer if they can be written.
    """

    name: str
    head: str
    doc: tuple[str, ...]
    members: tuple[Member, ...]
    readers: tuple[str, ...] = ()
    composer: Composer | None = None

    @property
    def docstring(self) -> tuple[str, ...]:
        """The lines of the docstring."""
        return docstring(self.doc)


@dataclass(frozen=True, slots=True)
class EnumsView:
    """The enums module: its classes, its imports, and whether it has words of flags, or composers."""

    classes: tuple[EnumClass, ...]
    runtime: tuple[str, ...]
    has_words: bool
    composes: bool


def enums_view(device: Device, names: Identifiers) -> EnumsView:
    """All enums of the device, then the words of flags in the order of the points."""
    classes = [_enum(names.enum_class(enum.name), enum.title, enum.entries) for enum in device.enums]
    used: set[str] = set()
    for point in device.points:
        if point.form == "flags" and point.generated:
            classes += _word(point, names, used)
    if any(not enum_class.readers for enum_class in classes):
        used.add("NamedNumber")
    has_words, composes = "Word" in used, any(enum_class.composer for enum_class in classes)
    return EnumsView(tuple(classes), tuple(sorted(used)), has_words, composes)


def _enum(name: str, title: Titles, entries: tuple[Entry, ...]) -> EnumClass:
    members = tuple(Member(upper(entry.name), str(entry.raw), _entry_doc(entry)) for entry in entries)
    return EnumClass(name, f"class {name}(NamedNumber):", (_sentence(title["en"]),), members)


def _word(point: Point, names: Identifiers, used: set[str]) -> list[EnumClass]:
    classes, bits, readers = [], [], []
    for flag in point.flags:
        if named := names.field_class(point, flag.name):
            classes.append(_enum(named, flag.title, flag.values))
        mask = (1 << flag.width) - 1 << flag.low
        bits.append(Member(upper(flag.name), f"0x{mask:04X}", _flag_doc(flag)))
        readers.append(laid_out(_reader(point, flag, names), 4))
        used.add("Flag" if flag.width == 1 else "Field")
    used.add("Word")
    name, doc = names.word_class(point), (_sentence(point.title["en"]), *_WORD_DOC)
    composer = _composer(point, names) if point.writable else None
    # the readers are in a base class, because type checkers take an enum's own attributes for members
    bases = call(f"class {name}", (f"_{name}Flags", "enum.IntFlag", "boundary=enum.KEEP"))
    return [*classes, EnumClass(name, f"{laid_out(bases, 0)}:", doc, tuple(bits), tuple(readers), composer)]


def _composer(point: Point, names: Identifiers) -> Composer:
    """The composer of a word; flags whose bits are always written as a constant have no parameter."""
    mask, bits = (point.fixed.mask, point.fixed.bits) if point.fixed else (0, 0)
    parameters, parts = [], []
    for flag in point.flags:
        if mask >> flag.low & (1 << flag.width) - 1 == (1 << flag.width) - 1:
            continue
        attribute = word_attribute(flag.name)
        named = names.field_class(point, flag.name)
        kind = "bool = False" if flag.width == 1 else f"{named} | int = 0" if named else "int = 0"
        parameters.append(f"{attribute}: {kind}")
        parts.append(f"cls.{attribute}.place({attribute})")
    if bits:
        parts.append(f"0x{bits:04X}")
    composed = call("return cls", (call("cls._joined", tuple(parts)),))
    return Composer(tuple(parameters), laid_out(composed, 8))


def _reader(point: Point, flag: Flag, names: Identifiers) -> Node:
    """The assignment of the attribute that reads a flag of the word."""
    attribute = word_attribute(flag.name)
    if flag.width == 1:
        return call(f"{attribute} = Flag", (str(flag.low),) if flag.active else (str(flag.low), "active=0"))
    named = names.field_class(point, flag.name)
    return call(f"{attribute} = Field", (str(flag.low), str(flag.width), *((named,) if named else ())))


def _entry_doc(entry: Entry) -> str:
    quantity = f" ({entry.quantity})" if entry.quantity else ""
    return "" if not quantity and _says_the_same(entry.title, entry.name) else _sentence(entry.title["en"] + quantity)


def _flag_doc(flag: Flag) -> str:
    """The docstring of a flag; it says so if the bit is 0 while the name is true."""
    meaning = "; ".join(f"{value.raw}: {value.title['en']}" for value in flag.values) if flag.width == 1 else ""
    if not meaning and flag.active and _says_the_same(flag.title, flag.name):
        return ""
    text = _sentence(f"{flag.title['en']} ({meaning})" if meaning else flag.title["en"])
    return text if flag.active else f"{text} True while the bit is 0."


def _says_the_same(title: Titles, name: str) -> bool:
    return title["en"].casefold() == name.replace("_", " ")


def _sentence(text: str) -> str:
    """Docstring text that ends with a full stop."""
    clean = python_doc(text)
    return clean if clean.endswith(".") else f"{clean}."
