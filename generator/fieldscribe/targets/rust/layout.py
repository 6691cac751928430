"""Breaks lines as rustfmt does, where the length of names decides, and lays out doc comments.

Doc comments have only names and numbers; titles, notes and texts of errata are in the documentation. So a corrected
title changes neither code nor digest.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.lowered import Lowered
from fieldscribe.model import Device, Point
from fieldscribe.text import humanised, rust_code

_WIDTH = 100
_ARRAY_WIDTH = 60
_CALL_WIDTH = 60
_STRUCT_WIDTH = 18
_FREE_WIDTH = 104
_DOC_WIDTH = 104
_BEGINS = re.compile(r"[`(\[]|[^\W\d]|\d+(?![\d.)])")
"""The characters with which a line may begin."""

Lines = tuple[str, ...]


class Item(NamedTuple):
    """The left side of a binding: an item, and its type if it has one."""

    name: str
    type: str = ""

    def __str__(self) -> str:
        return f"{self.name}: {self.type}" if self.type else self.name


def binding(indent: int, item: Item, right: str) -> Lines:
    """`item = right;`, broken after the sign, or after the colon before the type if it is still too long."""
    left = str(item)
    line = f"{left} = {right};"
    if indent + len(line) <= _WIDTH:
        return (line,)
    if indent + len(left) + 2 <= _WIDTH or not item.type:
        return f"{left} =", f"    {right};"
    return f"{item.name}:", f"    {item.type} = {right};"


def assignment(indent: int, item: Item, lines: Lines) -> Lines:
    """`item = lines;` for an expression of several lines; its first goes to a line of its own if it is too long."""
    first = f"{item} = {lines[0]}"
    if indent + len(first) <= _WIDTH:
        return (first, *lines[1:-1], f"{lines[-1]};")
    return (f"{item} =", *(f"    {line}" for line in lines[:-1]), f"    {lines[-1]};")


def arm(indent: int, pattern: str, body: str) -> Lines:
    """`pattern => body,`, else with a block."""
    line = f"{pattern} => {body},"
    return (line,) if indent + len(line) <= _WIDTH else (f"{pattern} => {{", f"    {body}", "}")


def signature(indent: int, name: str, parameters: Lines, result: str) -> Lines:
    """`name(parameters) -> result {`, else with a line per parameter."""
    line = f"{name}({', '.join(parameters)}) -> {result} {{"
    if indent + len(line) <= _WIDTH:
        return (line,)
    return (f"{name}(", *(f"    {parameter}," for parameter in parameters), f") -> {result} {{")


def array(item: Item, elements: list[str]) -> Lines:
    """`item = &[elements];`: one line or two, else a line for each element; indented by 4 at most."""
    joined = ", ".join(elements)
    if len(joined) <= _ARRAY_WIDTH and len(f"{item} = &[{joined}];") <= _WIDTH:
        return (f"{item} = &[{joined}];",)
    if len(joined) <= _ARRAY_WIDTH or (len(elements) == 1 and len(joined) + 12 <= _WIDTH):
        return f"{item} =", f"    &[{joined}];"
    return (f"{item} = &[", *(f"    {element}," for element in elements), "];")


def comparison(indent: int, left: str, right: str) -> Lines:
    """`left right`, else with `right` on a line of its own."""
    line = f"{left} {right}"
    return (line,) if indent + len(line) <= _WIDTH else (left, f"    {right}")


def calls(indent: int, item: Item, items: list[tuple[str, Lines]]) -> Lines:
    """`item = &[name(arguments), ...];`: one line, else a line per call, else a line per argument."""
    lines = called(indent, items)
    if len(lines) == 1:
        return binding(indent, item, lines[0])
    return f"{item} = {lines[0]}", *lines[1:-1], f"{lines[-1]};"


def called(indent: int, items: list[tuple[str, Lines]]) -> Lines:
    """Return a list of calls as an expression: on one line, or with a line for each call."""
    flat = [f"{name}({', '.join(arguments)})" for name, arguments in items]
    joined = ", ".join(flat)
    if len(joined) <= _ARRAY_WIDTH:
        return (f"&[{joined}]",)
    lines = ["&["]
    for line, (name, arguments) in zip(flat, items, strict=True):
        if indent + 4 + len(line) + 1 <= _WIDTH and len(line) - len(name) - 2 <= _CALL_WIDTH:
            lines.append(f"    {line},")
        elif len(items) == 1:
            return f"&[{name}(", *(f"    {one}," for one in arguments), ")]"
        else:
            lines += [f"    {name}(", *(f"        {one}," for one in arguments), "    ),"]
    return (*lines, "]")


def fields_of(indent: int, type_: str, names: Lines) -> Lines:
    """Return a struct literal whose fields come from the struct `all`."""
    joined = ", ".join(f"{name}: all.{name}" for name in names)
    if len(joined) <= _STRUCT_WIDTH:
        return (f"{type_} {{ {joined} }}",)
    lines = [f"{type_} {{"]
    for name in names:
        line = f"    {name}: all.{name},"
        lines += [line] if indent + len(line) <= _WIDTH else [f"    {name}: all", f"        .{name},"]
    return (*lines, "}")


def filled(left: str, between: str, items: Sequence[str], right: str) -> Lines:
    """Return items in as few lines as possible, for macros, which rustfmt does not change."""
    line = f"{left}{between.join(items)}{right}"
    if len(line) <= _FREE_WIDTH:
        return (line,)
    lines = [left]
    for place, item in enumerate(items):
        text = item + (between if place + 1 < len(items) else right)
        if len(lines[-1]) + len(text) > _FREE_WIDTH and lines[-1].strip():
            lines[-1] = lines[-1].rstrip()
            lines.append("    ")
        lines[-1] += text
    return tuple(lines)


def chained(steps: Sequence[str]) -> Lines:
    """Return a chain of fallible calls, on one line or with a line for each call; arguments are broken if they must."""
    line = "?".join(steps)
    if len(line) <= _FREE_WIDTH:
        return (line,)
    lines = [steps[0], *(f"    ?{step}" for step in steps[1:])]
    return tuple(part for line in lines for part in _broken(line))


def _broken(line: str) -> Iterator[str]:
    """Yield a line of a macro, broken at the first space after which the rest fits: no text in it has a space."""
    place = 0 if len(line) <= _FREE_WIDTH else line.find(" ", max(8, len(line) - _FREE_WIDTH + 8))
    yield from (line[:place], f"        {line[place + 1 :]}") if place > 0 else (line,)


def chain(item: Item, start: str, steps: list[str]) -> Lines:
    """`item = start.step().step();`: with one step on one line, with several on a line each."""
    if len(steps) < 2:
        return binding(0, item, "".join((start, *steps)))
    return (f"{item} = {start}", *(f"    {step}" for step in steps[:-1]), f"    {steps[-1]};")


# Doc comments.


def sentence(name: str) -> str:
    """Return a name as the first sentence of a doc comment: `base_frequency` as `Base frequency.`."""
    return f"{humanised(name)}."


class PointDoc:
    """Builds doc comments: all except name, code, address and range follow from the template of a point."""

    def __init__(self, point: Point, lowered: Lowered) -> None:
        self._before, self._behind = _around_address(point)
        self._type, self._facts = f"`{point.shape.wire_type}`", tuple(_facts(point, lowered.points))
        self._size = _size(point)
        self._tail = "".join(f"    ///\n{_comment(paragraph)}" for paragraph in _paragraphs(point, lowered))

    def of(self, item: str, code: str, address: int, limits: str) -> str:
        """Return the lines of a point's doc comment; `code` and `limits` are ready for Markdown."""
        place = f"{self._before} {wording.address_text(address)}{self._behind}"
        size = self._size or (limits and f"raw {limits}")
        start = f"{code} at {place}" if code else f"At {place}"
        facts = ", ".join((start, self._type, size, *self._facts) if size else (start, self._type, *self._facts))
        return f"{_comment(sentence(item))}    ///\n{_comment(f'{facts}.')}{self._tail}"[:-1]


