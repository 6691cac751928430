# SPDX-License-Identifier: 0BSD
"""Reads and writes parameters of a CAN device and receives its telegrams, as steps of frames, without I/O."""

from __future__ import annotations

import enum
from collections.abc import Callable, Generator, Mapping, Sequence
from time import monotonic
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from ..about import about_place
from ..arguments import check_name, check_place, check_values, check_words, shown
from ..errors import (
    EchoError,
    FrameError,
    NoReplyError,
    RequestError,
    TelegramError,
)
from ..facts import Place
from ..session import Refusals, Session
from ..table import check_unit, check_variants, exists
from .decoder import layouts_of
from .frames import Frame, Message, Profile, build, parse
from .receiver import Receiver

if TYPE_CHECKING:
    from ..layouts import Layout
    from ..points import Point


class Wanted(enum.Enum):
    """What a step wants of a transport besides sending a frame."""

    NEXT = enum.auto()
    """The next frame that comes."""
    WAITING = enum.auto()
    """The next frame that has come already; None if there is none, or if the transport cannot say."""


T = TypeVar("T")
Steps = Generator[Frame | Wanted, Frame | None, T]
"""Each step yields a frame to send (and receives None), or which frame it wants to receive."""

_SETTLED = 0.2
"""After this many seconds, a received frame was not in the queue before."""


