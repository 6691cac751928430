"""The facts under `bus` and `commands`: what the family's frames need to know of the device."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fieldscribe.diagnostics import Span
from fieldscribe.families.modbus import PROTOCOL_MOST, SPACES
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import Bus, Code, Command
from fieldscribe.resolve.drafts import humanised
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.values import integer, interval

NO_BUS = Bus((), (0, 0), None, (), (), {}, None, {}, {}, {})
_LAST_UNIT = 255
_LAST_FUNCTION = 127
_LAST_EXCEPTION = 255


def bus_of(scope: Scope) -> Bus:
    """The bus of the device; a finding when no file or two files say `bus`."""
    found = [file for file in scope.files if "bus" in file]
    if not found:
        if not scope.is_lost("bus", "bus"):
            hint = "add `bus:` with framings, units and functions"
            scope.report.error("missing-key", "no file of the device says `bus`", scope.header.span(), hint)
        return NO_BUS
    for second in found[1:]:
        first = [(found[0].key_span("bus"), "first said here")]
        scope.report.error("duplicate-name", "`bus` is said twice", second.key_span("bus"), "write it once", first)
    raw: Map = found[0]["bus"]
    units = interval(raw["units"], raw.span("units"), scope.report)
    if units is not None and not 0 <= units[0] <= units[1] <= _LAST_UNIT:
        message = f"units {units[0]}..{units[1]} are no unit addresses"
        scope.report.error("address-outside-space", message, raw.span("units"), f"they lie in 0..{_LAST_UNIT}")
    functions = codes(scope, raw.get("functions"), _LAST_FUNCTION)
    _counts(scope, raw, functions)
    return Bus(
        framings=tuple(raw["framings"]),
        units=units or (0, 0),
        broadcast=raw.get("broadcast"),
        functions=functions,
        exceptions=codes(scope, raw.get("exceptions"), _LAST_EXCEPTION),
        gaps=_gaps(scope, raw.get("gaps")),
        pad_coil_bytes=raw.get("pad_coil_bytes"),
        timing={key: str(value) for key, value in raw.get("timing", {}).items()},
        serial={key: _setting(value) for key, value in raw.get("serial", {}).items()},
        note=titles(raw.get("note")),
    )


def codes(scope: Scope, raw: Map | None, last: int) -> tuple[Code, ...]:
    """Numbered codes with their names, in the author's order; numbers and names are unique."""
    result: dict[int, Code] = {}
    keys: dict[int | str, str] = {}
    for key, value in raw.items() if raw is not None else ():
        span = raw.key_span(key) if raw is not None else Span("", 1, 1)
        number = integer(key, span, scope.report)
        if number is None:
            continue
        name = value if isinstance(value, str) else str(value["name"])
        other = keys.get(number, keys.get(name))
        if not 1 <= number <= last:
            message = f"the code {key} lies outside 1..{last}"
            scope.report.error("address-outside-space", message, span, "correct the code")
        elif other is not None and raw is not None:
            rule, what = ("value", f"code {number}") if number in keys else ("name", f"name `{name}`")
            first = [(raw.key_span(other), "first given here")]
            message = f"the {what} is given twice"
            scope.report.error(f"duplicate-enum-{rule}", message, span, "remove or rename one of them", first)
        else:
            most = None if isinstance(value, str) else value.get("max")
            result[number] = Code(number, name, _code_titles(value, name), most)
        keys.setdefault(number, key)
        keys.setdefault(name, key)
    return tuple(result.values())


def _counts(scope: Scope, raw: Map, functions: tuple[Code, ...]) -> None:
    """No function takes more items than the protocol can carry."""
    spans = {value["name"]: value.span("max") for value in raw["functions"].values() if isinstance(value, Map)}
    for code in functions:
        most = PROTOCOL_MOST.get(code.number)
        if most is not None and code.most is not None and code.most > most:
            message = f"`max: {code.most}` is more than one request can carry"
            hint = f"function {code.number:02X}h takes at most {most}"
            scope.report.error("too-many-items", message, spans[code.name], hint)


