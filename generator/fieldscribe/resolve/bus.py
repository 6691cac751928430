"""The facts under `bus`: what the family's frames need to know of the device."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fieldscribe.diagnostics import Span
from fieldscribe.families.modbus import BROADCAST, PROTOCOL_MOST
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import Bus, Code
from fieldscribe.resolve.drafts import humanised
from fieldscribe.resolve.scope import Scope, titles
from fieldscribe.resolve.values import integer, interval

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

NO_BUS = Bus((), (0, 0), None, (), (), {}, None, {}, {}, {})
_LAST_UNIT = 255
_MOST_PZD = 16


@dataclass(frozen=True, slots=True)
class _Rules:
    """What a family needs under `bus`, what it knows besides, how far its codes and units go, its one broadcast."""

    needed: tuple[str, ...]
    known: frozenset[str]
    last_function: int
    last_exception: int
    first_code: int = 0
    last_unit: int = 255
    broadcast: int | None = None


_OF_ALL = frozenset({"units", "exceptions", "timing", "serial", "note", "source", "line", "words", "gaps"})
_FAMILIES = {
    "modbus": _Rules(("framings", "functions"), _OF_ALL | {"broadcast", "pad_coil_bytes"}, 127, 255, 1),
    "can": _Rules((), _OF_ALL | {"bitrate", "identifier_bits", "broadcast"}, 0, 255),
    "uss": _Rules(("pkw", "pzd", "functions", "responses"), _OF_ALL | {"broadcast", "bitrate"}, 15, 255, 0, 31, 32),
}


def bus_of(scope: Scope) -> Bus:
    """The bus of the device; a finding when no file or two files say `bus`, or when it lacks what the family needs."""
    found = [file for file in scope.files if "bus" in file]
    rules = _FAMILIES[str(scope.header["family"])]
    if not found:
        if not scope.is_lost("bus", "bus"):
            hint = f"add `bus:` with {', '.join((*rules.needed[:1], 'units', *rules.needed[1:]))}"
            scope.report.error("missing-key", "no file of the device says `bus`", scope.header.span(), hint)
        return NO_BUS
    for second in found[1:]:
        first = [(found[0].key_span("bus"), "first said here")]
        scope.report.error("duplicate-name", "`bus` is said twice", second.key_span("bus"), "write it once", first)
    raw: Map = found[0]["bus"]
    _of_family(scope, raw, rules)
    functions, responses = (
        codes(scope, raw.get(key) if key in rules.needed else None, rules.first_code, rules.last_function)
        for key in ("functions", "responses")
    )
    if rules.broadcast is not None and raw.get("broadcast", rules.broadcast) != rules.broadcast:
        message = f"{raw['broadcast']} is no broadcast of the family {scope.header['family']}"
        hint = f"write {rules.broadcast}: bit 5 of the address byte, or leave it out"
        scope.report.error("wrong-choice", message, raw.span("broadcast"), hint)
    if scope.header["family"] == "modbus":
        _counts(scope, raw, functions)
        _broadcasts(scope, raw, functions)
    return Bus(
        framings=tuple(raw.get("framings", ())),
        units=_numbers(scope, raw, "units", "are no unit addresses", rules.last_unit),
        broadcast=raw.get("broadcast"),
        functions=functions,
        exceptions=codes(scope, raw.get("exceptions"), rules.first_code, rules.last_exception),
        gaps=_gaps(scope, raw.get("gaps")),
        pad_coil_bytes=raw.get("pad_coil_bytes"),
        timing={key: str(value) for key, value in raw.get("timing", {}).items()},
        serial={key: _setting(value) for key, value in raw.get("serial", {}).items()},
        note=titles(raw.get("note")),
        responses=responses,
        pkw=tuple(dict.fromkeys(raw.get("pkw", ()))),
        pzd=_numbers(scope, raw, "pzd", "is no count of words", _MOST_PZD),
        variant_pzd=tuple(_variant_pzd(scope)) if "pzd" in raw else (),
        bitrate=raw.get("bitrate"),
        identifier_bits=raw.get("identifier_bits"),
    )


def _variant_pzd(scope: Scope) -> Iterator[tuple[str, int]]:
    """The variants whose property `pzd` says that they take fewer words of process data than the product as a whole."""
    for axis, entry in scope.axes.items():
        for value, properties in entry["values"].items():
            if "pzd" not in properties:
                continue
            most = integer(properties["pzd"], properties.span("pzd"), scope.report)
            if most is not None and not 0 <= most <= _MOST_PZD:
                message = f"{most} is no count of words"
                scope.report.error("address-outside-space", message, properties.span("pzd"), f"write 0..{_MOST_PZD}")
            elif most is not None:
                yield f"{axis}={value}", most


def _of_family(scope: Scope, raw: Map, rules: _Rules) -> None:
    """Findings for keys that the family needs and that are missing, and for keys that it does not know."""
    family = scope.header["family"]
    for key in rules.needed:
        if key not in raw and key not in raw.broken:
            message = f"the key `{key}` is missing: the family {family} needs it"
            scope.report.error("missing-key", message, raw.span(), f"add `{key}: …`")
    for key in raw:
        if key not in rules.known and key not in rules.needed and not key.startswith("x-"):
            known = [name for name, other in _FAMILIES.items() if key in other.known or key in other.needed]
            message = f"`{key}` is nothing that the family {family} knows"
            hint = f"it belongs to {' and '.join(known)}: leave it out"
            scope.report.error("family-key", message, raw.key_span(key), hint)


def _numbers(scope: Scope, raw: Map, key: str, wrong: str, last: int) -> tuple[int, int]:
    """The ends of `units` or `pzd`; zeros after a finding or where it is not said."""
    if key not in raw:
        return 0, 0
    found = interval(str(raw[key]), raw.span(key), scope.report)
    if found is not None and 0 <= found[0] <= found[1] <= last:
        return found
    if found is not None:
        message = f"{key} {found[0]}..{found[1]} {wrong}"
        scope.report.error("address-outside-space", message, raw.span(key), f"they lie in 0..{last}")
    raw.broken += (key,)
    return 0, 0


def codes(scope: Scope, raw: Map | None, first: int, last: int) -> tuple[Code, ...]:
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
        if not first <= number <= last:
            message = f"the code {key} lies outside {first}..{last}"
            scope.report.error("address-outside-space", message, span, "correct the code")
        elif other is not None and raw is not None:
            rule, what = ("value", f"code {number}") if number in keys else ("name", f"name `{name}`")
            related = [(raw.key_span(other), "first given here")]
            message = f"the {what} is given twice"
            scope.report.error(f"duplicate-enum-{rule}", message, span, "remove or rename one of them", related)
        else:
            result[number] = _code(scope, number, name, value)
        keys.setdefault(number, key)
        keys.setdefault(name, key)
    return tuple(result.values())


def _code(scope: Scope, number: int, name: str, value: Map | str) -> Code:
    if isinstance(value, str):
        return Code(number, name, _code_titles(value, name), None)
    answers, refusals = (code_list(scope, value, key) for key in ("answers", "refusals"))
    text = _code_titles(value, name)
    return Code(number, name, text, value.get("max"), value.get("broadcast"), answers, refusals)


def code_list(scope: Scope, raw: Map, key: str) -> tuple[int, ...]:
    """The numbers of a list of codes, where `11..14` stands for several."""
    found: dict[int, None] = {}
    said: Seq = raw.get(key) or Seq(raw.file, raw.at)
    for place, one in enumerate(said):
        ends = interval(str(one), said.span(place), scope.report)
        if ends is not None and not 0 <= ends[0] <= ends[1] <= _LAST_UNIT:
            message = f"the code {one} lies outside 0..{_LAST_UNIT}"
            scope.report.error("address-outside-space", message, said.span(place), "correct the code")
        elif ends is not None:
            found.update(dict.fromkeys(range(ends[0], ends[1] + 1)))
    return tuple(found)


def _counts(scope: Scope, raw: Map, functions: tuple[Code, ...]) -> None:
    """No function takes more items than the protocol can carry."""
    spans = {value["name"]: value.span("max") for value in raw.get("functions", {}).values() if isinstance(value, Map)}
    for code in functions:
        most = PROTOCOL_MOST.get(code.number)
        if most is not None and code.most is not None and code.most > most:
            message = f"`max: {code.most}` is more than one request can carry"
            hint = f"function {code.number:02X}h takes at most {most}"
            scope.report.error("too-many-items", message, spans[code.name], hint)


def _broadcasts(scope: Scope, raw: Map, functions: tuple[Code, ...]) -> None:
    """No function is said to be broadcast that the protocol always answers."""
    spans = {
        value["name"]: value.span("broadcast") for value in raw.get("functions", {}).values() if isinstance(value, Map)
    }
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
