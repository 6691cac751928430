"""What a person asks for when frames are read or built, and the errors that say what cannot be done and why."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True, slots=True)
class Options:
    """Options for frames, None where they were not given; `own` holds by name those that only some families have."""

    framing: str | None = None
    unit: int | None = None
    request: str | None = None
    index: int | None = None
    own: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))


class UnclearError(Exception):
    """What was asked for does not exist in the device, or more than once; `hint` says what to do (may be empty)."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint


class RefusedError(Exception):
    """A value that must not be sent. `status` is the one that generated code gives, or `missing`, `read_only`, ...

    `why` is what the message says behind the point that it is about.
    """

    def __init__(self, status: str, message: str, hint: str = "", *, why: str = "") -> None:
        super().__init__(message)
        self.status = status
        self.message = message
        self.hint = hint
        self.why = why or message


def did_you_mean(names: list[str]) -> str:
    """A hint that offers near names; empty when there are none."""
    return f"did you mean {' or '.join(f'`{line(name)}`' for name in names)}?" if names else ""


def quoted(text: str) -> str:
    """What a person typed, as messages repeat it: clean and short."""
    cleaned = line(text[:200])
    return cleaned if len(cleaned) <= 60 else f"{cleaned[:57]}..."
