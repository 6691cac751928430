# SPDX-License-Identifier: 0BSD
"""Decodes the frames of a telegram to values, one by one as they arrive."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..arguments import shown
from ..errors import CodecError, RequestError, TelegramError, WrongTypeError
from ..layouts import Layout, has_needs, noted
from ..points import Decoding, Point
from ..rules import NO_RAWS
from ..table import check_variants, exists
from .frames import LENGTH
from .receiver import Receiver, pairs_of, parts_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..rules import Raws
    from ..session import Value
    from .frames import Frame, Profile
    from .session import CanSession


def layouts_of(profile: Profile, telegram: str, points: Sequence[Point], *, whole: bool = False) -> tuple[Layout, ...]:
    """The words of each frame of a telegram, with the points in them; of `whole` frames, those around the words too."""
    told = profile.telegram(telegram)
    message = profile.message(told.message)
    own = [point for point in points if point.facts.at.telegram == telegram]
    wanted = {name for point in own for name in point.scale_needs}
    words, before = len(pairs_of(message)), pairs_of(message)[0][0]
    around = (before, LENGTH - before - 2 * words) if whole else (0, 0)
    if message.signals:
        return tuple([Layout(own, part, wanted, (0, 0)) for part in parts_of(message, told.words)])
    return tuple([Layout(own, range(at, at + words), wanted, around) for at in range(0, told.words, words)])


class Decoder(Receiver):
    """Decodes the frames of a telegram that one unit sends: `Decoder(WoodwardMpu2s, "visualisation", unit=1)`.

    It remembers of earlier frames what the scales of points need, and the words of numbers that two frames carry.
    `errors` says, by the names of points, whose numbers in the last frame have no value, and why: what a scale needs
    has not come, or the number has no value.
    """

    def __init__(self, device: type[CanSession], telegram: str, unit: int, **variants: str) -> None:
        if not hasattr(device, "PROFILE"):
            raise RequestError("bad_device", f"takes the class of a CAN device, not {shown(device)}")
        check_variants(device.VARIANTS, variants)
        super().__init__(device.PROFILE, telegram, unit)
        self.errors: dict[str, CodecError] = {}
        self._known: dict[str, int] = {}
        self._places = [place for pair in pairs_of(self._message) for place in pair]
        first = self._places[0]
        self._in_order = self._places == list(range(first, first + len(self._places)))
        points = [one for one in device.POINTS.values() if one.facts.at.telegram == telegram and exists(one, variants)]
        self._layouts = layouts_of(device.PROFILE, telegram, points, whole=self._in_order)
        self._lacks = [bool(layout.needs) for layout in self._layouts]
        """For each frame, True if something that its scales need has not come yet."""
        apart = [one for one in points if not any(one in layout.points for layout in self._layouts)]
        self._apart = [self._parts(number, apart) for number in range(len(self._layouts))]

    def _parts(self, number: int, apart: Sequence[Point]) -> list[Decoding[Value]]:
        """Return the points in several frames that this frame can complete, as with the high word of a counter."""
        words = self._layouts[number].words
        ends = [(one, one.facts.at.addresses) for one in apart if isinstance(one, Decoding)]
        return [one for one, at in ends if (at[0] if len(at) == 2 else max(at)) in words]

    def decode(self, frame: Frame, raws: Raws = NO_RAWS, moment: float = 0.0) -> dict[str, Value]:
        """The values that a frame brings, by the names of points; none for a frame of something else.

        A frame with another identifier or length, or that a check byte does not fit, is something else.
        `raws` holds the raw numbers that scales need of points that are not in the telegram. What needs a number that
        has not come yet is left out, and so is one that has no value (see `errors` for both): a scale may need an
        implausible number. A number that two frames carry is left out while they may not belong together.
        """
        if self.errors:
            self.errors = {}
        if self._packing is None:
            number = self._taken(frame, moment)
            return {} if number is None else self._brought(number, frame.data, raws)
        values: dict[str, Value] = {}
        for number, data in self._signals_taken(self._packing, frame, moment).items():
            values.update(self._brought(number, data, raws))
        return values

    def _brought(self, number: int, data: bytes, raws: Raws) -> dict[str, Value]:
        """The values that one part of the telegram brings."""
        known: Raws = self._known
        layout = self._layouts[number]
        if not self._in_order:
            data = bytes([data[place] for place in self._places])
        if layout.gives:
            self._known.update(layout.wanted(data))
        if raws is not NO_RAWS:
            known = self._with(raws)
        lacks = self._lacks[number] = self._lacks[number] and not layout.needs <= known.keys()
        values: dict[str, Value] | None = None
        if not lacks:
            try:
                values = layout.decoder(data, known)
            except CodecError:
                values = None
        if values is None:  # point by point
            values = layout.decode_known(data, known, self.errors)
        if self._apart[number]:
            self._add_apart(self._apart[number], known, values)
        return values

    def _add_apart(self, points: Sequence[Decoding[Value]], known: Raws, values: dict[str, Value]) -> None:
        """Add the values of points in several frames."""
        for point in points:
            if has_needs(point, known, self.errors) and (raw := self._joined(point)) is not None:
                with noted(point, self.errors):
                    values[point.facts.name] = point.decode(raw, known)

    def _with(self, raws: Raws) -> Raws:
        """Return the raw numbers of earlier frames with those of the caller; raises WrongTypeError."""
        if not isinstance(raws, Mapping):
            raise WrongTypeError(f"raws are raw numbers by name, as {{'name': 1}}, not {shown(raws)}")
        return {**raws, **self._known}

    def _joined(self, point: Point) -> int | None:
        """The raw number of a point in several frames; None while these may not belong together."""
        addresses = point.facts.at.addresses
        try:
            by_address = dict(zip(addresses, self.words(addresses), strict=True))
        except TelegramError:
            return None
        return point.joined([by_address[at] for at in sorted(by_address)])
