"""Vectors of Modbus frames, commands and batched reads; and of bases of addresses.

`wire.py` chooses the requests and replies. A base follows from given numbers, or a client finds its blocks. Each vector
of one has the whole exchange that reads the set point, for languages whose devices find a base by themselves.
"""

import itertools
from collections.abc import Iterator, Mapping

from fieldscribe.families.modbus import FRAMINGS, SPACES, profile_of
from fieldscribe.families.modbus.frames import Request
from fieldscribe.families.modbus.targets.wire import ModbusWire
from fieldscribe.model import Base, Bus, Device, Found, Point, SteppedCommand, Word
from fieldscribe.targets.vectors.exchanges import Script, words_in_bytes
from fieldscribe.targets.vectors.lines import NO_BROADCAST, Lines

KINDS = {
    "build": "status:word bytes:bytes? frame:note?",
    "reply": "bytes:bytes? status:word values_out:ints? exception:int? frame:note?",
    "step": "command:word index:int with:pairs? read:int? write:int? address:int held:ints words:ints within:int? "
    "conditional:int base:word?",
    "block": "group:word space:word function:int address:int count:int",
    "base": "base:word given:pairs? script:script? status:word start:int? last:int?",
    "base_behind": "only:python.typescript base:word script:script status:word start:int? last:int?",
}
"""The kinds of vectors for frames, batched reads, and bases: given, the start of a found block, a place after that."""

_MOST_BYTES = {"rtu_bytes": 256, "tcp_bytes": 260}
"""The longest frames that the protocol allows."""
_LAST, _MOST_BLOCKS, _REFUSED = 0xFFFF, 256, 2
_Held = dict[int, int]
"""Words of a device by their addresses."""


def wires(lines: Lines, device: Device) -> list[ModbusWire]:
    """Return one for each framing of the device, in the order of the description."""
    return [ModbusWire(lines, device, framing) for framing in device.bus.framings or ("rtu",)]


def frames(lines: Lines, device: Device) -> None:
    """Add all vectors of Modbus frames."""
    described = wires(lines, device)
    described[0].add_codes("code", "exception", device.bus.exceptions)
    for wire in described:
        wire.opens()
        for command in device.commands:
            value = 1 if command.value is None else command.value
            script = wire.script(command.function, (command.address,), (value,))
            if script is not None:
                lines.add("command", command.name, value, script, "ok")
    described[0].opens()
    BaseVectors(described[0]).add()
    spoken = [wire for wire in described if wire.framing in device.bus.framings]
    for wire in spoken:
        wire.add_builds(wire.requests())
    for framing in [framing for framing in FRAMINGS if framing not in described[0].profile.framings]:
        foreign = ModbusWire(lines, device, framing)
        foreign.add_builds(itertools.islice(foreign.requests(), 1))
    for wire in spoken:
        wire.add_all_replies()
    described[0].add_examples()
    for stepped in device.stepped_commands:
        _steps(lines, stepped)
    for group, block in [(group, block) for group, blocks in device.blocks.items() for block in blocks]:
        lines.add("block", group, block.space, block.function, block.address, block.count)


def _steps(lines: Lines, command: SteppedCommand) -> None:
    """Add the words of each step for the ends of the arguments, over what the device held."""
    ends = {end: {name: both[end] for name, both in command.arguments.items()} for end in (0, 1)}
    for index, step in enumerate(command.steps):
        for given, filled in itertools.product((ends[0], ends[1]) if command.arguments else ({},), (0x0000, 0xA5C3)):
            words = tuple(_word(word, given, f"{filled:016b}") for word in step.words)
            facts = step.read, step.write, step.address, (filled,) * len(words), words, step.within
            lines.add("step", command.name, index, given or None, *facts, int(step.when is not None), step.base)


def _word(word: Word, given: Mapping[str, int], held: str) -> int:
    """Return a word for these arguments over what the device held, bit by bit."""
    number = f"{(word.constant + word.factor * given.get(word.argument or '', 0)) % 0x10000:016b}"
    bits = zip(number, f"{word.mask:016b}", held, strict=True)
    return int("".join([new if mask == "1" else old for new, mask, old in bits]), 2)


def limits(lines: Lines, bus: Bus) -> None:
    """Add the limits of the functions and of the protocol."""
    profile = profile_of(bus)
    known = [code.number for code in bus.functions if code.number in profile.most]
    for index, number in enumerate(known):
        lines.add("function", index, number, profile.most[number], int(number in profile.broadcasts))
    lines.add_limits(functions=len(known), broadcast=NO_BROADCAST if bus.broadcast is None else bus.broadcast)
    lines.add_limits(no_broadcast=NO_BROADCAST, **_MOST_BYTES)


# Bases of addresses.


class _Script:
    """The exchanges with a unit that holds some words, and refuses to read others."""

    def __init__(self, wire: ModbusWire, held: Mapping[int, int]) -> None:
        self.wire, self.held = wire, held
        self.steps: Script = []

    def read(self, function: int, address: int, count: int) -> tuple[int, ...] | None:
        """Add a read, and return its words; None if it is refused."""
        request = Request(self.wire.unit, function, address, count, (), self.wire.transaction)
        _, sent = self.wire.build(request)
        words = [self.held.get(each) for each in range(address, address + count)]
        known = [word for word in words if word is not None]
        answer = bytes((function, 2 * count)) + words_in_bytes(known)
        if len(known) < count:
            answer = bytes((function | 0x80, _REFUSED))
        self.steps.append((sent, self.wire.frame(request, answer)))
        return tuple(known) if len(known) == count else None


