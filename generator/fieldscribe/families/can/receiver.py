"""Collects the frames of a multiplexed telegram, and returns words that belong together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from operator import itemgetter

from fieldscribe.arithmetic.words import words_in
from fieldscribe.families.can.frames import CanFrame, carried, parse
from fieldscribe.model import Message, Telegram


@dataclass(slots=True)
class _Slot:
    """The last and the previous words of one multiplexer value; `at` and `before` count frames, 0 means never."""

    words: tuple[int, ...] = ()
    at: int = 0
    words_before: tuple[int, ...] = ()
    before: int = 0


class Receiver:
    """Takes the frames of one unit's telegram, and returns the words that have come."""

    def __init__(self, telegram: Telegram, message: Message, unit: int) -> None:
        self.message = message
        self.unit = unit
        self.per_frame = message.words
        self._clock = 0
        at = {role.number: place for place, role in enumerate(message.roles) if role.kind == "word"}
        words = dict.fromkeys(number // 2 for number in at)
        self._own = itemgetter(*[at.get(number, -1) for word in words for number in (2 * word, 2 * word + 1)])
        firsts = range(0, telegram.words, self.per_frame)
        self.positions = [range(first, min(first + self.per_frame, telegram.words)) for first in firsts]
        """The positions of the words that a frame with each multiplexer brings."""
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
        data = frame.data + b"\0"  # half a word that no byte of the message carries is 0
        slot.words, slot.at = words_in(bytes(self._own(data))), self._clock
        return slot.words

    def words(self, positions: Sequence[int]) -> tuple[str, tuple[int, ...]]:
        """Return the words at these positions, the high one first: ("ok", words), or "missing" or "torn" without words.

        Two words from two frames belong together if the same high word came before and after the low one. More than two
        words, such as a text, are given as they came last.
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
