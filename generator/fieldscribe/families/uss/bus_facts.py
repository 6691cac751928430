"""The facts of a bus and of frames that only this family has, and the tasks that read or write a point."""

from collections.abc import Iterator

from fieldscribe.facts.schema import INTEGER, list_of, map_of, null_or
from fieldscribe.facts.table import BEHAVIOUR, DOCS, WIRE, Fact, family_facts
from fieldscribe.families.uss import UssBus, UssFrame, of_bus
from fieldscribe.families.uss.telegrams import (
    EEPROM_TASKS,
    READ_TASK,
    RESPONSE_WIDTHS,
    TASK_WIDTHS,
    VARIABLE,
    write_task,
)
from fieldscribe.model import Bus, Point
from fieldscribe.wording.numbers import hex_text

LIMITS = family_facts(
    UssBus,
    Fact("pkw", "USS: the lengths in words that the parameter part may have; 127 is variable.", list_of(INTEGER), WIRE),
    Fact("pzd", "USS: the least and the most words of process data.", list_of(INTEGER, 2, 2), WIRE),
    Fact(
        "variant_pzd",
        "USS: the most words of process data of variants that take fewer, by axis=value.",
        map_of(INTEGER),
        BEHAVIOUR,
        value=lambda bus, _: {str(variant): most for variant, most in bus.variant_pzd},
    ),
    Fact("bitrate", "CAN and USS: bits a second.", null_or(INTEGER), WIRE),
)
"""The facts of a bus that only this family has."""

_PKW = "The words of the parameter part of a USS telegram, as set for the link."
FRAME = family_facts(UssFrame, Fact("pkw", _PKW, null_or(INTEGER), DOCS))
"""The same for worked examples."""


def tasks(bus: Bus, point: Point) -> tuple[tuple[str, int], ...]:
    """Return the tasks of a parameter: to `read` it, to change it in the `ram`, and to `write` it permanently."""
    if not point.addresses or point.telegram is not None:
        return ()
    known = {code.number for code in bus.functions}
    array = point.index is not None
    ways = [("read", READ_TASK)] if point.readable else []
    if point.writable:
        ways += [("ram", write_task(point.words, array=array, keep=False))] if point.keeps != "yes" else []
        ways += [("write", write_task(point.words, array=array, keep=True))] if point.keeps != "no" else []
    return tuple((purpose, task) for purpose, task in ways if task in known)


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """Yield label and text of each fact about the line."""
    details = of_bus(bus)
    yield "Unit numbers", "{}..{}".format(*bus.units)
    if bus.broadcast is not None:
        yield "Broadcast", f"address byte {hex_text(bus.broadcast, 2)}, not answered"
    lengths = (f"variable ({VARIABLE})" if length == VARIABLE else str(length) for length in details.pkw)
    yield "Words of the parameter part (PKW)", (", ".join(lengths))
    yield "Words of process data (PZD)", "{}..{}".format(*details.pzd)


PROTOCOL: dict[str, object] = {
    "tasks": dict(sorted(TASK_WIDTHS.items())),
    "eeprom": sorted(EEPROM_TASKS),
    "responses": RESPONSE_WIDTHS,
}
"""The words of value that tasks and responses carry, and the tasks that write to the EEPROM, too."""
