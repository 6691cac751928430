"""USS telegrams: builds their bytes, and reads bytes as responses. Pure functions, no I/O.

The words of a telegram are the parameter part, with its task or response, and process data. Tasks and responses of the
protocol, and the settings of a link, are listed here once; frames, checks and targets read these tables.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache, reduce
from operator import xor

from fieldscribe.arithmetic.words import words_in
from fieldscribe.diagnostics import UnclearError
from fieldscribe.families.decoded_frame import split_frames
from fieldscribe.families.frame_results import Options
from fieldscribe.families.uss import FAMILY, of_bus
from fieldscribe.model import Bus, Device

START = 0x02
LAST_PARAMETER = FAMILY.last_address
LEAST_BYTES = 4

VARIABLE = 127
"""The setting of the parameter part whose length depends on the request."""
SHORT = 3
"""The words of a parameter part that carries values of one word only."""
MASKS = 4
"""The words of masks that a broadcast has instead of a parameter part."""
READ_TASK, READ_ELEMENT_TASK = 1, 6
_WRITE_TASKS = {(1, False): (2, 14), (2, False): (3, 13), (1, True): (7, 12), (2, True): (8, 11)}
"""The tasks that write this many words, to an array element or not: to the RAM, and also to the EEPROM."""
TASK_WIDTHS = {task: width for (width, _), tasks in _WRITE_TASKS.items() for task in tasks}
"""The words of value in the tasks that write."""
EEPROM_TASKS = frozenset(eeprom for _, eeprom in _WRITE_TASKS.values())
RESPONSE_WIDTHS = {1: 1, 2: 2, 4: 1, 5: 2, 6: 1}
"""The words of value in the responses."""
SIZE, REFUSED, NO_RIGHTS = 6, 7, 8
"""The responses with the number of elements, and those that refuse a task."""
DOUBLE_RESPONSES = frozenset(response for response, width in RESPONSE_WIDTHS.items() if width == 2)
_PAGE = 2000
_PAGE_BITS = (15, 12, 13, 14)
"""The bits of the index word that hold the page of the parameter number, from its lowest bit on."""


def write_task(width: int, *, array: bool, keep: bool) -> int:
    """Return the task that writes a value of this many words: to the RAM, with `keep` also to the EEPROM."""
    return _WRITE_TASKS[width, array][keep]


# Links, and the words of a telegram.


@dataclass(frozen=True, slots=True)
class Link:
    """The settings of a link: the words of the parameter part and of process data.

    `single_first`: this firmware puts single words into the first value word although the part has 4 words.
    """

    pkw: int
    pzd: int
    single_first: bool = False

    @property
    def sent(self) -> int:
        """The number of words of the parameter part that a master sends."""
        return 4 if self.pkw == VARIABLE else self.pkw

    @property
    def single_last(self) -> bool:
        """True if a single value is in the second value word."""
        return self.pkw == 4 and not self.single_first


def default_link(bus: Bus) -> Link:
    """Return the usual link: a parameter part of variable length (or the longest), two words of process data."""
    lengths, (low, high) = of_bus(bus).pkw, of_bus(bus).pzd
    return Link(VARIABLE if VARIABLE in lengths or not lengths else lengths[-1], min(max(2, low), high))


def link_of(device: Device, options: Options) -> Link:
    """Return the link that the options choose. Raises UnclearError."""
    usual, lengths, (low, high) = default_link(device.bus), of_bus(device.bus).pkw, of_bus(device.bus).pzd
    pkw, pzd = options.of_family.get("pkw", usual.pkw), options.of_family.get("pzd", usual.pzd)
    if "pkw" in options.of_family and pkw not in lengths:
        message = f"--pkw {pkw}: {device.id} knows no parameter part of this length"
        raise UnclearError(message, f"it has {', '.join(map(str, lengths))}")
    if not low <= pzd <= high:
        raise UnclearError(f"--pzd {pzd}: {device.id} has {low} to {high} words of process data")
    return Link(pkw, pzd, options.of_family.get("single_first", False))


@dataclass(frozen=True, slots=True)
class Part:
    """A parameter part: the task or response, the parameter and its index, and the words of the value."""

    code: int
    parameter: int
    index: int
    values: tuple[int, ...]
    spontaneous: bool

    def value(self, width: int, link: Link) -> int | None:
        """Return the value of one or two words; None if there are too few words, or `width` is 0."""
        if width == 2:
            return self.values[0] << 16 | self.values[1] if len(self.values) > 1 else None
        place = 1 if link.single_last else 0
        return self.values[place] if width and len(self.values) > place else None


def parameter_words(task: int, parameter: int, index: int) -> tuple[int, int]:
    """Return the words that name a task and an element of a parameter: identification and index."""
    page, number = divmod(parameter, _PAGE)
    pages = sum((page >> bit & 1) << place for bit, place in enumerate(_PAGE_BITS))
    return task << 12 | number, pages | index


def part_of(words: Sequence[int]) -> Part | None:
    """Return the parameter part in these words; None for fewer than two."""
    if len(words) < 2:
        return None
    identification, place = words[:2]
    page = sum((place >> bit & 1) << weight for weight, bit in enumerate(_PAGE_BITS))
    number = (identification & 0x07FF) + _PAGE * page
    return Part(identification >> 12, number, place & 0xFF, tuple(words[2:]), bool(identification & 0x0800))


@dataclass(frozen=True, slots=True)
class Split:
    """The words of the parameter part, those of process data, and whether their number is that of the link."""

    part: tuple[int, ...]
    words: tuple[int, ...]
    fits: bool


def split(words: tuple[int, ...], link: Link, *, request: bool) -> Split:
    """Split the words of a telegram; a variable part has 3 or 4 words in a request, 3 or more in a response."""
    left = len(words) - link.pzd
    if link.pkw != VARIABLE:
        return Split(words[: link.pkw], words[link.pkw :], left == link.pkw)
    size = len(words) if left <= 0 else min(left, 4) if request else left
    return Split(words[:size], words[size:], left >= SHORT and (left <= 4 or not request))


# The bytes of a telegram.


@dataclass(frozen=True, slots=True)
class Unwrapped:
    """Bytes with the words of their telegram; `words` is None if they cannot be read.

    `flaws`: `short`, else `wrong_start`, `no_check` or else `wrong_length` and `wrong_check`, `odd` (a single last
    byte); `no_words` for a part alone.
    """

    data: bytes
    unit: int | None
    words: tuple[int, ...] | None
    flaws: tuple[str, ...] = ()


def check_byte(data: bytes) -> int:
    """Return the block check character: the exclusive or of all bytes."""
    return reduce(xor, data, 0)


def telegram(address: int, words: Sequence[int]) -> bytes:
    """Return the bytes of a telegram with these words."""
    data = b"".join(word.to_bytes(2, "big") for word in words)
    body = bytes((START, len(data) + 2, address)) + data
    return body + bytes((check_byte(body),))


@lru_cache(maxsize=16)  # called when pasted bytes are cut into telegrams, and again when these are decoded
def unwrap(data: bytes) -> Unwrapped:
    """Return the words of a whole telegram, with all its flaws. Any bytes are safe."""
    if len(data) < LEAST_BYTES:
        return Unwrapped(data, None, None, ("short",))
    flaws, body = ["wrong_start"] if data[0] != START else [], data[3:-1]
    if data[1] == len(data) - 1 and len(data) % 2:
        flaws, body = [*flaws, "no_check"], data[3:]
    else:
        flaws += ["wrong_length"] if data[1] + 2 != len(data) else []
        flaws += ["wrong_check"] if check_byte(data) else []
    return Unwrapped(data, data[2], words_in(body), (*flaws, *(("odd",) if len(body) % 2 else ())))


def frames_in(data: bytes) -> list[bytes]:
    """Return the telegrams in pasted bytes: several if whole ones follow each other, by length and check byte."""
    return split_frames(data, sound_size, LEAST_BYTES) if unwrap(data).flaws else [data]


def sound_size(data: bytes) -> int:
    """Return the size of the telegram that the bytes begin with; 0 if its start, length or check byte is wrong."""
    size = data[1] + 2 if len(data) > 1 and data[0] == START else 0
    return size if 0 < size <= len(data) and not unwrap(data[:size]).flaws else 0


def bare_words(data: bytes) -> Unwrapped:
    """Return the words of a single part."""
    whole = len(data) > 0 and len(data) % 2 == 0
    return Unwrapped(data, None, words_in(data) if whole else None, () if whole else ("no_words",))


# Requests and responses.


@dataclass(frozen=True, slots=True)
class Request:
    """A request: a task for one element of a parameter, with a value of `width` words."""

    unit: int
    task: int
    parameter: int = 0
    index: int = 0
    width: int = 0
    value: int = 0
    words: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Reply:
    """A response; `error` only if `status` is refused."""

    status: str
    response: int = 0
    width: int = 0
    value: int = 0
    error: int = 0
    words: tuple[int, ...] = ()


def request_in(unit: int, part: Part, link: Link, words: tuple[int, ...]) -> Request:
    """Return the request in a parameter part and process data."""
    width = TASK_WIDTHS.get(part.code, 0)
    return Request(unit, part.code, part.parameter, part.index, width, part.value(width, link) or 0, words)


def build(bus: Bus, link: Link, request: Request) -> tuple[str, bytes]:
    """Return ("ok", the bytes of a request), or (status, b"") if it must not be sent.

    The first failure wins: `bad_link` (a length that the device does not know, or other words of process data),
    `bad_unit`, `bad_task`, `bad_parameter`, `bad_index`, `bad_value` (also a double value without room).
    """
    status = _refusal(bus, link, request)
    if status != "ok":
        return status, b""
    words: tuple[int, ...] = ()
    if link.sent:
        high, low = divmod(request.value, 0x10000)
        if request.width == 1:
            high, low = (0, low) if link.single_last else (low, 0)
        words = (*parameter_words(request.task, request.parameter, request.index), high, low)[: link.sent]
    return "ok", telegram(request.unit, (*words, *request.words))


def _refusal(bus: Bus, link: Link, request: Request) -> str:
    (least, most), (low, high) = of_bus(bus).pzd, bus.units
    if link.pkw not in of_bus(bus).pkw or len(request.words) != link.pzd or not least <= link.pzd <= most:
        return "bad_link"
    if not low <= request.unit <= high:
        return "bad_unit"
    if request.task not in {code.number for code in bus.functions} or (link.pkw == 0 and request.task != 0):
        return "bad_task"
    if not 0 <= request.parameter <= LAST_PARAMETER:
        return "bad_parameter"
    if not 0 <= request.index <= 255:
        return "bad_index"
    too_wide = request.width == 2 and link.sent < 4
    fits = 0 <= request.value < 1 << 16 * request.width if request.width else request.value == 0
    words_fit = all(0 <= word <= 0xFFFF for word in request.words)
    return "ok" if fits and words_fit and not too_wide else "bad_value"


def broadcast(bus: Bus, link: Link, mask: tuple[int, ...], words: tuple[int, ...]) -> tuple[str, bytes]:
    """Return a telegram to all units: four words of masks and the process data; (status, b"") if these do not fit."""
    low, high = of_bus(bus).pzd
    if bus.broadcast is None or len(mask) != MASKS or len(words) != link.pzd or not low <= link.pzd <= high:
        return "bad_link", b""
    if not all(0 <= word <= 0xFFFF for word in (*mask, *words)):
        return "bad_value", b""
    return "ok", telegram(bus.broadcast, (*mask, *words))


def parse(bus: Bus, link: Link, request: Request, data: bytes) -> Reply:
    """Return `data` as the response to `request`. Any bytes at any length are safe; the first failure wins.

    `wrong_start`, `wrong_length`, `wrong_check`, `wrong_unit`, `wrong_parameter`, `no_answer`, `refused` (with the
    error), `no_rights`, `wrong_response` (one that does not belong to the task), `wrong_length` (a double value in too
    few words).
    """
    unwrapped = unwrap(data)
    if data[:1] != bytes((START,)):
        return Reply("wrong_start")
    words = unwrapped.words or ()
    if set(unwrapped.flaws) - {"wrong_check"} or not split(words, link, request=False).fits:
        return Reply("wrong_length")
    if unwrapped.flaws:
        return Reply("wrong_check")
    return answer_in(bus, link, request, words) if unwrapped.unit == request.unit else Reply("wrong_unit")


def answer_in(bus: Bus, link: Link, request: Request, received: tuple[int, ...]) -> Reply:
    """Return what `parse` returns, for the words of a telegram."""
    divided = split(received, link, request=False)
    if not divided.fits:
        return Reply("wrong_length")
    part, words = part_of(divided.part), divided.words
    if part is None:
        return Reply("ok", words=words)
    if request.task == 0:
        return Reply("ok", part.code, words=words)
    fault = _answer_fault(bus, request, divided.part)
    if fault is not None:
        return Reply(fault, part.code, error=part.values[0]) if fault == "refused" else Reply(fault)
    width = 2 if part.code in DOUBLE_RESPONSES else 1
    return Reply("ok", part.code, width, part.value(width, link) or 0, words=words)


def _answer_fault(bus: Bus, request: Request, pkw: tuple[int, ...]) -> str | None:
    """Return why a parameter part is not a good response; None if it is."""
    response = pkw[0] >> 12
    if response == 0:
        return "no_answer"
    if (pkw[0] & 0x0FFF, pkw[1]) != parameter_words(0, request.parameter, request.index):
        return "wrong_parameter"
    if response in (REFUSED, NO_RIGHTS):
        return "refused" if response == REFUSED else "no_rights"
    if not any(code.number == request.task and response in code.answers for code in bus.functions):
        return "wrong_response"
    return "wrong_length" if response in DOUBLE_RESPONSES and len(pkw) < 4 else None
