"""What is named exists: the command that `keeps` names, the point that a command's `busy` names."""

from __future__ import annotations

from fieldscribe.checks.subject import Subject
from fieldscribe.resolve.scope import unknown_name


def check(subject: Subject) -> None:
    """Names of commands and points that nothing has."""
    commands = [command.name for command in subject.commands]
    for resolved in subject.resolved:
        keeps = resolved.point.keeps
        if keeps is not None and keeps not in ("no", "yes", *commands):
            message = f"`keeps: {keeps}` names no command"
            hint = unknown_name(keeps, ["no", "yes", *commands], "commands")
            subject.report.error("unknown-command", message, resolved.draft.span("keeps"), hint)
    for raw in subject.scope.listed("commands"):
        busy = raw.get("busy")
        if busy is not None and subject.index.find(busy) is None:
            subject.report.error(
                "unknown-point", f"there is no point `{busy}`", raw.span("busy"), subject.index.hint(busy)
            )
