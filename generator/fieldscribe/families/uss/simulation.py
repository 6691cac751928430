"""The end of a USS line where devices answer: takes process data, carries out tasks, builds replies. No I/O."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from fieldscribe.arithmetic.words import split as words_of
from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.uss import of_bus, telegrams
from fieldscribe.families.uss.telegrams import LEAST_BYTES, Link, Part, sound_size, telegram
from fieldscribe.model import Point
from fieldscribe.simulation.device import OF_VALUES, Refusal, SimulatedDevice, by_unit
from fieldscribe.simulation.line import Answer, Core, cut_sound

LINES = {"serial": ("uss",), "tcp": ("uss",)}
_LONGEST = 257
_ALL = 255
"""The index that stands for all elements."""
_NUMBERS = 2000
"""The parameter numbers of a page."""
_NO_TASK, _NO_ANSWER = 0, 0
_READS = {telegrams.READ_TASK: False, telegrams.READ_ELEMENT_TASK: True}
_SIZE_TASK = 9
_ARRAY_TASKS = frozenset({telegrams.READ_ELEMENT_TASK, 7, 8, 11, 12})
_RESPONSES = {(1, False): 1, (2, False): 2, (1, True): 4, (2, True): 5}
"""The responses with values of so many words, of an element of an array or not."""
_WORDS: Mapping[str, tuple[str, ...]] = {
    "address": ("number", "address"),
    "absent": ("number", "address"),
    "read_only": ("not_changeable", "read_only"),
    "write_only": ("not_readable", "deactivated"),
    "out_of_range": ("limit",),
    "index": ("wrong_index", "index"),
    "no_array": ("no_array",),
    "part": ("data_type",),
    "condition": ("state",),
    "together": ("not_allowed", "state"),
    "too_long": ("too_long",),
    "task": ("not_implemented",),
}
"""The words that name the error for each kind of refusal; all others are about a value that is not allowed."""
REFUSALS, LARGEST_CODE = tuple(dict.fromkeys((*_WORDS, *OF_VALUES))), 0xFFFF
_VALUE = ("value_not_allowed", "not_allowed", "limit")


class UssCore(Core):
    """Devices on a line. What a device does not understand it does not answer."""

    def __init__(self, devices: Sequence[SimulatedDevice], framing: str = "uss") -> None:
        self.devices, self.framing = devices, framing
        self._units = {unit: _Unit(device) for unit, device in by_unit(devices).items()}

    def cut(self, data: bytes, *, quiet: bool) -> tuple[list[bytes], int]:
        """Cut by start, length and check byte."""
        found, end = cut_sound(data, sound_size, LEAST_BYTES, _LONGEST)
        return found, len(data) if quiet else max(end, len(data) - _LONGEST)

    def answer(self, request: bytes) -> Answer | None:
        """Return what a telegram leads to; None if no device answers it."""
        words = words_in(request[3:-1])
        if len(request) % 2:
            return None
        unit = self._units.get(request[2])
        if unit is not None:
            return unit.answer(words)
        answers = [
            each.broadcast(words) for each in self._units.values() if each.device.device.bus.broadcast == request[2]
        ]
        return answers[0] if answers else None

    def spoiled(self, answer: bytes, what: str) -> bytes:
        """Return an answer that is wrong in one way."""
        words, address = list(words_in(answer[3:-1])), answer[2]
        if what == "check":
            return answer[:-1] + bytes((answer[-1] ^ 0x55,))
        if what == "unit":
            address ^= 1
        elif what == "function" and words:
            words[0] ^= 0x3000
        elif what == "exception" and len(words) > 2:
            words[0], words[2] = words[0] & 0x0FFF | telegrams.REFUSED << 12, 17
        return telegram(address, words)


core_of = UssCore


@dataclass(frozen=True, slots=True)
class _Result:
    """The response to a task, and the words of its values: `each` words a value."""

    code: int
    values: tuple[int, ...]
    each: int = 1
    refused: str = ""


class _Unit:
    """One device, with the telegrams of its process data."""

    def __init__(self, device: SimulatedDevice) -> None:
        self.device = device
        model = device.device
        self._usual = telegrams.default_link(model.bus)
        self._settings = _setting(device, "pkw"), _setting(device, "pzd")
        self._taken = {each.direction: each.name for each in model.telegrams}
        self._tasks = {code.number for code in model.bus.functions}
        self._elements: dict[int, dict[int, Point]] = {}
        for point in device.layout.points.values():
            if point.space == "parameter" and point.addresses:
                self._elements.setdefault(point.addresses[0], {})[-1 if point.index is None else point.index] = point

    def link(self, count: int, sent: int | None = None) -> Link:
        """Return the current link of the device; if no point holds it, the one that fits the words of a telegram.

        `sent` is how many of them are not process data, if not those of a parameter part.
        """
        raw, (pkw, pzd), (low, high) = self.device.memory.raw, self._settings, of_bus(self.device.device.bus).pzd
        part = self._usual.pkw if pkw is None else raw(pkw)
        left = count - (Link(part, 0).sent if sent is None else sent)
        return Link(part, raw(pzd) if pzd is not None else left if low <= left <= high else self._usual.pzd)

    def answer(self, words: tuple[int, ...]) -> Answer | None:
        """Return the answer to a telegram; None if its parts have other lengths than the link."""
        link = self.link(len(words))
        divided = telegrams.split(words, link, request=True)
        if not divided.fits:
            self.device.complain("length", f"a telegram has {len(words)} words, and the link is set otherwise")
            return None
        self.device.end_silence()
        self._take_words(dict(enumerate(divided.words)), 0xFFFF)
        part = telegrams.part_of(divided.part)
        result = _Result(_NO_ANSWER, ())
        if part is not None:
            try:
                result = self._carried_out(part, divided.part[0] & 0x07FF, link)
            except Refusal as refusal:
                error = self.device.refusals.get(refusal.kind, self._error(refusal.kind, part.code))
                result = _Result(telegrams.REFUSED, (error,), refused=refusal.why)
                self.device.complain_of(refusal)
        head = () if part is None else (result.code << 12 | divided.part[0] & 0x07FF, divided.part[1])
        head = (0, 0) if part is not None and not result.code else head
        data = telegram(self.device.unit, (*head, *_value_words(result, link, bool(head)), *self._given(link.pzd)))
        return Answer(self.device, data, refused=result.refused)

    def broadcast(self, words: tuple[int, ...]) -> Answer:
        """Take the process data that the masks select; nobody answers."""
        if len(words) == telegrams.MASKS + self.link(len(words), telegrams.MASKS).pzd:
            self.device.end_silence()
            which, bits = words[:2]
            chosen = {at: word for at, word in enumerate(words[telegrams.MASKS :]) if which >> at + 1 & 1}
            if 0 in chosen:
                held = self._held("request").get(0, 0)
                chosen[0] = held & ~bits | chosen[0] & bits
            self._take_words(chosen, bits)
        else:
            self.device.complain("length", f"a broadcast has {len(words)} words, and the link is set otherwise")
        return Answer(self.device, b"")

    def _take_words(self, words: Mapping[int, int], bits: int) -> None:
        """Take words of process data; words without their constant bits or without a point are ignored.

        `bits` are those of the first word that count; its constant ones must be among them.
        """
        area = (self._taken.get("request", ""), 0)
        writers = self.device.layout.writers.get(area, {})
        for point in {each.name: each for address in words for each in writers.get(address, ())}.values():
            cells = {address: words[address] for address in point.addresses if address in words}
            first, fixed = next(iter(cells.values())), point.fixed
            counts = bits if 0 in cells else 0xFFFF
            if fixed is not None and (first & fixed.mask != fixed.bits or fixed.mask & ~counts):
                self.device.complain(
                    "constant bits", f"{point.name} came as {first:04X}h, which the device ignores", point.source
                )
                continue
            try:
                self.device.write(area, cells)
            except Refusal as refusal:
                self.device.complain_of(refusal)

    def _given(self, count: int) -> list[int]:
        """Return the words of process data that go to the master."""
        self.device.advance()
        held = self._held("response")
        return [held.get(address, 0) for address in range(count)]

    def _held(self, direction: str) -> Mapping[int, int]:
        return self.device.memory.areas.get((self._taken.get(direction, ""), 0), {})

    def _carried_out(self, part: Part, number: int, link: Link) -> _Result:
        """Carry out a task. Raises Refusal."""
        if part.spontaneous:
            self.device.complain("bit 11", "bit 11 of the first word is always 0")
        task, array = part.code, part.code in _ARRAY_TASKS
        if task == _NO_TASK:
            return _Result(_NO_ANSWER, ())
        width = telegrams.TASK_WIDTHS.get(task, 0)
        if task not in self._tasks or not (width or task in _READS or task == _SIZE_TASK):
            raise Refusal("task", f"task {task} is not implemented")
        elements = self._elements.get(part.parameter, {})
        if not elements or number >= _NUMBERS:
            raise Refusal("address", f"there is no parameter {part.parameter}")
        if task == _SIZE_TASK:
            return _Result(telegrams.SIZE, (len(elements),))
        if part.index == _ALL and link.pkw == telegrams.VARIABLE and not width:
            return self._all_elements(part.parameter, elements, link, array=array)
        element = part.index if -1 not in elements else -1
        if element not in elements or (element == -1 and part.index > 1):
            kind = "no_array" if -1 in elements else "index"
            raise Refusal(
                kind, f"parameter {part.parameter} has no element {part.index}", next(iter(elements.values()))
            )
        point = elements[element]
        if width:
            self._write(part, point, width, link)
        values, each = self._values(part.parameter, point)
        if each > 1 and link.sent < 4:
            raise Refusal("too_long", f"{point.name} has two words, and the answer has room for one", point)
        return _Result(_RESPONSES[each, array], values, each)

    def _all_elements(self, parameter: int, elements: Mapping[int, Point], link: Link, *, array: bool) -> _Result:
        if -1 in elements:
            raise Refusal("no_array", f"parameter {parameter} is no array", elements[-1])
        values = [self._values(parameter, elements[index]) for index in sorted(elements)]
        words = tuple(word for each, _ in values for word in each)
        if 2 * (len(words) + link.pzd) + 8 > _LONGEST - 1:
            raise Refusal("too_long", f"the elements of parameter {parameter} are too many for one telegram")
        return _Result(_RESPONSES[values[0][1], array], words, values[0][1])

    def _values(self, parameter: int, point: Point) -> tuple[tuple[int, ...], int]:
        """Return the words of a parameter, and how many it has. Raises Refusal."""
        cells = self.device.layout.cells[point.name]
        (number,) = self.device.read(cells.area, (parameter,))
        return words_of(number, cells.size), cells.size

    def _write(self, part: Part, point: Point, width: int, link: Link) -> None:
        cells, value = self.device.layout.written[point.name], part.value(width, link)
        if not point.writable:
            raise Refusal("read_only", f"{point.name} can only be read", point)
        if width != cells.size or value is None:
            raise Refusal("part", f"{point.name} has {cells.size} words, task {part.code} writes {width}", point)
        self.device.write(cells.area, {cells.addresses[0]: value}, keep=part.code in telegrams.EEPROM_TASKS)

    def _error(self, kind: str, task: int) -> int:
        """Return the number of the error for a kind of refusal: by its name, among those that the task can have."""
        errors = self.device.device.bus.exceptions
        fitting = [error for error in errors if not error.answers or task in error.answers] or list(errors)
        named = (error.number for word in _WORDS.get(kind, _VALUE) for error in fitting if word in error.name)
        return next(named, fitting[0].number if fitting else 0)


def _value_words(result: _Result, link: Link, has_part: bool) -> Iterator[int]:
    """Yield the words after the first two of an answer's parameter part."""
    if not has_part:
        return
    values = result.values
    if link.single_last and result.each == 1 and result.code not in (_NO_ANSWER, telegrams.REFUSED):
        values = (0, *values)
    yield from values
    least = telegrams.SHORT if link.pkw == telegrams.VARIABLE else link.pkw
    yield from (0 for _ in range(least - 2 - len(values)))


def _setting(device: SimulatedDevice, what: str) -> str | None:
    """Return the first point that holds how many words a part of the telegrams has; None without one."""
    points = device.layout.points.values()
    return next((point.name for point in points if f"{what}_length" in point.name and point.generated), None)
