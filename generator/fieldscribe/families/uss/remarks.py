"""Sentences about USS telegrams for people: names of their numbers, findings and notes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.uss.recognition import KEEPING_TASKS, TASK_WIDTHS
from fieldscribe.text import line
from fieldscribe.wording.buses import numbered, strange_unit

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.families.uss.recognition import Part
    from fieldscribe.families.uss.telegrams import Link
    from fieldscribe.model import Code, Device


def code_text(codes: tuple[Code, ...], number: int, kind: str) -> str:
    """A task, response or error with its name: `task 1 read_value`."""
    code = numbered(codes, number)
    return f"{kind} {number}" + (f" {code.name}" if code is not None else ", which the manual does not list")


def error_text(device: Device, error: int) -> str:
    """The meaning of an error value, from the manual."""
    code = numbered(device.bus.exceptions, error)
    if code is None:
        return f"error {error}, which the manual does not list"
    return line(f"error {error} {code.name}: {code.title['en']}")


def request_findings(device: Device, part: Part, unit: int | None) -> Iterator[str]:
    """Why the device refuses a request."""
    if unit is not None and (strange := strange_unit(device.bus, unit)):
        yield strange
    code = numbered(device.bus.functions, part.code)
    if code is None:
        yield f"the device does not know task {part.code}"
    elif part.code and not code.answers:
        refusals = " or ".join(code_text(device.bus.codes("responses"), number, "response") for number in code.refusals)
        yield f"the device cannot do this task{f'; expect {refusals}' if refusals else ''}"
    if part.spontaneous:
        yield "bit 11 of the first word (SP) is set, it is always 0"
    if TASK_WIDTHS.get(part.code, 0) == 2 and len(part.values) < 2:
        yield "a double word does not fit into this parameter part"


def request_notes(part: Part, link: Link) -> Iterator[str]:
    """What to know about a request."""
    if TASK_WIDTHS.get(part.code, 0) == 1 and len(part.values) > 1:
        yield from _misplaced(part, link)
    if part.code in KEEPING_TASKS:
        yield "it writes to the EEPROM too, which wears the memory"


def _misplaced(part: Part, link: Link) -> Iterator[str]:
    here, there = (1, 0) if link.single_last else (0, 1)
    if part.values[there] and not part.values[here]:
        ordinal = ("first", "second")
        also = "; is --pkw 127 or --single-first meant?" if link.single_last else "; is --pkw 4 meant?"
        where = f"in the {ordinal[here]} value word, here the {ordinal[there]} is used"
        yield f"over this link a single word stands {where}{also}"


def error_findings(device: Device, part: Part, task: int | None) -> Iterator[str]:
    """The finding that this task cannot have this error."""
    error = part.values[0]
    code = numbered(device.bus.exceptions, error)
    if task is not None and code is not None and code.answers and task not in code.answers:
        yield f"the manual does not give error {error} for task {task}"


def error_notes(part: Part, link: Link) -> Iterator[str]:
    """The note that the error may stand in another word."""
    if link.single_last and len(part.values) > 1:
        yield (
            "the error value is taken from the first value word; over this link single words stand in the second, "
            f"which holds {part.values[1]}"
        )
