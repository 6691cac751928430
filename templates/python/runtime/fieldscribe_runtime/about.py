# SPDX-License-Identifier: 0BSD
"""Adds to errors what was requested: the group and the points, and what had to be read first."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from .errors import EchoError, FieldscribeError, FrameError, LineError, NoReplyError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from .facts import Place
    from .points import Point
    from .traffic import Labelled, Traffic

_LISTED = 4
"""The most points of one request that an error lists."""


def add_points(error: FieldscribeError, asked: Sequence[Labelled]) -> None:
    """Add the requested points to an error, unless it names some already."""
    more = f" and {len(asked) - _LISTED} more" if len(asked) > _LISTED else ""
    error.point = error.point or ", ".join([one.label for one in asked[:_LISTED]]) + more


class About:
    """Adds to errors raised inside what was requested: points, a command, or a step. Logs name it too."""

    def __init__(self, traffic: Traffic, *asked: Labelled) -> None:
        self._asked = traffic.about = asked

    def __enter__(self) -> None:
        pass

    def __exit__(self, _: object, error: BaseException | None, traceback: object) -> None:
        if isinstance(error, FieldscribeError):
            add_points(error, self._asked)


@contextmanager
def about_place(traffic: Traffic, place: Place) -> Iterator[None]:
    """Add the place to errors of the line raised inside, unless they have one. Logs name it too."""
    traffic.about = (place,)
    try:
        yield
    except EchoError:
        raise
    except (FrameError, LineError, NoReplyError) as error:
        error.point = error.point or place.label
        raise


@contextmanager
def needing(traffic: Traffic, point: Point, other: Point) -> Iterator[None]:
    """Add to errors raised while another point is read that the requested point needs it."""
    try:
        with About(traffic, other):
            yield
    except FieldscribeError as error:
        error.point, error.needs = point.label, error.needs or error.point
        raise


@contextmanager
def of_group(group: str | None) -> Iterator[None]:
    """Add the group to errors raised inside."""
    try:
        yield
    except FieldscribeError as error:
        error.group = group
        raise
