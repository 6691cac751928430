"""What a crate of a USS drive says of its bus: tasks, lengths, numbers with names, which points travel how."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.identifiers import Identifier, Owner
from fieldscribe.targets.rust.families.numbers import code_names, constants
from fieldscribe.targets.rust.layout import array, binding
from fieldscribe.targets.rust.literals import type_name

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Bus, Device
    from fieldscribe.targets.rust.subjects import Scope, Subject


def uss_context(device: Device) -> dict[str, object]:
    """What the template of the family's items sees."""
    bus = device.bus
    return {
        "example_link": f"Link::new({max(bus.pkw)}, {bus.pzd[0]}), {bus.units[0]}",
        "exception_type": "u16",
        "exception_names": code_names(bus.exceptions),
        "profile": binding(0, "pub static PROFILE: Profile", _profile(bus)),
        "pkw": ", ".join(map(str, bus.pkw)),
        "tasks": array([f"Task::new({one.number}, &[{', '.join(map(str, one.answers))}])" for one in bus.functions]),
        "fixed": array([f"FixedBits::of::<points::{type_name(item)}>()" for item in _fixed(device)]),
        "numbers": (
            ("tasks", "Task ids.", constants(bus.functions, "u8")),
            ("responses", "Response ids.", constants(bus.responses, "u8")),
            (
                "exceptions",
                "Error values: why the drive refuses a task, as [`runtime::uss::ParseError::Refused`] has them.",
                constants(bus.exceptions, "u16", "error"),
            ),
        ),
    }


def _profile(bus: Bus) -> str:
    units, pzd = f"({bus.units[0]}, {bus.units[1]})", f"({bus.pzd[0]}, {bus.pzd[1]})"
    broadcast = "None" if bus.broadcast is None else f"Some({bus.broadcast})"
    naming = ".naming(exceptions::name)" if bus.exceptions else ""
    return f"Profile::new(TASKS, {units}, PKW, {pzd}, {broadcast}, FIXED){naming}"


def uss_traits(subject: Subject, scope: Scope) -> Iterator[str]:
    """A point is a parameter, or is sent, or is received in the process data."""
    point = subject.point
    if point.telegram is None:
        trait = "Parameter"
    else:
        telegram, _ = scope.telegrams[point.telegram]
        trait = "Sent" if telegram.direction == "request" else "Received"
    yield f"impl runtime::uss::{trait} {{}}"


def uss_identifiers(device: Device) -> Iterator[Identifier]:
    """The names of tasks and responses."""
    for module, codes in (("tasks", device.bus.functions), ("responses", device.bus.responses)):
        for code in codes:
            yield Identifier(f"Rust, {module}", code.name.upper(), Owner("code", code.name))


def _fixed(device: Device) -> Iterator[str]:
    """The points that are sent with bits that are always 1."""
    sent = {telegram.name for telegram in device.telegrams if telegram.direction == "request"}
    for point in device.points:
        if point.generated and point.telegram in sent and point.fixed is not None and point.fixed.bits:
            yield point.item
