"""Breaks lines as rustfmt does, where the length of names decides."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

_WIDTH = 100
_ARRAY_WIDTH = 60
_CALL_WIDTH = 60
_STRUCT_WIDTH = 18
_FREE_WIDTH = 104

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
