"""The view of the module of enums: names for numbers, and words of flags."""

from collections.abc import Iterator
from typing import NamedTuple

from fieldscribe.arithmetic.words import mask_of
from fieldscribe.model import Device, Entry, Flag, Point
from fieldscribe.targets.runtime_calls.calls import entry_text, flag_text, sentence
from fieldscribe.targets.runtime_calls.scope import Call, Hex, Name, Node, call
from fieldscribe.targets.typescript.identifiers import Identifiers, word_attribute
from fieldscribe.targets.typescript.layout import Layout, doc_lines, lazily
from fieldscribe.targets.typescript.points import is_big
from fieldscribe.text import camel, humanised, js_comment, upper


class Numbers(NamedTuple):
    """Names for numbers: the object, its comment, and its entries as name, number, comment."""

    name: str
    comment: tuple[str, ...]
    entries: tuple[tuple[str, str, str], ...]


class WordOfFlags(NamedTuple):
    """A word of flags: its comment, the call that makes it, and its flags as name, type, comment, whether writable."""

    name: str
    comment: tuple[str, ...]
    made: str
    flags: tuple[tuple[str, str, str, bool], ...]
    is_written: bool


def enums_context(device: Device, names: Identifiers) -> dict[str, object]:
    """Return the context of the module: numbers in the order of the device, then words of flags by their points."""
    numbers = [
        Numbers(*_numbers(names.enum_class(enum.name), humanised(enum.name), enum.entries)) for enum in device.enums
    ]
    layout, words, known = Layout({}, camel), list[WordOfFlags](), {one.name for one in numbers}
    for point in device.points:
        if names.word_class(point):
            for flag, name in _fields(point, names):
                if name not in known:
                    known.add(name)
                    title = humanised(flag.enum) if flag.enum else flag.title["en"]
                    numbers.append(Numbers(*_numbers(name, title, flag.values)))
            words.append(_word(point, names, layout))
    return {"numbers": numbers, "words": words, "old_names": sorted(names.old_classes.items())}


def _fields(point: Point, names: Identifiers) -> Iterator[tuple[Flag, str]]:
    for flag in point.flags:
        if name := names.field_class(point, flag.name):
            yield flag, name


def _numbers(
    name: str, title: str, entries: tuple[Entry, ...]
) -> tuple[str, tuple[str, ...], tuple[tuple[str, str, str], ...]]:
    return (
        name,
        _sentence(title),
        tuple((upper(entry.name), str(entry.raw), js_comment(entry_text(entry))) for entry in entries),
    )


def _word(point: Point, names: Identifiers, layout: Layout) -> WordOfFlags:
    mask, bits = (point.fixed.mask, point.fixed.bits) if point.fixed else (0, 0)
    classes = {flag.name: name for flag, name in _fields(point, names)}
    readers: dict[str, Node] = {word_attribute(flag): _reader(flag, classes.get(flag.name, "")) for flag in point.flags}
    facts: dict[str, Node] = {"constant": Hex(bits)} if bits else {}
    free = {flag.name for flag in point.flags if mask_of(flag.width, flag.low) & ~mask}
    closed = tuple(word_attribute(flag) for flag in point.flags if flag.name not in free)
    facts |= {"closed": closed} if closed and point.writable else {}
    name = names.word_class(point)
    made = call("wordOf", name, readers, *([facts] if facts else []))
    flags = tuple(
        (word_attribute(flag), _type(flag, classes), js_comment(flag_text(flag)), flag.name in free)
        for flag in point.flags
    )
    text = f"export const {name} = {lazily(layout.laid_out(made, 0))};"
    return WordOfFlags(name, _sentence(point.title["en"]), text, flags, point.writable and not is_big(point))


def _reader(flag: Flag, named: str) -> Call:
    if flag.width == 1:
        return call("bitFlag", flag.low) if flag.active else call("bitFlag", flag.low, active=0)
    return call("bitField", flag.low, flag.width, *([Name(named)] if named else ()))


def _type(flag: Flag, classes: dict[str, str]) -> str:
    if flag.width == 1:
        return "boolean"
    return f"{classes[flag.name]} | UnknownNumber" if flag.name in classes else "number"


def _sentence(text: str) -> tuple[str, ...]:
    return doc_lines(js_comment(sentence(text)))
