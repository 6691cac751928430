"""The facts under `bus`: what the family's frames need to know of the device."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.diagnostics import Span
from fieldscribe.families.modbus import BROADCAST, PROTOCOL_MOST
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import Bus, Code
from fieldscribe.resolve.drafts import humanised
from fieldscribe.resolve.scope import Scope, titles
from fieldscribe.resolve.values import integer, interval

if TYPE_CHECKING:
    from collections.abc import Mapping

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
    _broadcasts(scope, raw, functions)
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
            most, broadcast = (None, None) if isinstance(value, str) else (value.get("max"), value.get("broadcast"))
            result[number] = Code(number, name, _code_titles(value, name), most, broadcast)
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


def _broadcasts(scope: Scope, raw: Map, functions: tuple[Code, ...]) -> None:
    """No function is said to be broadcast that the protocol always answers."""
    spans = {value["name"]: value.span("broadcast") for value in raw["functions"].values() if isinstance(value, Map)}
    for code in functions:
        if code.broadcast and code.number not in BROADCAST:
            message = f"function {code.number:02X}h is never broadcast: it is of no use without an answer"
            shown = ", ".join(f"{one:02X}h" for one in sorted(BROADCAST))
            scope.report.error("not-broadcast", message, spans[code.name], f"functions that can be: {shown}")


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
            scope.unknown("space", space, raw.key_span(space), known)
            continue
        found = [
            (interval(str(text), texts.span(index), scope.report), texts.span(index))
            for index, text in enumerate(texts)
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
