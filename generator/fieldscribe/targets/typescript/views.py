"""The contexts of the TypeScript templates, module by module.

The points module, with its types, has a constant for each point and command. The main module has the class of the
device, with its constructor's options. The enums module has names for numbers, and words of flags.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Device, Entry, Flag, Point
from fieldscribe.targets.placeholders import TextTemplates
from fieldscribe.targets.runtime_calls import Call, Hex, Name, Node, Scope, call, calls, family_calls, reader
from fieldscribe.targets.typescript.syntax import (
    Identifiers,
    Layout,
    attribute,
    code_attribute,
    doc_lines,
    in_typescript,
    lazily,
    option,
    word_attribute,
)
from fieldscribe.text import camel, js_comment, js_string, upper
from fieldscribe.wording import open_text

TYPE_NAMES = ("ReadOnly", "ReadWrite", "Stored", "StoredWriteOnly", "WriteOnly")
"""The types of points, which differ in their methods."""
_NUMBER_BITS = 32
"""Raw numbers of more bits are bigint."""
_PACKAGE = "fieldscribe-runtime"
_NAMESPACE = "fieldscribe_runtime"
"""The name under which generated types import that package."""
_KEEP = "`keep: true`"
"""The argument with which a program keeps a value over power-off."""
_FIRST_LINE = ("name", "item", "at", "writeAt", "bits", "group", "code", "references")
"""The facts that identify a point, by their names in calls."""


def is_big(point: Point) -> bool:
    """Return True if the raw numbers of a point are bigint."""
    bits = 16 * point.words if point.text is not None else point.width if point.shape.narrow else point.shape.info.bits
    return bits > _NUMBER_BITS


# The points module.


class Declared(NamedTuple):
    """A constant: its name, the lines of its comment, its type; `old_names` are aliases."""

    name: str
    comment: tuple[str, ...]
    type: str
    old_names: tuple[str, ...] = ()


def points_context(device: Device, names: Identifiers) -> dict[str, object]:
    """Return the context of the points module.

    `constants` are the texts of the points and commands, `imports` names of the runtime, `numbers` those of the module
    of enums, `codes` the special codes that several points share.
    """
    points, made = Points(device, names), _made(device)
    scope, layout = points.scope, points.layout
    return {
        "constants": [*map(points.text, made), *(text for text, _ in points.commands())],
        "codes": [f"const {name} = {lazily(layout.flat(codes))};" for name, codes in scope.codes.items()],
        "imports": sorted({*map(layout.maker, scope.used)}),
        "numbers": _numbers(made, scope),
        "points": [attribute(point.item) for point in made],
        "commands": list(scope.commands.values()),
        "old_names": [(old, attribute(point.item)) for point in made for old in _old_names(point)],
    }


def types_context(device: Device, names: Identifiers) -> dict[str, object]:
    """Return the context of the types of the points module."""
    points, made = Points(device, names), _made(device)
    declared = [*map(points.declared, made), *(found for _, found in points.commands())]
    return {
        "numbers": _numbers(made, points.scope),
        "declared": declared,
        "types": [name for name in TYPE_NAMES if any(name in found.type for found in declared)],
        "device": js_string(device.id),
    }


def _made(device: Device) -> list[Point]:
    return [point for point in device.points if point.terms.generated]


def _numbers(points: list[Point], scope: Scope) -> list[str]:
    return sorted({calls.numbers_of(point, scope) for point in points} - {""})


def _old_names(point: Point) -> tuple[str, ...]:
    return () if point.variant is not None else tuple(map(attribute, point.was))


class Points:
    """Builds the texts of a device's constants, laid out once for all points with the same template key."""

    def __init__(self, device: Device, names: Identifiers) -> None:
        self.scope = Scope.of(device, names, attribute)
        self.layout = Layout(in_typescript(device).makers, camel)
        self._keys = self.scope.lowered.template_keys
        self._texts = TextTemplates()

    def text(self, point: Point) -> str:
        """Return the constant of a point."""
        leaf = self.layout.leaf
        point_texts = calls.texts_of(
            point, calls.numbers_of(point, self.scope), calls.end_texts(point, leaf), (js_string, leaf)
        )
        fields = (attribute(point.item), js_string(point.name), *point_texts)
        key = self._keys[id(point)], len(fields)
        return self._texts.fill(key, fields, lambda fields: self._laid_out(point, fields))

    def _laid_out(self, point: Point, texts: Sequence[str]) -> str:
        made = calls.call_of(point, calls.fields_of_texts(texts[2:], point), self.scope)
        maker, layout = self.layout.maker(made.name), self.layout
        facts: dict[str, Node] = {"name": Name(texts[1])}
        facts |= {} if point.variant is None else {"item": point.item}
        facts |= {key: fact for key, fact in made.keywords.items() if key != "name"}
        lines = ["", ""]
        for key, fact in facts.items():
            text = layout.flat_keyword(key, fact)
            lines[text.partition(":")[0] not in _FIRST_LINE] += f" {text},"
        body = "\n".join(f" {line}" for line in lines if line)
        form = layout.flat(made.positional[0])
        text = f"{maker}({form}, {{\n{body}\n}})"
        return f"export const {texts[0]} = {lazily(text)};\n"

    def declared(self, point: Point) -> Declared:
        """Return the declaration of a point."""
        scope, limits = self.scope, calls.limits_text(point, self.scope)
        kind = type_of(point, family_calls(scope.device).maker(point), scope)
        title = f"{point.title['en']}: {limits}" if limits else point.title["en"]
        doc = doc_lines(
            js_comment(f"{calls.sentence(title)}{calls.remarks_text(point, scope, _KEEP)}{self._errata(point)}")
        )
        return Declared(attribute(point.item), doc, kind, _old_names(point))

    def commands(self) -> Iterator[tuple[str, Declared]]:
        """Yield the constants of the commands."""
        for command, made in calls.commands_of(self.scope):
            name = self.scope.commands[command.name]
            text = f"export const {name} = {lazily(self.layout.laid_out(made, 0))}"
            doc = doc_lines(js_comment(calls.command_text(command)))
            yield f"{text};\n", Declared(name, doc, _command_type(made))

    def _errata(self, point: Point) -> str:
        changing, doubts = self.scope.lowered.errata_of(point)
        text = f" Errata: {', '.join(changing)}." if changing else ""
        return f"{text} The {open_text(doubts)}." if doubts else text


