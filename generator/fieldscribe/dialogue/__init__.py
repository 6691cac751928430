"""What frames on a line say, with state from one to the next. Each family knows its frames; the answers are alike.

A family offers a module `families/<family>/dialogue.py`, see `Dialogue`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.dialogue.options import Options
    from fieldscribe.model import Device, Point


@dataclass(frozen=True, slots=True)
class Item:
    """What a frame says of one place: a point and what its raw number means, a part of it, a command, or nothing known.

    `text` is complete in itself for people. `missing` names points without whose raw numbers there is no value;
    `findings` are what the device will not take, or what the manual closes, and stand in `text` too.
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
    findings: tuple[str, ...] = ()

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
            "findings": list(self.findings),
            "text": self.text,
        }


@dataclass(frozen=True, slots=True)
class Heard:
    """One frame in words.

    Faults break the frame itself; findings are what a sound frame asks or says against the manual; notes are neither.
    `kind`: request, reply, request_or_reply, exception, cyclic, broadcast, other (not of this device), unreadable.
    `details` are further facts of the family for JSON; `shown` is the frame as its users write it, if not as bytes.
    """

    data: bytes
    framing: str
    kind: str
    unit: int | None
    function: int | None
    summary: str
    items: tuple[Item, ...] = ()
    checks: str = ""
    faults: tuple[str, ...] = ()
    findings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    exception: int | None = None
    details: Mapping[str, object] = field(default_factory=dict)
    shown: str = ""

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {
            "bytes": self.data.hex(" ").upper(),
            "framing": self.framing,
            "kind": self.kind,
            "unit": self.unit,
            "function": self.function,
            "exception": self.exception,
            **self.details,
            "summary": self.summary,
            "items": [item.as_data() for item in self.items],
            "checks": self.checks,
            "faults": list(self.faults),
            "findings": list(self.findings),
            "notes": list(self.notes),
        }

    @property
    def wrong(self) -> bool:
        """Whether anything about the frame is a fault or a finding."""
        return bool(self.faults or self.findings or any(item.findings for item in self.items))


@dataclass(frozen=True, slots=True)
class Sent:
    """The frames that write a point, as their users write them, and what is odd about them."""

    frames: tuple[str, ...]
    notes: tuple[str, ...] = ()


class Dialogue(Protocol):
    """What the `dialogue` module of a family offers."""

    def decode(self, device: Device, settings: Settings, texts: Sequence[str], options: Options) -> list[Heard]:
        """What pasted frames say, in their order; any bytes are safe. Raises UnclearError for what is no frame."""

    def frames_for(self, device: Device, point: Point, raw: int, settings: Settings, options: Options) -> Sent:
        """The frames that write a raw number. Raises RefusedError."""

    def read_text(self, device: Device, point: Point) -> str:
        """How the point is read, with an example; empty if it cannot be read."""

    def write_text(self, device: Device, point: Point) -> str:
        """How the point is written, with an example; empty if it cannot be written."""


_DIALOGUES = {family: f"fieldscribe.families.{family}.dialogue" for family in ("modbus", "can", "uss")}
"""The modules by family; imported when a device needs one."""


def dialogue_of(device: Device) -> Dialogue:
    """The dialogue of the device's family."""
    module: Any = import_module(_DIALOGUES[device.family])
    dialogue: Dialogue = module
    return dialogue
