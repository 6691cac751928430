# SPDX-License-Identifier: 0BSD
"""Named constant writes, such as storing the parameters."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, overload

from .about import About
from .arguments import check_integer, shown
from .errors import AbsentError, AccessError
from .guided import Guided

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Never

    from .device import AnyAsyncDevice, AnyDevice
    from .facts import Place
    from .session import Session, Steps


class Command(Guided):
    """A write that makes the device do something; without a `value` any number does (1 if none is given)."""

    def __init__(self, *, at: Place, value: int | None = None) -> None:
        self.at = at
        self.value = value

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}: {self.at}>"

    @property
    def label(self) -> str:
        """The name, for messages."""
        return self.name

    def _guide(self) -> str:
        sent = "any number (1 if none is given)" if self.value is None else f"the number {self.value}"
        return f"{self.name}, a command: it writes {sent} to {self.at}.\n\nOn a device: device.{self.name}.send()"

    @overload
    def __get__(self, device: None, owner: object) -> Command: ...
    @overload
    def __get__(self, device: AnyDevice, owner: object) -> CommandHandle: ...
    @overload
    def __get__(self, device: AnyAsyncDevice, owner: object) -> AsyncCommandHandle: ...
    def __get__(self, device: AnyDevice | AnyAsyncDevice | None, owner: object) -> object:
        return self if device is None else device._bound_command(self)

    def __set__(self, device: object, value: object) -> None:
        raise AttributeError("a command is not assigned to: use its send method")

    def steps(self, device: Session, value: int | None) -> Steps[None]:
        """Return the write, carried out by a device."""
        if value is not None and not (isinstance(value, bool) and self.at.space == "coil"):
            check_integer("bad_value", f"the number of {self.name}", value)
        if self.value is not None and value not in (None, self.value):
            raise AccessError(f"{self.name} is the number {self.value}, not {shown(value)}")
        number = 1 if value is None else value
        return self._given_steps(device, number if self.value is None else self.value)

    def _given_steps(self, device: Session, number: int) -> Steps[None]:
        with carried_out_once(device), About(device.traffic, self):
            yield from device._put_steps(self.at, (number,))


@contextmanager
def carried_out_once(device: Session) -> Iterator[None]:
    """Turn off repetitions inside, so that no command is carried out twice."""
    retries, device.retries = device.retries, 0
    try:
        yield
    finally:
        device.retries = retries


def refuse(handle: CommandHandle, name: str) -> Never:
    """Raise AbsentError that says how a command is used."""
    if name[:1] == "_":
        raise AttributeError(name)
    what = handle._command.name
    raise AbsentError(f"{what} is a command: it has no {name}, use {what}.send()", name=name, obj=handle)


class CommandHandle:
    """A command of a device."""

    def __init__(self, command: Command, device: AnyDevice) -> None:
        self._command = command
        self._device = device

    if not TYPE_CHECKING:
        __getattr__ = refuse

    def __repr__(self) -> str:
        return f"{self._command!r}"[:-1] + f" of {self._device!r}>"

    def send(self, value: int | None = None) -> None:
        """Send the command; pass `value` only if the command takes any number."""
        self._device._run(self._command.steps(self._device, value))


class AsyncCommandHandle:
    """A command of an async device."""

    def __init__(self, command: Command, device: AnyAsyncDevice) -> None:
        self._command = command
        self._device = device

    if not TYPE_CHECKING:
        __getattr__ = refuse

    def __repr__(self) -> str:
        return f"{self._command!r}"[:-1] + f" of {self._device!r}>"

    async def send(self, value: int | None = None) -> None:
        """Send the command; pass `value` only if the command takes any number."""
        await self._device._run(self._command.steps(self._device, value))
