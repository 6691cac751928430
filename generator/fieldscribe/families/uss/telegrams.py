"""USS telegrams: builds their bytes, and reads bytes as responses. Pure functions, no I/O."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache, reduce
from operator import xor

from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.decoded_frame import cut_apart
from fieldscribe.families.uss import FAMILY, of_bus, parts
from fieldscribe.model import Bus

START = 0x02
LAST_PARAMETER = FAMILY.last_address
LEAST_BYTES = 4


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
    return cut_apart(data, sound_size, LEAST_BYTES) if unwrap(data).flaws else [data]


def sound_size(data: bytes) -> int:
    """Return the size of the telegram that the bytes begin with; 0 if its start, length or check byte is wrong."""
    size = data[1] + 2 if len(data) > 1 and data[0] == START else 0
    return size if 0 < size <= len(data) and not unwrap(data[:size]).flaws else 0


def bare_words(data: bytes) -> Unwrapped:
    """Return the words of a single part."""
    whole = len(data) > 0 and len(data) % 2 == 0
    return Unwrapped(data, None, words_in(data) if whole else None, () if whole else ("no_words",))


def request_in(unit: int, part: parts.Part, link: parts.Link, words: tuple[int, ...]) -> Request:
    """Return the request in a parameter part and process data."""
    width = parts.TASK_WIDTHS.get(part.code, 0)
    return Request(unit, part.code, part.parameter, part.index, width, part.value(width, link) or 0, words)


def build(bus: Bus, link: parts.Link, request: Request) -> tuple[str, bytes]:
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
        words = (*parts.parameter_words(request.task, request.parameter, request.index), high, low)[: link.sent]
    return "ok", telegram(request.unit, (*words, *request.words))


def _refusal(bus: Bus, link: parts.Link, request: Request) -> str:
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


def broadcast(bus: Bus, link: parts.Link, mask: tuple[int, ...], words: tuple[int, ...]) -> tuple[str, bytes]:
    """Return a telegram to all units: four words of masks and the process data; (status, b"") if these do not fit."""
    low, high = of_bus(bus).pzd
    if bus.broadcast is None or len(mask) != parts.MASKS or len(words) != link.pzd or not low <= link.pzd <= high:
        return "bad_link", b""
    if not all(0 <= word <= 0xFFFF for word in (*mask, *words)):
        return "bad_value", b""
    return "ok", telegram(bus.broadcast, (*mask, *words))


def parse(bus: Bus, link: parts.Link, request: Request, data: bytes) -> Reply:
    """Return `data` as the response to `request`. Any bytes at any length are safe; the first failure wins.

    `wrong_start`, `wrong_length`, `wrong_check`, `wrong_unit`, `wrong_parameter`, `no_answer`, `refused` (with the
    error), `no_rights`, `wrong_response` (one that does not belong to the task), `wrong_length` (a double value in too
    few words).
    """
    unwrapped = unwrap(data)
    if data[:1] != bytes((START,)):
        return Reply("wrong_start")
    words = unwrapped.words or ()
    if set(unwrapped.flaws) - {"wrong_check"} or not parts.split(words, link, request=False).fits:
        return Reply("wrong_length")
    if unwrapped.flaws:
        return Reply("wrong_check")
    return answer_in(bus, link, request, words) if unwrapped.unit == request.unit else Reply("wrong_unit")


def answer_in(bus: Bus, link: parts.Link, request: Request, received: tuple[int, ...]) -> Reply:
    """Return what `parse` returns, for the words of a telegram."""
    divided = parts.split(received, link, request=False)
    if not divided.fits:
        return Reply("wrong_length")
    part, words = parts.part_of(divided.part), divided.words
    if part is None:
        return Reply("ok", words=words)
    if request.task == 0:
        return Reply("ok", part.code, words=words)
    fault = _answer_fault(bus, request, divided.part)
    if fault is not None:
        return Reply(fault, part.code, error=part.values[0]) if fault == "refused" else Reply(fault)
    width = 2 if part.code in parts.DOUBLE_RESPONSES else 1
    return Reply("ok", part.code, width, part.value(width, link) or 0, words=words)


def _answer_fault(bus: Bus, request: Request, pkw: tuple[int, ...]) -> str | None:
    """Return why a parameter part is not a good response; None if it is."""
    response = pkw[0] >> 12
    if response == 0:
        return "no_answer"
    if (pkw[0] & 0x0FFF, pkw[1]) != parts.parameter_words(0, request.parameter, request.index):
        return "wrong_parameter"
    if response in (parts.REFUSED, parts.NO_RIGHTS):
        return "refused" if response == parts.REFUSED else "no_rights"
    if not any(code.number == request.task and response in code.answers for code in bus.functions):
        return "wrong_response"
    return "wrong_length" if response in parts.DOUBLE_RESPONSES and len(pkw) < 4 else None
