"""Device templates of wb-mqtt-serial: those that speak Modbus and are not deprecated."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

from fieldscribe.importing.readers import UnreadableError
from fieldscribe.importing.wb import draft_template
from fieldscribe.importing.wb.templates import read_template
from jinja2 import FileSystemLoader
from jinja2.sandbox import SandboxedEnvironment

from corpus.collection import Collection, Counts, Drafted, Points
from corpus.registers import Register


def _files(folder: Path) -> list[Path]:
    return sorted(file for file in folder.rglob("config-*") if file.name.endswith((".json", ".json.jinja")))


def _draft(file: Path) -> Drafted | None:
    try:
        template = read_template(file)
    except UnreadableError as error:
        if "the protocol is" in error.message:
            return None
        raise
    if template.get("deprecated") or template["device"].get("deprecated"):
        return None
    drafted = draft_template(file, "device")
    return Drafted(drafted.groups, drafted.head)


def expected(file: Path, points: Points, chance: Random, counts: Counts) -> Iterator[tuple[str, Iterator[str]]]:
    """Yield points with vectors for random contents of their registers, which the template is read for once more."""
    text = file.read_text("utf-8-sig")
    if file.suffix == ".jinja":
        text = SandboxedEnvironment(loader=FileSystemLoader(file.parent)).from_string(text).render()
    plain = re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda match: match[1] or "", text, flags=re.DOTALL)
    body = json.loads(plain, parse_float=Fraction)["device"]
    english = body.get("translations", {}).get("en", {})
    parameters = body.get("parameters", [])
    parameters = list(parameters.values()) if isinstance(parameters, dict) else parameters
    items = [item for item in parameters if "address" in item and not item.get("readonly")]
    for channel in body.get("channels", []):
        parts = channel.get("consists_of", [])
        items += [channel] if not parts else []
        items += [
            {**channel, **part, "type": "", "name": f"{channel['name']} {number}"}
            for number, part in enumerate(parts, 1)
        ]
    places: dict[Any, list[Mapping[str, Any]]] = {}
    for item in items:
        if item.get("address") is not None:
            places.setdefault(_place(item), []).append(item)
    given: dict[Any, list[Mapping[str, Any]]] = {}
    for point in points:
        if point["access"] != "w":
            given.setdefault((point["space"], point["address"], tuple(point["bits"] or ())), []).append(point)
    for place, here in places.items():
        for item, point in _pairs(here, given.get(place, []), english):
            yield point["name"], _register(item, english).vectors(point, chance, counts)


def _pairs(
    items: Sequence[Mapping[str, Any]], points: Points, english: Mapping[str, str]
) -> Iterator[tuple[Mapping[str, Any], Mapping[str, Any]]]:
    """Yield the items of one place, each with its point: the only one, or those with its title in the same order."""
    if len(items) == len(points) == 1:
        yield items[0], points[0]
        return
    for form in (str, _without_numbers):
        named: dict[str, list[Mapping[str, Any]]] = {}
        for item in items:
            title = str(item.get("title") or item.get("name") or item.get("id"))
            named.setdefault(form(english.get(title, title)), []).append(item)
        for title, alike in named.items():
            found = [point for point in points if form(point["title"]["en"]) == title]
            if len(found) == len(alike):
                yield from zip(alike, found, strict=True)
                items = [item for item in items if item not in alike]
                points = [point for point in points if point not in found]


def _without_numbers(title: str) -> str:
    return re.sub(r"\(index \d+\)|[\W\d]", "", title)


def _place(item: Mapping[str, Any]) -> tuple[str, int, tuple[int, ...]]:
    number, _, bits = str(item["address"]).partition(":")
    low, _, width = bits.partition(":")
    space = {"input": "input", "press_counter": "input", "coil": "coil", "discrete": "discrete"}
    held = (int(low), int(width)) if width and int(width) < 16 else ()
    if not held and item.get("format") in ("u8", "s8", "char8"):
        held = (0, 8)
    place = space.get(str(item.get("reg_type")), "holding"), int(number, 0)
    return (*place, (held[0] + held[1] - 1, held[0]) if held else ())


def _register(item: Mapping[str, Any], english: Mapping[str, str]) -> Register:
    one = _read(item, english)
    is_read_only = item.get("readonly") or item.get("read_only") or _place(item)[0] in ("input", "discrete")
    one.access = "r" if is_read_only else "rw"
    one.closed = bool(one.names) and item.get("type") != "pushbutton"
    if not one.names and one.width > 1:
        low, high = (None if key not in item else Fraction(_number(item[key])) for key in ("min", "max"))
        one.ends = low, high
    return one


def _number(value: Any) -> Any:
    """Return a number of a template, which may be a text: "0x1F"."""
    return int(value, 0) if isinstance(value, str) and "." not in value else value


def _read(item: Mapping[str, Any], english: Mapping[str, str]) -> Register:
    """Return the register but for what may be written."""
    form, (space, _, bits) = str(item.get("format", "u16")), _place(item)
    ratio, offset = (Fraction(item.get(key) or otherwise) for key, otherwise in (("scale", 1), ("offset", 0)))
    if space in ("coil", "discrete"):
        is_named = offset or item.keys() & {"on_value", "off_value", "enum"}
        return Register("u", 1, names=_names(item, ratio, offset, english) if is_named else {})
    if form in ("string", "string8"):
        return Register("t", 16 * int(item["string_data_size"]), per_word=1 if form == "string" else 2)
    kind, width = {"float": ("f", 32), "double": ("f", 64), "char8": ("u", 8)}.get(form) or (
        form[0],
        int(re.sub("[a-z]+", "", form)),
    )
    one = Register(kind, width, (bits[1], bits[0] - bits[1] + 1) if bits else None)
    one.low_word_first = item.get("word_order") == "little_endian"
    one.low_byte_first = item.get("byte_order") == "little_endian"
    one.clears = width == 8 and ":" not in str(item["address"])
    for key, name in (("unsupported_value", "unsupported"), ("error_value", "error")):
        if key in item:
            one.codes = {**one.codes, int(_number(item[key])) & (1 << width) - 1: name}
    if "enum" in item or item.get("type") in ("switch", "alarm"):
        one.names = _names(item, ratio, offset, english)
    elif item.get("type") == "pushbutton" and _number(item.get("on_value", 1)) != 1:
        one.names = {_number(item["on_value"]): "Press"}
    else:
        one.ratio, one.offset = ratio, offset
    return one


def _names(item: Mapping[str, Any], ratio: Fraction, offset: Fraction, english: Mapping[str, str]) -> Mapping[int, str]:
    """Return the titles of raw numbers; of a switch 1 is on if the template does not say otherwise."""
    if "enum" in item:
        raws = [(Fraction(str(value)) - offset) / ratio for value in item["enum"]]
        titles = item.get("enum_titles", [])
        titles = [str(title) for title in (titles if len(titles) == len(raws) else item["enum"])]
        return {int(raw): english.get(title, title) for raw, title in zip(raws, titles, strict=True)}
    if "on_value" in item or "off_value" in item:
        return {_number(item.get("off_value", 0)): "Off", _number(item.get("on_value", 1)): "On"}
    return {int((value - offset) / ratio): title for value, title in enumerate(("Off", "On"))}


WB = Collection("wb", _files, _draft, expected)
