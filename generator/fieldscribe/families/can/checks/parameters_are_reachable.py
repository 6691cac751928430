"""Parameters can be read and written as they say: there are messages for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.checks.reach import report_missing
from fieldscribe.families.can.frames import carries

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.resolve.subject import Subject


def check(subject: Subject) -> None:
    """One finding for each message that parameters need and that the device does not have."""
    report_missing(subject, _messages)


def _messages(subject: Subject, points: list[Point]) -> Iterator[tuple[int, str, str]]:
    if subject.scope.is_lost("messages", "messages") or len(subject.messages) < len(
        list(subject.scope.listed("messages"))
    ):
        return  # what could not be read may be what is missing
    asked = [one for one in subject.messages if one.direction == "request" and carries(one, "address")]
    answered = {one.answers for one in subject.messages if one.answers is not None and carries(one, "raw")}
    reads = any(not carries(one, "raw") and one.name in answered for one in asked)
    writes = any(carries(one, "raw") for one in asked)
    hint = "add {} under `messages`, or correct `access`"
    if not reads:
        told = hint.format("a request with `address`, and a response with `raw` that answers it")
        yield sum(one.readable for one in points), "no message reads a parameter", told
    if not writes:
        told = hint.format("a request with `address` and `raw`")
        yield sum(one.writable for one in points), "no message writes a parameter", told
