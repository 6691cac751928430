"""A received frame can be only one message: its identifier tells, or a byte that is constant in both."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.model import Message
    from fieldscribe.resolve.subject import Subject

_MOST = 64
"""With how many messages of its identifier each message is compared."""


def check(subject: Subject) -> None:
    """Findings for messages of the same identifier that differ in no constant byte."""
    raws = {str(node["name"]): node for node in reversed(list(subject.scope.listed("messages")))}
    heard: dict[int, list[Message]] = {}
    low, high = subject.bus.units
    for message in subject.messages:
        told_names: set[str] = set()
        for identifier in (
            range(message.identifier + low, message.identifier + high + 1)
            if message.adds_unit
            else (message.identifier,)
        ):
            earlier = heard.setdefault(identifier, [])
            for alike in earlier:
                if alike.name in told_names or subject.report.full or not _alike(alike, message):
                    continue
                told_names.add(alike.name)
                text = f"nobody can tell `{message.name}` from `{alike.name}` under the identifier {identifier:X}h"
                related = [(raws[alike.name].span("can_id"), f"`{alike.name}` stands here")]
                hint = "a constant byte must differ, or the identifiers; which there are with + unit, `units` says"
                subject.report.error("messages-alike", text, raws[message.name].span("can_id"), hint, related)
            if len(earlier) < _MOST:
                earlier.append(message)


def _alike(message: Message, other: Message) -> bool:
    pairs = zip(message.roles, other.roles, strict=True)
    return not any(mine.kind == theirs.kind == "constant" and mine.number != theirs.number for mine, theirs in pairs)
