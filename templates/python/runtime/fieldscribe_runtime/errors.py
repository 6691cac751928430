# SPDX-License-Identifier: 0BSD
"""Everything that can go wrong, as exceptions: one base class, and `status` names the case."""

from __future__ import annotations

from typing import Any, TypeVar


class FieldscribeError(Exception):
    """Base of all errors of generated devices; `status` is a stable name for programs.

    `point` says which point was asked for, with its code (`device.point(error.point)` is that point); of several that
    one request reads, which they are; else the command or the place. `group` is the group that was read, where it was
    one, and `needs` another point that had to be read first. `undecided` is the variant or number that this depends on,
    and that was not passed when the device was made. `exists_when` says when a refused point exists, where other points
    decide that. `received` is what came in place of a frame.
    """

    status: str = "error"
    group: str | None = None
    point: str | None = None
    needs: str | None = None
    undecided: str | None = None
    exists_when: str | None = None
    received: bytes = b""

    @property
    def lost(self) -> bool:
        """Whether the line lost a frame or spoiled it, so that trying again may help: no refusal, and no mistake."""
        return False

    @property
    def reason(self) -> str:
        """What is wrong, without what was asked for and what to do about it."""
        exists = f"; it exists only when {self.exists_when}" if self.exists_when else ""
        return ": ".join([*([f"needs {self.needs}"] if self.needs else []), super().__str__() + exists])

    def __str__(self) -> str:
        asked = [self.group and f"group {self.group}", self.point]
        advice = self.undecided and "pass it when the device is made"
        return ": ".join(filter(None, [*asked, self.reason, advice]))

    def __reduce__(self) -> tuple[Any, ...]:
        """Copies, also those between processes, have the message and all that is told beside it."""
        return _restored, (type(self), self.args, self.__dict__)


E = TypeVar("E", bound=FieldscribeError)


def undecided(error: E, what: str | None) -> E:
    """Return an error with the variant or number that it depends on, if there is one."""
    error.undecided = what
    return error


def _restored(kind: type[FieldscribeError], args: tuple[Any, ...], told: dict[str, Any]) -> FieldscribeError:
    error = kind.__new__(kind, *args)
    error.__dict__.update(told)
    return error


class CodecError(FieldscribeError, ValueError):
    """A value or raw number cannot be converted."""


class RangeError(CodecError):
    """The number may not be written."""

    status = "out_of_range"


class NotANumberError(CodecError):
    """The value is NaN."""

    status = "not_a_number"


class WrongTypeError(CodecError, TypeError):
    """The value is of a type that the point does not take: None, a text, or a bool where a number belongs."""

    status = "wrong_type"


class UnknownValueError(CodecError):
    """The number is none of the named ones, and only those may be written."""

    status = "unknown_value"


class ZeroFactorError(CodecError):
    """Another point that the scale or a limit needs is zero."""

    status = "zero_factor"


class NoCaseError(CodecError):
    """No scale fits the numbers of the points that choose it."""

    status = "no_case"


class ResultOverflowError(CodecError):
    """The result is too large to be represented."""

    status = "overflow"


class SpecialCodeError(CodecError):
    """A special code stands where a quantity belongs, or is to be written and only read; `special` is its name."""

    status = "special"

    def __init__(self, special: str, message: str) -> None:
        super().__init__(message)
        self.special = special


class MalformedError(CodecError):
    """The words do not hold what they should: a text that is no UTF-8 or UTF-16."""

    status = "malformed"


class WrongLengthError(CodecError):
    """Too few or too many words for this point."""

    status = "wrong_length"


class MissingRawError(CodecError):
    """The conversion needs the raw number of another point, and `raws` does not hold it."""

    status = "missing_raw"


class AccessError(FieldscribeError):
    """The device has the point or the group, but not this: it is only written, belongs to another device, ..."""

    status = "no_access"


class AbsentError(AccessError, AttributeError):
    """The device has no such point, by attribute or by name: why, the message says.

    The name is unknown, the point is documented only, or only another variant has it (or nobody said which one it is).
    """


class OtherDeviceError(FieldscribeError):
    """What answers is another device: a point holds something else than the description says."""

    status = "other_device"


