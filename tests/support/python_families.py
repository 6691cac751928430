"""Small CAN and USS devices for the tests of Python, and peers that answer for them from a dict.

The peers are written against the protocols and not with the runtime's own functions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from fieldscribe.conditions import Comparison, Condition
from fieldscribe.families.can import CanBus
from fieldscribe.families.uss import UssBus
from fieldscribe.model import (
    Bus,
    Code,
    Device,
    Digits,
    Enum,
    Fixed,
    Flag,
    Limit,
    Message,
    Place,
    Point,
    Role,
    ScaleCase,
    Telegram,
    Text,
    Variant,
)

from support.models import (
    HERTZ,
    SOURCE,
    VOLT,
    WATT,
    allowed,
    device_of,
    entry,
    linear,
    point,
    scaled,
    titles,
    units,
    value_of,
)

SWITCH = Enum("switch", (entry(0, "off"), entry(3, "on")), False)
DELAY = Enum("delay", tuple(entry(raw, f"step_{raw}") for raw in (0, 1, 2, 5)), False)
NORMALISATION = Enum("normalisation", (entry(0, "normalised"), entry(1, "absolute")), True)
WORD_FLAGS = (Flag(0, 1, "start", titles("Start"), 1, ()), Flag(10, 1, "valid", titles("Valid"), 1, ()))


def parameter(name: str, *addresses: int, type_name: str = "u16", **facts: Any) -> Point:
    """A parameter that can be read and written."""
    made = point(name, addresses[0], type_name, space="parameter", group="main", **facts)
    return replace(made, place=Place(addresses, {}))


def word(telegram: str, name: str, *positions: int, type_name: str = "u16", **facts: Any) -> Point:
    """A point in words of a telegram, read only unless said."""
    facts = {"access": "r", "group": telegram, **facts}
    made = point(name, positions[0], type_name, space="telegram", telegram=telegram, **facts)
    return replace(made, place=Place(positions, {}))


def text(name: str, characters: int, encoding: str, *addresses: int, **facts: Any) -> Point:
    """A text in words in reading order."""
    return parameter(name, *addresses, type_name="text", text=Text(characters, encoding), **facts)


def _roles(head: int, *rest: tuple[str, int]) -> tuple[Role, ...]:
    return (Role("constant", head), *(Role(kind, number) for kind, number in rest))


def can_messages() -> tuple[Message, ...]:
    """Requests that all units hear, answers and a multiplexed telegram on an identifier of the unit's own."""
    named = (("unit", 0), ("address", 8), ("address", 0))
    raw, check = (("raw", 8), ("raw", 0)), (("xor", 0b010101), ("xor", 0b101010))
    words = tuple(("word", number) for number in range(6))
    layouts = (
        ("read_request", "request", None, 0x33F, _roles(0xFF, *named, ("constant", 0), ("constant", 0), *check)),
        ("write_request", "request", None, 0x33F, _roles(0xEE, *named, *raw, *check)),
        ("read_answer", "response", "read_request", 0x320, _roles(0xFF, *named, *raw, *check)),
        ("write_answer", "response", "write_request", 0x320, _roles(0xEE, *named, *raw, *check)),
        ("measurements", "cyclic", None, 0x320, _roles(0xDD, ("multiplexer", 0), *words)),
    )
    return tuple(
        Message(name, titles(name), direction, answers, can_id, can_id == 0x320, roles, SOURCE)
        for name, direction, answers, can_id, roles in layouts
    )