class BaseVectors:
    """The vectors of the bases of a device, over one framing."""

    def __init__(self, wire: ModbusWire) -> None:
        self.wire, self.lines, self.device = wire, wire.lines, wire.device
        self._given = {each.name: each for each in wire.device.given}
        self._length = max((max(each.addresses, default=0) for each in wire.device.points if each.base), default=0)

    def add(self) -> None:
        """Add the vectors of each base from which a word can be read."""
        many = True
        for base in self.device.bases:
            point = next((each for each in self.device.points if each.base == base.name and _is_a_word(each)), None)
            if point is None:
                continue
            self.lines.set("point", point.item)
            if base.block is None:
                self._add_given(base, point)
            elif self.device.found is not None:
                self._add_found(self.device.found, base, base.block, point, many=many)
                many = False

    def _read(self, script: _Script, point: Point, start: int) -> None:
        script.read(SPACES[point.space].read, start + point.addresses[0], 1)

    def _add_given(self, base: Base, point: Point) -> None:
        """Add the ends of all numbers, then each number in turn beyond its ends."""
        given = [self._given[name] for name, _ in base.terms]
        for numbers in ({each.name: each.low for each in given}, {each.name: each.high for each in given}):
            start = base.at(numbers)
            script = _Script(self.wire, {start + point.addresses[0]: 1})
            self._read(script, point, start)
            self.lines.add("base", base.name, numbers, script.steps, "ok", start, _LAST - start)
            for each in given:
                for beyond in (each.low - 1, each.high + 1):
                    if 0 <= beyond <= _LAST:
                        self.lines.add("base", base.name, numbers | {each.name: beyond}, None, "bad_base")

    def _add_found(self, found: Found, base: Base, block: int, point: Point, *, many: bool) -> None:
        for held in _devices(found, base, block, self._length, many=many):
            script = _Script(self.wire, held)
            status, place = _search(script, found, base, block)
            if place:
                self._read(script, point, place[0])
            kind, given = ("base", (None,)) if base.starts_block else ("base_behind", ())
            self.lines.add(kind, base.name, *given, script.steps, status, *place)
        if many:
            cut = _Script(self.wire, {})
            cut.read(SPACES[found.space].read, found.places[0], len(found.words))
            ((sent, answer),) = cut.steps
            self.lines.add("base", base.name, None, [(sent, answer[:-1])], "short_frame")


def _is_a_word(point: Point) -> bool:
    """Return True for a point of one item that every device has and one request reads."""
    conditional = point.when is not None or point.since or point.until or point.terms.selects
    return point.readable and point.words == 1 and bool(point.addresses) and not conditional


def _devices(found: Found, base: Base, block: int, length: int, *, many: bool) -> Iterator[_Held]:
    """Yield the words of devices with the block at some place, or without it; with `many`, also of broken ones."""
    first, last, size = found.places[0], found.places[-1], len(found.words)
    words = [0] * (2 * length)
    for number, (_, address, _) in enumerate(base.counts, 1):
        words[address - 2] = number
    this, other = (block, words), (1 if block > 1 else 3, [7, 8])
    yield _chain(found, last, other, this, (block, [9, 9, 9]))
    if not base.starts_block:
        yield _chain(found, first, (block, [_LAST if base.counts else 0] * length))
        return
    yield _chain(found, first, other)
    if not many:
        return
    yield _chain(found, first, this)
    yield {place + at: word ^ (at == size - 1) for place in found.places for at, word in enumerate(found.words)}
    for too_long in (other[0], block):
        yield _chain(found, last) | {last + size: too_long, last + size + 1: _LAST - last - size}
    yield dict(list(_chain(found, last, this).items())[: size + 1])
    yield _chain(found, min(found.places), *[(other[0], [])] * _MOST_BLOCKS)


def _chain(found: Found, place: int, *blocks: tuple[int, list[int]]) -> _Held:
    """Return the words of a marker at a place and of the blocks after it."""
    words = [*found.words, *(word for block, held in blocks for word in (block, len(held), *held)), found.end, 0]
    return dict(enumerate(words, place))


def _search(script: _Script, found: Found, base: Base, block: int) -> tuple[str, tuple[int, ...]]:
    """Search as a client that reads the whole chain first; return status, start and last address."""
    function = SPACES[found.space].read
    marked = (each for each in found.places if script.read(function, each, len(found.words)) == found.words)
    place, blocks = next(marked, None), dict[int, tuple[int, int]]()
    if place is None:
        return "no_marker", ()
    place += len(found.words)
    for _ in range(_MOST_BLOCKS):
        head = script.read(function, place, 2)
        if head is None:
            return "exception", ()
        if head[0] == found.end:
            break
        if place + 1 + head[1] > _LAST:
            return "bad_chain", ()
        blocks.setdefault(head[0], (place, 1 + head[1]))
        place += 2 + head[1]
    else:
        return "bad_chain", ()
    if block not in blocks:
        return "no_block", ()
    start, last = blocks[block]
    words = base.offset
    for _, address, factor in base.counts:
        words += factor * (script.read(function, start + address, 1) or (0,))[0]
    return ("ok", (start + words, last - words)) if words <= last else ("behind_end", ())
