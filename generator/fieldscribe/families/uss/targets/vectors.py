"""Vectors of USS telegrams: requests, broadcasts, answers good and bad, and the manual's own examples."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from fieldscribe.families.uss import of_bus, of_frame
from fieldscribe.families.uss.parts import DOUBLE_RESPONSES, VARIABLE, Link, parameter_words
from fieldscribe.families.uss.telegrams import LAST_PARAMETER, START, Request, broadcast, build, parse, telegram
from fieldscribe.targets.vectors.family_vectors import NO_BROADCAST, add_codes, add_limits

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Bus, Device, Frame, Point
    from fieldscribe.targets.vectors.family_vectors import Script
    from fieldscribe.targets.vectors.lines import Lines

KINDS = {
    "uss_build": "status:word bytes:bytes?",
    "uss_broadcast": "mask:ints words:ints? status:word bytes:bytes?",
    "uss_reply": "bytes:bytes? status:word response:int? width:int? value:int? error:int? words:ints?",
    "uss_printed_build": "frame:note status:word bytes:bytes?",
    "uss_printed_reply": "frame:note bytes:bytes? status:word response:int? width:int? value:int? error:int? "
    "words:ints?",
}
"""The kinds of vectors for telegrams."""

_TASK_WIDTHS = {2: 1, 3: 2, 7: 1, 8: 2, 11: 2, 12: 1, 13: 2, 14: 1}
"""How many words of value the tasks that change something carry."""


_RAM = {(1, False): 2, (2, False): 3, (1, True): 7, (2, True): 8}
_EEPROM = {(1, False): 14, (2, False): 13, (1, True): 12, (2, True): 11}
"""The tasks that write a parameter into the EEPROM, by its words and whether it is an array."""


class UssWire:
    """Exchanges over the longest link that every variant accepts."""

    def __init__(self, device: Device) -> None:
        self.bus = device.bus
        self.unit = device.bus.units[0]
        pkw = next((length for length in (VARIABLE, 4, 3) if length in of_bus(device.bus).pkw), 0)
        self.link = Link(
            pkw, min(of_bus(device.bus).pzd[1], *(most for _, most in of_bus(device.bus).variant_pzd), 255)
        )
        self.directions = {telegram.name: telegram.direction for telegram in device.telegrams}
        self.tasks = {code.number: code.answers for code in device.bus.functions}

    def opens(self, lines: Lines) -> None:
        """The unit and the link."""
        lines.set("unit", self.unit)
        lines.set("link", self.link.pkw, self.link.pzd)

    def reads(self, point: Point, words: tuple[int, ...]) -> Script | None:
        """A parameter by its task; a word of process data from an answer without a task."""
        if point.text is not None or len(words) > 2:
            return None
        if point.telegram is None:
            return self._change(point, 1, words, len(words), asks=True)
        if self.directions.get(point.telegram) != "response" or max(point.addresses) >= self.link.pzd:
            return None
        return self._process((0,) * self.link.pzd, self._placed(point, words))

    def writes(self, point: Point, words: tuple[int, ...], *, keep: bool) -> Script | None:
        """A parameter by its task for RAM or EEPROM; a word of process data in a telegram without a task."""
        if point.text is not None or len(words) > 2:
            return None
        if point.telegram is None:
            tasks = _EEPROM if keep else _RAM
            if keep and point.keeps == "no":
                return None
            return self._change(point, tasks[len(words), point.index is not None], words, 0, asks=False)
        if keep or self.directions.get(point.telegram) != "request" or max(point.addresses) >= self.link.pzd:
            return None
        return self._process(self._placed(point, words), (0,) * self.link.pzd)

    def _placed(self, point: Point, words: tuple[int, ...]) -> tuple[int, ...]:
        placed = dict(zip(sorted(point.addresses), words, strict=True))
        return tuple(placed.get(at, 0) for at in range(self.link.pzd))

    def _process(self, sent: tuple[int, ...], heard: tuple[int, ...]) -> Script | None:
        status, data = build(self.bus, self.link, Request(self.unit, 0, words=sent))
        empty = (0,) * (3 if self.link.pkw == VARIABLE else self.link.pkw)
        return [(data, telegram(self.unit, (*empty, *heard)))] if status == "ok" else None

    def _change(self, point: Point, task: int, words: tuple[int, ...], width: int, *, asks: bool) -> Script | None:
        """One task for a parameter; `words` with the high one first are what it holds or is given."""
        number = 0
        for word in words:
            number = number << 16 | word
        quiet = (0,) * self.link.pzd
        carried = (0, 0) if asks else (len(words), number)
        request = Request(self.unit, task, point.addresses[0], point.index or 0, *carried, quiet)
        status, data = build(self.bus, self.link, request)
        answers = self.tasks.get(task, ())
        double = [answer for answer in answers if (answer in DOUBLE_RESPONSES) == (len(words) == 2)]
        if status != "ok" or not double or (len(words) == 2 and self.link.pkw == 3):
            return None
        head = parameter_words(double[0], request.parameter, request.index)
        part = list(head) + (list(words) if len(words) == 2 else [words[0]])
        if self.link.pkw == 4 and len(words) == 1:
            part = [*head, 0, words[0]]
        return [(data, telegram(self.unit, (*part, *quiet)))]

    def spoils(self, point: Point, script: Script, *, writes: bool) -> Iterator[tuple[str, Script]]:
        """The exchange with a refusal, a wrong check byte, another unit, and a cut telegram."""
        del writes
        [(sent, good)] = script
        if point.telegram is not None:
            return
        words = [int.from_bytes(good[at : at + 2], "big") for at in range(3, len(good) - 1, 2)]
        refused = telegram(self.unit, (words[0] & 0x0FFF | 0x7000, words[1], 17, *words[-self.link.pzd :]))
        if self.link.pkw == 4:
            refused = telegram(self.unit, (words[0] & 0x0FFF | 0x7000, words[1], 0, 17, *words[4:]))
        yield "refused", [(sent, refused)]
        yield "wrong_check", [(sent, good[:-1] + bytes((good[-1] ^ 1,)))]
        yield "wrong_unit", [(sent, telegram(self.unit ^ 1, tuple(words)))]
        yield "wrong_length", [(sent, good[:-1])]
        yield "wrong_start", [(sent, bytes((START ^ 1,)) + good[1:])]


def wires(device: Device) -> list[UssWire]:
    """The one way in which points travel."""
    return [UssWire(device)]


def frames(lines: Lines, device: Device) -> None:
    """All vectors for the telegrams of a USS device."""
    add_codes(lines, "constant", "task", device.bus.functions)
    add_codes(lines, "constant", "response", of_bus(device.bus).responses)
    add_codes(lines, "code", "error", device.bus.exceptions)
    for link in _links(device.bus):
        dialogue = _Dialogue(lines, device.bus, link)
        _builds(dialogue)
        _broadcasts(dialogue)
        _replies(dialogue)
        lines.gather()
    _printed(lines, device)


class _Dialogue:
    """Writes vectors for telegrams over one link."""

    def __init__(self, lines: Lines, bus: Bus, link: Link) -> None:
        self.lines, self.bus, self.link = lines, bus, link
        self.words = tuple(0x047F + 0x3333 * place & 0xFFFF for place in range(link.pzd))

    def _ask(self, request: Request) -> None:
        self._on_link()
        asked = request.unit, request.task, request.parameter, request.index
        self.lines.set("task", *asked, request.width, request.value, request.words)

    def _on_link(self) -> None:
        self.lines.set("link", self.link.pkw, self.link.pzd, 1 if self.link.single_first else None)

    def built(self, request: Request, frame: str | None = None) -> None:
        """The bytes of a request; `frame` names the manual's example that it is."""
        kind, lead = _kind("build", frame)
        self._ask(request)
        self.lines.add(kind, *lead, *build(self.bus, self.link, request))

    def answered(self, request: Request, data: bytes, frame: str | None = None) -> None:
        """The result of reading bytes as the answer to a request."""
        reply = parse(self.bus, self.link, request, data)
        kind, lead = _kind("reply", frame)
        self._ask(request)
        parts: dict[str, tuple[object, ...]] = {"ok": (reply.response, reply.width, reply.value, 0, reply.words)}
        parts["refused"] = (reply.response, 0, 0, reply.error)
        self.lines.add(kind, *lead, data, reply.status, *parts.get(reply.status, ()))

    def sent(self, mask: tuple[int, ...], words: tuple[int, ...]) -> None:
        """A telegram to all units."""
        self._on_link()
        self.lines.add("uss_broadcast", mask, words, *broadcast(self.bus, self.link, mask, words))

    def parameter_part(self, request: Request, response: int) -> tuple[int, ...]:
        """The parameter part of an answer, with recognisable values; a variable one only as long as needed."""
        if self.link.pkw == 0:
            return ()
        number, index = parameter_words(response, request.parameter, request.index)
        size = self.link.pkw if self.link.pkw != VARIABLE else 4 if response in DOUBLE_RESPONSES else 3
        return (number, index, 0x4248, 0x0006)[:size]


