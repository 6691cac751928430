"""The points of a description, row by row as the author wrote them, with what repeats written out."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import yaml

from independent.arithmetic import evaluate, is_number, number

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

Row = dict[str, Any]
"""Facts by the language's keys, all texts."""

NOTHING = ("", "~", "null")
_INHERITED = ("space", "access", "type", "telegram", "numbering", "addressing")


@dataclass
class Description:
    """What all points of a device share, and the points by the names of their generated items."""

    family: str
    words: Any = "high first"
    enums: dict[str, Row] = field(default_factory=dict)
    formats: dict[str, Row] = field(default_factory=dict)
    records: dict[str, Row] = field(default_factory=dict)
    points: dict[str, Row] = field(default_factory=dict)


def read(folder: Path) -> Description:
    """A description: its parts in order, as plain texts; nothing is checked."""
    device = _load(folder / "device.yaml")
    parts = [device, *(_load(folder / part) for part in device.get("parts", ()))]
    found = Description(device["family"])
    for part in parts:
        found.words = part.get("bus", {}).get("word_order", found.words)
        for key in ("enums", "formats", "records"):
            getattr(found, key).update(part.get(key, {}))
    for part in parts:
        group = part.get("group", {})
        around = [(one.get("special", {}), one.get("types", {})) for one in (device, group)]
        for row in part.get("points", ()):
            shared = {key: group[key] for key in _INHERITED if key in group} | {"around": around}
            for one in _written_out(found, shared | row):
                found.points[one["item"]] = one
    return found


def _load(path: Path) -> Row:
    loaded = yaml.load(path.read_text("utf-8"), Loader=yaml.BaseLoader)  # texts, lists and maps only
    return loaded if isinstance(loaded, dict) else {}


def _written_out(description: Description, row: Row) -> Iterator[Row]:
    """The points that a row stands for: of a record, for each set, for each element, for each variant."""
    shared = description.formats.get(row.get("format", ""), {})
    row = shared | row | {"format_special": shared.get("special", {})}
    if "record" in row:
        yield from _members(description, row)
        return
    for one in _sets(row):
        for element in _elements(one):
            yield from _variants(element)


def _members(description: Description, row: Row) -> Iterator[Row]:
    kept = {key: value for key, value in row.items() if key in (*_INHERITED, "code", "around")}
    for member in description.records[row["record"]]["points"]:
        shared = description.formats.get(member.get("format", ""), {})
        at = "~" if row["at"] in NOTHING else str(_whole(member["at"], {"base": number(row["at"])}))
        own = row.get("members", {}).get(member["name"], {}) | {"name": f"{row['name']}_{member['name']}", "at": at}
        yield from _variants(kept | shared | member | own | {"format_special": shared.get("special", {})})


def _sets(row: Row) -> Iterator[Row]:
    yield {key: value for key, value in row.items() if key != "sets"}
    for which, own in row.get("sets", {}).items():
        kept = {key: value for key, value in row.items() if key not in ("sets", "was", "code")}
        yield kept | own | {"name": f"{row['name']}_set_{which}"}


def _elements(row: Row) -> Iterator[Row]:
    """One row for each parameter set and array index that `at` names."""
    at = row.get("at")
    if not isinstance(at, dict):
        yield row
        return
    for chosen in _choices(at):
        repeated = [key for key, many in (("set", "sets"), ("index", "indices")) if many in at and key not in at]
        suffix = "".join(f"_{key}_{chosen[key]}" for key in repeated)
        own = _own_of(row.get("each", {}), chosen, by="index" if "index" in repeated else "set")
        yield row | own | {"name": row["name"] + suffix, "at": _at_rule(row, at, chosen), "element": chosen}


def _choices(at: Row) -> Iterator[dict[str, int]]:
    sets = range(1, number(at["sets"]) + 1) if "sets" in at and "set" not in at else [number(at.get("set", "1"))]
    if "indices" in at and "index" not in at:
        low, _, high = at["indices"].partition("..")
        indices = range(number(low), number(high) + 1) if high else range(1, number(low) + 1)
    else:
        indices = range(number(at.get("index", "1")), number(at.get("index", "1")) + 1)
    for index, which in itertools.product(indices, sets):
        yield {"set": which, "index": index}


def _own_of(each: Row, chosen: Mapping[str, int], by: str) -> Row:
    """What is said of one element: by its index (or set, where there is one index) alone, or by set/index."""
    own: Row = {}
    for key, facts in each.items():
        own |= facts if key in (str(chosen[by]), f"{chosen['set']}/{chosen['index']}") else {}
    return own


def _at_rule(row: Row, at: Row, chosen: Mapping[str, int]) -> str:
    if "addressing" not in row:
        return str(at["number"])
    names = {"number": number(at["number"]), "sets": number(at.get("sets", "1")), **chosen}
    names["indices"] = number(at["indices"]) if is_number(at.get("indices", "")) else 1
    return str(_whole(row["addressing"], names))


def _whole(text: str, names: Mapping[str, int]) -> int:
    exact = evaluate(text, lambda name, _: Fraction(names[name]))
    assert exact.denominator == 1
    return int(exact)


def _variants(row: Row) -> Iterator[Row]:
    if "variants" not in row:
        yield row | {"item": row["name"]}
    for which, own in row.get("variants", {}).items():
        whole = {key: value for key, value in row.items() if key != "variants"} | own
        for element in _elements(whole):
            yield element | {"item": f"{element['name']}_{which.partition('=')[2].lower()}"}
