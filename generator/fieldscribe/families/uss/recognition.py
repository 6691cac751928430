"""USS telegrams taken apart: the frame round the words, and the words of the parameter part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.uss.telegrams import START, VARIABLE, Link, check_byte
from fieldscribe.wording.buses import check_text, counted, too_short

if TYPE_CHECKING:
    from collections.abc import Sequence

TASK_WIDTHS = {2: 1, 3: 2, 7: 1, 8: 2, 11: 2, 12: 1, 13: 2, 14: 1}
"""How many words of value the tasks that change something carry."""
RESPONSE_WIDTHS = {1: 1, 2: 2, 4: 1, 5: 2, 6: 1}
"""How many words of value the responses carry; response 6 carries a count."""
KEEPING_TASKS = frozenset({11, 12, 13, 14})
"""The tasks that also write to the EEPROM."""
_PAGES = ((15, 1), (12, 2), (13, 4), (14, 8))
"""The bits of the index word that hold the page of the parameter number, with their weights."""
_PAGE = 2000
_LEAST_BYTES = 4


@dataclass(frozen=True, slots=True)
class Wrapped:
    """Bytes taken out of their telegram; `words` is None if they cannot be read. `checks` describes the check byte."""

    framing: str
    data: bytes
    unit: int | None
    words: tuple[int, ...] | None
    checks: str = ""
    faults: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Part:
    """A parameter part: the task or response, the parameter and its index, and the words of the value."""

    code: int
    parameter: int
    index: int
    values: tuple[int, ...]
    spontaneous: bool

    def value(self, width: int, link: Link) -> int | None:
        """The value of one or two words; None where there are too few."""
        if width == 2:
            return self.values[0] << 16 | self.values[1] if len(self.values) > 1 else None
        place = 1 if link.single_last else 0
        return self.values[place] if len(self.values) > place else None


def recognise(data: bytes, framing: str) -> Wrapped:
    """The words in the bytes of a whole telegram, or of a single part."""
    if framing == "uss":
        return _telegram(data)
    if not data or len(data) % 2:
        size = f"here {'is' if len(data) == 1 else 'are'} {counted(len(data), 'byte')}"
        return Wrapped(framing, data, None, None, faults=(f"the part is made of words of two bytes, {size}",))
    return Wrapped(framing, data, None, _words(data))


def part_of(words: Sequence[int]) -> Part | None:
    """The parameter part in these words; None for fewer than two."""
    if len(words) < 2:
        return None
    identification, place = words[:2]
    page = sum(weight for bit, weight in _PAGES if place >> bit & 1)
    number = (identification & 0x07FF) + _PAGE * page
    return Part(identification >> 12, number, place & 0xFF, tuple(words[2:]), bool(identification & 0x0800))


def split(words: tuple[int, ...], link: Link, *, request: bool) -> tuple[tuple[int, ...], tuple[int, ...], str]:
    """The words of the parameter part, those of process data, and what is wrong with their count (or empty)."""
    left = len(words) - link.pzd
    if link.pkw != VARIABLE:
        part, rest = words[: link.pkw], words[link.pkw :]
        if left != link.pkw:
            needed = f"{_count_text(len(words))}; a parameter part of {link.pkw} and {_pzd_text(link)}"
            return part, rest, f"{needed} make {link.pkw + link.pzd}"
        return part, rest, ""
    if left < 3 or (request and left > 4):
        most = 4 if request else left
        part = words[: max(0, min(left, most))] if left > 0 else words
        least = f"at least {3 + link.pzd}" if not request else f"{3 + link.pzd} or {4 + link.pzd}"
        return (
            part,
            words[len(part) :],
            f"{_count_text(len(words))}; a parameter part of variable length and {_pzd_text(link)} make {least}",
        )
    return words[:left], words[left:], ""


def _count_text(words: int) -> str:
    return f"it has {counted(words, 'word')}"


def _pzd_text(link: Link) -> str:
    return f"{counted(link.pzd, 'word')} of process data"


def _words(data: bytes) -> tuple[int, ...]:
    return tuple(int.from_bytes(data[at : at + 2], "big") for at in range(0, len(data) - 1, 2))


def _telegram(data: bytes) -> Wrapped:
    if len(data) < _LEAST_BYTES:
        return Wrapped("uss", data, None, None, faults=(too_short("a telegram", _LEAST_BYTES, data),))
    faults = []
    if data[0] != START:
        faults.append(f"a telegram begins with {START:02X}h, this with {data[0]:02X}h")
    right, whole = check_byte(data[:-1]), True
    checks = check_text(data[-1:], bytes((right,)))
    if data[1] == len(data) - 1 and len(data) % 2:
        checks = check_text(b"", bytes((check_byte(data),)))
        faults.append("the check byte is missing")
        whole = False
    else:
        if data[1] + 2 != len(data):
            faults.append(f"its length byte says {data[1] + 2} bytes, here are {len(data)}")
        if data[-1] != right:
            faults.append("the check byte is wrong")
    body = data[3:-1] if whole else data[3:]
    if len(body) % 2:
        faults.append("its data is no whole number of words")
    return Wrapped("uss", data, data[2], _words(body), checks, tuple(faults))
