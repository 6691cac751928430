# SPDX-License-Identifier: 0BSD
"""Finds a device's points by name, old name, code or group, for its known variants."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import isfinite
from typing import TYPE_CHECKING, Any, ClassVar

from .arguments import check_name, shown
from .commands import Command
from .descriptors import ByVariant, PointAttribute, Renamed
from .errors import (
    AbsentError,
    AccessError,
    FieldscribeError,
    NotANumberError,
    RequestError,
    undecided,
)
from .lookup import find, is_code, nearest
from .points import Decoding, Point
from .special import Special
from .steps import SteppedCommand

if TYPE_CHECKING:
    from .facts import Documented, Identification


def check_unit(unit: int, units: tuple[int, int]) -> None:
    """Raises RequestError (bad_unit) for a unit number that the device cannot have."""
    low, high = units
    if isinstance(unit, bool) or not isinstance(unit, int) or not low <= unit <= high:
        raise RequestError("bad_unit", f"the device can be unit {low} to {high}, not {shown(unit)}")


def check_variants(axes: Mapping[str, tuple[str, ...]], variants: Mapping[str, str | None]) -> None:
    """Raises RequestError (bad_variant) for an axis or a value that the device does not have."""
    for axis, value in variants.items():
        if axis not in axes:
            known = f", only by {', '.join(axes)}" if axes else ""
            raise RequestError("bad_variant", f"the device has no variants by {axis!r}{known}")
        if value is not None and value not in axes[axis]:
            raise RequestError("bad_variant", f"{axis} is one of {', '.join(axes[axis])}, not {shown(value)}")


def exists(point: Point, variants: Mapping[str, str | None]) -> bool:
    """Return True if the known variants have a point; False if its variant is not known."""
    axis, values = point.facts.only_for or ("", ())
    left = variants.get(axis) in (None, *values)
    variant = point.facts.variant
    return left and (variant is None or variants.get(variant[0]) == variant[1])


def _declares(kind: type, name: str) -> bool:
    """Return True if a class declares an attribute."""
    return name in getattr(kind, "__annotations__", ())


class PointTable:
    """A device's points, with what its bus needs to know."""

    POINTS: ClassVar[Mapping[str, PointAttribute[Any, Any]]] = {}
    GROUPS: tuple[str, ...] = ()
    """The groups that `read_many` reads."""
    BLOCKS: ClassVar[Mapping[str, tuple[Any, ...]]] = {}
    """Planned reads by group, if the family plans them."""
    VARIANTS: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    IDENTIFICATIONS: ClassVar[tuple[Identification, ...]] = ()
    DOCUMENTED: ClassVar[Mapping[str, Documented]] = {}
    """Points that are only documented, by name, with the reason."""

    AUTOMATIC: ClassVar[Mapping[str, tuple[SteppedCommand, ...]]] = {}
    """Commands that a device sends by itself: `first` (before anything else), `before write`."""

    OLD_NAMES: ClassVar[Mapping[str, Renamed]] = {}
    """Former names of points."""

    if not TYPE_CHECKING:  # type checkers report names that do not exist

        def __getattr__(self, name: str) -> Any:
            """Raise AttributeError that says why the device has no such point."""
            found = next((vars(kind)[name] for kind in type(self).__mro__ if name in vars(kind)), None)
            if hasattr(found, "__get__"):
                return found.__get__(self, type(self))  # the property raised AttributeError: raise it again
            documented = type(self).DOCUMENTED.get(name)
            message = f"{type(self).__name__!r} object has no attribute {name!r}"
            if documented is not None:
                message = f"{name} is documented only: {documented}"
            elif name[:1] != "_" and (near := nearest(self.POINTS.values(), name)):
                message += f"; did you mean {' or '.join(near)}?"
            raise AbsentError(message, name=name, obj=self)

        def __setattr__(self, name: str, value: object) -> None:
            """Refuse unknown attributes: otherwise assigning to a misspelt point would pass silently."""
            if name[:1] != "_" and not any(name in vars(kind) or _declares(kind, name) for kind in type(self).__mro__):
                near = nearest(self.POINTS.values(), name)
                own = f"declare an attribute of your own in your class, as in `{name}: object`"
                meant = f"did you mean {' or '.join(near)}? Use its write method" if near else own
                text = f"{type(self).__name__!r} object has no attribute {name!r}: {meant}"
                raise AttributeError(text, name=name, obj=self)
            super().__setattr__(name, value)

    def __init_subclass__(cls) -> None:
        points = [point for point in vars(cls).values() if isinstance(point, PointAttribute)]
        cls.POINTS = {**cls.POINTS, **{point.facts.item: point for point in points}}
        renamed = {name: alias for name, alias in vars(cls).items() if isinstance(alias, Renamed)}
        cls.OLD_NAMES = {**cls.OLD_NAMES, **renamed}
        stepped = [command for command in vars(cls).values() if isinstance(command, SteppedCommand)]
        for command in stepped:
            if command.run != "by caller":
                cls.AUTOMATIC = {**cls.AUTOMATIC, command.run: (*cls.AUTOMATIC.get(command.run, ()), command)}


