"""What a person says of the link and of single frames, and which families have a use for it."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from fieldscribe.dialogue.selection import UnclearError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.model import Device


@dataclass(frozen=True, slots=True)
class Options:
    """None, False and the empty text are what nobody said."""

    framing: str | None = None
    unit: int | None = None
    request: str | None = None
    can_id: str | None = None
    with_word: str | None = None
    pkw: int | None = None
    pzd: int | None = None
    single_first: bool = False
    direction: str | None = None
    index: int | None = None
    keep: bool = False


def asks_for_frames(options: Options) -> bool:
    """Whether something was said that only a whole frame has a use for."""
    return options != Options(index=options.index)


FRAMINGS: Mapping[str, tuple[str, ...]] = {"modbus": ("rtu", "tcp"), "uss": ("uss", "pkw", "pzd", "broadcast")}
"""How frames may be wrapped, by family."""

_TAKES: Mapping[str, tuple[str, ...]] = {
    "framing": tuple(FRAMINGS),
    "can_id": ("can",),
    "with_word": ("can",),
    "pkw": ("uss",),
    "pzd": ("uss",),
    "single_first": ("uss",),
    "direction": ("uss",),
    "index": ("uss",),
    "keep": ("uss",),
}
"""The families that an option is for; those that are not here are for all."""


def refuse_foreign(device: Device, options: Options) -> None:
    """Refuse what only devices of other families have a use for. Raises UnclearError."""
    family = device.family
    for one in fields(options):
        takes = _TAKES.get(one.name, (family,))
        given = getattr(options, one.name)
        if given is not None and given is not False and family not in takes:
            raise UnclearError(
                f"--{one.name.replace('_', '-')} is for {' and '.join(takes)} devices; {device.id} is a {family} device"
            )
    framings = FRAMINGS.get(family, ())
    if options.framing is not None and options.framing not in framings:
        raise UnclearError(
            f"--framing {options.framing} is not for {family} devices such as {device.id}",
            f"it takes {', '.join(framings)}",
        )
