"""The words of a USS telegram: the parameter part with its task or response, and process data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families.uss import of_bus
from fieldscribe.user_errors import UnclearError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.model import Bus, Device
    from fieldscribe.user_errors import Options


VARIABLE = 127
"""The setting of the parameter part whose length depends on the request."""
MASKS = 4
"""How many words of masks a broadcast has in place of the parameter part."""
READ_TASK = 1
_WRITES = {(1, False): (2, 14), (2, False): (3, 13), (1, True): (7, 12), (2, True): (8, 11)}
"""The tasks that write so many words, for an element of an array or not: into the RAM, and into the EEPROM too."""
TASK_WIDTHS = {task: width for (width, _), tasks in _WRITES.items() for task in tasks}
"""How many words of value the tasks that change something carry."""
KEEPING_TASKS = frozenset(keeping for _, keeping in _WRITES.values())
"""The tasks that also write to the EEPROM."""
RESPONSE_WIDTHS = {1: 1, 2: 2, 4: 1, 5: 2, 6: 1}
"""How many words of value the responses carry."""
SIZE, REFUSED, NO_RIGHTS = 6, 7, 8
"""The responses with the number of elements, and those that refuse a task."""
DOUBLE_RESPONSES = frozenset(response for response, width in RESPONSE_WIDTHS.items() if width == 2)
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
class Part:
    """A parameter part: the task or response, the parameter and its index, and the words of the value."""

    code: int
    parameter: int
    index: int
    values: tuple[int, ...]
    spontaneous: bool

    def value(self, width: int, link: Link) -> int | None:
        """The value of one or two words; None where there are too few, or none at all."""
        if width == 2:
            return self.values[0] << 16 | self.values[1] if len(self.values) > 1 else None
        place = 1 if link.single_last else 0
        return self.values[place] if width and len(self.values) > place else None


@dataclass(frozen=True, slots=True)
class Split:
    """The words of the parameter part, those of process data, and whether their count is that of the link."""

    part: tuple[int, ...]
    words: tuple[int, ...]
    fits: bool


def parameter_words(task: int, parameter: int, index: int) -> tuple[int, int]:
    """The words that name a task and an element of a parameter: identification and index."""
    page, number = divmod(parameter, _PAGE)
    pages = sum((page >> bit & 1) << place for bit, place in enumerate(_PAGE_BITS))
    return task << 12 | number, pages | index


def part_of(words: Sequence[int]) -> Part | None:
    """The parameter part in these words; None for fewer than two."""
    if len(words) < 2:
        return None
    identification, place = words[:2]
    page = 0
    for weight, bit in enumerate(_PAGE_BITS):
        page |= (place >> bit & 1) << weight
    number = (identification & 0x07FF) + _PAGE * page
    return Part(identification >> 12, number, place & 0xFF, tuple(words[2:]), bool(identification & 0x0800))


def split(words: tuple[int, ...], link: Link, *, request: bool) -> Split:
    """The two parts of a telegram; a variable parameter part has 3 or 4 words in a request, 3 or more in an answer."""
    left = len(words) - link.pzd
    if link.pkw != VARIABLE:
        return Split(words[: link.pkw], words[link.pkw :], left == link.pkw)
    size = len(words) if left <= 0 else min(left, 4) if request else left
    return Split(words[:size], words[size:], left >= 3 and (left <= 4 or not request))


def write_task(width: int, *, array: bool, keep: bool) -> int:
    """The task that writes a value of this many words: into the RAM, with `keep` also into the EEPROM."""
    return _WRITES[width, array][keep]


_USUAL_PZD = 2


@dataclass(frozen=True, slots=True)
class Asked:
    """The options of the family; None for those that were not given."""

    pkw: int | None = None
    pzd: int | None = None
    single_first: bool = False
    direction: str | None = None
    keep: bool = False


def asked(options: Options) -> Asked:
    """The options for the link and the telegrams."""
    return Asked(**options.own)


def default_link(bus: Bus) -> Link:
    """A parameter part of variable length (or the device's longest) and two words of process data."""
    own = of_bus(bus)
    low, high = own.pzd
    return Link(VARIABLE if VARIABLE in own.pkw or not own.pkw else own.pkw[-1], min(max(_USUAL_PZD, low), high))


def link_of(device: Device, options: Options) -> Link:
    """The link that the options choose. Raises UnclearError."""
    usual, own, said = default_link(device.bus), of_bus(device.bus), asked(options)
    if said.pkw is not None and said.pkw not in own.pkw:
        known = ", ".join(map(str, own.pkw))
        raise UnclearError(f"--pkw {said.pkw}: {device.id} knows no parameter part of this length", f"it has {known}")
    low, high = own.pzd
    if said.pzd is not None and not low <= said.pzd <= high:
        raise UnclearError(f"--pzd {said.pzd}: {device.id} has {low} to {high} words of process data")
    pkw = usual.pkw if said.pkw is None else said.pkw
    return Link(pkw, usual.pzd if said.pzd is None else said.pzd, said.single_first)
