"""The options for links and frames, and which families use them."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING

from fieldscribe.families import families, family
from fieldscribe.user_errors import Options, UnclearError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.families import Family
    from fieldscribe.model import Device


def asks_for_frames(options: Options) -> bool:
    """Whether any option was given that only concerns whole frames."""
    return options != Options(index=options.index)


def framings(bus_family: Family) -> tuple[str, ...]:
    """The framings of a family, if there is a choice."""
    return bus_family.framings if len(bus_family.framings) > 1 else ()


def refuse_foreign(device: Device, options: Options) -> None:
    """Refuse options that only other families use. Raises UnclearError."""
    for name in _said(options):
        takers = [bus_family.name for bus_family in families() if _takes(bus_family, name)]
        if device.family not in takers:
            flag = f"--{name.replace('_', '-')}"
            message = f"{flag} is for {' and '.join(takers)} devices; {device.id} is a {device.family} device"
            raise UnclearError(message)
    known = framings(family(device.family))
    if options.framing is not None and options.framing not in known:
        message = f"--framing {options.framing} is not for {device.family} devices such as {device.id}"
        raise UnclearError(message, f"it takes {', '.join(known)}")


def _said(options: Options) -> Iterator[str]:
    names = [field.name for field in fields(options) if field.name != "own"]
    yield from (name for name in names if getattr(options, name) is not None)
    yield from options.own


def _takes(bus_family: Family, name: str) -> bool:
    """Whether a family uses an option."""
    shared = {"framing": bool(framings(bus_family)), "index": bool(bus_family.indexed), "unit": True, "request": True}
    return shared.get(name, False) or any(option.name == name for option in bus_family.options)
