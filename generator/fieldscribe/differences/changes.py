"""The differences of two sides, device by device, with their places, their names in code, and the version step."""

from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

from fieldscribe.differences.comparison import Difference, Thing, differences
from fieldscribe.differences.sides import Side
from fieldscribe.facts.table import API, BEHAVIOUR, COMPATIBLE, DOCS, WIRE

CLASSES = {
    WIRE: "breaks on the wire",
    API: "breaks code",
    BEHAVIOUR: "changes behaviour",
    COMPATIBLE: "is compatible",
    DOCS: "changes the documentation",
}
"""The classes, the gravest first, with the effect of such a difference."""

_STEPS = {WIRE: "major", API: "major", BEHAVIOUR: "minor", COMPATIBLE: "minor", DOCS: "patch"}
STEPS = ("patch", "minor", "major")
"""The steps of a version, the smallest first."""


def step_for(classes: Iterable[str]) -> str | None:
    """Return the step that differences of these classes require; None without any."""
    required = {_STEPS[name] for name in classes}
    return next((step for step in reversed(STEPS) if step in required), None)


def next_version(version: str, step: str) -> str | None:
    """Return the lowest version that takes this step; None if the version is not like `1.2.3`.

    Below 1.0, breaking changes raise the middle number, as in Cargo and npm, and all others the last one.
    """
    numbers = _numbers(version)
    if numbers is None:
        return None
    major, minor, patch = numbers
    if step == "major" and major:
        return f"{major + 1}.0.0"
    if step == "major" or (step == "minor" and major):
        return f"{major}.{minor + 1}.0"
    return f"{major}.{minor}.{patch + 1}"


def is_taken(old: str, new: str, step: str) -> bool:
    """Return True if the new version is at least that step from the old one, or if one is not like `1.2.3`."""
    least, there = next_version(old, step), _numbers(new)
    return least is None or there is None or there >= (_numbers(least) or there)


def _numbers(version: str) -> tuple[int, int, int] | None:
    parts = version.split(".")
    if len(parts) != 3 or not all(part.isascii() and part.isdigit() and len(part) < 10 for part in parts):
        return None
    major, minor, patch = map(int, parts)
    return major, minor, patch


Names = tuple[tuple[str, str], ...]
"""A thing by kinds and names, from the outside in."""


