# SPDX-License-Identifier: 0BSD
"""Values of signals to the frame of their message."""

from __future__ import annotations

from itertools import accumulate
from typing import TYPE_CHECKING

from ..arguments import shown
from ..errors import RequestError
from ..points import Encoding
from ..rules import NO_RAWS
from ..table import check_unit
from .frames import Frame
from .signals import Packing

if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..rules import Raws
    from ..session import Value
    from .session import CanSession


def pack(
    device: type[CanSession], message: str, values: Mapping[str, Value], unit: int = 0, raws: Raws = NO_RAWS
) -> Frame:
    """The frame of a message with these values, by the names of points: `pack(Engine, "limits", {"speed": 1500.0})`.

    Bits of signals without a value are 0. Raises as encoding does, and RequestError for a point that is not in the
    message, or a message without signals.
    """
    profile = device.PROFILE
    laid_out = profile.message(message)
    check_unit(unit, profile.units)
    if not laid_out.signals:
        raise RequestError("bad_message", f"{message} has no signals")
    found: dict[int, int] = {}
    firsts = list(accumulate((one.words for one in laid_out.signals), initial=0))
    for name, value in values.items():
        point = device.POINTS.get(name)
        if point is None or point.facts.at.telegram != message:
            raise RequestError("bad_point", f"{shown(name)} is no signal of {message}")
        if not isinstance(point, Encoding):
            raise RequestError("bad_point", f"{name} cannot be written")
        found[firsts.index(point.facts.at.addresses[0])] = point.encode(value, raws)
    return Frame(laid_out.identifier(unit), Packing(laid_out.signals, laid_out.length).data(found))