def _comment(paragraph: str) -> str:
    if not is_long(paragraph):
        return f"    /// {paragraph}\n"
    return "".join(f"    /// {line}\n" for line in wrapped(paragraph))


def _paragraphs(point: Point, lowered: Lowered) -> Iterator[str]:
    """Yield the constant bits of a point, its special codes, and its errata."""
    if point.fixed is not None:
        yield f"Constant bits when written: {wording.fixed_text(point)}."
    if point.specials:
        yield f"{wording.codes_text(point, '`')}."
    yield from (f"{rust_code(text[0].upper() + text[1:])}." for text in wording.write_texts(point))
    errata, doubts = lowered.errata_of(point)
    if errata:
        yield f"Errat{'a' if len(errata) > 1 else 'um'}: {', '.join(f'`{name}`' for name in errata)}."
    if doubts:
        yield f"The {wording.open_text(doubts, rust_code)}."


def is_long(text: str) -> bool:
    """Return True if the text may take several lines."""
    return len(text) > _DOC_WIDTH


def wrapped(text: str) -> Iterator[str]:
    """Yield the text in lines; no line begins like a list or a heading."""
    if not is_long(text):
        yield text
        return
    line = ""
    for word in text.split(" "):
        if len(line) + len(word) >= _DOC_WIDTH and _BEGINS.match(word):
            yield line
            line = word
        else:
            line += f" {word}" if line else word
    yield line


