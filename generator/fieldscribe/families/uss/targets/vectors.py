"""Vectors of USS telegrams: requests, broadcasts, good and bad responses, and the manual's own examples."""

from collections.abc import Iterator
from dataclasses import replace

from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.uss import of_bus, of_frame
from fieldscribe.families.uss.parts import (
    DOUBLE_RESPONSES,
    READ_TASK,
    SHORT,
    TASK_WIDTHS,
    VARIABLE,
    Link,
    parameter_words,
    part_of,
    write_task,
)
from fieldscribe.families.uss.telegrams import (
    LAST_PARAMETER,
    START,
    Request,
    broadcast,
    build,
    parse,
    request_in,
    telegram,
)
from fieldscribe.model import Bus, Device, Point
from fieldscribe.targets.vectors.exchanges import Script, codes, single_bit_errors, with_flipped
from fieldscribe.targets.vectors.lines import NO_BROADCAST, Lines

_REPLY = "bytes:bytes? status:word response:int? width:int? value:int? error:int? words:ints?"
KINDS = {
    "uss_build": "status:word bytes:bytes?",
    "uss_broadcast": "mask:ints words:ints? status:word bytes:bytes?",
    "uss_reply": _REPLY,
    "uss_printed_build": "frame:note status:word bytes:bytes?",
    "uss_printed_reply": f"frame:note {_REPLY}",
}
"""The kinds of vectors for telegrams."""

_TELEGRAM_BYTES = 256
"""The longest telegram that the protocol allows."""


