"""The error of a wrong formula."""

from __future__ import annotations


class FormulaError(ValueError):
    """A formula that cannot be read or used. `column` is the offset in its text, from 0; `hint` may be empty."""

    def __init__(self, message: str, column: int, hint: str = "") -> None:
        super().__init__(message)
        self.message = message
        self.column = column
        self.hint = hint
