"""Messages of a CAN device: builds their frames, reads frames as messages, and collects those of a telegram. No I/O."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from operator import itemgetter
from struct import Struct
from types import MappingProxyType
from typing import NamedTuple

from fieldscribe.model import Device, Message, Role, Telegram

LENGTH = 8
"""The number of bytes of every message with a layout."""
LONGEST = 64
"""The most bytes of a message with signals; more than 8 take CAN FD."""
_WORD = 0xFFFF
_NO_WORDS: Mapping[int, int] = MappingProxyType({})
_STATUSES = {"constant": "wrong_constant", "unit": "wrong_unit"}
"""The status of a frame whose bytes of this role differ."""


class CanFrame(NamedTuple):
    """A frame on the bus; `remote` frames only ask for data. A captured frame has the time and the bus of its log."""

    id: int
    data: bytes
    remote: bool = False
    stamp: str = ""
    bus: str = ""

    @property
    def text(self) -> str:
        """The frame as candump logs it, and cansend takes it."""
        identifier = "%03X" % self.id if self.id <= 0x7FF else "%08X" % self.id  # noqa: UP031  # a stream has millions
        text = f"{identifier}#{'R' if self.remote else self.data.hex().upper()}"
        return " ".join(filter(None, (self.stamp, self.bus, text)))

    @property
    def details(self) -> dict[str, object]:
        """The time and the bus of the capture, for JSON."""
        return {"time": self.stamp.strip("()") or None, "interface": self.bus or None}


@dataclass(frozen=True, slots=True)
class Parsed:
    """A frame read as a message; fields that it does not carry are 0, and all fields unless `status` is "ok"."""

    status: str
    address: int = 0
    raw: int = 0


@dataclass(frozen=True, slots=True)
class Difference:
    """A wrong byte of a message: its place, the kind of its role, the byte found and the byte expected."""

    place: int
    kind: str
    here: int
    due: int


@dataclass(frozen=True, slots=True)
class Head:
    """A frame read as a message, without its words. `foreign`: it answers for a unit that the device cannot have.

    `slot` is the multiplexer (0 without one), `address` the parameter of the message, if it has one.
    """

    message: Message
    unit: int | None
    slot: int
    address: int | None
    differences: tuple[Difference, ...]
    wrong_sum: bool
    foreign: bool

    @property
    def flaws(self) -> int:
        """The number of flaws; a checksum counts once."""
        return self.foreign + self.wrong_sum + len(self.differences)


@dataclass(frozen=True, slots=True)
class ParameterWord:
    """The parameter of a request or an answer, and the word that it carries."""

    address: int
    raw: int | None


def identifier(message: Message, unit: int) -> int:
    """Return the identifier of a message to or from a unit."""
    return message.identifier + unit if message.adds_unit else message.identifier


def checksum(data: Sequence[int], mask: int) -> int:
    """Return the exclusive or of the bytes that `mask` selects."""
    result = 0
    for place, byte in enumerate(data):
        if mask >> place & 1:
            result ^= byte
    return result


def places(message: Message, kind: str) -> list[int]:
    """Return the places of the bytes with a role of this kind."""
    return [place for place, role in enumerate(message.roles) if role.kind == kind]


def carries(message: Message, kind: str) -> bool:
    """Return True if any byte of the message has a role of this kind."""
    return bool(places(message, kind))


def request_and_answer(messages: Sequence[Message], *, writes: bool) -> tuple[Message | None, Message | None]:
    """Return the request that reads or writes a parameter, and its answer; None for one that the device lacks."""
    for request in messages:
        asks = request.direction == "request" and carries(request, "address")
        if asks and carries(request, "raw") == writes:
            return request, next((message for message in messages if message.answers == request.name), None)
    return None, None


def carriers(device: Device) -> dict[str, Message]:
    """Return the message that carries each telegram, by the telegram's name."""
    messages = {message.name: message for message in device.messages}
    return {telegram.name: messages[telegram.message] for telegram in device.telegrams if telegram.message in messages}


