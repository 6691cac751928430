"""The contexts of the templates of the enums module and of the points module.

The first has classes of names for numbers, and of words of flags; the second an attribute for each point, with its
docstring.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Command, Device, Entry, Point, SteppedCommand, Variant
from fieldscribe.resources import Render
from fieldscribe.targets.placeholders import TextTemplates
from fieldscribe.targets.python.syntax import (
    DOC,
    RUNTIME,
    WIDTH,
    Identifiers,
    PythonFamily,
    arguments,
    attribute,
    comment,
    docstring,
    in_python,
    laid_out,
    leaf,
    scope_of,
    sorted_imports,
    word_attribute,
    wrapped,
)
from fieldscribe.targets.runtime_calls import Call, Hex, Name, Node, Scope, call, calls, reader
from fieldscribe.targets.runtime_calls.point_expressions import NUMBERED, addresses_of
from fieldscribe.text import python_doc, python_string, upper
from fieldscribe.wording import label, open_text

_WORD_DOC = ("", "Members are bits as they are on the wire; the names in small letters say what is true.")
BODY = 8
"""The indentation of an attribute's arguments."""
_FREE = 5
"""The fields before this one are on lines of their own: no line break depends on their width."""
_KEEP = "`keep=True`"
"""The argument with which a program keeps a value over power-off."""
LimitTexts = tuple[str, tuple[str, ...]]
"""The limits of a point as text, and their ends in code."""


# The enums module.


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


def enums_context(names: Identifiers, render: Render) -> dict[str, object]:
    """Return the context of the enums module."""
    texts, used, composes = list[str](), {"renamed_classes"} if names.old_classes else set[str](), False
    for numbers in names.in_order():
        if isinstance(numbers, Point):
            view = _word(numbers, names)
            used |= {"Word", *("Flag" if flag.width == 1 else "Field" for flag in numbers.flags)}
            composes |= numbers.writable
        else:
            view = _enum(*numbers)
            used.add("NamedNumber")
        texts.append(render("python/enum.py.j2", {"class": view}))
    typing = ["TYPE_CHECKING"] * bool(names.old_classes) + ["Self"] * composes
    return {
        "classes": texts,
        "old_classes": names.old_classes,
        "runtime": sorted(used),
        "has_words": "Word" in used,
        "typing": ", ".join(typing),
    }


def _enum(name: str, title: str, entries: tuple[Entry, ...]) -> EnumClass:
    members = tuple((upper(entry.name), str(entry.raw), python_doc(calls.entry_text(entry))) for entry in entries)
    return EnumClass(name, f"class {name}(NamedNumber):", docstring((_sentence(title),)), members)


def _word(point: Point, names: Identifiers) -> EnumClass:
    name, classes = names.word_class(point), [names.field_class(point, flag.name) for flag in point.flags]
    bits = tuple(
        (upper(flag.name), f"0x{mask_of(flag.width, flag.low):04X}", python_doc(calls.flag_text(flag)))
        for flag in point.flags
    )
    readers = tuple(
        laid_out(reader(flag, numbers), 4, f"{word_attribute(flag.name)} = ")
        for flag, numbers in zip(point.flags, classes, strict=True)
    )
    composer = _composer(point, classes) if point.writable else ()
    # the readers are in a base class, because type checkers take an enum's own attributes for members
    bases = call(f"class {name}", Name(f"_{name}Flags"), Name("enum.IntFlag"), boundary=Name("enum.KEEP"))
    text = docstring((_sentence(point.title["en"]), *_WORD_DOC))
    return EnumClass(name, f"{laid_out(bases, 0)}:", text, bits, readers, *composer)


def _composer(point: Point, classes: Sequence[str | None]) -> tuple[tuple[str, ...], str]:
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


def _sentence(text: str) -> str:
    return calls.sentence(python_doc(text))


# The points module.


def points_context(device: Device, names: Identifiers, render: Render) -> dict[str, object]:
    """Return the context of the points module: all points, group by group.

    `imports` are modules of the runtime with the names imported from each, `open_points` the lines about points whose
    type or scale the manual does not settle, `codes` the special codes that several points share. A group is its title
    and the text of its attributes.
    """
    family, scope = in_python(device), scope_of(device, names)
    scope.runtime("PointTable")
    attributes = Attributes(scope, render)
    titles = {group.name: comment(f"{group.name}: {group.title['en']}") for group in device.groups}
    groups = {group: list(map(attributes.of, found)) for group, found in calls.members(device).items()}
    commands = "".join([attributes.of_command(command, made) for command, made in calls.commands_of(scope)])
    profile, *facts = [laid_out(node, 4, f"{name}: ClassVar = ") for name, node in calls.class_facts(scope).items()]
    return {
        "imports": _imports(scope.used - {"enums"}, family),
        "open_points": list(_open_points(device)),
        "uses_enums": "enums" in scope.used,
        "has_codes": "Codes" in scope.used,
        "group_names": _group_names(calls.readable_groups(device)),
        "profile": profile,
        "facts": facts,
        "groups": [(titles.get(group, comment(group)), "".join(texts)) for group, texts in groups.items() if texts],
        "commands": commands,
        "codes": [laid_out(codes, 0, f"{name} = ") for name, codes in scope.codes.items()],
    }