def _kind(what: str, frame: str | None) -> tuple[str, tuple[str, ...]]:
    return (f"uss_{what}", ()) if frame is None else (f"uss_printed_{what}", (frame,))


def _links(bus: Bus) -> Iterator[Link]:
    """Links to test: every length of the parameter part, and the least and most words of process data."""
    least, most = of_bus(bus).pzd
    usual = min(max(2, least), most)
    for pkw in of_bus(bus).pkw:
        yield Link(pkw, usual)
        if pkw == 4:
            yield Link(pkw, usual, single_first=True)
    for pzd in dict.fromkeys((least, most, most + 1)):
        if pzd != usual:
            yield Link(of_bus(bus).pkw[-1], pzd)
    if 0 in of_bus(bus).pkw and least == 0:
        yield Link(0, 0)
    yield Link(5, usual)


def _requests(bus: Bus, words: tuple[int, ...]) -> Iterator[Request]:
    low, high = bus.units
    for code in bus.functions:
        width = _TASK_WIDTHS.get(code.number, 0)
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


def _builds(dialogue: _Dialogue) -> None:
    for request in dict.fromkeys(_requests(dialogue.bus, dialogue.words)):
        dialogue.built(request)


def _broadcasts(dialogue: _Dialogue) -> None:
    if dialogue.link.pkw not in of_bus(dialogue.bus).pkw:
        return
    for mask in ((6, 0xFFFF, 0, 0), (2, 0xFFFF, 0, 0), (6, 0x0401, 0, 0), (0xFFFF,) * 4):
        dialogue.sent(mask, dialogue.words)
    dialogue.sent((6, 0xFFFF, 0, 0), (*dialogue.words, 0))


