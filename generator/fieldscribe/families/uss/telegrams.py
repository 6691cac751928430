"""USS telegrams: builds their bytes, and reads bytes as answers. Pure functions, no I/O."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.uss.facts import FAMILY, of_bus

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.model import Bus

START = 0x02
VARIABLE = 127
"""The setting of the parameter part whose length depends on the request."""
LAST_PARAMETER = FAMILY.last_address
READ_TASK = 1
DOUBLE_RESPONSES = frozenset({2, 5})
_REFUSED, _NO_RIGHTS = 7, 8
_PAGE = 2000
_PAGE_BITS = (15, 12, 13, 14)
"""The bits of the index word that hold the page of the parameter number, from its lowest bit on."""


@dataclass(frozen=True, slots=True)
class Link:
    """The settings of a link: the words of the parameter part and of process data.

    `single_first`: the firmware that keeps single words in the first value word although the part has 4 words.
    """

    pkw: int
    pzd: int
    single_first: bool = False

    @property
    def sent(self) -> int:
        """How many words of the parameter part a master sends."""
        return 4 if self.pkw == VARIABLE else self.pkw

    @property
    def single_last(self) -> bool:
        """Whether a single value stands in the second value word."""
        return self.pkw == 4 and not self.single_first


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
    """An answer; `error` only if `status` is refused."""

    status: str
    response: int = 0
    width: int = 0
    value: int = 0
    error: int = 0
    words: tuple[int, ...] = ()


def check_byte(data: bytes) -> int:
    """The block check character: all bytes combined by exclusive or."""
    result = 0
    for byte in data:
        result ^= byte
    return result


def telegram(address: int, words: Sequence[int]) -> bytes:
    """The bytes of a telegram with these words."""
    data = b"".join(word.to_bytes(2, "big") for word in words)
    body = bytes((START, len(data) + 2, address)) + data
    return body + bytes((check_byte(body),))


def parameter_words(task: int, parameter: int, index: int) -> tuple[int, int]:
    """The words that name a task and an element of a parameter: identification and index."""
    page, number = divmod(parameter, _PAGE)
    pages = sum((page >> bit & 1) << place for bit, place in enumerate(_PAGE_BITS))
    return task << 12 | number, pages | index


def write_task(width: int, *, array: bool, keep: bool) -> int:
    """The task that writes a value of this many words: into the RAM, with `keep` also into the EEPROM."""
    tasks = {(1, False): (2, 14), (2, False): (3, 13), (1, True): (7, 12), (2, True): (8, 11)}
    return tasks[width, array][keep]


def build(bus: Bus, link: Link, request: Request) -> tuple[str, bytes]:
    """The bytes of a request; (status, b"") when it must not be sent.

    The first failure wins: `bad_link` (a length that the device does not know, or other words of process data),
    `bad_unit`, `bad_task`, `bad_parameter`, `bad_index`, `bad_value` (also a double value where there is no room).
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


def _bad_link(bus: Bus, link: Link, words: tuple[int, ...]) -> bool:
    low, high = of_bus(bus).pzd
    return link.pkw not in of_bus(bus).pkw or len(words) != link.pzd or not low <= link.pzd <= high


def _refusal(bus: Bus, link: Link, request: Request) -> str:
    if _bad_link(bus, link, request.words):
        return "bad_link"
    low, high = bus.units
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
    """A telegram to all units: four words of masks and the process data; (`bad_link`, b"") if these do not fit."""
    low, high = of_bus(bus).pzd
    if bus.broadcast is None or len(mask) != 4 or len(words) != link.pzd or not low <= link.pzd <= high:
        return "bad_link", b""
    if not all(0 <= word <= 0xFFFF for word in (*mask, *words)):
        return "bad_value", b""
    return "ok", telegram(bus.broadcast, (*mask, *words))


def parse(bus: Bus, link: Link, request: Request, data: bytes) -> Reply:
    """`data` read as the answer to `request`. Any bytes at any length are safe; the first failure wins.

    `wrong_start`, `wrong_length`, `wrong_check`, `wrong_unit`, `wrong_parameter`, `no_answer`, `refused` (with the
    error), `no_rights`, `wrong_response` (one that does not belong to the task), `wrong_length` (a double value in too
    few words).
    """
    received = tuple(int.from_bytes(data[at : at + 2], "big") for at in range(3, len(data) - 1, 2))
    pkw = len(received) - link.pzd
    fault = _envelope_fault(link, request, data, pkw)
    if fault is not None:
        return Reply(fault)
    words = received[pkw:]
    if link.pkw == 0:
        return Reply("ok", words=words)
    response = received[0] >> 12
    if request.task == 0:
        return Reply("ok", response, words=words)
    fault = _answer_fault(bus, request, received[:pkw])
    if fault is not None:
        return Reply(fault, response, error=received[2]) if fault == "refused" else Reply(fault)
    if response in DOUBLE_RESPONSES:
        return Reply("ok", response, 2, received[2] << 16 | received[3], words=words)
    return Reply("ok", response, 1, received[3 if link.single_last else 2], words=words)


def _envelope_fault(link: Link, request: Request, data: bytes, pkw: int) -> str | None:
    """What is wrong with the bytes as a telegram whose parameter part has `pkw` words."""
    if not data or data[0] != START:
        return "wrong_start"
    whole = len(data) >= 4 and data[1] + 2 == len(data) and len(data) % 2 == 0
    if not whole or (pkw < 3 if link.pkw == VARIABLE else pkw != link.pkw):
        return "wrong_length"
    if check_byte(data) != 0:
        return "wrong_check"
    return None if data[2] == request.unit else "wrong_unit"


def _answer_fault(bus: Bus, request: Request, pkw: tuple[int, ...]) -> str | None:
    """Why a parameter part is no good answer."""
    response = pkw[0] >> 12
    if response == 0:
        return "no_answer"
    if (pkw[0] & 0x0FFF, pkw[1]) != parameter_words(0, request.parameter, request.index):
        return "wrong_parameter"
    if response in (_REFUSED, _NO_RIGHTS):
        return "refused" if response == _REFUSED else "no_rights"
    if not any(code.number == request.task and response in code.answers for code in bus.functions):
        return "wrong_response"
    return "wrong_length" if response in DOUBLE_RESPONSES and len(pkw) < 4 else None
