"""The settings of a link: the options of the person, checked against the device."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.asked import UnclearError
from fieldscribe.families.uss.facts import of_bus
from fieldscribe.families.uss.parts import VARIABLE, Link

if TYPE_CHECKING:
    from fieldscribe.asked import Options
    from fieldscribe.model import Bus, Device

_USUAL_PZD = 2


@dataclass(frozen=True, slots=True)
class Asked:
    """The options of the family; None for those that were not given."""

    pkw: int | None = None
    pzd: int | None = None
    single_first: bool = False
    direction: str | None = None
    keep: bool = False


def asked(options: Options) -> Asked:
    """The options for the link and the telegrams."""
    return Asked(**options.own)


def default_link(bus: Bus) -> Link:
    """A parameter part of variable length (or the device's longest) and two words of process data."""
    own = of_bus(bus)
    low, high = own.pzd
    return Link(VARIABLE if VARIABLE in own.pkw or not own.pkw else own.pkw[-1], min(max(_USUAL_PZD, low), high))


def link_of(device: Device, options: Options) -> Link:
    """The link that the options choose. Raises UnclearError."""
    usual, own, said = default_link(device.bus), of_bus(device.bus), asked(options)
    if said.pkw is not None and said.pkw not in own.pkw:
        known = ", ".join(map(str, own.pkw))
        raise UnclearError(f"--pkw {said.pkw}: {device.id} knows no parameter part of this length", f"it has {known}")
    low, high = own.pzd
    if said.pzd is not None and not low <= said.pzd <= high:
        raise UnclearError(f"--pzd {said.pzd}: {device.id} has {low} to {high} words of process data")
    pkw = usual.pkw if said.pkw is None else said.pkw
    return Link(pkw, usual.pzd if said.pzd is None else said.pzd, said.single_first)
