"""The words of a USS telegram, the parameter part with its task or response and process data, and the link's settings.

Tasks and responses of the protocol are listed here once; frames, checks and targets read these tables.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from fieldscribe.families.frame_results import Options
from fieldscribe.families.uss import of_bus
from fieldscribe.model import Bus, Device
from fieldscribe.user_errors import UnclearError

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
    pkw, pzd = options.own.get("pkw", usual.pkw), options.own.get("pzd", usual.pzd)
    if "pkw" in options.own and pkw not in lengths:
        message = f"--pkw {pkw}: {device.id} knows no parameter part of this length"
        raise UnclearError(message, f"it has {', '.join(map(str, lengths))}")
    if not low <= pzd <= high:
        raise UnclearError(f"--pzd {pzd}: {device.id} has {low} to {high} words of process data")
    return Link(pkw, pzd, options.own.get("single_first", False))


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