def frame_count(telegram: Telegram, message: Message) -> int:
    """Return how many frames a telegram takes: the number of its multiplexer values."""
    return -(-telegram.words // message.words)


def is_of(message: Message, units: tuple[int, int], frame: CanFrame) -> bool:
    """Return True if a frame has the identifier and the length of a message."""
    low, high = units if message.adds_unit else (0, 0)
    return low <= frame.id - message.identifier <= high and len(frame.data) == message.length


def carried(message: Message, frame: CanFrame, kind: str) -> int:
    """Return the number in the bytes with a role of this kind, the high byte first."""
    bytes_by_role = zip(message.roles, frame.data, strict=False)
    return sum(
        byte << (0 if kind == "multiplexer" else role.number) for role, byte in bytes_by_role if role.kind == kind
    )


def unit_of(message: Message, frame: CanFrame) -> int | None:
    """Return the unit that sends or receives a frame, by its identifier or its bytes; None if neither gives it."""
    if message.adds_unit:
        return frame.id - message.identifier
    return carried(message, frame, "unit") if carries(message, "unit") else None


def telegram_words(message: Message, frame: CanFrame) -> dict[int, int]:
    """Return the words of a telegram in a frame, by their position in the telegram."""
    first = carried(message, frame, "multiplexer") * message.words
    words: dict[int, int] = {}
    for role, byte in zip(message.roles, frame.data, strict=True):
        if role.kind == "word":
            place = first + role.number // 2
            words[place] = words.get(place, 0) | byte << (0 if role.number & 1 else 8)
    return words


def build(message: Message, units: tuple[int, int], unit: int, address: int, raw: int) -> tuple[str, CanFrame]:
    """Return ("ok", the frame of a message), or (status, an empty frame) if it must not be sent.

    The first failure wins: `bad_unit` (outside `units`), `bad_address` and `bad_value` (not 16 bits).
    """
    for status, number, low, high in (
        ("bad_unit", unit, *units),
        ("bad_address", address, 0, _WORD),
        ("bad_value", raw, 0, _WORD),
    ):
        if not low <= number <= high:
            return status, CanFrame(0, b"")
    return "ok", CanFrame(identifier(message, unit), filled(message, {"unit": unit, "address": address, "raw": raw}))


def filled(message: Message, numbers: Mapping[str, int], words: Mapping[int, int] = _NO_WORDS) -> bytes:
    """Return the bytes of a message with a layout, checksums included: `numbers` by the kind of their role."""
    return summed(message, [_byte(role, numbers, words) for role in message.roles])


def summed(message: Message, data: Iterable[int]) -> bytes:
    """Return the data of a message with its right checksums."""
    result = bytearray(data)
    for place in places(message, "xor"):
        result[place] = checksum(result, message.roles[place].number)
    return bytes(result)


def _byte(role: Role, numbers: Mapping[str, int], words: Mapping[int, int]) -> int:
    if role.kind == "constant":
        return role.number
    if role.kind == "word":
        return words.get(role.number >> 1, 0) >> (0 if role.number & 1 else 8) & 0xFF
    return numbers.get(role.kind, 0) >> (0 if role.kind == "multiplexer" else role.number) & 0xFF


def differences(message: Message, unit: int, frame: CanFrame) -> tuple[Difference, ...]:
    """Return the wrong bytes of a frame of the right length for this message and unit, apart from checksums."""
    result = []
    for place, (role, here) in enumerate(zip(message.roles, frame.data, strict=True)):
        if role.kind in _STATUSES:
            due = _byte(role, {"unit": unit}, _NO_WORDS)
            result += [Difference(place, role.kind, here, due)] if here != due else []
    return tuple(result)


def sums(message: Message, data: bytes) -> tuple[bytes, bytes]:
    """Return the checksums in the data of a message, and the right ones for its other bytes."""
    masks = {place: message.roles[place].number for place in places(message, "xor")}
    return bytes([data[place] for place in masks]), bytes([checksum(data, mask) for mask in masks.values()])


def parse(message: Message, unit: int, frame: CanFrame) -> Parsed:
    """Return the frame as this message of this unit. Any bytes at any length are safe; the first failure wins.

    `wrong_id`, `wrong_length` (not 8 bytes), `wrong_constant`, `wrong_unit`, `wrong_check`.
    """
    if frame.id != identifier(message, unit):
        return Parsed("wrong_id")
    if len(frame.data) != LENGTH:
        return Parsed("wrong_length")
    wrong = {difference.kind for difference in differences(message, unit, frame)}
    for kind, status in _STATUSES.items():
        if kind in wrong:
            return Parsed(status)
    here, right = sums(message, frame.data)
    if here != right:
        return Parsed("wrong_check")
    return Parsed("ok", carried(message, frame, "address"), carried(message, frame, "raw"))


@dataclass(slots=True)
class _Slot:
    """The last and the previous words of one multiplexer value; `at` and `before` are numbers of frames, 0 for none."""

    words: tuple[int, ...] = ()
    at: int = 0
    words_before: tuple[int, ...] = ()
    before: int = 0


class Receiver:
    """Collects the frames of one unit's telegram, and returns the received words."""

    def __init__(self, telegram: Telegram, message: Message, unit: int) -> None:
        self.message = message
        self.unit = unit
        self.per_frame = message.words
        self._clock = 0
        at = {role.number: place for place, role in enumerate(message.roles) if role.kind == "word"}
        words = dict.fromkeys(number // 2 for number in at)
        self._own = itemgetter(*[at.get(number, -1) for word in words for number in (2 * word, 2 * word + 1)])
        self._words_in = Struct(f">{len(words)}H").unpack
        firsts = range(0, telegram.words, self.per_frame)
        self.positions = [range(first, min(first + self.per_frame, telegram.words)) for first in firsts]
        """The positions of the words of a frame, for each multiplexer value."""
        self._slots = [_Slot() for _ in firsts]

    def take(self, frame: CanFrame) -> bool:
        """Keep the words of a frame; return False if it does not belong to the telegram."""
        place = carried(self.message, frame, "multiplexer")  # 0 without one
        belongs = parse(self.message, self.unit, frame).status == "ok" and place < len(self._slots)
        if belongs:
            self.keep(place, frame)
        return belongs

    def keep(self, place: int, frame: CanFrame) -> tuple[int, ...]:
        """Keep and return the words of a sound frame of the telegram, whose multiplexer is `place`."""
        self._clock += 1
        slot = self._slots[place]
        slot.words_before, slot.before = slot.words, slot.at
        data = frame.data + b"\0"  # the half of a word that no byte carries is 0
        slot.words, slot.at = self._words_in(bytes(self._own(data))), self._clock
        return slot.words

    def words(self, positions: Sequence[int]) -> tuple[str, tuple[int, ...]]:
        """Return the words at these positions, the high one first: ("ok", words), or "missing" or "torn" without words.

        Two words from two frames belong together if the same high word came before and after the low one. For more than
        two words, such as a text, the last ones count.
        """
        if len(positions) == 1:
            slot, word = self._slots[positions[0] // self.per_frame], positions[0] % self.per_frame
            return ("ok", (slot.words[word],)) if slot.at else ("missing", ())
        slots = [(self._slots[position // self.per_frame], position % self.per_frame) for position in positions]
        if any(slot.at == 0 for slot, _ in slots):
            return "missing", ()
        return _together(slots)


def _together(slots: list[tuple[_Slot, int]]) -> tuple[str, tuple[int, ...]]:
    (high, high_word), (low, low_word) = slots[0], slots[-1]
    if high is low or len(slots) > 2:
        return "ok", tuple(slot.words[word] for slot, word in slots)
    if high.before == 0 or high.words[high_word] != high.words_before[high_word]:
        return "torn", ()
    if high.before < low.at < high.at:
        return "ok", (high.words[high_word], low.words[low_word])
    if low.at > high.at and high.before < low.before < high.at:
        return "ok", (high.words[high_word], low.words_before[low_word])
    return "torn", ()