class NamedPoints(PointTable):
    """The points of a device, for the variants that are known."""

    variants: Mapping[str, str | None]

    def rows(self, values: Mapping[str, object]) -> list[dict[str, Any]]:
        """Return values by name, as from `read_many`, as rows for a data frame, `csv.DictWriter` or `json.dumps`.

        Without a value, `value` is None: `status` is "ok", "special" or that of an error, and `detail` the name of the
        special code or the error message. `raw` is also None if the scale needs other points.
        """
        if not isinstance(values, Mapping):
            raise RequestError("bad_value", f"takes values by name, as read_many gives them, not {shown(values)}")
        return [self._row(name, value) for name, value in values.items()]

    def _row(self, name: str, value: object) -> dict[str, Any]:
        row: dict[str, Any] = {"name": name, "code": None, "value": value, "unit": "", "raw": None, "status": "ok"}
        row["detail"] = ""
        if isinstance(value, (FieldscribeError, Special)):
            status = "special" if isinstance(value, Special) else value.status
            row.update(value=None, status=status, detail=str(value))
        elif isinstance(value, float) and not isfinite(value):  # which JSON does not know
            row.update(value=None, status=NotANumberError.status, detail=str(value))
        elif hasattr(value, "isoformat"):  # a time, which JSON does not know either
            row["value"] = value.isoformat()
        if not isinstance(value, AbsentError):
            point = self._resolved(name)
            row.update(name=point.facts.name, code=point.facts.code, unit=point.facts.unit, raw=point.raw_of(value))
        return row

    def _resolved(self, what: Any) -> PointAttribute[Any, Any]:
        """Return the point of this device's variant by name, old name or code; raises AccessError."""
        check_name("point", what)
        name = what
        if (old := self.OLD_NAMES.get(what)) is not None:
            old.warn(stacklevel=4)
            name = old.new_name.rstrip("_")
        found = self._found(name) or self._labelled(name)
        if found is not None:
            return found
        coded = find(self.POINTS.values(), what)
        points = [point for point in coded if self._has(point)] or coded
        if len({point.facts.name for point in points}) > 1:
            raise AccessError(f"{what} means several points: {', '.join(point.facts.item for point in points)}")
        if len(points) != 1:
            name = points[0].facts.name if points else name
            why, axis = self._absence(name)
            raise undecided(AbsentError(f"{name} {why}"), axis)
        return points[0]

    def _named(self, name: str) -> list[PointAttribute[Any, Any]]:
        """Return the points with a name, one for each variant that has its own."""
        return [point for point in self.POINTS.values() if point.facts.name == name]

    def _labelled(self, label: str) -> PointAttribute[Any, Any] | None:
        """Return the point with a label (code and name), as in errors."""
        code, _, name = label.rpartition(" ")
        found = self._found(name) if code else None
        return found if found is not None and found.label == label else None

    def _found(self, name: str) -> PointAttribute[Any, Any] | None:
        return self.POINTS.get(name) or next((point for point in self._named(name) if self._has(point)), None)

    def _absence(self, name: str) -> tuple[str, str | None]:
        """Return why a point does not exist, and the variant axis if that is not known yet."""
        axes = [point.facts.variant[0] for point in self._named(name) if point.facts.variant]
        if not axes:
            return self._other_meaning(name), None
        if self.variants.get(axes[0]) is None:
            return f"depends on {axes[0]}", axes[0]
        return f"does not exist for {axes[0]} {self.variants[axes[0]]}", None

    def _other_meaning(self, name: str) -> str:
        """Return what a name is if it is no point: a documented point, a command, a group, or names like it."""
        for documented, facts in self.DOCUMENTED.items():
            if name in (documented, documented.rstrip("_")) or is_code(facts.code, name):
                return f"is documented only{'' if documented == name else f', as {documented}'}: {facts}"
        if isinstance(getattr(type(self), name, None), (Command, SteppedCommand)):
            return f"is a command of this device: {name}.send() sends it"
        if name in self._groups():
            return f"is a group of this device: read_many({name!r}) reads it"
        near = nearest([*self.POINTS.values()], name)
        hint = f"; did you mean {' or '.join(near)}?" if near else ": its `POINTS` lists their names"
        return f"is no point of this device{hint}"

    def _groups(self) -> list[str]:
        return list(dict.fromkeys([point.facts.group for point in self.POINTS.values() if point.facts.group]))

    def _meant_by_group(self, group: str) -> str:
        """Return a hint for an unknown group."""
        if self._found(group) is not None or find(self.POINTS.values(), group):
            return f"; it is a point: read_many([{group!r}]) reads it"
        return f", only {', '.join(self._groups())}"

    def _needed(self, point: Point, name: str) -> PointAttribute[Any, Any]:
        """Return a point that another one needs; the AccessError names both."""
        found = self._found(name)
        if found is None:
            why, axis = self._absence(name)
            raise undecided(AccessError(f"{point.label} needs {name}, which {why}"), axis)
        return found

    def _require(self, point: Point) -> None:
        """Raises AccessError if the point belongs to another variant than this device."""
        axis, value = point.facts.variant or ("", None)
        if self.variants.get(axis, value) not in (value, None):
            raise AbsentError(f"{point.label} exists only for {axis} {value}")
        axis, values = point.facts.only_for or ("", ())
        if self.variants.get(axis) not in (None, *values):
            raise AbsentError(f"{point.label} exists only for {axis} {' or '.join(values)}")

    def _has(self, point: Point) -> bool:
        return exists(point, self.variants)

    def _surely_has(self, point: Point) -> bool:
        """Return True if the known variants have the point for certain."""
        axis, _ = point.facts.only_for or ("", ())
        known = not axis or self.variants.get(axis) is not None
        return known and not point.facts.uncertain and self._has(point)

    def _listed(
        self, what: Iterable[str | Point], absent: dict[str, FieldscribeError] | None = None
    ) -> list[Decoding[Any]]:
        """Return the points of a group or list; raises AccessError, or stores it by name in `absent`."""
        if isinstance(what, (Point, bytes, bytearray)) or not isinstance(what, Iterable):
            raise AccessError(f"takes the name of a group, or a list of points and their names, not {shown(what)}")
        points: list[Decoding[Any]] = []
        for one in what:
            try:
                points.append(self._readable_point(one))
            except AccessError as error:
                if absent is None or not isinstance(one, str):
                    raise
                absent[one] = error
        return points

    def _readable_point(self, one: Any) -> Decoding[Any]:
        point = self._own(one)
        self._require(point)
        if not isinstance(point, Decoding):
            raise AccessError(f"{point.label} cannot be read")
        return point

    def _own(self, one: Any) -> PointAttribute[Any, Any]:
        """Return a point by its name or code, or checks that a point is of this device."""
        if isinstance(one, ByVariant):
            same = getattr(type(self), one.name, None) is one
            return self._resolved(one.name.rstrip("_") if same else one)
        if not isinstance(one, Point):
            return self._resolved(one)
        point = self._resolved(one.facts.item)
        if one.facts is not point.facts or getattr(one, "_device", self) is not self:
            raise AccessError(f"{one.label} is a point of another device")
        return point
