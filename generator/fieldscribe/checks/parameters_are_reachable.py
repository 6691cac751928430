"""Parameters can be read and written as they say: CAN has messages for it, USS has tasks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families import uss
from fieldscribe.resolve.telegrams import SPACE

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.checks.subject import Subject
    from fieldscribe.model import Message, Point

_READ = 1
_SHORT = 3
"""The length of a parameter part that has room for one word of a value."""


def check(subject: Subject) -> None:
    """One finding for each way to read or write that parameters need and that the device does not have."""
    family = subject.scope.header["family"]
    if family not in ("can", "uss") or not subject.bus_is_whole:
        return
    sound = [one.point for one in subject.resolved if one.point.generated and "type" not in one.draft.failed]
    points = [point for point in sound if point.space != SPACE]
    for count, message, hint in (_messages if family == "can" else _tasks)(subject, points):
        if count and subject.scope.bus is not None:
            span = subject.scope.bus.span()
            subject.report.error("no-function", f"{message}, and {_needed(count)}", span, hint)


def _needed(count: int) -> str:
    return f"{count} point{'s need' if count > 1 else ' needs'} it"


def _messages(subject: Subject, points: list[Point]) -> Iterator[tuple[int, str, str]]:
    if subject.scope.is_lost("messages", "messages") or len(subject.messages) < len(
        list(subject.scope.listed("messages"))
    ):
        return  # what could not be read may be what is missing
    asked = [one for one in subject.messages if one.direction == "request" and _carries(one, "address")]
    answered = {one.answers for one in subject.messages if one.answers is not None and _carries(one, "raw")}
    reads = any(not _carries(one, "raw") and one.name in answered for one in asked)
    writes = any(_carries(one, "raw") for one in asked)
    hint = "add {} under `messages`, or correct `access`"
    if not reads:
        told = hint.format("a request with `address`, and a response with `raw` that answers it")
        yield sum(one.readable for one in points), "no message reads a parameter", told
    if not writes:
        told = hint.format("a request with `address` and `raw`")
        yield sum(one.writable for one in points), "no message writes a parameter", told


def _carries(message: Message, kind: str) -> bool:
    return any(role.kind == kind for role in message.roles)


def _tasks(subject: Subject, points: list[Point]) -> Iterator[tuple[int, str, str]]:
    known = {code.number for code in subject.bus.functions}
    hint = "list the task under `functions`, or correct `access` or `keeps`"
    lengths = set(subject.bus.pkw)
    if lengths == {0}:
        yield len(points), "no telegram has a parameter part", "correct `pkw`, which lists its lengths in words"
        return
    if lengths and lengths <= {0, _SHORT}:
        wide = sum(point.words > 1 for point in points)
        hint = "correct `pkw`, or the types"
        yield wide, f"a parameter part of {_SHORT} words carries no value of 32 bits", hint
        hint = "list the task under `functions`, or correct `access` or `keeps`"
    if _READ not in known:
        yield sum(one.readable for one in points), f"the device has no task {_READ}, which reads a value", hint
    needed: dict[int, int] = {}
    for point in points:
        for keep in {"yes": (True,), "no": (False,)}.get(point.keeps or "", (False, True)) if point.writable else ():
            task = uss.write_task(point.words, array=point.index is not None, keep=keep)
            if task not in known and (point.keeps is not None or not keep):
                needed[task] = needed.get(task, 0) + 1
    for task, count in sorted(needed.items()):
        yield count, f"the device has no task {task}, which writes such a value", hint
