"""What a unit is, and which points have it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Unit

Answer = tuple[str, str, list[tuple[str, str]]]
"""How the question was understood, a heading, and rows."""

_MOST_POINTS = 20


def find_units(device: Device, asked: str) -> Iterator[Answer]:
    """The unit with this symbol, as the device uses it; also a shipped unit that no point has."""
    from fieldscribe.language.units import shipped_unit

    own = {point.unit.symbol: point.unit for point in device.points if point.unit.symbol}
    unit = own.get(asked) or shipped_unit(asked)
    if unit is not None:
        yield f"unit {unit.symbol}", f"{unit.symbol}: {unit.name}", _rows(device, unit)


def _rows(device: Device, unit: Unit) -> list[tuple[str, str]]:
    from fieldscribe.language.units import shipped

    known = shipped().get(unit.symbol)
    declared = known is None or known.unit != unit
    names = list(dict.fromkeys(point.name for point in device.points if point.unit == unit))
    rest = f" and {len(names) - _MOST_POINTS} more" if len(names) > _MOST_POINTS else ""
    return [
        ("Quantity", unit.quantity),
        ("Means", f"{known.factor} {known.base}" if known is not None and known.prefix and not declared else ""),
        ("Declared", "by the description" if declared else "no need: it comes with fieldscribe"),
        ("Points", ", ".join(names[:_MOST_POINTS]) + rest if names else "none"),
    ]
