"""No two things get one identifier in a target, and none is a reserved word there."""

from __future__ import annotations

from fieldscribe.checks.subject import Subject


def check(subject: Subject) -> None:
    """Filled in once the targets' naming rules are known."""
