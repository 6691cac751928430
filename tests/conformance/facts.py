"""What the package says of points beside their conversions."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

from support.vector_file import Vector

from conformance.package import Check, Package, attribute_of, attributes


def address(package: Package, vector: Vector) -> bool:
    """Where a point is, and its limits."""
    point = package.point(vector)
    at = point.facts.at
    found = {"point": point.facts.item, "code": point.facts.code}
    found |= {"space": at.space, "address": at.address, "words": point.size}
    if vector["raw_min"] is not None:
        found["raw_min"], found["raw_max"] = point.raw_limits
    references = {key: str(number) for key, number in point.facts.references.items()}
    found |= {"decimals": point.decimals or None, "references": references}
    return all((vector[key] or None) == (value or None) for key, value in found.items())


def place(package: Package, vector: Vector) -> bool:
    """All addresses of a point."""
    at = package.point(vector).facts.at
    return (list(at.addresses), at.index, at.telegram) == (vector["addresses"], vector["index"], vector["telegram"])


def display(package: Package, vector: Vector) -> bool:
    """With how many decimals people see values, which the point and its help say."""
    point, decimals = package.point(vector), vector["decimals"]
    said = f"with {decimals} decimal{'' if decimals == 1 else 's'}"
    guided = f"\nShown: {said}, by {point.facts.item}.text(value).\n" in point._guide()
    return bool(point.facts.display == decimals and repr(point).endswith(f", shown {said}>") and guided)


def fixed(package: Package, vector: Vector) -> bool:
    """The bits that are always written as a constant."""
    return bool(package.point(vector).facts.fixed == (vector["mask"], vector["bits"]))


def facts(package: Package, vector: Vector) -> bool:
    """What a point belongs to, and what it has beside its numbers."""
    point = package.point(vector)
    facts = point.facts
    found = {"group": facts.group, "name": facts.name, "symbol": facts.unit or None, "default": facts.default}
    found |= {"changes": facts.changes, "changes_with": list(facts.changes_with), "keeps": facts.keeps or None}
    found["uncertain"] = 1 if facts.uncertain else None
    found["conditions"] = list(facts.conditions)
    found["variant"] = "=".join(facts.variant) if facts.variant else None
    found["only_for"] = [facts.only_for[0], *facts.only_for[1]] if facts.only_for else []
    apart = facts.write_at
    found |= {"write_space": apart and apart.space, "write_addresses": list(apart.addresses) if apart else []}
    typed = vector["type"] in ("text", "bytes") or _is_wire(package.runtime, point.wire, vector["type"])
    return typed and _chosen(package, point) and all(vector[key] == value for key, value in found.items())


def _chosen(package: Package, point: Any) -> bool:
    """Whether the plain name of a point that variants share chooses it for its variant."""
    if point.facts.variant is None:
        return True
    axis, value = point.facts.variant
    shared = _attribute(package, point.facts.name)
    return bool(shared.axis == axis and shared.points[value] is point)


def _attribute(package: Package, name: str) -> Any:
    """What stands in the class for a name."""
    return attributes(package.device)[attribute_of(package.device, name)]


def alias(package: Package, vector: Vector) -> bool:
    """An old name gives the same point, also as text, and warns with both names."""
    point = package.point(vector).facts
    suffix = point.item.removeprefix(point.name)  # points of variants share their names, also the old ones
    old, new = (_attribute(package, vector[key].removesuffix(suffix)) for key in ("old", "new"))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        same = getattr(package.device, old.name) is new is attributes(package.device)[old.new_name]
    told = [str(one.message) for one in caught if one.category is DeprecationWarning and one.filename == __file__]
    return same and told == [f"{old.name} is now called {new.name}"] and package.device.OLD_NAMES[old.name] is old


def left_out(package: Package, vector: Vector) -> bool:
    """What is documented only is no attribute of a device, and the message says why."""
    documented = package.device.DOCUMENTED
    said = []
    for name in documented:
        try:
            getattr(object.__new__(package.device), name)
        except AttributeError as error:
            said.append(str(error))
    reasons = [f"{name} is documented only: {one}" for name, one in documented.items()]
    codes = [one.code or "none" for one in documented.values()]
    same = ([name.rstrip("_") for name in documented], codes) == (vector["names"], vector["codes"])
    return bool(same and said == reasons)


def documented(package: Package, vector: Vector) -> bool:
    """Where a point is that is documented only."""
    [one] = [one for name, one in package.device.DOCUMENTED.items() if name.rstrip("_") == vector["name"]]
    found = one.at.space, one.at.address, len(one.at.addresses), one.at.index
    where = ", ".join(map(str, one.at.addresses)) + ("" if one.at.index is None else f", index {one.at.index}")
    told = f"{one.reason}; `read_at` and `write_at` reach its words at {one.at.telegram or one.at.space} {where}"
    if one.write_at is not None:
        elsewhere = f" at {', '.join(map(str, one.write_at.addresses))}"
        told = told.replace(" and `write_at` reach", " reaches") + f", `write_at`{elsewhere}"
    return str(one) == told and found == tuple(vector[key] for key in ("space", "address", "words", "index"))


def identification(package: Package, vector: Vector) -> bool:
    """What a point holds in this device, or in a variant."""
    held = vector["raw"] if vector["text"] is None else vector["text"]
    variant = next(iter(vector["variant"].items()), None) if vector["variant"] else None
    rows = package.device.IDENTIFICATIONS
    return any(one.point == vector["of"] and held in one.values and one.variant == variant for one in rows)


def block(package: Package, vector: Vector) -> bool:
    """A planned read."""
    return any(
        (vector["space"], vector["function"], vector["address"], vector["count"])
        == (block.space, block.function, block.address, block.count)
        for block in package.device.BLOCKS[vector["group"]]
    )


def group(package: Package, vector: Vector) -> bool:
    """The words that bring a group."""
    members = [one for one in package.device.POINTS.values() if one.facts.group == vector["group"]]
    read = [one.facts.at for one in members if hasattr(one, "decode") and one.facts.at.space == "parameter"]
    return bool(list(dict.fromkeys(address for at in read for address in at.addresses)) == vector["addresses"])


def code(package: Package, vector: Vector) -> bool:
    """A number of the protocol with a name."""
    names = getattr(package.device.PROFILE, "exceptions" if vector["what"] == "exception" else "errors")
    return bool(names[vector["number"]] == vector["name"])


CHECKS: Mapping[str, Check] = {
    "address": address,
    "place": place,
    "display": display,
    "fixed": fixed,
    "facts": facts,
    "alias": alias,
    "left_out": left_out,
    "documented": documented,
    "identification": identification,
    "block": block,
    "group": group,
    "code": code,
}
"""The checks of this theme by the kind of vector."""


def _is_wire(runtime: Any, wire: Any, name: str) -> bool:
    """Whether a type has that name; one without a constant has its sign and width in its name."""
    named = getattr(runtime, name.upper(), None) or runtime.Type(int(name[1:]), name[0] == "s")
    return bool((wire.bits, wire.signed) == (named.bits, named.signed))
