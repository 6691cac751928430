"""Resolves commands (a constant under a name, or several requests in order), and what identifies a device."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from fieldscribe.arithmetic.texts import fits
from fieldscribe.diagnostics import Span
from fieldscribe.families import families
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import integer_in
from fieldscribe.language.suggestions import space_hint
from fieldscribe.model import Bus, Command, Identification, Point, SteppedCommand, Variant
from fieldscribe.resolve.bus import NO_BUS, reader_of
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.steps import Steps
from fieldscribe.resolve.symbols import SymbolTable
from fieldscribe.resolve.values import integer
from fieldscribe.text import humanised, shortened

_NEEDED = ("at", "function", "value")
_ALONE = (*_NEEDED, "space", "wears", "busy")
"""The keys of a command that is one constant."""


def commands_of(
    scope: Scope, bus: Bus, symbols: SymbolTable, points: Mapping[str, Point]
) -> tuple[tuple[Command, ...], tuple[SteppedCommand, ...]]:
    """Return the commands of all files: those that write a constant, and those with steps."""
    single: list[Command] = []
    stepped: list[SteppedCommand] = []
    for node in scope.unique("commands"):
        name = str(node["name"])
        if scope.family.commands_in is None:
            hint = "describe the point that it writes, with its value under `enum` or `flags`"
            known = " and ".join(family.name for family in families() if family.commands_in is not None)
            scope.report.error("family-key", f"commands are for the family {known}", node.span("name"), hint)
            continue
        if name in ("no", "yes", "choice"):
            hint = "these are the words of `keeps`: give it another name"
            scope.report.error("duplicate-name", f"a command cannot be called `{name}`", node.span("name"), hint)
            continue
        if "steps" in node:
            _refuse_other_keys(scope, node)
            several = Steps(scope, bus, symbols, points).command(node)
            stepped += [] if several is None else [several]
        elif "steps" not in node.broken and not _lacks(scope, node):
            command = _command(scope, bus, node)
            single += [] if command is None else [command]
    return tuple(single), tuple(stepped)


def _lacks(scope: Scope, node: Map) -> bool:
    """Report the keys that a command of one constant lacks; return True if there are any."""
    lacked = [key for key in _NEEDED if key not in node]
    for key in lacked:
        if key not in node.broken:
            scope.report.error("missing-key", f"the key `{key}` is missing", node.span("name"), f"add `{key}: …`")
    return bool(lacked)


def _refuse_other_keys(scope: Scope, node: Map) -> None:
    """Report keys of a constant in a command that has steps."""
    for key in node.keys() & set(_ALONE):
        hint = "leave it out, or write it at a step"
        scope.report.error("steps", f"`{key}` does not belong beside `steps`", node.key_span(key), hint)


def _command(scope: Scope, bus: Bus, node: Map) -> Command | None:
    address = integer(node["at"], node.span("at"), scope.report)
    function = integer(node["function"], node.span("function"), scope.report)
    value = None if node["value"] == "any" else integer(node["value"], node.span("value"), scope.report)
    space = str(node.get("space", scope.family.commands_in))
    if space not in scope.family.spaces:
        known = scope.family.spaces
        scope.unknown("space", space, node.span("space"), known, space_hint(space, known))
        return None
    if address is None or function is None:
        return None
    if not all([_reaches(scope, bus, node, space, function), _fits(scope, node, space, address, value)]):
        return None
    return Command(
        name=str(node["name"]),
        title=titles(node.get("title"), humanised(node["name"])),
        note=titles(node.get("note")),
        space=space,
        address=address,
        function=function,
        value=value,
        wears=node.get("wears"),
        busy=node.get("busy"),
        source=source_of(scope, node),
    )


def _fits(scope: Scope, node: Map, space: str, address: int, value: int | None) -> bool:
    """Return True if the space has the address and can hold the value; report what does not fit."""
    last = scope.family.last_address
    greatest = 1 if scope.family.spaces[space] == "bit" else 0xFFFF
    inside, holds = 0 <= address <= last, value is None or 0 <= value <= greatest
    if not inside:
        message = f"the address {address} lies outside 0..{last}"
        scope.report.error("address-outside-space", message, node.span("at"), "`at` is the number on the wire")
    if not holds:
        message = f"the value {value} does not fit into `{space}`"
        scope.report.error("range-outside-type", message, node.span("value"), f"0..{greatest} can be written")
    return inside and holds


def _reaches(scope: Scope, bus: Bus, node: Map, space: str, function: int) -> bool:
    """Return True if the device has the function and it writes into the space; report it otherwise."""
    known = reader_of(scope).writes(space)
    if function in known and (bus is NO_BUS or function in {code.number for code in bus.functions}):
        return True
    message, hint = f"the device has no function {function:02X}h", "declare it under `bus`, `functions`"
    if function not in known:
        message = f"function {function:02X}h does not write into `{space}`"
        hint = f"functions that do: {', '.join(f'{other:02X}h' for other in known) or 'none'}"
    scope.report.error("unknown-function", message, node.span("function"), hint)
    return False


def identifications_of(scope: Scope, symbols: SymbolTable, points: Mapping[str, Point]) -> tuple[Identification, ...]:
    """Return what identifies the device, then its variants, in the author's order; report what cannot be read."""
    stated: list[tuple[Variant | None, Map | None]] = [(None, scope.header.get("identify"))]
    stated += [
        (Variant(axis, value), facts.get("identify"))
        for axis, entry in scope.axes.items()
        for value, facts in entry["values"].items()
    ]
    found: list[Identification] = []
    known: dict[tuple[str, tuple[Identification, ...]], str] = {}
    for variant, node in stated:
        if node is None:
            continue
        these = tuple(_identifications(scope, symbols, points, variant, node))
        found += these
        if variant is not None:
            other = known.setdefault((variant.axis, tuple(replace(one, variant=None) for one in these)), variant.value)
            if these and other != variant.value:
                message = f"nothing tells {variant.value} and {other} apart: the device holds the same for both"
                hint = "give one of them what only it holds"
                scope.report.error("identify", message, node.span(), hint)
    return tuple(found)


