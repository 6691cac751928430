"""What frames on a line say, with state from one to the next. Each family knows its frames; the answers are alike."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable

    from fieldscribe.dialogue.codec import Settings
    from fieldscribe.model import Device


@dataclass(frozen=True, slots=True)
class Item:
    """What a frame says of one place: a point and what its raw number means, a part of it, a command, or nothing known.

    `text` is complete in itself for people. `missing` names points without whose raw numbers there is no value.
    """

    space: str
    address: int
    count: int
    text: str
    point: str | None = None
    code: str | None = None
    raw: int | None = None
    value: str | None = None
    missing: tuple[str, ...] = ()

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {
            "space": self.space,
            "address": self.address,
            "count": self.count,
            "point": self.point,
            "code": self.code,
            "raw": self.raw,
            "value": self.value,
            "missing": list(self.missing),
            "text": self.text,
        }


@dataclass(frozen=True, slots=True)
class Heard:
    """One frame in words. `kind`: request, reply, request_or_reply, exception, unreadable; notes are not faults."""

    data: bytes
    framing: str
    kind: str
    unit: int | None
    function: int | None
    summary: str
    items: tuple[Item, ...] = ()
    checks: str = ""
    faults: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    exception: int | None = None

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {
            "bytes": self.data.hex(" ").upper(),
            "framing": self.framing,
            "kind": self.kind,
            "unit": self.unit,
            "function": self.function,
            "exception": self.exception,
            "summary": self.summary,
            "items": [item.as_data() for item in self.items],
            "checks": self.checks,
            "faults": list(self.faults),
            "notes": list(self.notes),
        }


class Listener(Protocol):
    """Hears frames in the order in which they were on the line."""

    def hear(self, data: bytes) -> Heard:
        """What the next frame says; any bytes are safe."""

    def expect_reply_to(self, data: bytes) -> Heard:
        """Take a frame as the request that the following frames answer."""


def listener(device: Device, settings: Settings, framing: str | None = None) -> Listener:
    """A listener for the device's family. `settings` are raw numbers of points that are known before."""
    from fieldscribe.families.modbus.dialogue import ModbusListener

    known: dict[str, Callable[[Device, Settings, str | None], Listener]] = {"modbus": ModbusListener}
    return known[device.family](device, settings, framing)
