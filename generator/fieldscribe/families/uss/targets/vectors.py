"""Vectors of USS telegrams: requests, broadcasts, good and bad responses, and the manual's own examples."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.uss import of_bus, of_frame
from fieldscribe.families.uss.telegrams import (
    DOUBLE_RESPONSES,
    LAST_PARAMETER,
    MASKS,
    READ_TASK,
    SHORT,
    TASK_WIDTHS,
    VARIABLE,
    Link,
    Request,
    broadcast,
    build,
    parameter_words,
    parse,
    part_of,
    request_in,
    telegram,
    write_task,
)
from fieldscribe.model import Bus, Device, Frame, Point
from fieldscribe.targets.vectors.exchanges import (
    Example,
    Script,
    Wire,
    of_other_lengths,
    single_bit_errors,
    with_flipped,
)
from fieldscribe.targets.vectors.lines import NO_BROADCAST, Lines

KINDS = {
    "uss_build": "status:word bytes:bytes? frame:note?",
    "uss_broadcast": "mask:ints words:ints? status:word bytes:bytes?",
    "uss_reply": "bytes:bytes? status:word response:int? width:int? value:int? error:int? words:ints? frame:note?",
}
"""The kinds of vectors for telegrams."""

_TELEGRAM_BYTES = 256
"""The longest telegram that the protocol allows."""


class UssWire(Wire):
    """Exchanges and telegrams of a device over a link; by default the longest that every variant accepts."""

    PREFIX = "uss_"

    def __init__(self, lines: Lines, device: Device, link: Link | None = None) -> None:
        super().__init__(lines, device, device.bus.units[0])
        facts = of_bus(device.bus)
        pkw = next((length for length in (VARIABLE, 4, SHORT) if length in facts.pkw), 0)
        self.link = link or Link(pkw, min(facts.pzd[1], *(most for _, most in facts.variant_pzd), 255))
        self.quiet = (0,) * self.link.pzd
        self.words = tuple(0x047F + 0x3333 * place & 0xFFFF for place in range(self.link.pzd))
        self.directions = {telegram.name: telegram.direction for telegram in device.telegrams}
        self.tasks = {code.number: code.answers for code in device.bus.functions}

    def opens(self) -> None:
        """Set the unit and the link."""
        super().opens()
        self._set_link()

    def _set_link(self) -> None:
        self.lines.set("link", self.link.pkw, self.link.pzd, 1 if self.link.single_first else None)

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
        status, data = self.build(Request(self.unit, 0, words=sent))
        return [(data, self.without_task(received))] if status == "ok" else None

    def without_task(self, words: tuple[int, ...]) -> bytes:
        """Return an answer with process data alone."""
        return telegram(self.unit, ((0,) * (SHORT if self.link.pkw == VARIABLE else self.link.pkw) + words))

    def _parameter(self, point: Point, task: int, words: tuple[int, ...], *, writes: bool) -> Script | None:
        """Return one task for a parameter; `words`, the high one first, are what it holds or is given."""
        number = words[0] << 16 | words[1] if len(words) == 2 else words[0]
        carried = (len(words), number) if writes else (0, 0)
        request = Request(self.unit, task, point.addresses[0], point.index or 0, *carried, self.quiet)
        status, data = self.build(request)
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

    def set_request(self, request: Request) -> None:
        """Set the task of the next vectors, and the link."""
        self._set_link()
        element = request.unit, request.task, request.parameter, request.index
        self.lines.set("task", *element, request.width, request.value, request.words)

    def build(self, request: Request) -> tuple[str, bytes]:
        """Return the status of a request and its bytes."""
        return build(self.bus, self.link, request)

    def parse(self, request: Request, answer: bytes) -> tuple[object, ...]:
        """Return a response, its status, its number, the width of its value, the value, the error, and the words."""
        reply = parse(self.bus, self.link, request, answer)
        parts: dict[str, tuple[object, ...]] = {
            "ok": (reply.response, reply.width, reply.value, 0, reply.words),
            "refused": (reply.response, 0, 0, reply.error, None),
        }
        return answer, reply.status, *parts.get(reply.status, (None,) * 5)

    def add_broadcast(self, mask: tuple[int, ...], words: tuple[int, ...]) -> None:
        """Add a telegram to all units."""
        self._set_link()
        self.lines.add("uss_broadcast", mask, words, *broadcast(self.bus, self.link, mask, words))

    def requests(self) -> Iterator[Request]:
        """Yield each task, then requests with extreme units, parameters, indices, values and process data."""
        (low, high), words = self.bus.units, self.words
        for code in self.bus.functions:
            width = TASK_WIDTHS.get(code.number, 0)
            yield Request(low, code.number, 700, 0, width, 5 if width else 0, words)
        base = Request(high, 1, 1082, 0, 0, 0, words)
        yield base
        numbers = (0, 1, 1999, 2000, 2010, 3999, 4000, 6000, 8000, 16000, 30000, LAST_PARAMETER, LAST_PARAMETER + 1)
        changes: list[dict[str, Any]] = [
            *({"unit": unit} for unit in (high + 1, max(0, low - 1), 255)),
            *(
                {"task": 16},
                {"task": 0, "parameter": 0},
                {"words": (*words, 1)},
                {"words": words[1:] if words else (1,)},
            ),
            *({"parameter": number} for number in numbers),
            *({"parameter": 2010, "index": index} for index in (1, 2, 254, 255, 256)),
            *({"task": 2, "width": 1, "value": value} for value in (0xFFFF, 0x10000)),
            {"task": 2, "width": 1, "value": 0x8001, "index": 3, "parameter": 2016},
            *({"task": 3, "width": 2, "value": value} for value in (0x42200000, 0xFFFFFFFF, 0x100000000, 1)),
        ]
        yield from (replace(base, **changed) for changed in changes)

    def add_all_replies(self) -> None:
        """Add all responses to some tasks, the known ones to the others, and damaged ones to one task."""
        least, most = of_bus(self.bus).pzd
        if not least <= self.link.pzd <= most:
            return
        unit = self.bus.units[1]
        for task in [0] if self.link.pkw == 0 else sorted(self.tasks):
            request = Request(unit, task, 2010, 1)
            responses = range(16) if task in (0, 1, 2, 3, 6) else (*self.tasks[task], 7, 8)
            parts = (self._part(request, response) for response in responses)
            self.add_replies(request, [telegram(unit, (*part, *self.words)) for part in parts])
        request = Request(unit, 0 if self.link.pkw == 0 else 1, 1082, 0)
        self.add_replies(request, self._spoiled(request, 1 if self.link.pkw == SHORT else 2))

    def example(self, frame: Frame, answered: Example | None) -> Example | None:
        """Return the request that a printed part is or answers, and the telegram that answers it."""
        words, (least, _) = words_in(frame.corrected), of_bus(self.bus).pzd
        if frame.framing == "pzd":
            wire = self.over(len(words))
            answers = () if frame.direction == "request" else (wire.without_task(words),)
            return wire, Request(wire.unit, 0, words=words), answers
        if frame.framing != "pkw":
            return None
        if frame.direction != "request":
            if answered is None:
                return None
            return *answered[:2], (telegram(answered[1].unit, (*words, *answered[1].words)),)
        wire, part = self.over(least, of_frame(frame).pkw or VARIABLE), part_of(words)
        return None if part is None else (wire, request_in(wire.unit, part, wire.link, wire.words), ())

    def over(self, pzd: int, pkw: int | None = None) -> "UssWire":
        """Return the same over another link; by default with the last length of the parameter part."""
        lengths = of_bus(self.bus).pkw or (0,)
        return UssWire(self.lines, self.device, Link(lengths[-1] if pkw is None else pkw, pzd))

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
        yield from (good, good + good, *of_other_lengths(good), *single_bit_errors(good))
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


def wires(lines: Lines, device: Device) -> list[UssWire]:
    """Return the one way in which points travel."""
    return [UssWire(lines, device)]


def frames(lines: Lines, device: Device) -> None:
    """Add all vectors of the telegrams of a USS device."""
    usual, facts = UssWire(lines, device), of_bus(device.bus)
    usual.add_codes("constant", "task", device.bus.functions)
    usual.add_codes("constant", "response", facts.responses)
    usual.add_codes("code", "error", device.bus.exceptions)
    for wire in [UssWire(lines, device, link) for link in _links(device.bus)]:
        wire.add_builds(wire.requests())
        if wire.link.pkw in facts.pkw:
            for mask in ((6, 0xFFFF, 0, 0), (2, 0xFFFF, 0, 0), (6, 0x0401, 0, 0), (0xFFFF,) * 4):
                wire.add_broadcast(mask, wire.words)
            wire.add_broadcast((6, 0xFFFF, 0, 0), (*wire.words, 0))
            wire.add_all_replies()
    usual.add_examples()
    for words in [words_in(example.corrected) for example in device.frames if example.framing == "broadcast"]:
        usual.over(len(words) - MASKS).add_broadcast(words[:MASKS], words[MASKS:])


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


def limits(lines: Lines, bus: Bus) -> None:
    """Add the responses to each task, and the lengths of the parts."""
    facts = of_bus(bus)
    for index, code in enumerate(bus.functions):
        lines.add("function", index, code.number, None, None, sum(1 << answer for answer in set(code.answers)))
    lines.add_limits(functions=len(bus.functions), parameter_parts=len(facts.pkw))
    lines.add_limits(broadcast=NO_BROADCAST if bus.broadcast is None else bus.broadcast, no_broadcast=NO_BROADCAST)
    lines.add_limits(telegram_bytes=_TELEGRAM_BYTES, last_parameter=LAST_PARAMETER)
    lines.add_limits(least_process_words=facts.pzd[0], most_process_words=facts.pzd[1])