def left_out(device: Device, lowered: Lowered) -> tuple[tuple[str, ...], ...]:
    """Return the lines for each point that is only documented: its address if it has one, and what is open."""
    return tuple(
        tuple(wrapped(", ".join((f"`{point.item}`", *_whereabouts(point, lowered)))))
        for point in device.points
        if not point.generated
    )


def _whereabouts(point: Point, lowered: Lowered) -> Iterator[str]:
    if point.code:
        yield rust_code(point.code)
    if point.addresses:
        before, after = _around_address(point)
        yield f"{before} {wording.address_text(min(point.addresses))}{after}"
    _, doubts = lowered.errata_of(point)
    if doubts:
        yield f"the {wording.open_text(doubts, rust_code)}"


def _around_address(point: Point) -> tuple[str, str]:
    """Return the texts before and after the address of a point."""
    space = point.space if point.telegram is None else f"telegram {rust_code(point.telegram)} word"
    written = point.write_place
    after = "" if written is None else f" (written at {wording.address_text(min(written.addresses))})"
    after += "" if point.index is None else f" index {point.index}"
    return space, after + (f" bits {point.bits[0]} to {point.bits[1]}" if point.bits else "")


def _size(point: Point) -> str:
    """Return the size of a text or of a word of digits; empty for numbers."""
    if point.form == "text" and point.text is not None:
        count, encoding, *others = wording.characters_text(point.text).split(", ")
        return ", ".join((f"{count} of {rust_code(encoding)}", *others))
    if point.form == "digits" and point.digits is not None:
        return f"{point.digits.count} decimal digits"
    return ""


def _facts(point: Point, points: Mapping[str, Point]) -> Iterator[str]:
    yield from _resolution(point)
    if point.display is not None:
        yield wording.display_text(point)
    if point.epoch:
        yield wording.epoch_text(point)
    yield wording.access_text(point.access)
    if point.variant:
        yield f"for {rust_code(str(point.variant))}"
    if point.when:
        yield f"exists only when {rust_code(wording.condition_text(point.when, points))}"


def _resolution(point: Point) -> Iterator[str]:
    """Yield the unit of a raw step and of a count."""
    if point.form not in ("scaled", "float"):
        return
    resolution, scale = wording.resolution_text(point), wording.scale_text(point)
    count = wording.count_text(point) if point.form == "scaled" else ""
    if resolution and resolution != count:
        yield f"steps of {rust_code(resolution)}{' (for information, not checked)' if point.steps else ''}"
    elif scale and not resolution:
        yield f"value {rust_code(scale)}"
    if count:
        yield f"one count is {rust_code(count)}"
    yield from (*wording.width_texts(point), *map(rust_code, wording.overflow_texts(point)))
