# SPDX-License-Identifier: 0BSD
"""Objects with a docstring of their own, for `help()`: the attributes of a device class are objects, not classes."""

from __future__ import annotations

from typing import Any


class _Guide:
    """A docstring: on a class its own text, on an object the object's guide."""

    def __init__(self, text: str | None) -> None:
        self._text = text

    def __get__(self, guided: Guided | None, owner: type) -> str | None:
        return self._text if guided is None else guided._guide()


class Guided:
    """The base of classes whose objects have docstrings."""

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        guide: Any = _Guide(cls.__doc__)
        cls.__doc__ = guide

    def _guide(self) -> str:
        """Return the text for `help()`."""
        raise NotImplementedError
