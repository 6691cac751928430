"""Whoever hears a frame can say which message it is: by its identifier, or by a byte that is a constant in both."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.model import Message
    from fieldscribe.resolve.subject import Subject

_MOST = 64
"""How many messages of one identifier are compared with a further one."""


def check(subject: Subject) -> None:
    """Messages that travel under one identifier and differ in no constant byte."""
    raws = {str(raw["name"]): raw for raw in reversed(list(subject.scope.listed("messages")))}
    heard: dict[int, list[Message]] = {}
    low, high = subject.bus.units
    for message in subject.messages:
        told: set[str] = set()
        for identifier in (
            range(message.identifier + low, message.identifier + high + 1)
            if message.adds_unit
            else (message.identifier,)
        ):
            others = heard.setdefault(identifier, [])
            for alike in others:
                if alike.name in told or subject.report.full or not _alike(alike, message):
                    continue
                told.add(alike.name)
                text = f"nobody can tell `{message.name}` from `{alike.name}` under the identifier {identifier:X}h"
                related = [(raws[alike.name].span("can_id"), f"`{alike.name}` stands here")]
                hint = "a constant byte must differ, or the identifiers; which there are with + unit, `units` says"
                subject.report.error("messages-alike", text, raws[message.name].span("can_id"), hint, related)
            if len(others) < _MOST:
                others.append(message)


def _alike(one: Message, other: Message) -> bool:
    pairs = zip(one.roles, other.roles, strict=True)
    return not any(mine.kind == theirs.kind == "constant" and mine.number != theirs.number for mine, theirs in pairs)
