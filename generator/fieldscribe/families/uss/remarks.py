"""Sentences about USS telegrams: names of tasks and responses, faults, findings and notes."""

from collections.abc import Iterable, Iterator, Mapping

from fieldscribe.families.uss.telegrams import (
    EEPROM_TASKS,
    LEAST_BYTES,
    START,
    TASK_WIDTHS,
    VARIABLE,
    Link,
    Part,
    Unwrapped,
    check_byte,
)
from fieldscribe.model import Code, Device
from fieldscribe.text import counted, line
from fieldscribe.wording.numbers import check_text, numbered, strange_unit, too_short

NO_REQUEST = "read as a request, for there was none before it; --direction response reads it as a response"
PARTS = "the words of the parameter part alone are read with --framing pkw, process data with --framing pzd"
FROM_MASTER = "read as words from the master; --direction response reads those of the device"
_FLAWS: Mapping[str, str] = {
    "no_words": "the part is made of words of two bytes, here {are} {size}",
    "wrong_start": "a telegram begins with {start:02X}h, this with {data[0]:02X}h",
    "no_check": "the check byte is missing",
    "wrong_length": "its length byte says {length} bytes, here are {count}",
    "wrong_check": "the check byte is wrong",
    "odd": "its data is no whole number of words",
}


def flaw_texts(unwrapped: Unwrapped) -> Iterator[str]:
    """Yield what is wrong with the bytes of a telegram, or of a single part."""
    data = unwrapped.data
    count, are = len(data), "is" if len(data) == 1 else "are"
    length = data[1] + 2 if count > 1 else 0
    for flaw in unwrapped.flaws:
        if flaw == "short":
            yield too_short("a telegram", LEAST_BYTES, count)
        else:
            size = counted(count, "byte")
            yield _FLAWS[flaw].format(data=data, start=START, length=length, count=count, size=size, are=are)


def checks_text(unwrapped: Unwrapped) -> str:
    """Return whether the check byte of a telegram is right; empty if there is none to check."""
    if unwrapped.unit is None:
        return ""
    body = unwrapped.data if "no_check" in unwrapped.flaws else unwrapped.data[:-1]
    return check_text(unwrapped.data[len(body) :], bytes((check_byte(body),)))


def misfit_text(words: int, link: Link, *, request: bool) -> str:
    """Return the fault of a telegram whose number of words is not that of the link."""
    length, sizes = f"of {link.pkw}", f"{link.pkw + link.pzd}"
    if link.pkw == VARIABLE:
        length = "of variable length"
        sizes = f"{3 + link.pzd} or {4 + link.pzd}" if request else f"at least {3 + link.pzd}"
    parts = f"a parameter part {length} and {counted(link.pzd, 'word')} of process data"
    return f"it has {counted(words, 'word')}; {parts} make {sizes}"


def code_text(codes: tuple[Code, ...], number: int, kind: str) -> str:
    """Return a task, response or error with its name: `task 1 read_value`."""
    code = numbered(codes, number)
    return f"{kind} {number}" + (f" {code.name}" if code is not None else ", which the manual does not list")


def titled_code(codes: tuple[Code, ...], number: int, kind: str) -> str:
    """Return the same with its meaning in the manual: `error 17 busy: ...`."""
    code = numbered(codes, number)
    return line(code_text(codes, number, kind) + (f": {code.title['en']}" if code is not None else ""))


def words_printed(words: Iterable[int]) -> str:
    """Return words as the manuals of this family print them: `143A 0000 4248 0000`."""
    return " ".join(f"{word:04X}" for word in words)


def request_findings(device: Device, part: Part, unit: int | None) -> Iterator[str]:
    """Yield why the device refuses a request."""
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
    """Yield notes about a request."""
    here, there = (1, 0) if link.single_last else (0, 1)
    single = TASK_WIDTHS.get(part.code, 0) == 1 and len(part.values) > 1
    if single and part.values[there] and not part.values[here]:
        ordinal = ("first", "second")
        also = "; is --pkw 127 or --single-first meant?" if link.single_last else "; is --pkw 4 meant?"
        where = f"in the {ordinal[here]} value word, here the {ordinal[there]} is used"
        yield f"over this link a single word stands {where}{also}"
    if part.code in EEPROM_TASKS:
        yield "it writes to the EEPROM too, which wears the memory"


def error_findings(device: Device, error: int, task: int | None) -> Iterator[str]:
    """Yield a finding if this task cannot have this error."""
    code = numbered(device.bus.exceptions, error)
    if task is not None and code is not None and code.answers and task not in code.answers:
        yield f"the manual does not give error {error} for task {task}"


def error_notes(part: Part, link: Link) -> Iterator[str]:
    """Yield a note if the error may be in another word."""
    if link.single_last and len(part.values) > 1:
        yield (
            "the error value is taken from the first value word; over this link single words stand in the second, "
            f"which holds {part.values[1]}"
        )