def can_points() -> tuple[Point, ...]:
    """One of everything that a CAN device adds."""
    exponent = value_of("power_exponent", -1, ten_to=True)
    setpoint: dict[str, Any] = {"unit": VOLT, "scale": scaled("1/400", 0, value_of("rated_voltage"))}
    highest = Limit(linear(2, 0, value_of("rated_voltage")), (), 0, 1000)
    return (
        parameter("rated_voltage", 507, allowed=allowed((50, 480)), unit=VOLT, changes_with=("transformer",)),
        parameter("transformer", 508),
        parameter("voltage_setpoint", 510, **setpoint),
        parameter("limited", 511, allowed=allowed((0, highest))),
        parameter("controller", 19, type_name="u8", bits=(15, 14), enum=SWITCH, allowed=allowed((0, 0), (3, 3))),
        parameter("slow_ramp", 19, type_name="bit", bits=(3, 3), fixed=Fixed(0x00F1, 0x0001)),
        parameter("delays", 404, digits=Digits(4, DELAY)),
        parameter("command_word", 30, flags=WORD_FLAGS, fixed=Fixed(0x040F, 0x0406)),
        parameter("command_number", 31, fixed=Fixed(0x8000, 0x8000), allowed=allowed((0x8000, 0x80FF))),
        text("fault_text", 8, "ascii", 739, 738, 737, 736),
        text("label", 4, "latin-1", 740, 741),
        parameter("level", 600, variant=Variant("voltage", "100V"), allowed=allowed((1, 9))),
        parameter("level", 600, variant=Variant("voltage", "400V"), allowed=allowed((1, 99))),
        parameter("spare", 601, when=Condition(((Comparison("size", "!=", ("small",)),),))),
        word("measurements", "frequency", 0, unit=HERTZ, scale=scaled(100), decimals=2),
        word("measurements", "power", 1, type_name="s16", unit=WATT, scale=scaled(1, 0, exponent)),
        word("measurements", "power_exponent", 2, type_name="s8", bits=(15, 8), allowed=allowed((-9, 9))),
        word("measurements", "hours", 5, 6, type_name="u32"),
        word("measurements", "starts", 9, 10, type_name="u32"),
    )


def can_device() -> Device:
    """A measuring device on CAN."""
    bus = Bus((), (0, 30), None, (), (), {}, {}, {}, {}, CanBus(125000, 11))
    telegram = Telegram("measurements", titles("Measurements"), "cyclic", 11, "measurements", SOURCE)
    return device_of(
        "sample_can",
        can_points(),
        family="can",
        bus=bus,
        messages=can_messages(),
        telegrams=(telegram,),
        variants={"voltage": ("100V", "400V"), "size": ("small", "large")},
    )


_TASKS = {0: (0,), 1: (1, 2), 2: (1,), 3: (2,), 7: (4,), 8: (5,), 11: (5,), 12: (4,), 13: (2,), 14: (1,)}


def uss_points() -> tuple[Point, ...]:
    """One of everything that a USS device adds."""
    normalised = linear(16384, 0, value_of("reference_frequency", -1))
    by_choice = (ScaleCase("normalisation", 0, normalised), ScaleCase("normalisation", 1, linear(100)))
    frequency: dict[str, Any] = {"type_name": "s16", "unit": HERTZ, "scale": by_choice, "decimals": 4}
    f32: dict[str, Any] = {"type_name": "f32", "unit": HERTZ, "order": None}
    return (
        parameter("command_source", 700, code="P0700", allowed=allowed((0, 5)), keeps="choice"),
        parameter("maximum_frequency", 1082, **f32, allowed=units(0, 650), keeps="choice"),
        parameter("reference_frequency", 2000, **f32, changes="rarely", keeps="choice"),
        parameter(
            "normalisation",
            2009,
            index=0,
            enum=NORMALISATION,
            allowed=allowed((0, 1)),
            changes_with=("command_source",),
        ),
        parameter("baud_rate", 2010, index=1, allowed=allowed((4, 9)), keeps="choice"),
        parameter("answer_source", 2016, type_name="u32", index=3, keeps="choice"),
        parameter("relay_source", 731, type_name="u32"),
        parameter("reaction", 610, type_name="s16", keeps="no"),
        parameter("mode", 800, type_name="u8", bits=(7, 4)),
        parameter("drive_status", 52, access="r", flags=WORD_FLAGS),
        parameter("unlock", 900, access="w", keeps="choice"),
        word("task", "control_word", 0, access="w", flags=WORD_FLAGS, fixed=Fixed(0x0400, 0x0400)),
        word("task", "main_setpoint", 1, access="w", **frequency),
        word("task", "jog", 2, type_name="u8", access="w", bits=(2, 1)),
        word("answer", "status_word", 0, flags=WORD_FLAGS),
        word("answer", "main_actual_value", 1, **frequency),
        word("answer", "energy", 2, 3, type_name="u32"),
    )


