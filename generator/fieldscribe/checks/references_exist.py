"""What is named exists: the command that `keeps` names, the point that a command's `busy` names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families import families
from fieldscribe.language.meant import value_hint

if TYPE_CHECKING:
    from fieldscribe.resolve.subject import Subject


def check(subject: Subject) -> None:
    """Names of commands and points that nothing has."""
    scope = subject.scope
    declared = {str(raw["name"]) for raw in scope.listed("commands")}
    choice = ("choice",) if scope.family.chooses_memory else ()  # the request says whether the memory keeps it
    known = ("no", "yes", *choice, *sorted(declared))
    for resolved in subject.resolved:
        keeps = resolved.point.keeps
        if keeps == "choice" and keeps not in known:
            message = f"a {scope.family.name} request cannot choose where the device keeps the value"
            choosers = " and ".join(one.name for one in families() if one.chooses_memory)
            hint = (
                f"write `keeps: yes`, `keeps: no`, or the command that stores; `choice` is for the tasks of {choosers}"
            )
            scope.report.error("wrong-choice", message, resolved.draft.span("keeps"), hint)
        elif keeps is not None and keeps not in known:
            span = resolved.draft.span("keeps")
            scope.unknown("command", keeps, span, known, value_hint("keeps", keeps))
    for raw in scope.listed("commands"):
        busy = raw.get("busy")
        if busy is not None and subject.index.find(busy) is None:
            subject.index.unknown(busy, raw.span("busy"))
