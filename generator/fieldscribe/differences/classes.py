"""How grave a difference is, and which step of the version it asks for."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

WIRE, API, BEHAVIOUR, COMPATIBLE, DOCS = "wire", "api", "behaviour", "compatible", "docs"

CLASSES = {
    WIRE: "breaks on the wire",
    API: "breaks code",
    BEHAVIOUR: "changes behaviour",
    COMPATIBLE: "is compatible",
    DOCS: "changes the documentation",
}
"""The classes, the gravest first, and what such a difference does."""

_STEPS = {WIRE: "major", API: "major", BEHAVIOUR: "minor", COMPATIBLE: "minor", DOCS: "patch"}
STEPS = ("patch", "minor", "major")
"""The steps of a version, the smallest first."""


def step_for(classes: Iterable[str]) -> str | None:
    """The step that differences of these classes ask for; None where there are none."""
    asked = {_STEPS[name] for name in classes}
    return next((step for step in reversed(STEPS) if step in asked), None)


def next_version(version: str, step: str) -> str | None:
    """The lowest version that takes this step; None where the version is no `1.2.3`.

    Below 1.0 the middle number says what breaks, as Cargo and npm read it, and the last one everything else.
    """
    numbers = _numbers(version)
    if numbers is None:
        return None
    major, minor, patch = numbers
    if step == "major" and major:
        return f"{major + 1}.0.0"
    if step == "major" or (step == "minor" and major):
        return f"{major}.{minor + 1}.0"
    return f"{major}.{minor}.{patch + 1}"


def is_taken(old: str, new: str, step: str) -> bool:
    """Whether the way from the old version to the new one is at least that step; True where one is no `1.2.3`."""
    least, there = next_version(old, step), _numbers(new)
    return least is None or there is None or there >= (_numbers(least) or there)


def _numbers(version: str) -> tuple[int, int, int] | None:
    parts = version.split(".")
    if len(parts) != 3 or not all(part.isascii() and part.isdigit() and len(part) < 10 for part in parts):
        return None
    major, minor, patch = map(int, parts)
    return major, minor, patch
