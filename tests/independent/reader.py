"""The points of a description, row by row as the author wrote them, with what repeats written out."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

import yaml

from independent.arithmetic import evaluate, is_number, number

Row = dict[str, Any]
"""Facts by the language's keys, all texts."""

NOTHING = ("", "~", "null")
_CHOICES = {"set": "sets", "index": "indices"}
_INHERITED = ("space", "access", "type", "telegram", "numbering", "addressing", "bytes", "coding", "bit_numbers")


@dataclass
class Description:
    """What all points of a device share, and the points by the names of their generated items."""

    family: str
    words: Any = "high first"
    bytes: Any = "high first"
    enums: dict[str, Row] = field(default_factory=dict)
    formats: dict[str, Row] = field(default_factory=dict)
    records: dict[str, Row] = field(default_factory=dict)
    points: dict[str, Row] = field(default_factory=dict)


def read(folder: Path) -> Description:
    """A description: its parts in order, as plain texts; nothing is checked."""
    device, *below = _load(folder / "device.yaml")
    parts = [device, *below, *(document for part in device.get("parts", ()) for document in _load(folder / part))]
    found = Description(device["family"])
    for part in parts:
        found.words = part.get("bus", {}).get("words", found.words)
        found.bytes = part.get("bus", {}).get("bytes", found.bytes)
        for key in ("enums", "formats", "records"):
            getattr(found, key).update(part.get(key, {}))
    for group in parts:
        around = [(one.get("special", {}), one.get("types", {})) for one in (device, group)]
        for row in group.get("points", ()):
            shared = {key: group[key] for key in _INHERITED if key in group} | {"around": around}
            for one in _written_out(found, shared | row):
                found.points[one["item"]] = one
    return found


def _load(path: Path) -> list[Row]:
    """The documents of a file: texts, lists and maps only."""
    loaded = yaml.load_all(path.read_text("utf-8"), Loader=yaml.BaseLoader)
    return [one for one in loaded if isinstance(one, dict)]


def _written_out(description: Description, row: Row) -> Iterator[Row]:
    """The points that a row stands for: of a record, for each set, for each element, for each variant."""
    shared = description.formats.get(row.get("format", ""), {})
    row = shared | row | {"format_special": shared.get("special", {})}
    if "record" in row:
        yield from _members(description, row)
        return
    for one in _sets(row):
        yield from _places(one)


def _members(description: Description, row: Row) -> Iterator[Row]:
    kept = {key: value for key, value in row.items() if key in (*_INHERITED, "code", "around")}
    for member in description.records[row["record"]]["points"]:
        shared = description.formats.get(member.get("format", ""), {})
        own = row.get("members", {}).get(member["name"], {}) | {"name": f"{row['name']}_{member['name']}"}
        for key in ("at", "write_at"):
            if key in member | own:
                own[key] = "~" if row["at"] in NOTHING else _by_base((member | own)[key], row["at"])
        yield from _places(kept | shared | member | own | {"format_special": shared.get("special", {})})


def _by_base(text: str, base: str) -> str:
    return str(_whole(text, {"base": number(base)}))


def _sets(row: Row) -> Iterator[Row]:
    """The point in its own set, and in those that have rows of their own."""
    if "cases" in row:
        for which, own in row["cases"].items():
            yield (
                {key: value for key, value in row.items() if key != "cases"} | own | {"name": f"{row['name']}_{which}"}
            )
        return
    if not isinstance(row.get("sets"), dict):
        yield row
        return
    yield {key: value for key, value in row.items() if key not in ("sets", "set")}
    for which, own in row["sets"].items():
        kept = {key: value for key, value in row.items() if key not in ("sets", "was", "code", *_CHOICES)}
        yield kept | own | {"name": f"{row['name']}_set_{which}"}


def _places(row: Row) -> Iterator[Row]:
    """One row for each parameter set, array index and variant."""
    for which, own in row.get("variants", {"": {}}).items():
        whole = {key: value for key, value in row.items() if key != "variants"} | own
        ending = f"_{which.partition('=')[2].lower()}" if which else ""
        for chosen in _choices(whole):
            repeated = [key for key, many in _CHOICES.items() if many in whole and key not in whole]
            name = whole["name"] + "".join(f"_{key}_{chosen[key]}" for key in repeated)
            each = _own_of(whole.get("each", {}), chosen, by="index" if "index" in repeated else "set")
            at = {key: _by_rule(whole, chosen, key) for key in ("at", "write_at") if key in whole}
            yield whole | each | own | at | {"name": name, "item": name + ending}


def _choices(row: Row) -> Iterator[dict[str, int]]:
    for index, which in itertools.product(_counted(row, "index"), _counted(row, "set")):
        yield {"set": which, "index": index}


def _counted(row: Row, which: str) -> list[int]:
    """The sets, or the indices, that a row stands for: one alone, a count from 1, or an interval."""
    if which in row or _CHOICES[which] not in row:
        return [number(row.get(which, "1"))]
    low, _, high = str(row[_CHOICES[which]]).replace("to end", "1..end").partition("..")
    last = row["most"] if high and not is_number(high) else high  # the device says how many there are
    return list(range(number(low), number(last) + 1) if high else range(1, number(low) + 1))


def _own_of(each: Row, chosen: Mapping[str, int], by: str) -> Row:
    """What is said of one element: by its index (or set, where there is one index) alone, or by set/index."""
    own: Row = {}
    for key, facts in each.items():
        own |= facts if key in (str(chosen[by]), f"{chosen['set']}/{chosen['index']}") else {}
    return own


def _by_rule(row: Row, chosen: Mapping[str, int], key: str) -> str | list[str]:
    """The address that the group's rule gives, for both ends of a text; of words in a list, each."""
    if isinstance(row[key], list):
        return [str(_by_rule({**row, key: each}, chosen, key)) for each in row[key]]
    if "addressing" not in row or row[key] in NOTHING:
        return str(row[key])
    counts = {many: number(row[many]) if is_number(row.get(many, "")) else 1 for many in _CHOICES.values()}
    names = [{**counts, **chosen, "number": number(end)} for end in row[key].split("..")]
    return "..".join(str(_whole(row["addressing"], one)) for one in names)


def _whole(text: str, names: Mapping[str, int]) -> int:
    exact = evaluate(text, lambda name, _: Fraction(names[name]))
    assert exact.denominator == 1
    return int(exact)
