"""The view of the enums module: names for numbers, and words of flags."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import NamedTuple

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Device, Entry, Flag, Point
from fieldscribe.resources import Render
from fieldscribe.targets.placeholders import TextTemplates, placeholders
from fieldscribe.targets.python.identifiers import Identifiers, word_attribute
from fieldscribe.targets.python.layout import docstring, laid_out
from fieldscribe.targets.runtime_calls.calls import entry_text, flag_text, sentence
from fieldscribe.targets.runtime_calls.scope import Hex, Name, Node, call
from fieldscribe.text import humanised, python_doc, upper

_WORD_DOC = ("", "Members are bits as they are on the wire; the names in small letters say what is true.")


class EnumClass(NamedTuple):
    """A class: its head (`class Name(...):`), its docstring, and its members (name, value, docstring or empty).

    Words of flags also have a reader for each flag. If they can be written, `composed` is the expression that builds a
    word from these parameters (`on: bool = False`).
    """

    name: str
    head: str
    docstring: str
    members: tuple[tuple[str, str, str], ...]
    readers: tuple[str, ...] = ()
    parameters: tuple[str, ...] = ()
    composed: str = ""


def enums_context(device: Device, names: Identifiers, render: Render) -> dict[str, object]:
    """Return the context of the enums module: enums in the order of the device, then words of flags by their points."""
    classes = _Classes(names, render)
    for enum in device.enums:
        classes.add_enum(names.enum_class(enum.name), humanised(enum.name), enum.entries)
    for point in device.points:
        if names.word_class(point):
            classes.add_word(point)
    if names.old_classes:
        classes.used.add("renamed_classes")
    typing = ["TYPE_CHECKING"] * bool(names.old_classes) + ["Self"] * classes.composes
    return {
        "classes": classes.texts,
        "old_classes": names.old_classes,
        "runtime": sorted(classes.used),
        "has_words": "Word" in classes.used,
        "typing": ", ".join(typing),
    }


class _Classes:
    """Builds the texts of classes, laid out once for all with the same members. `used` are names of the runtime."""

    def __init__(self, names: Identifiers, render: Render) -> None:
        self.texts: list[str] = []
        self.used: set[str] = set()
        self._added: set[str] = set()
        self.composes = False
        self._names, self._render = names, render
        self._templates = TextTemplates()

    def add_enum(self, name: str, title: str, entries: tuple[Entry, ...]) -> None:
        """Add the class of named numbers."""
        self._added.add(name)
        self.used.add("NamedNumber")
        self._add(id(entries), (name, _sentence(title)), lambda name, text: _enum(name, text, entries))

    def add_word(self, point: Point) -> None:
        """Add the class of a word of flags, after those of the numbers of its flags."""
        classes = tuple([self._names.field_class(point, flag.name) or "" for flag in point.flags])
        for flag, named in zip(point.flags, classes, strict=True):
            if named and named not in self._added:
                title = humanised(flag.enum) if flag.enum else flag.title["en"]
                self.add_enum(named, title, flag.values)
            self.used.add("Flag" if flag.width == 1 else "Field")
        self.used.add("Word")
        self.composes |= point.writable
        name = self._names.word_class(point)
        key = (id(point.flags), classes, point.fixed, point.writable, len(name))
        self._add(key, (name, _sentence(point.title["en"])), lambda name, text: _word(name, text, point, classes))

    def _add(self, key: Hashable, words: tuple[str, str], view: Callable[[str, str], EnumClass]) -> None:
        """Add the class of a view that is made with placeholders for these words."""

        def lay_out() -> str:
            name, sentence = placeholders(words)
            return self._render("python/enum.py.j2", {"class": view(name, sentence)})

        self.texts.append(self._templates.fill(key, words, lay_out))


def _enum(name: str, sentence: str, entries: tuple[Entry, ...]) -> EnumClass:
    members = tuple((upper(entry.name), str(entry.raw), python_doc(entry_text(entry))) for entry in entries)
    return EnumClass(name, f"class {name}(NamedNumber):", docstring((sentence,)), members)


def _word(name: str, sentence: str, point: Point, classes: tuple[str, ...]) -> EnumClass:
    bits = tuple(
        (upper(flag.name), f"0x{mask_of(flag.width, flag.low):04X}", python_doc(flag_text(flag)))
        for flag in point.flags
    )
    readers = tuple(
        laid_out(reader(flag, named), 4, f"{word_attribute(flag.name)} = ")
        for flag, named in zip(point.flags, classes, strict=True)
    )
    composer = _composer(point, classes) if point.writable else ()
    # the readers are in a base class, because type checkers take an enum's own attributes for members
    bases = call(f"class {name}", Name(f"_{name}Flags"), Name("enum.IntFlag"), boundary=Name("enum.KEEP"))
    return EnumClass(name, f"{laid_out(bases, 0)}:", docstring((sentence, *_WORD_DOC)), bits, readers, *composer)


def _composer(point: Point, classes: tuple[str, ...]) -> tuple[tuple[str, ...], str]:
    """Return parameters and result; flags whose bits are constant have no parameter."""
    mask, bits = (point.fixed.mask, point.fixed.bits) if point.fixed else (0, 0)
    parameters, parts = [], list[Node]()
    for flag, named in zip(point.flags, classes, strict=True):
        if mask_of(flag.width, flag.low) & ~mask == 0:
            continue
        attribute = word_attribute(flag.name)
        kind = "bool = False" if flag.width == 1 else f"{named} | int = 0" if named else "int = 0"
        parameters.append(f"{attribute}: {kind}")
        parts.append(Name(f"cls.{attribute}.place({attribute})"))
    if bits:
        parts.append(Hex(bits))
    return tuple(parameters), laid_out(call("return cls", call("cls._joined", *parts)), 8)


def reader(flag: Flag, named: str) -> Node:
    """Return the reader of a flag of the word; `named` is the class of its numbers."""
    if flag.width == 1:
        return call("Flag", flag.low) if flag.active else call("Flag", flag.low, active=0)
    return call("Field", flag.low, flag.width, *([Name(named)] if named else ()))


def _sentence(text: str) -> str:
    return sentence(python_doc(text))
