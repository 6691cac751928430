"""How a link is set: what was asked for, held against what the device knows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.dialogue.selection import UnclearError
from fieldscribe.families.uss.telegrams import VARIABLE, Link

if TYPE_CHECKING:
    from fieldscribe.dialogue.options import Options
    from fieldscribe.model import Bus, Device

_USUAL_PZD = 2


def default_link(bus: Bus) -> Link:
    """A parameter part of variable length (or the device's longest) and two words of process data."""
    low, high = bus.pzd
    return Link(VARIABLE if VARIABLE in bus.pkw or not bus.pkw else bus.pkw[-1], min(max(_USUAL_PZD, low), high))


def link_of(device: Device, options: Options) -> Link:
    """The link that was asked for. Raises UnclearError."""
    usual, bus = default_link(device.bus), device.bus
    if options.pkw is not None and options.pkw not in bus.pkw:
        known = ", ".join(map(str, bus.pkw))
        raise UnclearError(
            f"--pkw {options.pkw}: {device.id} knows no parameter part of this length", f"it has {known}"
        )
    low, high = bus.pzd
    if options.pzd is not None and not low <= options.pzd <= high:
        raise UnclearError(f"--pzd {options.pzd}: {device.id} has {low} to {high} words of process data")
    pkw = usual.pkw if options.pkw is None else options.pkw
    return Link(pkw, usual.pzd if options.pzd is None else options.pzd, options.single_first)


def default_unit(device: Device) -> int:
    """The unit that examples go to: 1 or the lowest that the device may have."""
    low, high = device.bus.units
    return 1 if low <= 1 <= high else low
