# SPDX-License-Identifier: 0BSD
"""Commands of several requests in order: set-up sequences, keys, mailboxes."""

from __future__ import annotations

from contextlib import contextmanager
from keyword import iskeyword
from typing import TYPE_CHECKING, overload

from .about import About
from .arguments import shown, whole
from .commands import carried_out_once, refuse
from .conditions import holds
from .errors import FieldscribeError, RangeError, RequestError, WaitError
from .guided import Guided
from .receiving import Pause
from .records import Record

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from .conditions import Clauses
    from .device import AnyAsyncDevice, AnyDevice
    from .facts import Place
    from .session import Session, Steps
    from .traffic import Traffic

_PAUSE = 0.1
"""Seconds between two reads of what a step waits for."""


class StepWord(Record):
    """A word: constant + factor * argument, modulo 65536. Bits outside `mask` are preserved."""

    constant: int
    factor: int = 0
    argument: str = ""
    mask: int = 0xFFFF

    def merged(self, arguments: Mapping[str, int], held: int) -> int:
        """Return the word to write, given the word that the device holds."""
        number = self.constant + (self.factor * arguments[self.argument] if self.factor else 0)
        return held & ~self.mask | number & self.mask


class Step(Record):
    """One request: it writes words, or waits for at most `within` seconds until the device has them.

    `says` is the text of the description; `when` is a condition (groups of tests, one of which must hold), or empty.
    """

    says: str
    at: Place
    words: tuple[int | StepWord, ...]
    within: float | None = None
    when: Clauses = ()

    @property
    def reads(self) -> bool:
        """True if the words must be read: to wait for them, or to preserve bits."""
        return self.within is not None or any(isinstance(word, StepWord) and word.mask != 0xFFFF for word in self.words)

    def merged(self, arguments: Mapping[str, int], held: tuple[int, ...]) -> tuple[int, ...]:
        """Return the words to write, given those that the device holds; a step that waits is done if they are equal."""
        pairs = zip(self.words, held, strict=True)
        return tuple([word.merged(arguments, old) if isinstance(word, StepWord) else word for word, old in pairs])


class SteppedCommand(Guided):
    """A command of several requests in order.

    `arguments` are the least and the greatest number of each. `run` says when a device sends the command: `first`
    (before anything else), `before write` (of any point), or `by caller`; the caller also repeats a command that is due
    `every` so many seconds.
    """

    def __init__(
        self,
        *requests: Step,
        arguments: Mapping[str, tuple[int, int]] | None = None,
        run: str = "by caller",
        every: float | None = None,
    ) -> None:
        self.requests = requests
        self.arguments = arguments or {}
        self._spelled = {f"{name}_" if iskeyword(name) else name: name for name in self.arguments}
        self.run = run
        self.every = every

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}: {len(self.requests)} steps>"

    def _guide(self) -> str:
        call = f"{self.name}.send({', '.join([f'{name}=number' for name in self._spelled])})"
        given = {"first": "sent before all else", "before write": "sent before each write of a point"}.get(self.run)
        every = "" if self.every is None else f", again every {self.every:g} s"
        steps = "".join([f"\n{number}. {step.says}" for number, step in enumerate(self.requests, 1)])
        ends = "".join([f"\n{name} is {low}..{high}." for name, (low, high) in self.arguments.items()])
        return f"{self.name}, a command: {given or f'on a device, device.{call}{every}'}.\n{steps}\n{ends}"

    @overload
    def __get__(self, device: None, owner: object) -> SteppedCommand: ...
    @overload
    def __get__(self, device: AnyDevice, owner: object) -> SteppedHandle: ...
    @overload
    def __get__(self, device: AnyAsyncDevice, owner: object) -> AsyncSteppedHandle: ...
    def __get__(self, device: AnyDevice | AnyAsyncDevice | None, owner: object) -> object:
        return self if device is None else device._bound_steps(self)

    def __set__(self, device: object, value: object) -> None:
        raise AttributeError("a command is not assigned to: use its send method")

    def steps(self, device: Session, arguments: Mapping[str, int]) -> Steps[None]:
        """Return the steps of the requests on a device. An error names its step; the steps before it are done."""
        numbers = self._checked(arguments)
        for place, step in enumerate(self.requests, 1):
            with _of_step(device.traffic, f"{self.name}, step {place} ({step.says})"):
                if (yield from _is_taken(device, step)):
                    yield from _request_steps(device, step, numbers)

    def _checked(self, arguments: Mapping[str, int]) -> dict[str, int]:
        """Return the arguments as numbers; raises an error for one that is missing, unknown, or out of its range."""
        arguments = {self._spelled.get(name, name): number for name, number in arguments.items()}
        if arguments.keys() != self.arguments.keys():
            takes = ", ".join(self._spelled) or "no arguments"
            raise RequestError("bad_arguments", f"{self.name} takes {takes}, not {', '.join(arguments) or 'none'}")
        numbers = {name: whole(number) for name, number in arguments.items()}
        for name, (low, high) in self.arguments.items():
            if not low <= numbers[name] <= high:
                raise RangeError(f"{name} of {self.name} is {low}..{high}, not {shown(numbers[name])}")
        return numbers