def type_of(point: Point, maker: str, scope: Scope) -> str:
    """Return the type of a point: `ReadWrite<number, { limits: "maximumFrequency" }>`."""
    numbers = calls.numbers_of(point, scope)
    value, taken = _values(point, numbers)
    codes = [js_string(special.name) for special in point.specials]
    if codes:
        value = f"{value} | SpecialCode<{' | '.join(codes)}>"
    written = [js_string(special.name) for special in point.specials if special.writable]
    if written and point.writable:
        taken = f"{taken} | SpecialCode<{' | '.join(written)}>"
    facts = dict(_facts(point, numbers))
    given = value if point.readable else taken
    if taken != given and point.writable:
        facts["takes"] = taken
    listed = "; ".join(f"{key}: {fact}" for key, fact in facts.items())
    return f"{maker}<{given}, {{ {listed} }}>" if listed else f"{maker}<{given}>"


def _values(point: Point, numbers: str) -> tuple[str, str]:
    """Return the types that decoding returns and that encoding takes, both without special codes."""
    open_numbers, big = f"{numbers} | UnknownNumber", is_big(point)
    closed = point.enum is not None and point.enum.closed
    forms = {
        "bit": ("boolean", "boolean"),
        "digits": (f"readonly ({open_numbers})[]", f"readonly {numbers}[]"),
        "enum": (open_numbers, numbers if closed else open_numbers),
        "flags": (numbers, f"{numbers} | {'bigint' if big else 'number'}"),
        "integer": ("bigint", "bigint | number") if big else ("number", "number"),
        "text": ("string", "string"),
    }
    if point.text is not None and point.text.parts:
        date, time = f"{_NAMESPACE}.DateParts", f"{_NAMESPACE}.TimeParts"
        held = {"date": (date,), "time": (time,)}.get(point.text.encoding, (date, time))
        return " & ".join(held), " & ".join(held).replace(time, f"{_NAMESPACE}.GivenTime")
    return ("Date", "Date | number") if point.epoch else forms.get(point.form, ("number", "number"))


def _facts(point: Point, numbers: str) -> Iterator[tuple[str, str]]:
    if is_big(point):
        yield "raw", "bigint"
    needs = dict.fromkeys(point.shape.scale_arguments)
    if needs:
        yield "scale", _union(needs)
    limits = {name for name in point.arguments if name not in needs} if point.writable else set()
    if limits:
        yield "limits", _union(dict.fromkeys(name for name in point.arguments if name in limits))
    if point.specials:
        single = [special for special in point.specials if special.low == special.high]
        if single:
            named = "; ".join(f"{code_attribute(special)}: {js_string(special.name)}" for special in single)
            yield "special", f"{{ {named} }}"
    if numbers:
        yield "names", f"typeof {numbers}"