def _code_titles(value: Map | str, name: str) -> Mapping[str, str]:
    if isinstance(value, str):
        return {"en": humanised(name)}
    texts = {key: str(text) for key, text in value.items() if len(key) == 2}
    return {"en": humanised(name), **titles(value.get("title")), **texts}


def _gaps(scope: Scope, raw: Map | None) -> dict[str, tuple[tuple[int, int], ...]]:
    result: dict[str, tuple[tuple[int, int], ...]] = {}
    known, last = scope.family.spaces, scope.family.last_address
    for space, texts in raw.items() if raw is not None else ():
        if raw is not None and space not in known:
            scope.unknown("unknown-space", "space", space, raw.key_span(space), known, "gaps")
            continue
        found = [
            (interval(str(text), texts.span(index), scope.report), texts.span(index)) for index, text in enumerate(texts)
        ]
        for one, span in found:
            if one is not None and not 0 <= one[0] <= one[1] <= last:
                message = f"the gap {one[0]}..{one[1]} lies outside 0..{last}"
                scope.report.error("address-outside-space", message, span, "gaps are given in numbers on the wire")
        result[space] = tuple(sorted(one for one, _ in found if one is not None))
    return result


def _setting(value: Any) -> dict[str, str]:
    if isinstance(value, Map):
        return {key: str(text) for key, text in value.items()}
    if isinstance(value, Seq):
        return {str(one): str(one) for one in value}
    return {str(value): str(value)}


def commands_of(scope: Scope, bus: Bus) -> tuple[Command, ...]:
    """The named constant writes of all files."""
    result: dict[str, Command] = {}
    places: dict[str, Span] = {}
    for raw in scope.listed("commands"):
        name = str(raw["name"])
        if name in result or name in ("no", "yes"):
            first = [(places[name], "first declared here")] if name in places else []
            message = f"the command `{name}` is declared twice" if first else f"a command cannot be called `{name}`"
            hint = "rename one of them" if first else "`keeps` knows yes, no and names of commands"
            scope.report.error("duplicate-name", message, raw.span("name"), hint, first)
            continue
        command = _command(scope, bus, raw)
        if command is not None:
            result[name] = command
            places[name] = raw.span("name")
    return tuple(result.values())


def _command(scope: Scope, bus: Bus, raw: Map) -> Command | None:
    report = scope.report
    address = integer(raw["at"], raw.span("at"), report)
    function = integer(raw["function"], raw.span("function"), report)
    value = None if raw["value"] == "any" else integer(raw["value"], raw.span("value"), report)
    space = raw.get("space", "holding")
    if space not in scope.family.spaces:
        scope.unknown("unknown-space", "space", space, raw.span("space"), scope.family.spaces, "space")
        return None
    if address is None or function is None:
        return None
    if not 0 <= address <= scope.family.last_address:
        message = f"the address {address} lies outside 0..{scope.family.last_address}"
        report.error("address-outside-space", message, raw.span("at"), "`at` is the number on the wire")
        return None
    greatest = 1 if scope.family.spaces[space] == "bit" else 0xFFFF
    if value is not None and not 0 <= value <= greatest:
        message = f"the value {value} does not fit into `{space}`"
        report.error("range-outside-type", message, raw.span("value"), f"0..{greatest} can be written")
        return None
    known = [one for one in (SPACES[space].write_one, SPACES[space].write_many) if one is not None]
    if function not in known:
        message = f"function {function:02X}h does not write into `{space}`"
        shown = ", ".join(f"{one:02X}h" for one in known) or "none"
        report.error("unknown-function", message, raw.span("function"), f"functions that do: {shown}")
        return None
    if function not in (code.number for code in bus.functions) and bus is not NO_BUS:
        message = f"the device has no function {function:02X}h"
        report.error("unknown-function", message, raw.span("function"), "declare it under `bus`, `functions`")
        return None
    return Command(
        name=str(raw["name"]),
        title=titles(raw.get("title"), humanised(raw["name"])),
        note=titles(raw.get("note")),
        space=space,
        address=address,
        function=function,
        value=value,
        wears=raw.get("wears"),
        busy=raw.get("busy"),
        source=source_of(scope, raw),
    )
