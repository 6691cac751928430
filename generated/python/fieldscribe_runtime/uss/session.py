# SPDX-License-Identifier: 0BSD
"""Reads and writes parameters and process data of a USS device, as steps of telegrams, without I/O."""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar, TypeVar

from ..about import About, about_place
from ..arguments import (
    check_bytes,
    check_integer,
    check_name,
    check_number,
    check_place,
    check_values,
    check_words,
)
from ..errors import AccessError, EchoError, FrameError, RequestError, no_reply
from ..facts import Place
from ..layouts import Layout
from ..session import Refusals, Session
from ..table import check_unit, check_variants, exists
from .frames import (
    NO_TASK,
    RAM,
    READ,
    Link,
    Profile,
    Reply,
    Request,
    broadcast,
    build,
    check_link,
    check_request,
    parse,
)

if TYPE_CHECKING:
    from ..points import Point

T = TypeVar("T")
Steps = Generator[bytes, bytes, T]
"""Each step yields the bytes of a request and is sent those of the reply."""


class UssSession(Session):
    """The state of one USS device: the settings of its link, and the process data that its next telegrams carry.

    Each telegram carries process data, even one that reads a parameter. A word is 0 until it is written, all bits of
    it; the bits that are always written as a constant come with the first point of their word, so that reading, or
    writing a setpoint alone, commands nothing.

    When a telegram that changes words fails, nobody knows which words the device has now, and neither the new nor the
    old ones may be repeated: what seems to have failed must not start a motor, and a stop must not be taken back. All
    words are 0 then until some are written again; write the setpoint again, too.

    A task that the device has not answered yet is sent again up to `repeats` times.
    """

    PROFILE: ClassVar[Profile]
    link: Link
    repeats: int = 20

    def __init__(self, link: Link, unit: int, variants: Mapping[str, str | None]) -> None:
        check_unit(unit, self.PROFILE.units)
        super().__init__(unit, variants)
        check_link(self.PROFILE, link, variants)
        self.link = link
        self._sent: dict[int, int] = {}

    def drop_process_data(self) -> None:
        """Set all words of process data to 0 until they are written again, as others have commanded the device."""
        self._sent = {}

    @classmethod
    def layouts(cls, telegram: str, *, words: int | None = None, **variants: str) -> tuple[Layout, ...]:
        """The process data of a telegram, or its first words, with the points in them; variants as for the device."""
        check_name("telegram", telegram)
        check_variants(cls.VARIANTS, variants)
        if words is not None:
            check_number("bad_count", "the number of words", words, (1, 0xFFFF))
        for one in cls.PROFILE.telegrams:
            if one.name == telegram:
                points = [point for point in cls.POINTS.values() if exists(point, variants)]
                own = [point for point in points if point.facts.at.telegram == telegram]
                return (Layout(own, range(one.words if words is None else words)),)
        known = ", ".join([one.name for one in cls.PROFILE.telegrams])
        raise AccessError(f"the device has no telegram {telegram}, only {known}")

    def _get_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Read a parameter (the high word first), or words of the process data that comes back."""
        if place.telegram is None:
            request = Request(self.unit, READ, self._number(place), place.index or 0)
            reply = yield from self._exchange_steps(request, self._sent)
            return divmod(reply.value, 0x10000) if reply.width == 2 else (reply.value,)
        if self._is_sent(place):
            return self._chosen(self._words(self._sent), place)
        self._chosen(self._words({}), place)  # raises if the link does not carry them
        reply = yield from self._exchange_steps(Request(self.unit), self._sent)
        return self._chosen(reply.words, place)

    def _gather_steps(self, points: Sequence[Point], group: str | None, refusals: Refusals) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points; process data out of one telegram."""
        raws: dict[str, int] = {}
        heard = [point for point in points if point.facts.at.telegram and not self._is_sent(point.facts.at)]
        if heard:
            raws = yield from self._part_steps(heard, refusals, self._process_data_steps, heard)
        rest = [point for point in points if point not in heard]
        return {**raws, **(yield from super()._gather_steps(rest, group, refusals))}

    def _process_data_steps(self, points: Sequence[Point]) -> Steps[dict[str, int]]:
        """Read points of the process data by one telegram."""
        reply = yield from self._exchange_steps(Request(self.unit), self._sent)
        raws: dict[str, int] = {}
        for point in points:
            with About(self.traffic, point):
                raws[point.facts.item] = self._taken(point, self._chosen(reply.words, point.facts.at))
        return raws

    def _shared_word_steps(self, point: Point) -> Steps[int]:
        """The word that a bit group shares with others; of process data that is sent, the word as it will be sent."""
        at = point.facts.at
        if at.telegram is None or not self._is_sent(at):
            return (yield from super()._shared_word_steps(point))
        return self._sent.get(at.address, self._constants.get(at.address, (0, 0))[1])

    def _store_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write a parameter by the task that `place` names (RAM unless it does), or words of the process data."""
        if place.telegram is None:
            yield from self._change_steps(place, values)
            return
        if not self._is_sent(place):
            raise RequestError("bad_space", f"the words of {place.telegram} come from the device")
        if len(values) != len(place.addresses):
            raise RequestError("bad_value", f"{len(values)} words do not fill {len(place.addresses)}")
        self._chosen(self._words({}), place)  # raises if the link does not carry them
        sent = {**self._sent, **dict(zip(sorted(place.addresses), values, strict=True))}
        request = Request(self.unit, words=self._words(sent))
        check_request(request, self.PROFILE, self.link)  # an error here means that nothing is sent
        self._sent = {}  # unknown until the device has answered, whatever ends the wait
        yield from self._retried_steps(0, self._telegram_steps, request, sent)
        self._sent = sent

    def _change_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write a parameter; the answer confirms the change with the value that the device has now."""
        task = place.function or RAM.get((len(values), place.index is not None))
        if task is None:
            raise RequestError("bad_value", f"a parameter has one word or two, not {len(values)}")
        value = sum(word << 16 * part for part, word in enumerate(reversed(values)))
        request = Request(self.unit, task, self._number(place), place.index or 0, len(values), value)
        reply = yield from self._exchange_steps(request, self._sent)
        if reply.value != value:
            answered = divmod(reply.value, 0x10000) if reply.width == 2 else (reply.value,)
            text = f"{value} was written to {request.parameter}, but the device answered {reply.value}"
            raise EchoError(text, values, answered)

    def _broadcast_steps(self, mask: tuple[int, int, int, int], words: Sequence[int] | None) -> Steps[None]:
        """Process data for all units; raises RequestError (bad_link, bad_value)."""
        for what, found in (("the mask", mask), ("words", () if words is None else words)):
            check_words("bad_value", what, found)
        chosen = self._words(self._sent) if words is None else tuple(words)
        request = broadcast(mask, chosen, self.PROFILE, self.link)
        for at, (fixed, bits) in self._constants.items():
            if mask[0] >> at + 1 & 1 and chosen[at] & fixed != bits:
                text = f"word {at + 1} is {chosen[at]:04X}h and has not {bits:04X}h in {fixed:04X}h"
                raise RequestError("bad_value", text)
            if at == 0 and (missing := bits & ~mask[1]):
                text = f"the mask leaves out {missing:04X}h of the first word, which has to count"
                raise RequestError("bad_value", text)
        self._sent = {}
        self.traffic.about = ()
        yield from self._retried_steps(0, self._to_all_steps, request)

    def _exchange_steps(self, request: Request, sent: Mapping[int, int]) -> Steps[Reply]:
        """Carry out one task, again if it is lost, as it changes no process data."""
        return (yield from self._retried_steps(self.retries, self._telegram_steps, request, sent))

    def _telegram_steps(self, request: Request, sent: Mapping[int, int]) -> Steps[Reply]:
        """One task with process data, and the reply; a task is repeated until the device answers it."""
        request = request.replaced(words=self._words(sent))
        frame = build(request, self.PROFILE, self.link)
        left = self.repeats
        while True:
            moment = self.traffic.sent(frame)
            try:
                reply = yield frame
            except TimeoutError as error:
                about = f" to task {request.task} for {request.parameter}" if request.task != NO_TASK else ""
                raise no_reply(f"unit {self.unit} did not reply{about}", error) from error
            check_bytes(reply)
            self.traffic.came(reply, moment)
            try:
                return parse(request, reply, self.PROFILE, self.link)
            except FrameError as error:
                if error.status != "no_answer" or left <= 0:
                    raise
            self.traffic.answered()
            left -= 1

    def _number(self, place: Place) -> int:
        if place.space != "parameter":
            known = ", ".join(("parameter", *(one.name for one in self.PROFILE.telegrams)))
            raise RequestError("bad_space", f"there is no space {place.space!r}, only {known}")
        return place.address

    def _read_at_steps(self, space: str, address: int, index: int | None) -> Steps[tuple[int, ...]]:
        """Read by number; raises RequestError for a space or number that does not exist."""
        place = self._place(space, address, 1, index)
        with about_place(self.traffic, place):
            return (yield from self._get_steps(place))

    def _write_at_steps(self, space: str, address: int, words: tuple[int, ...], index: int | None) -> Steps[None]:
        """Write by number; raises RequestError for a space or number that does not exist, or for wrong words."""
        check_values(words)
        place = self._place(space, address, len(words), index)
        check_words("bad_value", "values", words)
        with about_place(self.traffic, place):
            yield from self._put_steps(place, words)

    def _place(self, space: str, address: int, count: int, index: int | None) -> Place:
        """A parameter by number, or words of the telegram of that name."""
        check_place(space, address, count)
        if index is not None:
            check_integer("bad_index", "index", index)
        if any(one.name == space for one in self.PROFILE.telegrams):
            return Place("telegram", tuple(range(address, address + count)), telegram=space)
        return Place(space, (address,), index=index)

    def _is_sent(self, place: Place) -> bool:
        """Return True if words of a telegram go to the device."""
        return any(one.name == place.telegram and one.direction == "request" for one in self.PROFILE.telegrams)

    def _carried(self, point: Point) -> bool:
        """Return True if the link has room for the words of a point."""
        if point.facts.at.telegram is not None:
            return max(point.facts.at.addresses) < self.link.pzd
        return self.link.sent >= (4 if point.size > 1 else 3)

    def _words(self, sent: Mapping[int, int]) -> tuple[int, ...]:
        """All words of process data as they are sent."""
        return tuple([sent.get(at, 0) for at in range(self.link.pzd)])

    def _chosen(self, words: tuple[int, ...], place: Place) -> tuple[int, ...]:
        """The words of a place out of the process data."""
        if not 0 <= place.address <= max(place.addresses) < len(words):
            text = f"the link carries {len(words)} words of process data, and this is word {max(place.addresses) + 1}"
            raise RequestError("bad_link", text)
        return tuple([words[at] for at in sorted(place.addresses)])

    @cached_property
    def _constants(self) -> dict[int, tuple[int, int]]:
        """The bits that are always written as a constant, mask and bits, by the word of process data."""
        found: dict[int, tuple[int, int]] = {}
        for point in self.POINTS.values():
            at = point.facts.at
            if point.facts.fixed and at.telegram is not None and self._is_sent(at):
                mask, bits = found.get(at.address, (0, 0))
                found[at.address] = mask | point.facts.fixed[0], bits | point.facts.fixed[1]
        return found