def _replies(dialogue: _Dialogue) -> None:
    bus, link, words = dialogue.bus, dialogue.link, dialogue.words
    if link.pkw not in of_bus(bus).pkw or not of_bus(bus).pzd[0] <= link.pzd <= of_bus(bus).pzd[1]:
        return
    unit = bus.units[1]
    tasks = [0] if link.pkw == 0 else sorted(code.number for code in bus.functions)
    for task in tasks:
        request = Request(unit, task, 2010, 1)
        responses = range(16) if task in (0, 1, 2, 3, 6) else (*_answers(bus, task), 7, 8)
        parts = dict.fromkeys(dialogue.parameter_part(request, response) for response in responses)
        for part in parts:
            dialogue.answered(request, telegram(unit, (*part, *words)))
    request = Request(unit, 0 if link.pkw == 0 else 1, 1082, 0)
    response = 1 if link.pkw == 3 else 2
    for data in dict.fromkeys(_spoiled(dialogue, request, response)):
        dialogue.answered(request, data)


def _answers(bus: Bus, task: int) -> tuple[int, ...]:
    return next(code.answers for code in bus.functions if code.number == task)


def _spoiled(dialogue: _Dialogue, request: Request, response: int) -> Iterator[bytes]:
    """Cut, too long, with other marks, with every single bit turned, and whole telegrams that answer something else."""
    unit, words = request.unit, (*dialogue.parameter_part(request, response), *dialogue.words)
    good = telegram(unit, words)
    yield b""
    yield from (good[:length] for length in range(1, len(good)))
    yield from (good, good + b"\x00", good + good, bytes((START ^ 1,)) + good[1:])
    for bit in range(8 * len(good)):
        data = bytearray(good)
        data[bit >> 3] ^= 1 << (bit & 7)
        yield bytes(data)
    yield telegram(unit ^ 1, words)
    yield telegram(unit, (*words, 0))
    yield telegram(unit, words[1:])
    yield telegram(unit, ())
    if dialogue.link.pkw:
        yield telegram(unit, (words[0] ^ 0x0800, *words[1:]))
        yield telegram(unit, (words[0] ^ 1, *words[1:]))
        yield telegram(unit, (words[0], words[1] ^ 0x8000, *words[2:]))
        yield telegram(unit, (words[0], words[1] ^ 1, *words[2:]))
        yield telegram(unit, (0x7000 | words[0] & 0x0FFF, words[1], 17, *words[3:]))
        yield telegram(unit, (0x2000 | words[0] & 0x0FFF, *words[1:3], *dialogue.words))
        yield telegram(unit, (*words[:2], *dialogue.words))