def _union(names: Iterable[str]) -> str:
    return " | ".join(js_string(camel(name)) for name in names)


def _command_type(made: Call) -> str:
    given = made.keywords.get("arguments")
    if isinstance(given, Mapping):
        return f"DeviceCommand<{{ {'; '.join(f'{js_string(str(name))}: number' for name in given)} }}>"
    return "DeviceCommand" if made.name == "Command" else "DeviceCommand<Record<never, number>>"


# The main module.


def device_context(device: Device, names: Identifiers) -> dict[str, object]:
    """Return the context of the main module: imports by module, facts of the class, and options."""
    family, scope = in_typescript(device), Scope.of(device, names, attribute)
    layout = Layout(family.makers, camel)
    facts = {name.lower(): node for name, node in calls.class_facts(scope).items()}
    facts |= {"version": device.version, "digest": device.digest}
    imports: dict[str, list[str]] = {}
    for name in sorted({family.device, "defineDevice", *map(layout.maker, scope.used)}):
        module = family.modules.get(name)
        imports.setdefault(f"{_PACKAGE}/{module}" if module else _PACKAGE, []).append(name)
    options = [(option(axis), " | ".join(map(js_string, values))) for axis, values in device.variants.items()]
    options += [(option(each.name), "number") for each in device.given]
    return {
        "name": names.device_class,
        "options": names.options,
        "base": family.device,
        "base_module": f"{_PACKAGE}/{family.modules[family.device]}",
        "imports": sorted(imports.items()),
        "facts": [layout.laid_out(node, 2, f"{camel(name)}: ") for name, node in facts.items()],
        "choices": [(f"{name}?", kind) for name, kind in options],
        "settings": list(family.options),
        "device": js_string(device.id),
        "groups": " | ".join(map(js_string, calls.readable_groups(device))) or "never",
    }


# The module of enums.


def enums_context(names: Identifiers) -> dict[str, object]:
    """Return the context of the module: numbers with names, and words of flags."""
    layout = Layout({"Flag": "bitFlag", "Field": "bitField"}, camel)
    numbers, words = list[dict[str, object]](), list[dict[str, object]]()
    for each in names.in_order():
        if isinstance(each, Point):
            words.append(_word(each, names, layout))
        else:
            numbers.append(_named(*each))
    return {"numbers": numbers, "words": words, "old_names": sorted(names.old_classes.items())}


def _named(name: str, title: str, entries: tuple[Entry, ...]) -> dict[str, object]:
    """Return names for numbers; each entry is its name, number and comment."""
    members = [(upper(entry.name), str(entry.raw), js_comment(calls.entry_text(entry))) for entry in entries]
    return {"name": name, "comment": _sentence(title), "entries": members}


def _word(point: Point, names: Identifiers, layout: Layout) -> dict[str, object]:
    """Return a word of flags: the call that makes it, and its flags as name, type, comment, whether writable."""
    mask, bits = (point.fixed.mask, point.fixed.bits) if point.fixed else (0, 0)
    classes = {flag.name: names.field_class(point, flag.name) for flag in point.flags}
    readers: dict[str, Node] = {word_attribute(flag): reader(flag, classes[flag.name]) for flag in point.flags}
    facts: dict[str, Node] = {"constant": Hex(bits)} if bits else {}
    free = {flag.name for flag in point.flags if mask_of(flag.width, flag.low) & ~mask}
    closed = tuple(word_attribute(flag) for flag in point.flags if flag.name not in free)
    facts |= {"closed": closed} if closed and point.writable else {}
    name = names.word_class(point)
    made = call("wordOf", name, readers, *([facts] if facts else []))
    flags = tuple(
        (word_attribute(flag), _type(flag, classes[flag.name]), js_comment(calls.flag_text(flag)), flag.name in free)
        for flag in point.flags
    )
    text = f"export const {name} = {lazily(layout.laid_out(made, 0))};"
    is_written = point.writable and not is_big(point)
    return {
        "name": name,
        "comment": _sentence(point.title["en"]),
        "made": text,
        "flags": flags,
        "is_written": is_written,
    }


def _type(flag: Flag, numbers: str | None) -> str:
    if flag.width == 1:
        return "boolean"
    return f"{numbers} | UnknownNumber" if numbers else "number"


def _sentence(text: str) -> tuple[str, ...]:
    return doc_lines(js_comment(calls.sentence(text)))
