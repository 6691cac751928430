# SPDX-License-Identifier: 0BSD
"""Checks of arguments: their errors say what is expected."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any, TypeVar

from .errors import AccessError, FrameError, RangeError, RequestError, WrongTypeError

if TYPE_CHECKING:
    from collections.abc import Awaitable

T = TypeVar("T")

_SHOWN = 80
_MOST = 0x10000
"""The number of words or bits that 16-bit addresses reach."""


def shown(value: object) -> str:
    """Return any value as text for messages."""
    try:
        text = repr(value)
    except ValueError:  # more digits than Python prints
        return "a number of thousands of digits"
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}..."


def whole(number: Any) -> int:
    """Return the number as a plain int.

    Raises RangeError for a number that is not an integer, and WrongTypeError for anything else. That includes bool:
    True instead of a number is usually a mistake.
    """
    if isinstance(number, bool):
        raise WrongTypeError(f"takes a number, not {number}")
    try:
        return operator.index(number)
    except TypeError:
        if hasattr(number, "__float__"):
            raise RangeError(f"{shown(number)} is no integer: only whole numbers are taken") from None
        raise WrongTypeError(f"takes an integer, not {shown(number)}") from None


def integral(number: Any) -> int:
    """Return an integer for a value of a point; a float that is a whole number is accepted."""
    if type(number) is float and number.is_integer():
        return int(number)
    return whole(number)


def raw_number(number: Any, width: int) -> int:
    """Return a raw number as a plain int; a bool is accepted for one bit, a float raises WrongTypeError."""
    if isinstance(number, bool) and width == 1:
        return int(number)
    try:
        return whole(number)
    except (RangeError, WrongTypeError):
        raise WrongTypeError(f"takes a raw number, which is an integer, not {shown(number)}") from None


def check_integer(status: str, what: str, number: Any) -> None:
    """Raises RequestError unless this is an integer and not a bool."""
    if isinstance(number, bool) or not isinstance(number, int):
        raise RequestError(status, f"{what} is an integer, not {shown(number)}")


def check_number(status: str, what: str, number: Any, ends: tuple[int, int]) -> None:
    """Raises RequestError unless this is an integer from `ends[0]` to `ends[1]`."""
    check_integer(status, what, number)
    if not ends[0] <= number <= ends[1]:
        raise RequestError(status, f"{what} {shown(number)} is outside {ends[0]}..{ends[1]}")


def check_seconds(status: str, what: str, given: Any) -> None:
    """Raises RequestError unless this is a number of seconds, 0 or more."""
    if isinstance(given, bool) or not isinstance(given, (int, float)) or not given >= 0:
        raise RequestError(status, f"{what} is a number of seconds from 0 on, not {shown(given)}")


def check_words(status: str, what: str, words: Any) -> None:
    """Raises RequestError unless this is a tuple or list of words."""
    if not isinstance(words, (tuple, list)):
        raise RequestError(status, f"{what} are a tuple of words, not {shown(words)}")
    for word in words:
        check_number(status, "a word", word, (0, 0xFFFF))


def check_values(values: tuple[Any, ...]) -> None:
    """Raises RequestError for a list; each word must be an argument of its own."""
    if len(values) == 1 and isinstance(values[0], (tuple, list)):
        raise RequestError("bad_value", f"each word is an argument: write_at(space, address, *{shown(values[0])})")


def check_place(space: Any, address: Any, count: Any) -> None:
    """Raises RequestError unless these can be a space, an address in it and a number of words or bits."""
    if not isinstance(space, str):
        raise RequestError("bad_space", f"a space is named by a text such as 'holding', not {shown(space)}")
    check_number("bad_address", "address", address, (0, _MOST - 1))
    check_integer("bad_count", "the number of words or bits", count)
    if not 1 <= count <= _MOST:
        raise RequestError("bad_count", f"takes 1 to {_MOST} words or bits, not {shown(count)}")


def check_name(kind: str, name: Any) -> None:
    """Raises AccessError unless this is a name."""
    if not isinstance(name, str) or not name.strip():
        raise AccessError(f"a {kind} is named by a text, not {shown(name)}")


def check_bytes(reply: Any) -> None:
    """Raises FrameError unless a reply is bytes."""
    if not isinstance(reply, (bytes, bytearray)):
        hint = ""
        if hasattr(reply, "__await__"):
            hint = ": an async transport belongs to the async device"
            getattr(reply, "close", str)()  # a coroutine, which nobody will await
        raise FrameError("wrong_type", f"a reply is bytes, not {shown(reply)}{hint}")


def check_transport(transport: object, **parts: str) -> None:
    """Raises RequestError (bad_transport) if a transport lacks one of the parts, given with their meanings."""
    missing = [name for name in parts if not hasattr(transport, name)]
    if missing:
        needed = " and ".join([f"`{name}` ({what})" for name, what in parts.items()])
        lacking = " and no ".join(missing)
        raise RequestError("bad_transport", f"a transport has {needed}; {shown(transport)} has no {lacking}")


def awaited(transport: object, result: Awaitable[T]) -> Awaitable[T]:
    """Return the awaitable of an async transport; raises RequestError (bad_transport) for a blocking one."""
    if not hasattr(result, "__await__"):
        text = f"{shown(transport)} returned {shown(result)}: an async device takes an async transport"
        raise RequestError("bad_transport", text)
    return result
