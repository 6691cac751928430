# SPDX-License-Identifier: 0BSD
"""How a CAN device's parameters are read and written, and its telegrams heard: frames in and out, no I/O."""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from time import monotonic
from typing import TYPE_CHECKING, ClassVar, TypeVar

from ..errors import FrameError, NoReplyError, RequestError, TelegramError
from ..session import Session
from .frames import Frame, Message, Profile, build, parse
from .receiver import Receiver

if TYPE_CHECKING:
    from ..facts import Place
    from ..points import Point

T = TypeVar("T")
Steps = Generator[Frame | None, Frame | None, T]
"""Each step yields a frame to send (and is sent None), or None to be sent the next frame that comes."""


class CanSession(Session):
    """The state of one device on a CAN bus.

    While other frames keep coming, what is waited for may take `patience` seconds. Words of a telegram that came up to
    `fresh_for` seconds ago need not come again to be read.
    """

    PROFILE: ClassVar[Profile]
    patience: float = 10.0
    fresh_for: float = 1.0

    def __init__(self, unit: int, variants: Mapping[str, str | None]) -> None:
        super().__init__(unit, variants)
        self.receivers = {one.name: Receiver(self.PROFILE, one.name, unit) for one in self.PROFILE.telegrams}
        self._since: float | None = None

    def take(self, frame: Frame) -> bool:
        """Feed a frame that came by another way; whether it is of a telegram of this device."""
        moment = monotonic()
        taken = [receiver.take(frame, moment) for receiver in self.receivers.values()]
        return any(taken)

    def get_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Read parameters one by one, or listen for words of a telegram; in ascending order of address."""
        if place.telegram is not None:
            return (yield from self._listen_steps(place))
        if place.space != "parameter":
            raise RequestError("bad_space", f"the space {place.space!r} cannot be read by address, only parameter")
        request = self.PROFILE.request(writes=False)
        answer = self.PROFILE.answer(request)
        words: tuple[int, ...] = ()
        for address in sorted(place.addresses):
            words = (*words, (yield from self._ask_steps(request, answer, address, 0)))
        return words

    def gather_steps(self, points: Sequence[Point], group: str | None) -> Steps[dict[str, int]]:
        """Read the raw numbers of several points; those of a telegram out of the same frames."""
        self._since = monotonic() - self.fresh_for
        try:
            return (yield from super().gather_steps(points, group))
        finally:
            self._since = None

    def store_steps(self, place: Place, values: tuple[int, ...]) -> Steps[None]:
        """Write parameters one by one."""
        if place.space != "parameter":
            raise RequestError("bad_space", f"the space {place.space!r} cannot be written, only parameter")
        request = self.PROFILE.request(writes=True)
        answer = self.PROFILE.answer(request)
        for address, word in zip(sorted(place.addresses), values, strict=True):
            raw = yield from self._ask_steps(request, answer, address, word)
            if answer is not None and answer.carries("raw") and raw != word:
                raise FrameError("echo_mismatch", f"{word} was written to {address}, and the device answered {raw}")

    def _ask_steps(self, request: Message, answer: Message | None, address: int, raw: int) -> Steps[int]:
        """One request, and the raw number of its answer; all other frames are offered to the receivers."""
        yield build(request, self.PROFILE, self.unit, address, raw)
        if answer is None:
            return raw
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
                    return word
            self.take(frame)

    def _listen_steps(self, place: Place) -> Steps[tuple[int, ...]]:
        """Words of a telegram, as soon as all of them are there, fresh, and belong together."""
        self.PROFILE.telegram(place.telegram)
        receiver = self.receivers[place.telegram or ""]
        since = monotonic() - self.fresh_for if self._since is None else self._since
        deadline = monotonic() + self.patience
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

    def _next_steps(self, deadline: float, awaited: str, trouble: Exception | None) -> Steps[Frame]:
        """The next frame, whatever it is; raises NoReplyError when none comes, or the wait has been too long."""
        reason = f"{awaited} did not come" + (f" ({trouble})" if trouble else "")
        if monotonic() > deadline:
            raise NoReplyError(f"{reason} within {self.patience:g} s") from trouble
        try:
            frame = yield None
        except TimeoutError as error:
            raise NoReplyError(reason) from trouble or error
        assert frame is not None, "a transport returned nothing instead of raising TimeoutError"
        return frame