class CanSession(Session):
    """The state of one device on a CAN bus.

    While other frames keep coming, a step waits for its own frame for at most `patience` seconds. Words of a telegram
    that came at most `fresh_for` seconds ago are read without waiting for new ones.
    """

    PROFILE: ClassVar[Profile]
    patience: float = 10.0
    fresh_for: float = 1.0

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        check_unit(unit, self.PROFILE.units)
        super().__init__(unit, variants)
        self._receivers = {one.name: Receiver(self.PROFILE, one.name, unit) for one in self.PROFILE.telegrams}
        self._since: float | None = None
        self._until: float | None = None
        """The moment when the wait for words that nobody sends was over, while several points are read."""
        self._unanswered = False

    def take(self, frame: Frame) -> bool:
        """Feed a frame that came by another way; return True if it belongs to a telegram of this device."""
        moment = monotonic()
        taken = [receiver.take(frame, moment) for receiver in self._receivers.values()]
        return any(taken)

    @classmethod
    def layouts(cls, telegram: str, **variants: str) -> tuple[Layout, ...]:
        """The words of a telegram's frames, with the points in them; variants as for the device."""
        check_name("telegram", telegram)
        check_variants(cls.VARIANTS, variants)
        return layouts_of(cls.PROFILE, telegram, [one for one in cls.POINTS.values() if exists(one, variants)])

    def _get_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Read parameters one by one, or listen for words of a telegram; in ascending order of address."""
        if place.telegram is not None:
            return (yield from self._listen_steps(place))
        if place.space != "parameter":
            raise RequestError("bad_space", f"the space {place.space!r} cannot be read by address, only parameter")
        request = self.PROFILE.request(writes=False)
        answer = self.PROFILE.answer(request)
        words: tuple[int, ...] = ()
        for address in sorted(place.addresses):
            words = (
                *words,
                (yield from self._retried_steps(self.retries, self._ask_steps, request, answer, address, 0)),
            )
        return words

    def _gather_steps(self, points: Sequence[Point], group: str | None, refusals: Refusals) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points; those of a telegram out of the same frames."""
        self._since = monotonic() - self.fresh_for
        try:
            return (yield from super()._gather_steps(points, group, refusals))
        finally:
            self._since = self._until = None

    def _part_steps(
        self, points: Sequence[Point], refusals: Refusals, ask: Callable[..., Steps[dict[str, int]]], *arguments: Any
    ) -> Steps[dict[str, int]]:
        """Read some points; with `refusals`, words that a telegram did not bring are noted there, too."""
        try:
            return (yield from super()._part_steps(points, refusals, ask, *arguments))
        except NoReplyError as error:
            receiver = self._receivers.get(points[0].facts.at.telegram or "")
            if refusals is None or receiver is None or not receiver.is_sent(self._since or 0.0):
                raise
            self._until = monotonic()
            refusals.update(dict.fromkeys([point.facts.item for point in points], error))
            return {}

    def _store_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write parameters one by one."""
        if place.space != "parameter":
            instead = "; `pack` makes the frame of a message" if place.space == "signal" else ""
            raise RequestError("bad_space", f"the space {place.space!r} cannot be written, only parameter{instead}")
        request = self.PROFILE.request(writes=True)
        answer = self.PROFILE.answer(request)
        for address, word in zip(sorted(place.addresses), values, strict=True):
            raw = yield from self._retried_steps(self.retries, self._ask_steps, request, answer, address, word)
            if answer is not None and answer.carries("raw") and raw != word:
                text = f"{word} was written to {address}, but the device answered {raw}"
                raise EchoError(text, (word,), (raw,))

    def _ask_steps(self, request: Message, answer: Message | None, address: int, raw: int) -> Steps[int]:
        """Send a request and return the raw number of its answer; the receivers get all other frames."""
        frame = build(request, self.PROFILE, self.unit, address, raw)
        yield from self._clear_steps()
        sent = self.traffic.sent(frame)
        yield frame
        if answer is None:
            return raw
        self._unanswered = True  # unknown until the answer has come, whatever ends the wait
        deadline = monotonic() + self.patience
        spoiled: FrameError | None = None
        while True:
            frame = yield from self._next_steps(deadline, f"{answer.name} for {address}", spoiled)
            try:
                found, word = parse(answer, self.unit, frame)
            except FrameError as error:
                spoiled = error if error.status == "wrong_check" else spoiled
            else:
                if found == address or not answer.carries("address"):
                    self._unanswered = False
                    self.traffic.came(frame, sent)
                    return word
            self.take(frame)

    def _clear_steps(self) -> Steps[None]:
        """Empty the queue before a request, so that no late answer is taken for the next one."""
        deadline = monotonic() + self.patience
        while (frame := (yield Wanted.WAITING)) is not None and monotonic() < deadline:
            self.take(frame)
        deadline = monotonic() + _SETTLED
        while self._unanswered and monotonic() < deadline:
            try:
                late = yield Wanted.NEXT
            except TimeoutError:
                self._unanswered = False
            else:
                if late is not None:
                    self.take(late)

    def _listen_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Words of a telegram, as soon as all of them are there, fresh, and belong together."""
        self.PROFILE.telegram(place.telegram)
        receiver = self._receivers[place.telegram or ""]
        since = monotonic() - self.fresh_for if self._since is None else self._since
        deadline = self._until or monotonic() + self.patience
        awaited = f"{receiver.telegram} with words {', '.join(map(str, place.addresses))}"
        trouble: TelegramError | None = None
        while True:
            if receiver.newer(place.addresses, since):
                try:
                    by_address = dict(zip(place.addresses, receiver.words(place.addresses), strict=True))
                except TelegramError as error:
                    trouble = error
                else:
                    return tuple([by_address[address] for address in sorted(place.addresses)])
            self.take((yield from self._next_steps(deadline, awaited, trouble)))

    def _read_at_steps(self, space: str, address: int, count: int) -> Steps[tuple[int, ...]]:
        """Read by address; raises RequestError for a space or address that does not exist."""
        place = self._place(space, address, count)
        with about_place(self.traffic, place):
            return (yield from self._get_steps(place))

    def _write_at_steps(self, space: str, address: int, values: tuple[int, ...]) -> Steps[None]:
        """Write by address; raises RequestError for a space or address that does not exist, or for wrong words."""
        check_values(values)
        place = self._place(space, address, len(values))
        check_words("bad_value", "values", values)
        with about_place(self.traffic, place):
            yield from self._put_steps(place, values)

    def _place(self, space: str, address: int, count: int) -> Place:
        """Parameters by address, or words of the telegram of that name."""
        check_place(space, address, count)
        addresses = tuple(range(address, address + count))
        if space in self._receivers:
            return Place("telegram", addresses, telegram=space)
        return Place(space, addresses)

    def _next_steps(self, deadline: float, awaited: str, trouble: Exception | None) -> Steps[Frame]:
        """Return the next frame of any kind; raises NoReplyError if none comes or the wait was too long."""
        reason = f"unit {self.unit} did not send {awaited}" + (f" ({trouble})" if trouble else "")
        if monotonic() > deadline:
            raise NoReplyError(f"{reason} within {self.patience:g} s") from trouble
        try:
            frame = yield Wanted.NEXT
        except TimeoutError as error:
            raise NoReplyError(reason) from trouble or error
        if not isinstance(frame, Frame):
            text = f"a transport gives a Frame(id, data) or raises TimeoutError; this one gave {shown(frame)}"
            raise RequestError("bad_transport", text)
        return frame
