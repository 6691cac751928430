"""Every parameter that says it is read or written has a message for that."""

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
        return  # the missing message may be one that could not be read
    asked = [message for message in subject.messages if message.direction == "request" and carries(message, "address")]
    answered = {
        message.answers for message in subject.messages if message.answers is not None and carries(message, "raw")
    }
    reads = any(not carries(message, "raw") and message.name in answered for message in asked)
    writes = any(carries(message, "raw") for message in asked)
    hint = "add {} under `messages`, or correct `access`"
    if not reads:
        what_to_add = hint.format("a request with `address`, and a response with `raw` that answers it")
        yield sum(point.readable for point in points), "no message reads a parameter", what_to_add
    if not writes:
        what_to_add = hint.format("a request with `address` and `raw`")
        yield sum(point.writable for point in points), "no message writes a parameter", what_to_add
