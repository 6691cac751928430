"""Every parameter that says it is read or written has a task for that."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.checks.reach import report_missing
from fieldscribe.families.uss.facts import of_bus
from fieldscribe.families.uss.parts import READ_TASK, write_task

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.resolve.subject import Subject

_SHORT = 3
"""The words of a parameter part that carries values of one word only."""


def check(subject: Subject) -> None:
    """One finding for each task that parameters need and that the device does not have."""
    report_missing(subject, _tasks)


def _tasks(subject: Subject, points: list[Point]) -> Iterator[tuple[int, str, str]]:
    known = {code.number for code in subject.bus.functions}
    hint = "list the task under `functions`, or correct `access` or `keeps`"
    lengths = set(of_bus(subject.bus).pkw)
    if lengths == {0}:
        yield len(points), "no telegram has a parameter part", "correct `pkw`, which lists its lengths in words"
        return
    if lengths and lengths <= {0, _SHORT}:
        wide = sum(point.words > 1 for point in points)
        hint = "correct `pkw`, or the types"
        yield wide, f"a parameter part of {_SHORT} words carries no value of 32 bits", hint
        hint = "list the task under `functions`, or correct `access` or `keeps`"
    if READ_TASK not in known:
        yield sum(point.readable for point in points), f"the device has no task {READ_TASK}, which reads a value", hint
    needed: dict[int, int] = {}
    for point in points:
        for keep in {"yes": (True,), "no": (False,)}.get(point.keeps or "", (False, True)) if point.writable else ():
            task = write_task(point.words, array=point.index is not None, keep=keep)
            if task not in known and (point.keeps is not None or not keep):
                needed[task] = needed.get(task, 0) + 1
    for task, count in sorted(needed.items()):
        yield count, f"the device has no task {task}, which writes such a value", hint
