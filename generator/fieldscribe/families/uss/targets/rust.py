"""USS in generated Rust: tasks, lengths, named codes, and how each point travels."""

from collections.abc import Iterator

from fieldscribe.families.uss import of_bus
from fieldscribe.model import Bus, Device
from fieldscribe.targets.identifiers import Names, Owner
from fieldscribe.targets.rust.conformance import change_of, of_all, of_scale
from fieldscribe.targets.rust.layout import Item, array, binding
from fieldscribe.targets.rust.literals import type_name
from fieldscribe.targets.rust.scope import CratePoint, CrateScope, RustFamily, Way, code_names, constants

_ERRORS_DOC = "Error values: why the drive refuses a task, as [`ReplyError::Refused`] has them."


def context(device: Device) -> dict[str, object]:
    """Return the names that the family's template uses."""
    bus, facts = device.bus, of_bus(device.bus)
    tasks = [f"Task::new({code.number}, &[{', '.join(map(str, code.answers))}])" for code in bus.functions]
    fixed = [f"FixedBits::of::<points::{type_name(item)}>()" for item in _fixed(device)]
    return {
        "example_link": f"Link::new({max(facts.pkw)}, {facts.pzd[0]}), {bus.units[0]}",
        "exception_type": "u16",
        "exception_names": code_names(bus.exceptions),
        "profile": binding(0, Item("pub const PROFILE", "Profile"), _profile(bus)),
        "pkw": ", ".join(map(str, facts.pkw)),
        "tasks": array(Item("const TASKS", "&[Task]"), tasks),
        "fixed": array(Item("const FIXED", "&[FixedBits]"), fixed),
        "numbers": (
            ("tasks", "Task ids.", constants(bus.functions, "u8")),
            ("responses", "Response ids.", constants(facts.responses, "u8")),
            ("exceptions", _ERRORS_DOC, constants(bus.exceptions, "u16", "error")),
        ),
    }


def _profile(bus: Bus) -> str:
    units, pzd = f"({bus.units[0]}, {bus.units[1]})", f"({of_bus(bus).pzd[0]}, {of_bus(bus).pzd[1]})"
    broadcast = "None" if bus.broadcast is None else f"Some({bus.broadcast})"
    naming = ".naming(exceptions::name)" if bus.exceptions else ""
    return f"Profile::new(TASKS, {units}, PKW, {pzd}, {broadcast}, FIXED){naming}"


def _fixed(device: Device) -> Iterator[str]:
    """Yield the points that are sent with bits that are always 1."""
    sent = {telegram.name for telegram in device.telegrams if telegram.direction == "request"}
    for point in device.points:
        if point.generated and point.telegram in sent and point.fixed is not None and point.fixed.bits:
            yield point.item


def traits(subject: CratePoint, scope: CrateScope) -> Iterator[str]:
    """Yield the trait of a point: it is a parameter, or sent or received in the process data."""
    telegram = subject.point.telegram
    trait = "Parameter"
    if telegram is not None:
        trait = "Sent" if scope.telegrams[telegram][0].direction == "request" else "Received"
    yield f"impl runtime::uss::{trait} {{}}"


def identifiers(device: Device) -> Iterator[Names]:
    """Yield the names of tasks and responses."""
    for kind, module, codes in (
        ("function", "tasks", device.bus.functions),
        ("response", "responses", of_bus(device.bus).responses),
    ):
        for code in codes:
            yield Names(f"Rust, module `{module}`", Owner(kind, code.name), (code.name.upper(),))


def ways(subject: CratePoint, scope: CrateScope) -> Iterator[Way]:
    """Yield the ways of a point: process data travel in one direction; parameters also go into the EEPROM."""
    point = subject.point
    if point.telegram is None:
        if point.writable and point.keeps != "no":
            yield "store", *change_of(subject, "store", "store_update")
        return
    if point.form == "text" or point.bits:
        return
    direction = scope.telegrams[point.telegram][0].direction
    if direction == "response" and point.readable:
        yield "read", "receive", (of_scale(subject),)
    elif direction == "request" and point.writable:
        needs = (of_scale(subject), of_all(subject))
        yield ("write", "send", needs) if point.readable else ("write", "send_only", ())


IN_RUST = RustFamily(
    context,
    traits,
    identifiers,
    ways,
    names=("Link",),
    transports=("std", "embedded-io", "embedded-io-async"),
    line=lambda _: 'TcpLine::speaking(Protocol::Uss, "192.168.0.20:4001")',
    line_names="{tcp::TcpLine, Protocol}",
)
