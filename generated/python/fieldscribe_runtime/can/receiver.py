# SPDX-License-Identifier: 0BSD
"""Collects a multiplexed telegram from its frames, and knows which of its words belong together."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..arguments import check_integer, check_name, shown
from ..errors import RequestError, TelegramError
from ..table import check_unit
from .frames import recognizer
from .signals import Packing

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from .frames import Frame, Message, Profile


class _Slot:
    """The last frame of one multiplexer number, and that before; of signals, the words that come together.

    `number` counts the taken frames, 0 is never; `moment` is what the caller said of the last one.
    """

    data: bytes = b""
    number: int = 0
    data_before: bytes = b""
    number_before: int = 0
    moment: float = 0.0


class Receiver:
    """Takes the frames of a telegram from one unit, and returns its words once they have come.

    Raises RequestError `bad_unit` for one that the device cannot have.
    """

    def __init__(self, profile: Profile, telegram: str, unit: int) -> None:
        check_unit(unit, profile.units)
        check_name("telegram", telegram)
        layout = profile.telegram(telegram)
        self.telegram = layout.name
        self.unit = unit
        self._message = profile.message(layout.message)
        self._count = 0
        self._packing = Packing(self._message.signals, self._message.length) if self._message.signals else None
        self._pairs, self._together = pairs_of(self._message), parts_of(self._message, layout.words)
        self._slots = [_Slot() for _ in self._together]
        self._part_of = [(part, at) for part, words in enumerate(self._together) for at in range(len(words))]
        """The part in which each word of the telegram comes, and its place there."""
        self._is_own = recognizer(self._message, unit)
        kinds = [role.kind for role in self._message.roles]
        self._multiplexer = kinds.index("multiplexer") if "multiplexer" in kinds else None

    def take(self, frame: Frame, moment: float = 0.0) -> bool:
        """Return True if the frame belongs to the telegram; its words are then kept, with the `moment` when it came."""
        if self._packing is None:
            return self._taken(frame, moment) is not None
        return bool(self._signals_taken(self._packing, frame, moment))

    def _taken(self, frame: Frame, moment: float) -> int | None:
        """Return the number of the frame within the telegram, from 0; None if it is another one."""
        try:
            if not self._is_own(frame):
                return None
        except (AttributeError, TypeError):
            raise _no_frame(frame) from None
        data = frame.data
        place = 0 if self._multiplexer is None else data[self._multiplexer]
        if place >= len(self._slots):
            return None
        self._count += 1
        slot = self._slots[place]
        slot.data_before, slot.number_before = slot.data, slot.number
        slot.data, slot.number, slot.moment = data, self._count, moment
        return place

    def _signals_taken(self, packing: Packing, frame: Frame, moment: float) -> Mapping[int, bytes]:
        """The parts of a telegram of signals that a frame brings, by number, with the bytes that hold their words."""
        try:
            if not self._is_own(frame):
                return {}
        except (AttributeError, TypeError):
            raise _no_frame(frame) from None
        self._count += 1
        parts = packing.coming(frame.data)
        for place, data in parts.items():
            slot = self._slots[place]
            slot.data_before, slot.number_before = slot.data, slot.number
            slot.data, slot.number, slot.moment = data, self._count, moment
        return parts

    def word(self, position: int) -> int:
        """One word of the telegram, counted from 0; raises TelegramError `missing`."""
        return self.words((position,))[0]

    def newer(self, positions: Iterable[int], moment: float) -> bool:
        """Return True if all frames with these words came at `moment` or later."""
        slots = [self._slot(position) for position in positions]
        return all(slot.number and slot.moment >= moment for slot in slots)

    def is_sent(self, moment: float) -> bool:
        """Return True if any frame of the telegram came at `moment` or later."""
        return any(slot.number and slot.moment >= moment for slot in self._slots)

    def words(self, positions: Sequence[int]) -> tuple[int, ...]:
        """The words at these positions, the high one first; raises TelegramError, `missing` or `torn`.

        Two words of two frames are accepted only if the same high word came before and after the low one: a counter
        may have moved on in between. Longer runs of words, such as texts, are given as they came last.
        """
        if not isinstance(positions, (tuple, list, range)) or not positions:
            raise RequestError("bad_address", f"takes positions of words, as in (0, 1), not {shown(positions)}")
        found = [(self._slot(position), self._part_of[position][1]) for position in positions]
        if any(slot.number == 0 for slot, _ in found):
            raise TelegramError("missing", f"not all frames of {self.telegram} with words {positions} came yet")
        (high, high_word), (low, low_word) = found[0], found[-1]
        if high is low or len(found) > 2:
            return tuple([self._word(slot.data, word) for slot, word in found])
        first = self._word(high.data, high_word)
        if high.number_before and first == self._word(high.data_before, high_word):
            if high.number_before < low.number < high.number:
                return first, self._word(low.data, low_word)
            if high.number_before < low.number_before < high.number < low.number:
                return first, self._word(low.data_before, low_word)
        raise TelegramError("torn", f"words {positions} of {self.telegram} may belong to different values")

    def _word(self, data: bytes, word: int) -> int:
        high, low = self._pairs[word]
        return data[high] << 8 | data[low]

    def _slot(self, position: int) -> _Slot:
        if type(position) is not int:
            check_integer("bad_address", "the position of a word", position)
        count = len(self._part_of)
        if not 0 <= position < count:
            raise RequestError("bad_address", f"{self.telegram} has {count} words, and none at {shown(position)}")
        return self._slots[self._part_of[position][0]]


def _no_frame(frame: object) -> RequestError:
    of_python_can = "; this is Frame(message.arbitration_id, bytes(message.data))"
    hint = of_python_can if hasattr(frame, "arbitration_id") else ""
    return RequestError("bad_frame", f"takes a Frame(id, data), not {shown(frame)}{hint}")


def pairs_of(message: Message) -> list[tuple[int, int]]:
    """Return the places of the high and the low byte of each word of a frame."""
    if message.signals:
        return [(2 * word, 2 * word + 1) for word in range(sum(one.words for one in message.signals))]
    places = {role.number: place for place, role in enumerate(message.roles) if role.kind == "word"}
    return [(places[2 * word], places[2 * word + 1]) for word in range(len(places) // 2)]


def parts_of(message: Message, words: int) -> list[range]:
    """The words of a telegram that come together."""
    if message.signals:
        return Packing(message.signals, message.length).parts
    carried = len(pairs_of(message))
    return [range(at, min(at + carried, words)) for at in range(0, words, carried)]