def _identifications(
    scope: Scope, symbols: SymbolTable, points: Mapping[str, Point], variant: Variant | None, node: Map
) -> Iterator[Identification]:
    for word, held in node.items():
        facts = symbols.find(word)
        if facts is None:
            symbols.unknown(word, node.key_span(word))
            continue
        point = points[facts.item]
        if facts.failed:
            continue
        plain = not point.info.floating and not (point.text is not None and (point.text.is_bytes or point.text.parts))
        if not _is_there(point, variant, scope) or not point.readable or not point.generated or not plain:
            message = f"`{point.name}` cannot identify a device"
            hint = "name a point that every variant has and that can be read: a whole number or a text"
            scope.report.error("identify", message, node.key_span(word), hint)
            continue
        items = list(enumerate(held)) if isinstance(held, Seq) else [(None, held)]
        if point.text is not None:
            if not all(fits(point.text, str(item)) for _, item in items):
                hint = f"a text of it has at most {point.text.characters} characters, in {point.text.encoding}"
                scope.report.error("identify", f"`{point.name}` cannot hold this text", node.span(word), hint)
            yield Identification(variant, point.name, (), tuple(str(item) for _, item in items))
            continue
        names = {} if point.enum is None else {entry.name: entry.raw for entry in point.enum.entries}
        spans = [node.span(word) if place is None else held.span(place) for place, _ in items]
        raws = [_raw(scope, names, item, span) for (_, item), span in zip(items, spans, strict=True)]
        outside = next((raw for raw in raws if raw is not None and not point.held[0] <= raw <= point.held[1]), None)
        if outside is not None:
            message, hint = f"`{point.name}` cannot hold {outside}", f"write {point.held[0]}..{point.held[1]}"
            scope.report.error("identify", message, node.span(word), hint)
        yield Identification(variant, point.name, tuple(raw for raw in raws if raw is not None), ())


def _is_there(point: Point, variant: Variant | None, scope: Scope) -> bool:
    """Return True if every variant has the point, or at least the one that it identifies."""
    given = {} if variant is None else {variant.axis: variant.value}
    return point.variant is None and (
        point.when is None
        or any(
            all(test.of not in scope.axes or (test.of in given and test.holds(given[test.of])) for test in clause)
            for clause in point.when.clauses
        )
    )


def _raw(scope: Scope, names: Mapping[str, int], item: Any, span: Span) -> int | None:
    """Return the raw number of a name or a number; None after a finding."""
    if isinstance(item, str) and integer_in(item) is None:
        if item not in names and names:
            scope.unknown("entry", item, span, names)
        elif item not in names:
            scope.report.error("bad-number", f"`{shortened(item)}` is no number", span, "write a raw number, or a list")
        return names.get(item)
    return integer(item, span, scope.report)
