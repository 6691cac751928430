"""What is answered to people: frames and what they say, and the frames that write a point."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from fieldscribe.asked import RefusedError
from fieldscribe.wording import label
from fieldscribe.wording.buses import units_text

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from fieldscribe.model import Bus, Point


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


@dataclass(frozen=True, slots=True)
class Way:
    """How a point is written, in words, and how frames show it with a raw number as an example.

    `shown` gives nothing where no frame can be built; `joint` stands between the words and the example.
    """

    how: str
    shown: Callable[[int], str] | None = None
    joint: str = "; "


_WHY = {
    "bad_framing": "the device does not speak this framing",
    "bad_unit": "the device cannot have this unit number",
    "bad_function": "the device allows no function that writes it",
    "bad_count": "it has more words than the device takes in one request",
    "bad_address": "it lies beyond the last address",
    "bad_link": "the device knows no such link",
    "bad_task": "over this link there is no task that writes it",
    "bad_parameter": "its number cannot be sent",
    "bad_index": "its index cannot be sent",
    "bad_value": "its value does not fit into the parameter part of this link",
    "no_message": "the manual gives no message that writes it",
}


def refused(bus: Bus, point: Point, status: str, hint: str = "") -> RefusedError:
    """That no frame can be built which writes a point, and why."""
    hint = hint or (units_text(bus) if status == "bad_unit" else "")
    return RefusedError(status, f"{label(point)}: {_WHY.get(status, status)}", hint)