def _group_names(groups: tuple[str, ...]) -> str:
    """Return the type of the groups that can be read."""
    if not groups:
        return ""
    names = list(map(leaf, groups))
    line = f"Group = Literal[{', '.join(names)}]"
    return line if len(line) < WIDTH else "\n".join(["Group = Literal[", *(f"    {name}," for name in names), "]"])


def _imports(used: set[str], family: PythonFamily) -> list[tuple[str, list[str]]]:
    """Return the used names by their modules, sorted for imports."""
    of_family = used & family.exports if family.module != RUNTIME else set()
    imports = [(RUNTIME, sorted_imports(used - of_family)), (family.module, sorted_imports(of_family))]
    return [(module, names) for module, names in imports if names]


def _open_points(device: Device) -> Iterable[str]:
    """Yield the lines of a list of points whose type or scale is open, with their wire addresses."""
    for point in device.points:
        if not point.raw_only:
            continue
        index = f", index={point.index}" if point.space in NUMBERED and point.index is not None else ""
        addresses = ", ".join(map(leaf, addresses_of(point.addresses, point.space)))
        text = f"- {label(point)}: {python_string(point.telegram or point.space)}, {addresses}{index}"
        yield from textwrap.wrap(
            python_doc(text), DOC, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
        )


class Attributes:
    """Builds the texts of a device's attributes."""

    def __init__(self, scope: Scope, render: Render) -> None:
        self._scope = scope
        self._render = render
        self._keys = scope.lowered.template_keys
        self._texts = TextTemplates()
        self._limits: dict[tuple[int, int], LimitTexts] = {}
        self._remarks: dict[int, tuple[str, list[str]]] = {}

    def of(self, member: Point | dict[Variant, Point]) -> str:
        """Return the attribute of a point, or of points that have one name in different variants."""
        return self.of_point(member) if isinstance(member, Point) else self.by_variant(member)

    def of_point(self, point: Point) -> str:
        """Return the attribute of a point."""
        key, scope = self._keys[id(point)], self._scope
        limited = key, id(point.allowed)
        limits = self._limits.get(limited) or self._limits.setdefault(limited, _limits_of(point, scope))
        remarks = self._remarks.get(key) or self._remarks.setdefault(
            key, (calls.remarks_text(point, scope, _KEEP), _errata(point, scope))
        )
        fields = self._fields(point, limits, remarks)
        whole = key, tuple(map(len, fields[_FREE:]))
        return self._texts.fill(whole, fields, lambda fields: self._laid_out(point, fields))

    def by_variant(self, points: Mapping[Variant, Point]) -> str:
        """Return the attribute of points that have one name in different variants."""
        variant, first = next(iter(points.items()))
        doc = docstring(wrapped(python_doc(f"{first.title['en']}, as the device's {variant.axis} has it.")))
        made = calls.variants_call(points, self._scope)
        return self._text(attribute(first.name), made, doc, calls.old_names_of(points))

    def of_command(self, command: Command | SteppedCommand, made: Call) -> str:
        """Return the attribute of a command."""
        text = python_doc(calls.command_text(command))
        return self._text(self._scope.commands[command.name], made, docstring((text,)))

    def _text(self, name: str, made: Call, doc: str, old_names: tuple[str, ...] = ()) -> str:
        """Return the text of an attribute: its name, the call that makes it, its docstring, its old names."""
        if old_names:
            self._scope.runtime("renamed")
        view = {"name": name, "maker": made.name, "arguments": arguments(made, BODY), "docstring": doc}
        return self._render("python/attribute.py.j2", {"attribute": {**view, "old_names": old_names}})

    def _fields(self, point: Point, limits: LimitTexts, remarks: tuple[str, list[str]]) -> tuple[str, ...]:
        """Return the texts that only this point has: attribute, docstring, then those of `PointFields`."""
        return (
            calls.attribute_of(point, self._scope),
            _docstring(point.title["en"], limits[0], *remarks),
            *calls.texts_of(point, calls.numbers_of(point, self._scope), limits[1], (python_string, leaf)),
        )

    def _laid_out(self, point: Point, texts: Sequence[str]) -> str:
        made = calls.call_of(point, calls.fields_of_texts(texts[2:], point), self._scope)
        return self._text(texts[0], made, texts[1], calls.old_attributes(point, self._scope))


def _limits_of(point: Point, scope: Scope) -> LimitTexts:
    return calls.limits_text(point, scope), calls.end_texts(point, leaf)


def _docstring(title: str, limits: str, remarks: str, errata: list[str]) -> str:
    """Return the lines of a docstring: title, limits, remarks, and the errata that change facts."""
    text = f"{title}: {limits}" if limits else title
    lines = wrapped(python_doc(calls.sentence(text) + remarks))
    return docstring(lines + errata)


def _errata(point: Point, scope: Scope) -> list[str]:
    changing, doubts = scope.lowered.errata_of(point)
    lines = ["", *wrapped(f"Errata: {', '.join(changing)}.")] if changing else []
    return [*lines, "", *wrapped(python_doc(f"The {open_text(doubts)}."))] if doubts else lines