class Comparison:
    """One device on both sides; None for a side without it."""

    def __init__(self, device: str, old: Side | None, new: Side | None) -> None:
        self.device, self.old, self.new = device, old, new

    @cached_property
    def differences(self) -> list[Difference]:
        """The differences, without things that only seem gone because one side could not resolve them."""
        if self.old is None or self.new is None:
            names = [None if side is None else self.device for side in (self.old, self.new)]
            thing = Thing("device", *names)
            weight = API if self.new is None else COMPATIBLE
            return [Difference(weight, (thing,), "", thing.old, thing.new)]
        found = differences(self.old.exported, self.new.exported)
        return [difference for difference in found if not self._is_lost(difference)]

    @property
    def step(self) -> str | None:
        """The step that the version must take; None if nothing differs."""
        return step_for(difference.weight for difference in self.differences)

    def places(self, difference: Difference) -> dict[str, str | None]:
        """Return the place of the fact on each side."""
        return {
            "old": None if self.old is None else self._place(self.old, difference, old=True),
            "new": None if self.new is None else self._place(self.new, difference, old=False),
        }

    def symbols(self, difference: Difference) -> dict[str, list[str]]:
        """Return the names in generated code by language, those of the old side first."""
        sides = self.symbols_of_sides(difference)
        return {language: list(dict.fromkeys((*old, *new))) for language, (old, new) in sides.items()}

    def symbols_of_sides(self, difference: Difference) -> Mapping[str, tuple[list[str], list[str]]]:
        """Return the names in generated code by language on each side; an exported model has none."""
        symbols: dict[str, tuple[list[str], list[str]]] = {}
        for number, side in enumerate((self.old, self.new)):
            names = _names(difference, old=number == 0)
            if side is None or side.described is None or names is None or difference.weight == DOCS:
                continue
            for language, identifiers in side.described.identifiers(names, difference.fact).items():
                symbols.setdefault(language, ([], []))[number].extend(dict.fromkeys(identifiers))
        return symbols

    @property
    def is_nameless(self) -> bool:
        """Return True if some names in code are not known."""
        return any(self.nameless(difference) for difference in self.differences)

    def nameless(self, difference: Difference) -> list[str]:
        """Return the sides whose names in code are unknown: exported models, unless the other side has them."""
        if difference.weight == DOCS or not difference.things:
            return []
        names = {"old": _names(difference, old=True), "new": _names(difference, old=False)}
        sides = {"old": self.old, "new": self.new}
        known = [names[which] for which, side in sides.items() if side is not None and side.described is not None]
        exported = [which for which, side in sides.items() if side is not None and side.described is None]
        return [which for which in exported if names[which] is not None and names[which] not in known]

    def _place(self, side: Side, difference: Difference, *, old: bool) -> str | None:
        """Return the place of a fact; for a part that this side lacks, the place of the thing around it."""
        names = _names(difference, old=old)
        if names is None:
            names = _names(difference._replace(things=difference.things[:-1]), old=old)
            return side.place(names, difference.things[-1].kind) if names else None
        return side.place(names, difference.fact)

    def _is_lost(self, difference: Difference) -> bool:
        """Return True if a thing only seems added or removed because a side has errors."""
        thing = difference.things[0] if difference.things else None
        if difference.fact or thing is None or None not in thing[1:]:
            return False
        side = self.old if thing.old is None else self.new
        if side is None or side.described is None:
            return False
        lost = side.described.lost
        return lost is None or (thing.kind, thing.name) in lost


def compared(old: Mapping[str, Side], new: Mapping[str, Side]) -> list[Comparison]:
    """Return the devices of both sides, in the order of the new side, removed ones last."""
    ids = dict.fromkeys([*new, *old])
    return [Comparison(device, old.get(device), new.get(device)) for device in ids]


def subject_of(difference: Difference) -> str | None:
    """Return the subject of a difference: a point by name, another thing as `kind:name`, None for the device."""
    if not difference.things or difference.things[0].kind == "device":
        return None
    thing = difference.things[0]
    return thing.name if thing.kind == "point" else f"{thing.kind}:{thing.name}"


def fact_of(difference: Difference) -> str:
    """Return the fact in words, after the parts that it belongs to: `entry keypad raw`."""
    inner, renamed = difference.things[1:], difference.is_rename
    words = [f"{thing.kind} {thing.old if renamed else thing.name}" for thing in inner]
    if renamed:
        words.append("name")
    elif difference.fact or not inner:
        words.append(difference.fact or difference.things[-1].kind)
    return " ".join(words)


def as_data(comparisons: list[Comparison]) -> dict[str, Any]:
    """Return everything for JSON."""
    changes = [_change(comparison, difference) for comparison in comparisons for difference in comparison.differences]
    return {"changes": changes, "step": step_for(change["class"] for change in changes)}


def _change(comparison: Comparison, difference: Difference) -> dict[str, Any]:
    return {
        "class": difference.weight,
        "device": comparison.device,
        "point": subject_of(difference),
        "fact": fact_of(difference),
        "old": difference.old,
        "new": difference.new,
        "places": comparison.places(difference),
        "symbols": comparison.symbols(difference),
        "symbols_missing": comparison.nameless(difference),
        "rename": difference.is_rename,
    }


def _names(difference: Difference, *, old: bool) -> Names | None:
    """Return the thing by its names on one side; None if this side does not have it."""
    names = [(thing.kind, thing.old if old else thing.new) for thing in difference.things]
    return None if any(name is None for _, name in names) else tuple((kind, name or "") for kind, name in names)
