# SPDX-License-Identifier: 0BSD
"""How a USS device's parameters and process data are read and written: telegrams as bytes, no I/O."""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, TypeVar

from ..errors import NoReplyError, RequestError
from ..session import Session
from .frames import NO_TASK, RAM, READ, Link, Profile, Reply, Request, build, parse

if TYPE_CHECKING:
    from ..facts import Place
    from ..points import Point

T = TypeVar("T")
Steps = Generator[bytes, bytes, T]
"""Each step yields the bytes of a request and is sent those of the reply."""


class UssSession(Session):
    """The state of one USS device: how its link is set, and the process data that its next telegrams carry.

    Until a word of process data is written, all of them are 0, so that reading parameters commands nothing. From then
    on words that were not written are 0 but for the bits that are always written as a constant.
    """

    PROFILE: ClassVar[Profile]

    def __init__(self, link: Link, unit: int, variants: Mapping[str, str | None]) -> None:
        super().__init__(unit, variants)
        self.link = link
        self._sent: dict[int, int] = {}

    def get_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Read a parameter (the high word first), or words of the process data that comes back."""
        if place.telegram is None:
            request = Request(self.unit, READ, self._number(place), place.index or 0)
            reply = yield from self._exchange_steps(request, self._sent)
            return divmod(reply.value, 0x10000) if reply.width == 2 else (reply.value,)
        if self._is_sent(place):
            return self._process_data(self._sent, place)
        reply = yield from self._exchange_steps(Request(self.unit), self._sent)
        return self._chosen(reply.words, place)

    def gather_steps(self, points: Sequence[Point], group: str | None) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points; process data out of one telegram."""
        raws: dict[str, int] = {}
        heard = [point for point in points if point.facts.at.telegram and not self._is_sent(point.facts.at)]
        if heard:
            reply = yield from self._exchange_steps(Request(self.unit), self._sent)
            for point in heard:
                raws[point.facts.item] = self.taken(point, self._chosen(reply.words, point.facts.at))
        rest = [point for point in points if point not in heard]
        return {**raws, **(yield from super().gather_steps(rest, group))}

    def shared_word_steps(self, point: Point) -> Steps[int]:
        """The word that a bit group shares with others; of process data that is sent, the word as it is sent."""
        at = point.facts.at
        if at.telegram is None or not self._is_sent(at):
            return (yield from super().shared_word_steps(point))
        return self._process_data(self._sent, at)[0]

    def store_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write a parameter by the task that `place` names (RAM unless it does), or words of the process data."""
        if place.telegram is None:
            task = place.function or RAM.get((len(values), place.index is not None))
            if task is None:
                raise RequestError("bad_value", f"a parameter has one word or two, not {len(values)}")
            value = sum(word << 16 * part for part, word in enumerate(reversed(values)))
            request = Request(self.unit, task, self._number(place), place.index or 0, len(values), value)
            yield from self._exchange_steps(request, self._sent)
            return
        if not self._is_sent(place):
            raise RequestError("bad_space", f"the words of {place.telegram} come from the device")
        self._chosen((0,) * self.link.pzd, place)  # raises if the link does not carry them
        sent = {**self._sent, **dict(zip(sorted(place.addresses), values, strict=True))}
        yield from self._exchange_steps(Request(self.unit), sent)
        self._sent = sent  # only now: after a failure the next telegram must not start what seemed to have failed

    def _exchange_steps(self, request: Request, sent: Mapping[int, int]) -> Steps[Reply]:
        """One telegram with its process data, and the reply."""
        words = tuple([sent.get(at, self._constants.get(at, 0) if sent else 0) for at in range(self.link.pzd)])
        request = Request(
            request.unit, request.task, request.parameter, request.index, request.width, request.value, words
        )
        try:
            reply = yield build(request, self.PROFILE, self.link)
        except TimeoutError as error:
            about = f" to task {request.task} for {request.parameter}" if request.task != NO_TASK else ""
            raise NoReplyError(f"unit {self.unit} did not reply{about}") from error
        return parse(request, reply, self.PROFILE, self.link)

    def _number(self, place: Place) -> int:
        if place.space != "parameter":
            raise RequestError("bad_space", f"there is no space {place.space!r}, only parameter")
        return place.address

    def _is_sent(self, place: Place) -> bool:
        """Whether words of a telegram go to the device."""
        return any(one.name == place.telegram and one.direction == "request" for one in self.PROFILE.telegrams)

    def _process_data(self, sent: Mapping[int, int], place: Place) -> tuple[int, ...]:
        """Words as they are sent."""
        return tuple([sent.get(at, self._constants.get(at, 0)) for at in sorted(place.addresses)])

    def _chosen(self, words: tuple[int, ...], place: Place) -> tuple[int, ...]:
        """The words of a place out of the process data."""
        if max(place.addresses) >= len(words):
            text = f"the link carries {len(words)} words of process data, and this is word {max(place.addresses) + 1}"
            raise RequestError("bad_link", text)
        return tuple([words[at] for at in sorted(place.addresses)])

    @cached_property
    def _constants(self) -> dict[int, int]:
        """The bits that are always written as a constant, by the word of process data."""
        bits: dict[int, int] = {}
        for point in self.POINTS.values():
            at = point.facts.write_at or point.facts.at
            if point.facts.fixed and at.telegram is not None and self._is_sent(at):
                bits[at.address] = bits.get(at.address, 0) | point.facts.fixed[1]
        return bits