def _printed(lines: Lines, device: Device) -> None:
    """The manual's examples, each in a whole telegram: parameter parts, process data, masks for all units."""
    asked: dict[str, tuple[_Dialogue, Request]] = {}
    bus, unit = device.bus, device.bus.units[0]
    for frame in device.frames:
        words = _frame_words(frame)
        if frame.framing == "pkw" and frame.direction == "request":
            dialogue = _Dialogue(lines, bus, Link(of_frame(frame).pkw or VARIABLE, of_bus(bus).pzd[0]))
            request = replace(_request_of(unit, words, dialogue.link), words=dialogue.words)
            asked[frame.name] = (dialogue, request)
            dialogue.built(request, frame.name)
        elif frame.framing == "pkw" and frame.answers in asked:
            dialogue, request = asked[frame.answers]
            dialogue.answered(request, telegram(unit, (*words, *dialogue.words)), frame.name)
        elif frame.framing == "pzd":
            _printed_words(_Dialogue(lines, bus, Link(of_bus(bus).pkw[-1], len(words))), frame, words)
        elif frame.framing == "broadcast":
            _Dialogue(lines, bus, Link(of_bus(bus).pkw[-1], len(words) - 4)).sent(words[:4], words[4:])


def _printed_words(dialogue: _Dialogue, frame: Frame, words: tuple[int, ...]) -> None:
    """An example with process data only: sent without a task, or received without an answer."""
    request = Request(dialogue.bus.units[0], 0, words=words)
    if frame.direction == "request":
        dialogue.built(request, frame.name)
    else:
        empty = (0,) * (3 if dialogue.link.pkw == VARIABLE else dialogue.link.pkw)
        dialogue.answered(request, telegram(request.unit, (*empty, *words)), frame.name)


def _frame_words(frame: Frame) -> tuple[int, ...]:
    data = frame.corrected
    return tuple(int.from_bytes(data[at : at + 2], "big") for at in range(0, len(data) - 1, 2))


def _request_of(unit: int, words: tuple[int, ...], link: Link) -> Request:
    """The request in the words of a parameter part."""
    number, pages = words[0], words[1]
    page = sum((pages >> place & 1) << bit for bit, place in enumerate((15, 12, 13, 14)))
    task, parameter = number >> 12, (number & 0x07FF) + 2000 * page
    first, second = (*words[2:], 0, 0)[:2]
    width = _TASK_WIDTHS.get(task, 0)
    value = (0, second if link.single_last else first, first << 16 | second)[width]
    return Request(unit, task, parameter, pages & 0xFF, width, value)


def limits(lines: Lines, bus: Bus) -> None:
    """The responses to each task, and the lengths of the parts."""
    own = of_bus(bus)
    for index, code in enumerate(bus.functions):
        lines.add("function", index, code.number, None, None, sum(1 << answer for answer in set(code.answers)))
    add_limits(lines, functions=len(bus.functions), parameter_parts=len(own.pkw))
    add_limits(lines, broadcast=NO_BROADCAST if bus.broadcast is None else bus.broadcast, no_broadcast=NO_BROADCAST)
    add_limits(lines, telegram_bytes=_TELEGRAM_BYTES, last_parameter=LAST_PARAMETER)
    add_limits(lines, least_process_words=own.pzd[0], most_process_words=own.pzd[1])


_TELEGRAM_BYTES = 256
"""The longest telegram that the protocol allows."""
