"""Reads a bench file: YAML with lines, and the devices on each."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

from fieldscribe.diagnostics import Report
from fieldscribe.language.load import load
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.source import read_source
from fieldscribe.simulation.making import Bench, DeviceSettings, LineSettings
from fieldscribe.user_errors import UnclearError, did_you_mean

_Kinds = Mapping[str, tuple[tuple[type, ...], str]]
_TEXT, _NUMBER, _LIST, _MAP = ((str,), "a text"), ((int,), "a whole number"), ((Seq,), "a list"), ((Map,), "a mapping")
_BENCH: _Kinds = {
    "lines": _LIST,
    "seed": _NUMBER,
    "time_scale": ((int, Decimal), "a number"),
    "strict": ((bool, str), "yes or no"),
}
_LINE: _Kinds = {
    "tcp": ((int, str), "[HOST:]PORT"),
    "serial": ((str, type(None)), "a path, or nothing for a new pseudo terminal"),
    "can": _TEXT,
    "framing": _TEXT,
    "baud": _NUMBER,
    "bitrate": _NUMBER,
    "faults": _LIST,
    "devices": _LIST,
}
_DEVICE: _Kinds = {
    "device": _TEXT,
    "unit": _NUMBER,
    "units": _TEXT,
    "variant": _MAP,
    "given": _MAP,
    "values": _MAP,
    "unmet": _LIST,
    "refusals": _MAP,
    "behaviour": ((bool, str), "yes or no"),
}


def read_bench(file: Path) -> Bench:
    """Return the bench of a file. Raises UnclearError with the place of the first thing that is wrong."""
    report = Report()
    source = read_source(file, report)
    documents = load(source, report) if source is not None else []
    if report.has_errors:
        first = report.findings[0]
        raise UnclearError(
            f"{first.span.file}:{first.span.line}:{first.span.column}: {first.message}", first.hint or ""
        )
    if len(documents) != 1 or documents[0] is None:
        raise UnclearError(f"{file}:1:1: a bench file is one mapping with `lines`", "")
    node = _checked(documents[0], _BENCH, "lines")
    lines = [_line(_mapping(node["lines"], place)) for place in range(len(node["lines"]))]
    strict = node.get("strict") in (True, "yes")
    return Bench(lines, node.get("seed", 0), float(node.get("time_scale", 1)), strict, file.parent)


def _line(node: Map) -> LineSettings:
    _checked(node, _LINE, "devices")
    on = [key for key in ("tcp", "serial", "can") if key in node]
    if len(on) != 1:
        raise _wrong(node, None, "a line is one of `tcp`, `serial` and `can`", "tcp: 5020")
    devices = [_device(_mapping(node["devices"], place)) for place in range(len(node["devices"]))]
    if not devices:
        raise _wrong(node, "devices", "a line has at least one device", "list it, or leave the line out")
    speed = node.get("baud", node.get("bitrate", 0))
    at = "" if node[on[0]] is None else str(node[on[0]])
    return LineSettings(devices, on[0], at, node.get("framing", ""), speed, tuple(map(str, node.get("faults", ()))))


def _device(node: Map) -> DeviceSettings:
    _checked(node, _DEVICE, "device")
    units: tuple[int, ...] = (node["unit"],) if "unit" in node else ()
    if "units" in node:
        low, dots, high = node["units"].partition("..")
        if not (dots and low.strip().isdecimal() and high.strip().isdecimal() and len(low + high) < 8):
            raise _wrong(node, "units", f"`{node['units'][:40]}` is no interval", "write it as 1..10")
        units = tuple(range(int(low), int(high) + 1))
    variants = tuple(f"{axis}={value}" for axis, value in node.get("variant", {}).items())
    given, refusals = (_numbers(node, key) for key in ("given", "refusals"))
    unmet = tuple(map(str, node.get("unmet", ())))
    moves = node["behaviour"] in (True, "yes") if "behaviour" in node else None
    return DeviceSettings(node["device"], units, variants, given, node.get("values", {}), unmet, refusals, moves)


def _numbers(node: Map, key: str) -> Mapping[str, int]:
    numbers: Map | dict[str, Any] = node.get(key, {})
    for name, number in numbers.items():
        if not isinstance(number, int):
            raise _wrong(node[key], name, f"`{name}` is a whole number", "")
    return numbers


def _mapping(items: Seq, place: int) -> Map:
    if isinstance(items[place], Map):
        node: Map = items[place]
        return node
    span = items.span(place)
    raise UnclearError(f"{span.file}:{span.line}:{span.column}: this is no mapping", "write `- key: value`")


def _checked(node: Map, kinds: _Kinds, needed: str) -> Map:
    """Return the mapping if its keys and their values are of these kinds."""
    for key, value in node.items():
        if key not in kinds:
            near = did_you_mean([known for known in kinds if known[:3] == key[:3]])
            raise _wrong(node, key, f"there is no key `{key[:40]}` here", near or f"there are {', '.join(kinds)}")
        types, words = kinds[key]
        if not isinstance(value, types) or (isinstance(value, bool) and bool not in types):
            raise _wrong(node, key, f"`{key}` is {words}", "")
    if needed not in node:
        raise _wrong(node, None, f"the key `{needed}` is missing", f"add `{needed}: …`")
    return node


def _wrong(node: Map, key: str | None, message: str, hint: str) -> UnclearError:
    span = node.span(key)
    return UnclearError(f"{span.file}:{span.line}:{span.column}: {message}", hint)