class _Label:
    """The name of a step in logs."""

    def __init__(self, label: str) -> None:
        self.label = label


@contextmanager
def _of_step(traffic: Traffic, label: str) -> Iterator[None]:
    """Add to errors raised inside the step, and the point that it had to read."""
    try:
        with About(traffic, _Label(label)):
            yield
    except FieldscribeError as error:
        if error.point != label:
            error.point, error.needs = label, error.needs or error.point
        raise


def _is_taken(device: Session, step: Step) -> Steps[bool]:
    """Return True if the condition of a step is true; reads the points that it compares."""
    held: dict[str, int | str] = {}
    for clause in step.when:
        is_true = True
        for of, test, than in clause:
            if of not in held:
                held[of] = device._variant(of) if of in device.VARIANTS else (yield from device._raw_of_steps(of))
            is_true = holds(held[of], test, than)
            if not is_true:
                break
        if is_true:
            return True
    return not step.when


def _request_steps(device: Session, step: Step, arguments: Mapping[str, int]) -> Steps[None]:
    """Write the words of a step, or wait for them; raises WaitError if they do not appear in time."""
    left = step.within
    while True:
        held = (0,) * len(step.words)
        if step.reads:
            held = yield from device._get_steps(step.at.replaced(function=None))
        words = step.merged(arguments, held)
        if left is None:
            with carried_out_once(device):
                yield from device._put_steps(step.at, words)
            return
        if words == held:
            return
        if left <= 0:
            raise WaitError(f"not so within {step.within:g} s", held)
        yield Pause(min(left, _PAUSE))
        left -= _PAUSE


class SteppedHandle:
    """A command of a device that has several steps."""

    def __init__(self, command: SteppedCommand, device: AnyDevice) -> None:
        self._command = command
        self._device = device

    if not TYPE_CHECKING:
        __getattr__ = refuse

    def __repr__(self) -> str:
        return f"{self._command!r}"[:-1] + f" of {self._device!r}>"

    @property
    def every(self) -> float | None:
        """The seconds after which the command is due again; None if it is not repeated."""
        return self._command.every

    def send(self, /, **arguments: int) -> None:
        """Carry out the steps in order. An error names its step; those before it are done."""
        self._device._run(self._command.steps(self._device, arguments))


class AsyncSteppedHandle:
    """A command of an async device that has several steps."""

    def __init__(self, command: SteppedCommand, device: AnyAsyncDevice) -> None:
        self._command = command
        self._device = device

    if not TYPE_CHECKING:
        __getattr__ = refuse

    def __repr__(self) -> str:
        return f"{self._command!r}"[:-1] + f" of {self._device!r}>"

    @property
    def every(self) -> float | None:
        """The seconds after which the command is due again; None if it is not repeated."""
        return self._command.every

    async def send(self, /, **arguments: int) -> None:
        """Carry out the steps in order. An error names its step; those before it are done."""
        await self._device._run(self._command.steps(self._device, arguments))