class WaitError(FieldscribeError):
    """The device did not come to what a step of a command waits for; `held` are the words that it had last."""

    status = "not_reached"

    def __init__(self, message: str, held: tuple[int, ...]) -> None:
        super().__init__(message)
        self.held = held


class BlockError(FieldscribeError):
    """A block of addresses cannot be found.

    `status` is `no_marker` (nothing says where blocks start), `bad_chain` (they do not end), `no_block` (the device has
    no block of that id) or `behind_end` (the block is shorter than the point needs).
    """

    def __init__(self, status: str, message: str) -> None:
        super().__init__(message)
        self.status = status


class RequestError(FieldscribeError, ValueError):
    """The request cannot be sent to this device; `status` says why (bad_unit, bad_count, ...)."""

    def __init__(self, status: str, message: str) -> None:
        super().__init__(message)
        self.status = status


_OF_GATEWAYS = frozenset({0x0A, 0x0B})
_FINAL = frozenset({"exception", "refused", "no_rights", "echo_mismatch", "wrong_type"})


class FrameError(FieldscribeError):
    """The reply is not a good answer to the request; `status` says why (bad_crc, short_frame, echo_mismatch, ...).

    `words` is the process data that came in the same telegram, where the rest of it was good.
    """

    words: tuple[int, ...] = ()

    @property
    def lost(self) -> bool:
        """Whether trying again may help: not if the device refused, and not if a transport gives no bytes."""
        return self.status not in _FINAL

    def __init__(self, status: str, message: str) -> None:
        super().__init__(message)
        self.status = status


class EchoError(FrameError):
    """The device took a write and confirmed another value than the one `written`: `answered` is what it has now.

    Both are words in ascending order of address, the high word of a parameter first.
    """

    def __init__(self, message: str, written: tuple[int, ...], answered: tuple[int, ...]) -> None:
        super().__init__("echo_mismatch", message)
        self.written = written
        self.answered = answered


_STANDARD = {
    0x01: "illegal_function",
    0x02: "illegal_data_address",
    0x03: "illegal_data_value",
    0x04: "server_device_failure",
    0x05: "acknowledge",
    0x06: "server_device_busy",
    0x08: "memory_parity_error",
    0x0A: "gateway_path_unavailable",
    0x0B: "gateway_target_device_failed_to_respond",
}
"""What Modbus calls exceptions."""


class ExceptionReplyError(FrameError):
    """The device refused the request with an exception `code`; `name` is the manual's name for it, where known.

    Where the manual has none, the message has that of the standard.
    """

    @property
    def lost(self) -> bool:
        """Whether a gateway says that the unit is not there (codes 0Ah and 0Bh, unless the device names them)."""
        return self.name is None and self.code in _OF_GATEWAYS

    def __init__(self, code: int, name: str | None = None) -> None:
        called = name or _STANDARD.get(code)
        text = f"the device answered exception {code:02X}h" + (f" ({called})" if called else "")
        super().__init__("exception", text)
        self.code = code
        self.name = name


class RefusedError(FrameError):
    """The device refused the task with an error number `code`; `name` is the manual's name for it, where known."""

    def __init__(self, code: int, name: str | None = None) -> None:
        super().__init__("refused", f"the device refused the task: error {code}" + (f" ({name})" if name else ""))
        self.code = code
        self.name = name


class TelegramError(FieldscribeError):
    """Words of a telegram cannot be told; `status` is `missing` (not all came yet) or `torn` (they do not agree)."""

    def __init__(self, status: str, message: str) -> None:
        super().__init__(message)
        self.status = status


class NoReplyError(FieldscribeError, TimeoutError):
    """Nothing came that answers, in time; what was heard last, if it tells why, is the `__cause__`."""

    status = "timeout"
    lost = True


def no_reply(what: str, error: TimeoutError) -> NoReplyError:
    """Return the error for a request that nobody answered, with what the transport says of the bytes that came."""
    made = NoReplyError(f"{what}: {error}" if str(error) else what)
    made.received = getattr(error, "received", b"")
    return made


class LineError(FieldscribeError, ConnectionError):
    """The line itself failed: it cannot be opened, or the other side is gone; the `__cause__` says more.

    `unsent` is true if the request was not sent.
    """

    status = "line"
    lost = True

    def __init__(self, message: str, *, unsent: bool = False) -> None:
        super().__init__(message)
        self.unsent = unsent
