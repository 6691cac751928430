"""A point means one thing: its number is a name, a word of flags, a quantity by a scale, or a floating-point number."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject
    from fieldscribe.resolve.drafts import Draft

_OF_INTEGERS = ("enum", "flags", "scale", "decimals", "steps")
_RIVALS = (
    ("enum", "flags", "name the numbers of several bits under `values` of one flag"),
    ("enum", "scale", "codes beside the numbers go under `special`"),
    ("flags", "scale", "bits with a number of their own are a point with `bits`"),
    ("range", "range_in_units", "give one of them; what the manual prints besides goes under `printed`"),
)


def check(subject: Subject) -> None:
    """Facts of one point that cannot both hold."""
    for resolved in subject.resolved:
        draft = resolved.draft
        if resolved.point.info.floating:
            _floating(subject, draft)
            continue
        for first, second, hint in _RIVALS:
            if draft.get(first) is not None and draft.get(second) is not None:
                related = [(draft.span(first), f"`{first}` stands here")]
                message = f"`{draft.name}` cannot have both `{first}` and `{second}`"
                subject.report.error("two-meanings", message, draft.span(second), hint, related)


def _floating(subject: Subject, draft: Draft) -> None:
    for key in _OF_INTEGERS:
        if draft.get(key) is not None:
            message = f"`{key}` is for whole numbers, and `{draft.name}` is a floating-point number"
            hint = "the device sends the value itself in the unit: leave it out"
            subject.report.error("float-fact", message, draft.span(key), hint)
