# SPDX-License-Identifier: 0BSD
"""USS telegrams as bytes, without any I/O. Any bytes of any length are safe to parse."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..arguments import check_bytes, check_integer, check_number, shown
from ..errors import FrameError, RefusedError, RequestError
from ..receiving import Framing
from ..records import Record

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ..facts import Telegram

START = 0x02
VARIABLE = 127
"""The setting for a parameter part whose length follows from the request."""
NO_TASK, READ = 0, 1
USS = "uss"
"""The name of this framing in transports."""
RAM = {(1, False): 2, (2, False): 3, (1, True): 7, (2, True): 8}
"""The tasks that change a value in RAM, by its number of words and whether it is an element of an array."""
EEPROM = {(1, False): 14, (2, False): 13, (1, True): 12, (2, True): 11}
"""The tasks that change a value and keep it in EEPROM."""

_NO_ANSWER, _REFUSED, _NO_RIGHTS = 0, 7, 8
_DOUBLE = frozenset({2, 5})
_LEAST_PART = 3
_LAST_PARAMETER, _LAST_INDEX = 31999, 255
_PAGE = 2000
_PAGE_BITS = (15, 12, 13, 14)


class Link(Record):
    """The settings of a link: `pkw` words of the parameter part (127: variable), `pzd` words of process data.

    `single_first`: the firmware that keeps single words in the first value word although the part has 4 words.
    """

    pkw: int
    pzd: int
    single_first: bool = False

    @property
    def sent(self) -> int:
        """The number of words of the parameter part that are sent."""
        return 4 if self.pkw == VARIABLE else self.pkw

    @property
    def single_last(self) -> bool:
        """True if a single value stands in the second value word."""
        return self.pkw == 4 and not self.single_first


class Profile(Record):
    """What a device takes: unit numbers, the address byte for all of them, lengths, tasks with their answers.

    `errors` names the numbers with which tasks are refused, `telegrams` the process data. `pzd` holds for all variants
    together; `variant_pzd` says by axis and value which of them take less.
    """

    units: tuple[int, int]
    pkw: tuple[int, ...]
    pzd: tuple[int, int]
    tasks: Mapping[int, tuple[int, ...]]
    broadcast: int | None = None
    errors: Mapping[int, str] = {}
    telegrams: tuple[Telegram, ...] = ()
    variant_pzd: Mapping[tuple[str, str], tuple[int, int]] = {}


class Request(Record):
    """A request: a task for a parameter (or an element of one) with a value of `width` words, and process data."""

    unit: int
    task: int = NO_TASK
    parameter: int = 0
    index: int = 0
    width: int = 0
    value: int = 0
    words: tuple[int, ...] = ()


class Reply(Record):
    """An accepted answer: its response id, a value of `width` words (0 without a task), and process data."""

    response: int = 0
    width: int = 0
    value: int = 0
    words: tuple[int, ...] = ()


def _check_byte(data: bytes) -> int:
    result = 0
    for byte in data:
        result ^= byte
    return result


def _telegram(address: int, words: Sequence[int]) -> bytes:
    data = b"".join([word.to_bytes(2, "big") for word in words])
    body = bytes((START, len(data) + 2, address)) + data
    return body + bytes((_check_byte(body),))


def _named(task: int, parameter: int, index: int) -> tuple[int, int]:
    """The words that name a task and an element of a parameter."""
    page, number = divmod(parameter, _PAGE)
    pages = sum((page >> bit & 1) << place for bit, place in enumerate(_PAGE_BITS))
    return task << 12 | number, pages | index


def check_link(profile: Profile, link: Link, variants: Mapping[str, str | None]) -> None:
    """Raises RequestError (bad_link) if a device, of these variants as far as they are known, has no such link."""
    _check_part(profile, link)
    _check_length(profile.pzd, link, "the device")
    for axis, value in variants.items():
        if value is not None:
            _check_length(profile.variant_pzd.get((axis, value), profile.pzd), link, f"{axis} {value}")


def _check_part(profile: Profile, link: Link) -> None:
    if not isinstance(link, Link):
        raise RequestError("bad_link", f"the link is a Link, as Link(pkw=4, pzd=2), not {shown(link)}")
    check_integer("bad_link", "the length of the parameter part", link.pkw)
    if link.pkw not in profile.pkw:
        allowed = ", ".join(map(str, profile.pkw))
        raise RequestError("bad_link", f"the parameter part is {allowed} words long, not {shown(link.pkw)}")


def _check_length(limits: tuple[int, int], link: Link, whose: str) -> None:
    low, high = limits
    check_integer("bad_link", "the length of the process data", link.pzd)
    if not low <= link.pzd <= high:
        raise RequestError("bad_link", f"{whose} takes {low}..{high} words of process data, not {shown(link.pzd)}")


def _check_process_data(profile: Profile, link: Link, words: Sequence[int]) -> None:
    _check_length(profile.pzd, link, "the device")
    if not isinstance(words, (tuple, list)):
        raise RequestError("bad_value", f"process data is a tuple of words, not {shown(words)}")
    if len(words) != link.pzd:
        raise RequestError("bad_link", f"the link carries {link.pzd} words of process data, not {len(words)}")


def check_request(request: Request, profile: Profile, link: Link) -> None:
    """Raises RequestError if such a request must not be sent.

    The first failure decides: bad_link, bad_unit, bad_task, bad_parameter, bad_index, bad_value.
    """
    _check_part(profile, link)
    _check_process_data(profile, link, request.words)
    check_number("bad_unit", "unit", request.unit, profile.units)
    check_integer("bad_task", "task", request.task)
    if request.task not in profile.tasks:
        raise RequestError("bad_task", f"the device has no task {shown(request.task)}")
    if link.pkw == 0 and request.task != NO_TASK:
        raise RequestError("bad_task", "the link carries no parameters")
    check_number("bad_parameter", "parameter", request.parameter, (0, _LAST_PARAMETER))
    check_number("bad_index", "index", request.index, (0, _LAST_INDEX))
    for number in (request.width, request.value, *request.words):
        check_integer("bad_value", "a value", number)
    if request.width == 2 and link.sent < 4:
        raise RequestError("bad_value", "the link has no room for double words")
    largest = (1 << 16 * request.width) - 1 if request.width in (0, 1, 2) else -1
    if not 0 <= request.value <= largest or not all(0 <= word <= 0xFFFF for word in request.words):
        text = f"a value does not fit: {shown(request.value)} into {shown(request.width)} words, or a word"
        raise RequestError("bad_value", text)


def build(request: Request, profile: Profile, link: Link) -> bytes:
    """The bytes of a request; raises RequestError if it must not be sent."""
    check_request(request, profile, link)
    high, low = divmod(request.value, 0x10000)
    if request.width == 1:
        high, low = (0, low) if link.single_last else (low, 0)
    part = (*_named(request.task, request.parameter, request.index), high, low)[: link.sent]
    return _telegram(request.unit, (*part, *request.words))


def broadcast(mask: tuple[int, ...], words: tuple[int, ...], profile: Profile, link: Link) -> bytes:
    """Process data for all units, which nobody answers; four words of `mask` say which words and bits count.

    Raises RequestError (bad_link, bad_value).
    """
    _check_process_data(profile, link, words)
    if profile.broadcast is None or not isinstance(mask, (tuple, list)) or len(mask) != 4:
        raise RequestError("bad_link", "a broadcast takes 4 words of mask, and a device that knows it")
    for word in (*mask, *words):
        check_number("bad_value", "a word", word, (0, 0xFFFF))
    return _telegram(profile.broadcast, (*mask, *words))


def reply_size(received: bytes) -> int | None:
    """Return the length of the reply that begins with these bytes; None while they are too few to tell."""
    return received[1] + 2 if len(received) >= 2 else None


FRAMING = Framing(reply_size, lambda telegram: telegram[2] if len(telegram) > 2 else -1, shortest=4, longest=257)
"""Return what a receiver needs to know about telegrams."""


def parse(request: Request, reply: bytes, profile: Profile, link: Link) -> Reply:
    """Return the content of a reply to `request`.

    Raises FrameError, the first failure deciding: wrong_start, wrong_length, wrong_check, wrong_unit, no_answer,
    wrong_parameter, refused (RefusedError, with the device's number), no_rights, wrong_response. From no_answer on the
    error holds the process data, which came nevertheless.
    """
    check_bytes(reply)
    words = _opened(request, reply, link)
    part, data = words[: len(words) - link.pzd], words[len(words) - link.pzd :]
    if not part:
        return Reply(words=data)
    if len(part) < _LEAST_PART:
        raise FrameError("wrong_length", f"a parameter part of {len(part)} words is of no link")
    response = part[0] >> 12
    if request.task == NO_TASK:
        return Reply(response, words=data)
    try:
        _check_answer(request, part, profile)
    except FrameError as error:
        error.words = data
        raise
    if response in _DOUBLE:
        return Reply(response, 2, part[2] << 16 | part[3], data)
    return Reply(response, 1, part[3 if link.single_last else 2], data)


def _opened(request: Request, reply: bytes, link: Link) -> tuple[int, ...]:
    """Return the words of a reply whose bytes are a valid telegram of the right unit and length."""
    if not reply or reply[0] != START:
        raise FrameError("wrong_start", "the reply does not begin with 02h")
    size = len(reply)
    whole = size >= 4 and reply[1] + 2 == size and size % 2 == 0
    part = (size - 4) // 2 - link.pzd
    if not whole:
        raise FrameError("wrong_length", f"{size} bytes are no whole reply")
    if part < 3 if link.pkw == VARIABLE else part != link.pkw:
        least = "at least " if link.pkw == VARIABLE else ""
        belong = 4 + 2 * ((3 if least else link.pkw) + link.pzd)
        text = f"the reply has {size} bytes where {least}{belong} belong: is the link of the device set so?"
        raise FrameError("wrong_length", text)
    if _check_byte(reply) != 0:
        raise FrameError("wrong_check", "the check of the reply is wrong")
    if reply[2] != request.unit:
        raise FrameError("wrong_unit", f"unit {reply[2]} answered instead of {request.unit}")
    return tuple([int.from_bytes(reply[at : at + 2], "big") for at in range(3, size - 1, 2)])


def _check_answer(request: Request, part: tuple[int, ...], profile: Profile) -> None:
    """Raises FrameError if a parameter part does not answer the task."""
    response = part[0] >> 12
    if response == _NO_ANSWER:
        raise FrameError("no_answer", "the device has not answered the task yet")
    if (part[0] & 0x0FFF, part[1]) != _named(0, request.parameter, request.index):
        raise FrameError("wrong_parameter", "the reply is for another parameter")
    if response == _REFUSED:
        raise RefusedError(part[2], profile.errors.get(part[2]))
    if response == _NO_RIGHTS:
        raise FrameError("no_rights", "the device does not let this master change parameters")
    if response not in profile.tasks.get(request.task, ()):
        raise FrameError("wrong_response", f"response {response} does not belong to task {request.task}")
    if response in _DOUBLE and len(part) < 4:
        raise FrameError("wrong_length", "the reply has no room for the double word that it announces")
