"""Faults of an answer on its way, written in a few words such as `late 0.5 x3`."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import NamedTuple

from fieldscribe.user_errors import UnclearError

KINDS = {
    "silent": "no answer comes",
    "late": "the answer arrives N seconds later (1)",
    "cut": "only its first N bytes arrive (half of them)",
    "doubled": "the answer arrives twice",
    "check": "its checksum is wrong (over TCP: its transaction number)",
    "unit": "another unit answers",
    "function": "the answer has another function",
    "exception": "the device refuses",
    "damaged": "byte N of it is wrong (the first)",
    "noise": "random bytes come before byte N (the first)",
    "drop": "the line breaks down after byte N (the first)",
}
"""The faults, with what each means; N is the number after the name, with its default."""
_SPOILED = frozenset({"check", "unit", "function", "exception"})
_NUMBER, _TIMES, _SHARE = (re.compile(form) for form in (r"\d+(?:\.\d+)?", r"x(\d+)", r"(\d+(?:\.\d+)?)%"))


class Outcome(NamedTuple):
    """What is sent for an answer: bytes, a delay, and whether the line breaks down afterwards."""

    data: bytes
    delay: float
    drop: bool = False
    fault: str = ""


@dataclass(slots=True)
class Fault:
    """A fault for the next `times` answers (None: all), each with the probability `share`."""

    kind: str
    number: float | None = None
    times: int | None = None
    share: float = 1.0

    @classmethod
    def of(cls, text: str) -> Fault:
        """Return the fault written as a kind, then in any order N, `xTIMES` and `SHARE%`. Raises UnclearError."""
        kind, *words = text.split() or [""]
        fault = cls(kind)
        if kind not in KINDS:
            raise UnclearError(f"there is no fault `{kind[:40]}`", f"there are {', '.join(KINDS)}")
        for word in words:
            if _NUMBER.fullmatch(word):
                fault.number = float(word)
            elif match := _TIMES.fullmatch(word):
                fault.times = int(match[1])
            elif match := _SHARE.fullmatch(word):
                fault.share = float(match[1]) / 100
            else:
                hint = f"write it as `{kind} 2 x3 50%`: with the number 2, for 3 answers, for every second one"
                raise UnclearError(f"`{word[:40]}` does not belong to the fault `{kind}`", hint)
        return fault


class Faults:
    """The active faults; the oldest one that applies to an answer is used."""

    def __init__(self, seed: int = 0) -> None:
        self.waiting: list[Fault] = []
        self._random = Random(seed)  # noqa: S311  # no secret

    def outcome(self, data: bytes, delay: float, spoiled: Callable[[bytes, str], bytes]) -> Outcome:
        """Return what is sent for an answer; `spoiled` corrupts it in the family's way."""
        for fault in self.waiting:
            if fault.share < 1 and self._random.random() >= fault.share:
                continue
            if fault.times is not None:
                fault.times -= 1
                if fault.times <= 0:
                    self.waiting.remove(fault)
            return self._struck(fault, data, delay, spoiled)
        return Outcome(data, delay)

    def _struck(self, fault: Fault, data: bytes, delay: float, spoiled: Callable[[bytes, str], bytes]) -> Outcome:
        kind, number = fault.kind, fault.number
        at = min(int(number or 0), len(data))
        if kind in _SPOILED:
            data = spoiled(data, kind)
        elif kind == "late":
            delay += 1.0 if number is None else number
        elif kind == "cut":
            data = data[: len(data) // 2 if number is None else at]
        elif kind == "doubled":
            data += data
        elif kind == "damaged":
            at = min(at, len(data) - 1)
            data = data[:at] + bytes((data[at] ^ self._random.randint(1, 255),)) + data[at + 1 :]
        elif kind == "noise":
            data = data[:at] + self._random.randbytes(3) + data[at:]
        elif kind == "drop":
            data = data[:at]
        return Outcome(b"" if kind == "silent" else data, delay, kind == "drop", kind)
