"""The options for frames that a user gives, and the errors for a request that cannot be met."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from fieldscribe.text import line

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True, slots=True)
class Options:
    """The options for frames, None if not given; `own` has those of single families, by name."""

    framing: str | None = None
    unit: int | None = None
    request: str | None = None
    index: int | None = None
    own: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))


class UnclearError(Exception):
    """The device does not have what the user named, or has it more than once; `hint` may be empty."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.hint = hint


class RefusedError(Exception):
    """A value must not be sent. `status` is that of generated code, or `missing`, `read_only` and the like.

    `why` is the message without the name of the point.
    """

    def __init__(self, status: str, message: str, hint: str = "", *, why: str = "") -> None:
        super().__init__(message)
        self.status = status
        self.message = message
        self.hint = hint
        self.why = why or message


def did_you_mean(names: list[str]) -> str:
    """Return a hint that offers near names; empty if there are none."""
    return f"did you mean {' or '.join(f'`{line(name)}`' for name in names)}?" if names else ""
