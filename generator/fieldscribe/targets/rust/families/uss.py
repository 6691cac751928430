"""What a crate of a USS drive says of its bus: tasks, lengths, numbers with names, which points travel how."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.documentation import sentence
from fieldscribe.targets.rust.layout import array, binding, short_array
from fieldscribe.targets.rust.literals import integer, mask

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Code, Device
    from fieldscribe.targets.rust.subjects import Scope, Subject

Constant = tuple[str, tuple[str, ...]]
"""What a doc comment says of a constant, and its lines."""


def uss_context(device: Device) -> dict[str, object]:
    """What the template of the family's items sees."""
    bus = device.bus
    return {
        "units": f"({bus.units[0]}, {bus.units[1]})",
        "pzd": f"({bus.pzd[0]}, {bus.pzd[1]})",
        "pkw": ", ".join(map(str, bus.pkw)),
        "broadcast": "None" if bus.broadcast is None else f"Some({bus.broadcast})",
        "tasks": array([f"Task::new({one.number}, &[{', '.join(map(str, one.answers))}])" for one in bus.functions]),
        "words_at_first": short_array(
            0, "const WORDS: &[u16]", [mask(word, "u16") for word in _words_at_first(device)]
        ),
        "numbers": (
            ("tasks", "Task ids.", "u8", _constants(bus.functions, "u8")),
            ("responses", "Response ids.", "u8", _constants(bus.responses, "u8")),
            ("exceptions", "Error values of a refusal.", "u16", _constants(bus.exceptions, "u16")),
        ),
    }


def uss_traits(subject: Subject, scope: Scope) -> Iterator[tuple[str, ...]]:
    """A point is a parameter, or is sent, or is received in the process data."""
    point = subject.point
    if point.telegram is None:
        trait = "Parameter"
    else:
        telegram, _ = scope.telegrams[point.telegram]
        trait = "Sent" if telegram.direction == "request" else "Received"
    yield (f"impl runtime::uss::{trait} for {subject.name} {{}}",)


def uss_identifiers(device: Device) -> Iterator[tuple[str, str, str]]:
    """The names of tasks and responses."""
    for module, codes in (("tasks", device.bus.functions), ("responses", device.bus.responses)):
        for code in codes:
            yield module, code.name.upper(), f"{module} {code.name}"


def _constants(codes: Iterable[Code], type_: str) -> tuple[Constant, ...]:
    return tuple(
        (sentence(one.name), binding(4, f"pub const {one.name.upper()}: {type_}", integer(one.number))) for one in codes
    )


def _words_at_first(device: Device) -> list[int]:
    """The fixed bits of the words that are sent, up to the last that has some."""
    sent = {telegram.name for telegram in device.telegrams if telegram.direction == "request"}
    words: dict[int, int] = {}
    for point in device.points:
        if point.telegram in sent and point.fixed is not None and point.fixed.bits and point.address is not None:
            words[point.address] = words.get(point.address, 0) | point.fixed.bits
    return [words.get(position, 0) for position in range(max(words, default=-1) + 1)]
