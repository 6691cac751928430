"""Reads several points such that one without a good answer loses no other."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from fieldscribe.resources import use_python_runtime

use_python_runtime()

from fieldscribe_runtime import FieldscribeError, LineError  # noqa: E402 - they are found from here on

if TYPE_CHECKING:
    from fieldscribe_runtime import AnyDevice

_MOST_SILENT = 2
"""How many points may stay without an answer before any has one."""


class PartialReads:
    """Reads points of one device. `gone` is the error with which the line was lost meanwhile."""

    def __init__(self, device: AnyDevice) -> None:
        self._device = device
        self._answering = ""
        """A point that the device answered: whether it still does tells a lost point from a lost line."""
        self.gone: FieldscribeError | None = None

    def read(self, what: str | Sequence[str], items: Sequence[str]) -> dict[str, Any]:
        """Return the value or the error of each point by name; `what` are these points, or their group.

        Raises FieldscribeError if nothing is answered at all.
        """
        try:
            return self._asked(what)
        except FieldscribeError as error:
            if not error.lost or isinstance(error, LineError):
                raise
            return self._singly(items, error)

    def _asked(self, what: str | Sequence[str]) -> dict[str, Any]:
        values: dict[str, Any] = self._device.read_many(what, errors="return")
        good = (name for name, value in values.items() if not isinstance(value, FieldscribeError))
        self._answering = next(good, self._answering)
        return values

    def _singly(self, items: Sequence[str], error: FieldscribeError) -> dict[str, Any]:
        values: dict[str, Any] = {}
        silent = 0
        for item in items:
            try:
                values.update(self._asked([item]) if len(items) > 1 and self.gone is None else {item: error})
            except FieldscribeError as lost:
                if not lost.lost:
                    raise
                values[item] = error = lost
            if values.get(item) is error and self.gone is None:
                silent += 1
                self.gone = self._lost_line(error, silent)
        if not self._answering:
            raise error
        return values

    def _lost_line(self, error: FieldscribeError, silent: int) -> FieldscribeError | None:
        """Return the error of the line where nothing answers any more; None if only a point does not."""
        if isinstance(error, LineError) or not self._answering:
            return error if silent >= _MOST_SILENT or isinstance(error, LineError) else None
        try:
            self._asked([self._answering])
        except FieldscribeError as lost:
            return lost
        return None