def uss_device() -> Device:
    """A drive on USS."""
    functions = tuple(
        Code(number, f"task_{number}", titles("Task"), None, None, answers, (7, 8))
        for number, answers in _TASKS.items()
    )
    errors = (Code(17, "not_now", titles("Not now"), None),)
    bus = Bus((), (0, 31), 32, functions, errors, {}, {}, {}, {}, UssBus(pkw=(0, 3, 4, 127), pzd=(0, 4)))
    telegrams = tuple(
        Telegram(name, titles(name), direction, 4, None, SOURCE)
        for name, direction in (("task", "request"), ("answer", "response"))
    )
    return device_of("sample_uss", uss_points(), family="uss", bus=bus, telegrams=telegrams, variants={})


class CanUnit:
    """A unit on a CAN bus, and the bus; a parameter holds no number above that in `most`."""

    def __init__(self, frame: Callable[[int, bytes], Any], number: int) -> None:
        self.frame = frame
        self.number = number
        self.parameters: dict[int, int] = {}
        self.waiting: list[Any] = []
        self.log: list[str] = []
        self.most: dict[int, int] = {}

    def send(self, frame: Any) -> None:
        """Take a request, and make the answer wait."""
        self.log.append(f"{frame.id:X}#{frame.data.hex()}")
        data = frame.data
        check = bytes(data[at] ^ data[at + 2] ^ data[at + 4] for at in (0, 1))
        assert (frame.id, len(data), data[6:]) == (0x33F, 8, check)
        if data[1] != self.number:
            return
        address = int.from_bytes(data[2:4], "big")
        if data[0] == 0xEE:
            self.parameters[address] = min(int.from_bytes(data[4:6], "big"), self.most.get(address, 0xFFFF))
        body = data[:4] + self.parameters.get(address, 0).to_bytes(2, "big")
        check = bytes(body[at] ^ body[at + 2] ^ body[at + 4] for at in (0, 1))
        self.waiting.append(self.frame(0x320 + self.number, body + check))

    def receive(self) -> Any:
        """The next frame."""
        if not self.waiting:
            raise TimeoutError("nothing came")
        return self.waiting.pop(0)

    def words(self, slot: int, *words: int) -> Any:
        """A frame of the telegram."""
        data = b"".join(word.to_bytes(2, "big") for word in (*words, 0, 0, 0)[:3])
        return self.frame(0x320 + self.number, bytes((0xDD, slot)) + data)


class UssDrive:
    """A drive on a USS line: parameters are words (one or two) by number and index, `answer` its process data."""

    def __init__(self, pkw: int = 4, pzd: int = 2) -> None:
        self.pkw, self.pzd = pkw, pzd
        self.ram: dict[tuple[int, int], tuple[int, ...]] = {}
        self.eeprom: dict[tuple[int, int], tuple[int, ...]] = {}
        self.task: tuple[int, ...] = ()
        self.answer: tuple[int, ...] = (0, 0, 0, 0)
        self.log: list[str] = []

    def exchange(self, request: bytes) -> bytes:
        """The reply to a request."""
        self.log.append(request.hex())
        assert (request[0], request[1] + 2, _xor(request)) == (2, len(request), 0)
        words = [int.from_bytes(request[at : at + 2], "big") for at in range(3, len(request) - 1, 2)]
        sent = len(words) - self.pzd
        assert sent == (4 if self.pkw == 127 else self.pkw)
        self.task = tuple(words[sent:])
        part = self._part(words[:sent]) if sent else []
        data = b"".join(word.to_bytes(2, "big") for word in (*part, *self.answer[: self.pzd]))
        body = bytes((2, len(data) + 2, request[2])) + data
        return body + bytes((_xor(body),))

    def _part(self, words: list[int]) -> list[int]:
        task, low = words[0] >> 12, words[0] & 0x07FF
        page = sum((words[1] >> place & 1) << bit for bit, place in enumerate((15, 12, 13, 14)))
        number, index = low + 2000 * page, words[1] & 0xFF
        if task == 0:
            return [0] * len(words)
        single_last = self.pkw == 4
        if task != 1:
            double = task in (3, 8, 11, 13)
            value = tuple(words[2:4]) if double else (words[3 if single_last else 2],)
            self.ram[number, index] = value
            if task > 8:
                self.eeprom[number, index] = value
        value = self.ram.get((number, index), (0,))
        response = len(value) if task in (1, 2, 3, 13, 14) else 3 + len(value)
        room = value if len(value) == 2 else (0, *value) if single_last else (*value, 0)
        return [response << 12 | low, words[1], *room][: len(words)]


def _xor(data: bytes) -> int:
    result = 0
    for byte in data:
        result ^= byte
    return result
