"""The view of the enums module: names for numbers, and words of flags."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.targets.placeholders import TextTemplate, placeholders
from fieldscribe.targets.python.identifiers import word_attribute
from fieldscribe.targets.python.layout import Node, call, docstring, laid_out
from fieldscribe.text import python_doc

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from fieldscribe.model import Device, Entry, Flag, Point, Titles
    from fieldscribe.render import Render
    from fieldscribe.targets.python.identifiers import Identifiers

_WORD_DOC = ("", "Members are bits as they are on the wire; the names in small letters say what is true.")


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
    """A class: its head (`class Name(...):`), its docstring, and its members.

    Words of flags also have readers of each flag, and a composer if they can be written.
    """

    name: str
    head: str
    docstring: str
    members: tuple[Member, ...]
    readers: tuple[str, ...] = ()
    composer: Composer | None = None


@dataclass(frozen=True, slots=True)
class EnumsView:
    """The enums module: the texts of its classes, their old names, its imports, and whether it has words of flags."""

    classes: list[str]
    old_classes: Mapping[str, str]
    runtime: tuple[str, ...]
    has_words: bool
    typing: str


def enums_view(device: Device, names: Identifiers, render: Render) -> EnumsView:
    """Return all enums of the device, then the words of flags in the order of the points."""
    classes = _Classes(names, render)
    for enum in device.enums:
        classes.add_enum(names.enum_class(enum.name), enum.title, enum.entries)
    for point in device.points:
        if point.shape.flags and point.form == "flags" and point.generated:
            classes.add_word(point)
    if names.old_classes:
        classes.used.add("renamed_classes")
    typing = ["TYPE_CHECKING"] * bool(names.old_classes) + ["Self"] * classes.composes
    used = tuple(sorted(classes.used))
    return EnumsView(classes.texts, names.old_classes, used, "Word" in classes.used, ", ".join(typing))


class _Classes:
    """The texts of classes: laid out once for all that have the same members."""

    def __init__(self, names: Identifiers, render: Render) -> None:
        self.texts: list[str] = []
        self.used: set[str] = set()
        """The used names of the runtime."""
        self.composes = False
        self._names = names
        self._render = render
        self._patterns: dict[object, TextTemplate] = {}

    def add_enum(self, name: str, title: Titles, entries: tuple[Entry, ...]) -> None:
        """Add the class of named numbers."""
        self.used.add("NamedNumber")
        words = (name, _sentence(title["en"]))
        self._add(id(entries), words, lambda: _enum(*_blanked(words), entries))

    def add_word(self, point: Point) -> None:
        """Add the class of a word of flags, behind those of the numbers of its flags."""
        fields = tuple([self._names.field_class(point, flag.name) or "" for flag in point.flags])
        for flag, named in zip(point.flags, fields, strict=True):
            if named:
                self.add_enum(named, flag.title, flag.values)
            self.used.add("Flag" if flag.width == 1 else "Field")
        self.used.add("Word")
        self.composes |= point.writable
        words = (self._names.word_class(point), _sentence(point.title["en"]))
        key = (id(point.flags), fields, point.fixed, point.writable, len(words[0]))
        self._add(key, words, lambda: _word(*_blanked(words), point, fields))

    def _add(self, alike: object, words: tuple[str, str], view: Callable[[], EnumClass]) -> None:
        pattern = self._patterns.get(alike)
        if pattern is None:
            pattern = self._patterns[alike] = TextTemplate(self._render("python/enum.py.j2", {"class": view()}))
        self.texts.append(pattern.fill(words))


def _blanked(words: tuple[str, str]) -> tuple[str, str]:
    """Return placeholders for the name of a class and for its sentence."""
    name, sentence = placeholders(words)
    return name, sentence


def _enum(name: str, sentence: str, entries: tuple[Entry, ...]) -> EnumClass:
    members = tuple(Member(upper(entry.name), str(entry.raw), _entry_doc(entry)) for entry in entries)
    return EnumClass(name, f"class {name}(NamedNumber):", "\n".join(docstring((sentence,))), members)


def _word(name: str, sentence: str, point: Point, fields: tuple[str, ...]) -> EnumClass:
    bits = [
        Member(upper(flag.name), f"0x{(1 << flag.width) - 1 << flag.low:04X}", _flag_doc(flag)) for flag in point.flags
    ]
    readers = [laid_out(_reader(flag, named), 4) for flag, named in zip(point.flags, fields, strict=True)]
    composer = _composer(point, fields) if point.writable else None
    # the readers are in a base class, because type checkers take an enum's own attributes for members
    bases = call(f"class {name}", (f"_{name}Flags", "enum.IntFlag", "boundary=enum.KEEP"))
    doc = "\n".join(docstring((sentence, *_WORD_DOC)))
    return EnumClass(name, f"{laid_out(bases, 0)}:", doc, tuple(bits), tuple(readers), composer)


def _composer(point: Point, fields: tuple[str, ...]) -> Composer:
    """Return the composer of a word; flags whose bits are always written as a constant have no parameter."""
    mask, bits = (point.fixed.mask, point.fixed.bits) if point.fixed else (0, 0)
    parameters, parts = [], []
    for flag, named in zip(point.flags, fields, strict=True):
        if mask >> flag.low & (1 << flag.width) - 1 == (1 << flag.width) - 1:
            continue
        attribute = word_attribute(flag.name)
        kind = "bool = False" if flag.width == 1 else f"{named} | int = 0" if named else "int = 0"
        parameters.append(f"{attribute}: {kind}")
        parts.append(f"cls.{attribute}.place({attribute})")
    if bits:
        parts.append(f"0x{bits:04X}")
    composed = call("return cls", (call("cls._joined", tuple(parts)),))
    return Composer(tuple(parameters), laid_out(composed, 8))


def _reader(flag: Flag, named: str) -> Node:
    """Return the assignment of the attribute that reads a flag of the word; `named` is the class of its numbers."""
    attribute = word_attribute(flag.name)
    if flag.width == 1:
        return call(f"{attribute} = Flag", (str(flag.low),) if flag.active else (str(flag.low), "active=0"))
    return call(f"{attribute} = Field", (str(flag.low), str(flag.width), *((named,) if named else ())))


def _entry_doc(entry: Entry) -> str:
    quantity = f" ({entry.quantity})" if entry.quantity else ""
    return "" if not quantity and _says_the_same(entry.title, entry.name) else _sentence(entry.title["en"] + quantity)


def _flag_doc(flag: Flag) -> str:
    """Return the docstring of a flag; it says so if the bit is 0 while the name is true."""
    meaning = "; ".join(f"{value.raw}: {value.title['en']}" for value in flag.values) if flag.width == 1 else ""
    if not meaning and flag.active and _says_the_same(flag.title, flag.name):
        return ""
    text = _sentence(f"{flag.title['en']} ({meaning})" if meaning else flag.title["en"])
    return text if flag.active else f"{text} True while the bit is 0."


def _says_the_same(title: Titles, name: str) -> bool:
    return title["en"].casefold() == name.replace("_", " ")


def _sentence(text: str) -> str:
    """Return docstring text that ends with a full stop."""
    clean = python_doc(text)
    return clean if clean.endswith(".") else f"{clean}."
