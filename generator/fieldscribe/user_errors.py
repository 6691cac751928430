"""The errors for a request of a user that cannot be met, and hints with near names."""

from __future__ import annotations

from fieldscribe.text import line


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
