# SPDX-License-Identifier: 0BSD
"""A multiplexed telegram as its frames come in, and which of its words belong together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..errors import FrameError, RequestError, TelegramError
from ..session import check_unit
from .frames import Frame, Message, Profile, check

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


@dataclass(slots=True)
class _Slot:
    """The words of one multiplexer number: the last ones and those before.

    `number` counts the taken frames, 0 is never; `moment` is what the caller said of the last one.
    """

    words: tuple[int, ...] = ()
    number: int = 0
    words_before: tuple[int, ...] = ()
    number_before: int = 0
    moment: float = 0.0


class Receiver:
    """Takes the frames of a telegram from one unit, and gives its words once they came.

    Raises RequestError `bad_unit` for one that the device cannot have.
    """

    def __init__(self, profile: Profile, telegram: str, unit: int) -> None:
        check_unit(unit, profile.units)
        layout = profile.telegram(telegram)
        self.telegram = layout.name
        self.unit = unit
        self._message = profile.message(layout.message)
        self._pairs = _pairs(self._message)
        self._count = 0
        self._slots = [_Slot() for _ in range(-(-layout.words // len(self._pairs)))]
        self._words = layout.words

    def take(self, frame: Frame, moment: float = 0.0) -> bool:
        """Whether the frame belongs to the telegram; if so its words are kept, with the `moment` when it came."""
        try:
            check(self._message, self.unit, frame)
        except FrameError:
            return False
        roles = zip(self._message.roles, frame.data, strict=True)
        place = next((byte for role, byte in roles if role.kind == "multiplexer"), 0)
        if place >= len(self._slots):
            return False
        self._count += 1
        slot = self._slots[place]
        slot.words_before, slot.number_before = slot.words, slot.number
        slot.words = tuple([frame.data[high] << 8 | frame.data[low] for high, low in self._pairs])
        slot.number, slot.moment = self._count, moment
        return True

    def word(self, position: int) -> int:
        """One word of the telegram, counted from 0; raises TelegramError `missing`."""
        return self.words((position,))[0]

    def newer(self, positions: Iterable[int], moment: float) -> bool:
        """Whether all frames with these words came at `moment` or later."""
        slots = [self._slot(position) for position in positions]
        return all(slot.number and slot.moment >= moment for slot in slots)

    def words(self, positions: Sequence[int]) -> tuple[int, ...]:
        """The words at these positions, the high one first; raises TelegramError, `missing` or `torn`.

        Two words of two frames are believed only when the same high word came before and after the low one: a counter
        may have moved on in between. Longer runs of words, such as texts, are given as they came last.
        """
        found = [(self._slot(position), position % len(self._pairs)) for position in positions]
        if any(slot.number == 0 for slot, _ in found):
            raise TelegramError("missing", f"not all frames of {self.telegram} with words {positions} came yet")
        (high, high_word), (low, low_word) = found[0], found[-1]
        if high is low or len(found) > 2:
            return tuple([slot.words[word] for slot, word in found])
        if high.number_before and high.words[high_word] == high.words_before[high_word]:
            if high.number_before < low.number < high.number:
                return high.words[high_word], low.words[low_word]
            if high.number_before < low.number_before < high.number < low.number:
                return high.words[high_word], low.words_before[low_word]
        raise TelegramError("torn", f"words {positions} of {self.telegram} may belong to different values")

    def _slot(self, position: int) -> _Slot:
        if not 0 <= position < self._words:
            raise RequestError("bad_address", f"{self.telegram} has {self._words} words, and none at {position}")
        return self._slots[position // len(self._pairs)]


def _pairs(message: Message) -> list[tuple[int, int]]:
    """Where the high and the low byte of each word of a frame are."""
    places = {role.number: place for place, role in enumerate(message.roles) if role.kind == "word"}
    return [(places[2 * word], places[2 * word + 1]) for word in range(len(places) // 2)]