class UssWire:
    """Exchanges over the longest link that every variant accepts."""

    def __init__(self, device: Device) -> None:
        self.bus, self.unit = device.bus, device.bus.units[0]
        facts = of_bus(device.bus)
        pkw = next((length for length in (VARIABLE, 4, SHORT) if length in facts.pkw), 0)
        self.link = Link(pkw, min(facts.pzd[1], *(most for _, most in facts.variant_pzd), 255))
        self.quiet = (0,) * self.link.pzd
        self.directions = {telegram.name: telegram.direction for telegram in device.telegrams}
        self.tasks = {code.number: code.answers for code in device.bus.functions}

    def opens(self, lines: Lines) -> None:
        """Set the unit and the link."""
        lines.set("unit", self.unit)
        lines.set("link", self.link.pkw, self.link.pzd)

    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """Return a parameter read by its task, or a word of process data in a response without a task."""
        if point.text is not None or len(words) > 2:
            return None
        if point.telegram is None:
            return self._parameter(point, READ_TASK, words, writes=False)
        placed = self._placed(point, words, "response")
        return None if placed is None else self._process_data(self.quiet, placed)

    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """Return a parameter written by its task, or a word of process data in a request without a task."""
        if point.text is not None or len(words) > 2 or (keep and (point.telegram is not None or point.keeps == "no")):
            return None
        if point.telegram is None:
            task = write_task(len(words), array=point.index is not None, keep=keep)
            return self._parameter(point, task, words, writes=True)
        placed = self._placed(point, words, "request")
        return None if placed is None else self._process_data(placed, self.quiet)

    def _placed(self, point: Point, words: tuple[int, ...], direction: str) -> tuple[int, ...] | None:
        """Return process data with these words; None if they do not travel in this direction over the link."""
        if self.directions.get(point.telegram or "") != direction or max(point.addresses) >= self.link.pzd:
            return None
        placed = dict(zip(sorted(point.addresses), words, strict=True))
        return tuple(placed.get(at, 0) for at in range(self.link.pzd))

    def _process_data(self, sent: tuple[int, ...], received: tuple[int, ...]) -> Script | None:
        status, data = build(self.bus, self.link, Request(self.unit, 0, words=sent))
        return [(data, telegram(self.unit, (*_empty_part(self.link), *received)))] if status == "ok" else None

    def _parameter(self, point: Point, task: int, words: tuple[int, ...], *, writes: bool) -> Script | None:
        """Return one task for a parameter; `words`, the high one first, are what it holds or is given."""
        number = words[0] << 16 | words[1] if len(words) == 2 else words[0]
        carried = (len(words), number) if writes else (0, 0)
        request = Request(self.unit, task, point.addresses[0], point.index or 0, *carried, self.quiet)
        status, data = build(self.bus, self.link, request)
        fitting = (code for code in self.tasks.get(task, ()) if (code in DOUBLE_RESPONSES) == (len(words) == 2))
        response = next(fitting, None)
        if status != "ok" or response is None or (len(words) == 2 and self.link.pkw == SHORT):
            return None
        padding = (0,) if self.link.pkw == 4 and len(words) == 1 else ()
        head = parameter_words(response, request.parameter, request.index)
        return [(data, telegram(self.unit, (*head, *padding, *words, *self.quiet)))]

    def bad_answers(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """Yield the exchange with a refusal, a wrong check byte, another unit, and a cut telegram."""
        del writes
        [(sent, good)] = script
        if point.telegram is not None:
            return
        words = words_in(good[3:-1])
        head = words[0] & 0x0FFF | 0x7000, words[1]
        refusal = (*head, 0, 17, *words[4:]) if self.link.pkw == 4 else (*head, 17, *words[-self.link.pzd :])
        yield "refused", [(sent, telegram(self.unit, refusal))]
        yield "wrong_check", [(sent, with_flipped(good, len(good) - 1))]
        yield "wrong_unit", [(sent, telegram(self.unit ^ 1, words))]
        yield "wrong_length", [(sent, good[:-1])]
        yield "wrong_start", [(sent, with_flipped(good, 0))]


def wires(device: Device) -> list[UssWire]:
    """Return the one way in which points travel."""
    return [UssWire(device)]


def _empty_part(link: Link) -> tuple[int, ...]:
    return (0,) * (SHORT if link.pkw == VARIABLE else link.pkw)


def frames(lines: Lines, device: Device) -> None:
    """Add all vectors of the telegrams of a USS device."""
    codes(lines, "constant", "task", device.bus.functions)
    codes(lines, "constant", "response", of_bus(device.bus).responses)
    codes(lines, "code", "error", device.bus.exceptions)
    for link in _links(device.bus):
        dialogue = _Dialogue(lines, device.bus, link)
        for request in dict.fromkeys(_requests(device.bus, dialogue.words)):
            dialogue.built(request)
        if link.pkw in of_bus(device.bus).pkw:
            dialogue.broadcasts()
            dialogue.replies()
    _printed(lines, device)


def _links(bus: Bus) -> Iterator[Link]:
    """Yield the links to test: every length of the parameter part, the least and most words of process data."""
    lengths, (least, most) = of_bus(bus).pkw, of_bus(bus).pzd
    usual = min(max(2, least), most)
    for pkw in lengths:
        yield Link(pkw, usual)
        if pkw == 4:
            yield Link(pkw, usual, single_first=True)
    yield from (Link(lengths[-1], pzd) for pzd in dict.fromkeys((least, most, most + 1)) if pzd != usual)
    if 0 in lengths and least == 0:
        yield Link(0, 0)
    yield Link(5, usual)


def _requests(bus: Bus, words: tuple[int, ...]) -> Iterator[Request]:
    low, high = bus.units
    for code in bus.functions:
        width = TASK_WIDTHS.get(code.number, 0)
        yield Request(low, code.number, 700, 0, width, 5 if width else 0, words)
    base = Request(high, 1, 1082, 0, 0, 0, words)
    yield from (base, replace(base, unit=high + 1), replace(base, unit=max(0, low - 1)), replace(base, unit=255))
    yield from (replace(base, task=16), replace(base, task=0, parameter=0))
    for parameter in (0, 1, 1999, 2000, 2010, 3999, 4000, 6000, 8000, 16000, 30000, LAST_PARAMETER, LAST_PARAMETER + 1):
        yield replace(base, parameter=parameter)
    yield from (replace(base, parameter=2010, index=index) for index in (1, 2, 254, 255, 256))
    change = replace(base, task=2, width=1, value=0xFFFF)
    yield from (change, replace(change, value=0x10000), replace(change, value=0x8001, index=3, parameter=2016))
    double = replace(base, task=3, width=2, value=0x42200000)
    yield from (double, replace(double, value=0xFFFFFFFF), replace(double, value=0x100000000), replace(double, value=1))
    yield from (replace(base, words=(*words, 1)), replace(base, words=words[1:] if words else (1,)))


class _Dialogue:
    """Adds vectors of telegrams over one link."""

    def __init__(self, lines: Lines, bus: Bus, link: Link) -> None:
        self.lines, self.bus, self.link = lines, bus, link
        self.words = tuple(0x047F + 0x3333 * place & 0xFFFF for place in range(link.pzd))

    def _set_link(self) -> None:
        self.lines.set("link", self.link.pkw, self.link.pzd, 1 if self.link.single_first else None)

    def _add(self, what: str, request: Request, printed: str | None, *values: object) -> None:
        self._set_link()
        element = request.unit, request.task, request.parameter, request.index
        self.lines.set("task", *element, request.width, request.value, request.words)
        kind, name = (f"uss_{what}", ()) if printed is None else (f"uss_printed_{what}", (printed,))
        self.lines.add(kind, *name, *values)

    def built(self, request: Request, printed: str | None = None) -> None:
        """Add the bytes of a request; `printed` names the manual's example that it is."""
        self._add("build", request, printed, *build(self.bus, self.link, request))

    def answered(self, request: Request, data: bytes, printed: str | None = None) -> None:
        """Add the result of reading bytes as the response to a request."""
        reply = parse(self.bus, self.link, request, data)
        parts: dict[str, tuple[object, ...]] = {
            "ok": (reply.response, reply.width, reply.value, 0, reply.words),
            "refused": (reply.response, 0, 0, reply.error),
        }
        self._add("reply", request, printed, data, reply.status, *parts.get(reply.status, ()))

    def sent(self, mask: tuple[int, ...], words: tuple[int, ...]) -> None:
        """Add a telegram to all units."""
        self._set_link()
        self.lines.add("uss_broadcast", mask, words, *broadcast(self.bus, self.link, mask, words))

    def broadcasts(self) -> None:
        """Add broadcasts with several masks, and one with a word too many."""
        for mask in ((6, 0xFFFF, 0, 0), (2, 0xFFFF, 0, 0), (6, 0x0401, 0, 0), (0xFFFF,) * 4):
            self.sent(mask, self.words)
        self.sent((6, 0xFFFF, 0, 0), (*self.words, 0))

    def replies(self) -> None:
        """Add all responses to some tasks, the known ones to the others, and damaged ones to one task."""
        if not of_bus(self.bus).pzd[0] <= self.link.pzd <= of_bus(self.bus).pzd[1]:
            return
        unit, answers = self.bus.units[1], {code.number: code.answers for code in self.bus.functions}
        for task in [0] if self.link.pkw == 0 else sorted(answers):
            request = Request(unit, task, 2010, 1)
            responses = range(16) if task in (0, 1, 2, 3, 6) else (*answers[task], 7, 8)
            for part in dict.fromkeys(self._part(request, response) for response in responses):
                self.answered(request, telegram(unit, (*part, *self.words)))
        request = Request(unit, 0 if self.link.pkw == 0 else 1, 1082, 0)
        for data in dict.fromkeys(self._spoiled(request, 1 if self.link.pkw == SHORT else 2)):
            self.answered(request, data)

    def _part(self, request: Request, response: int) -> tuple[int, ...]:
        """Return the parameter part of a response, with recognisable values; a variable part is short."""
        if self.link.pkw == 0:
            return ()
        head = parameter_words(response, request.parameter, request.index)
        size = self.link.pkw if self.link.pkw != VARIABLE else 4 if response in DOUBLE_RESPONSES else SHORT
        return (*head, 0x4248, 0x0006)[:size]

    def _spoiled(self, request: Request, response: int) -> Iterator[bytes]:
        """Yield telegrams that are cut, too long, with another start, with a wrong bit, or answer something else."""
        unit, words = request.unit, (*self._part(request, response), *self.words)
        good = telegram(unit, words)
        yield from (good[:length] for length in range(len(good)))
        yield from (good, good + b"\x00", good + good, bytes((START ^ 1,)) + good[1:])
        yield from single_bit_errors(good)
        yield telegram(unit ^ 1, words)
        yield from (telegram(unit, others) for others in ((*words, 0), words[1:], ()))
        if self.link.pkw:
            yield telegram(unit, (words[0] ^ 0x0800, *words[1:]))
            yield telegram(unit, (words[0] ^ 1, *words[1:]))
            yield telegram(unit, (words[0], words[1] ^ 0x8000, *words[2:]))
            yield telegram(unit, (words[0], words[1] ^ 1, *words[2:]))
            yield telegram(unit, (0x7000 | words[0] & 0x0FFF, words[1], 17, *words[3:]))
            yield telegram(unit, (0x2000 | words[0] & 0x0FFF, *words[1:3], *self.words))
            yield telegram(unit, (*words[:2], *self.words))


def _printed(lines: Lines, device: Device) -> None:
    """Add the manual's examples, each in a whole telegram: parameter parts, process data, masks for all units."""
    requests: dict[str, tuple[_Dialogue, Request]] = {}
    bus, unit = device.bus, device.bus.units[0]
    longest, (least, _) = of_bus(bus).pkw[-1] if of_bus(bus).pkw else 0, of_bus(bus).pzd
    for frame in device.frames:
        words = words_in(frame.corrected)
        if frame.framing == "pkw" and frame.direction == "request":
            dialogue = _Dialogue(lines, bus, Link(of_frame(frame).pkw or VARIABLE, least))
            part = part_of(words)
            if part is not None:
                requests[frame.name] = dialogue, request_in(unit, part, dialogue.link, dialogue.words)
                dialogue.built(requests[frame.name][1], frame.name)
        elif frame.framing == "pkw" and frame.answers in requests:
            dialogue, request = requests[frame.answers]
            dialogue.answered(request, telegram(unit, (*words, *dialogue.words)), frame.name)
        elif frame.framing == "pzd":
            dialogue, request = _Dialogue(lines, bus, Link(longest, len(words))), Request(unit, 0, words=words)
            if frame.direction == "request":
                dialogue.built(request, frame.name)
            else:
                dialogue.answered(request, telegram(unit, (*_empty_part(dialogue.link), *words)), frame.name)
        elif frame.framing == "broadcast":
            _Dialogue(lines, bus, Link(longest, len(words) - 4)).sent(words[:4], words[4:])


def limits(lines: Lines, bus: Bus) -> None:
    """Add the responses to each task, and the lengths of the parts."""
    facts = of_bus(bus)
    for index, code in enumerate(bus.functions):
        lines.add("function", index, code.number, None, None, sum(1 << answer for answer in set(code.answers)))
    lines.add_limits(functions=len(bus.functions), parameter_parts=len(facts.pkw))
    lines.add_limits(broadcast=NO_BROADCAST if bus.broadcast is None else bus.broadcast, no_broadcast=NO_BROADCAST)
    lines.add_limits(telegram_bytes=_TELEGRAM_BYTES, last_parameter=LAST_PARAMETER)
    lines.add_limits(least_process_words=facts.pzd[0], most_process_words=facts.pzd[1])
