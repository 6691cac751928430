# SPDX-License-Identifier: 0BSD
"""Objects of which `help()` says what each of them is: attributes of a device class are no classes of their own."""

from __future__ import annotations

from typing import Any


class _Guide:
    """A docstring: of the class its own text, of an object what that tells."""

    def __init__(self, text: str | None) -> None:
        self._text = text

    def __get__(self, guided: Guided | None, owner: type) -> str | None:
        return self._text if guided is None else guided._guide()


class Guided:
    """Something with a docstring for each object."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        guide: Any = _Guide(cls.__doc__)
        cls.__doc__ = guide

    def _guide(self) -> str:
        """Return what `help()` says of it."""
        raise NotImplementedError
