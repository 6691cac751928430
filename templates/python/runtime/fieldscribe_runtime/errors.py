# SPDX-License-Identifier: 0BSD
"""The exceptions of generated devices: one base class; `status` names the case."""

from __future__ import annotations

from typing import Any, TypeVar


class FieldscribeError(Exception):
    """Base of all errors of generated devices; `status` is a stable name for programs.

    `point` names the point with its code (`device.point(error.point)` returns it), the points of one request, the
    command, or the place. `group` is the group that was read, if it was one. `needs` is another point that had to be
    read first. `undecided` is the variant or number that the result depends on and that was not passed when the device
    was made. `exists_when` is the condition on other points under which a refused point exists. `received` is what
    arrived instead of a frame.
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
        """True if a frame was lost or damaged on the line, so that trying again may help."""
        return False

    @property
    def reason(self) -> str:
        """What is wrong, without the names of the request and without advice."""
        exists = f"; it exists only when {self.exists_when}" if self.exists_when else ""
        return ": ".join([*([f"needs {self.needs}"] if self.needs else []), super().__str__() + exists])

    def __str__(self) -> str:
        asked = [self.group and f"group {self.group}", self.point]
        advice = self.undecided and "pass it when the device is made"
        return ": ".join(filter(None, [*asked, self.reason, advice]))

    def __reduce__(self) -> tuple[Any, ...]:
        """Copies, also between processes, keep the message and all attributes."""
        return _restored, (type(self), self.args, self.__dict__)


E = TypeVar("E", bound=FieldscribeError)


def undecided(error: E, what: str | None) -> E:
    """Return the error with the variant or number that it depends on, if any."""
    error.undecided = what
    return error


def _restored(kind: type[FieldscribeError], args: tuple[Any, ...], told: dict[str, Any]) -> FieldscribeError:
    error = kind.__new__(kind, *args)
    error.__dict__.update(told)
    return error


class CodecError(FieldscribeError, ValueError):
    """A value or raw number cannot be converted."""


class RangeError(CodecError):
    """The number may not be written, or does not exist."""

    status = "out_of_range"


class NotANumberError(CodecError):
    """The value is NaN."""

    status = "not_a_number"


class WrongTypeError(CodecError, TypeError):
    """The point does not take a value of this type: None, a str, or a bool instead of a number."""

    status = "wrong_type"


class UnknownValueError(CodecError):
    """The number has no name, and only named ones may be written."""

    status = "unknown_value"


class ZeroFactorError(CodecError):
    """Another point that the scale or a limit needs is zero."""

    status = "zero_factor"


class NoCaseError(CodecError):
    """The scale has no case for the numbers of the points that choose it."""

    status = "no_case"


class ResultOverflowError(CodecError):
    """The result is too large."""

    status = "overflow"


class SpecialCodeError(CodecError):
    """A special code instead of a quantity, or a write of a read-only one; `special` is its name."""

    status = "special"

    def __init__(self, special: str, message: str) -> None:
        super().__init__(message)
        self.special = special


class MalformedError(CodecError):
    """The words are no valid text (UTF-8 or UTF-16), or no date."""

    status = "malformed"


class WrongLengthError(CodecError):
    """Too few or too many words for this point."""

    status = "wrong_length"


class MissingRawError(CodecError):
    """The conversion needs the raw number of another point, but `raws` does not hold it."""

    status = "missing_raw"


class AccessError(FieldscribeError):
    """The device has the point or the group but not this access: it is write-only, of another device, ..."""

    status = "no_access"


class AbsentError(AccessError, AttributeError):
    """The device has no such point, by attribute or by name; the message says why.

    The name is unknown, the point is only documented, or only another variant has it (or the variant was not passed).
    """


class OtherDeviceError(FieldscribeError):
    """Another device answers: a point holds something else than the description says."""

    status = "other_device"


class WaitError(FieldscribeError):
    """The device did not reach what a step of a command waits for; `held` are the last words read."""

    status = "not_reached"

    def __init__(self, message: str, held: tuple[int, ...]) -> None:
        super().__init__(message)
        self.held = held


class BlockError(FieldscribeError):
    """A block of addresses cannot be found.

    `status` is `no_marker` (no marker of a chain of blocks), `bad_chain` (the chain does not end), `no_block` (no block
    with this id) or `behind_end` (the block is shorter than the point needs).
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
    """The reply is not a valid answer to the request; `status` says why (bad_crc, short_frame, echo_mismatch, ...).

    `words` is the process data of the same telegram, if that part was valid.
    """

    words: tuple[int, ...] = ()

    @property
    def lost(self) -> bool:
        """True if trying again may help: not after a refusal, and not if a transport returned no bytes object."""
        return self.status not in _FINAL

    def __init__(self, status: str, message: str) -> None:
        super().__init__(message)
        self.status = status


class EchoError(FrameError):
    """The device confirmed a write with another value than the one `written`: `answered` is what it has now.

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
"""The standard's names of Modbus exceptions."""


class ExceptionReplyError(FrameError):
    """The device refused the request with an exception `code`; `name` is the manual's name for it, if it has one.

    If not, the message has the name in the standard.
    """

    @property
    def lost(self) -> bool:
        """True if a gateway did not reach the unit (codes 0Ah and 0Bh, unless the device names them)."""
        return self.name is None and self.code in _OF_GATEWAYS

    def __init__(self, code: int, name: str | None = None) -> None:
        called = name or _STANDARD.get(code)
        text = f"the device answered exception {code:02X}h" + (f" ({called})" if called else "")
        super().__init__("exception", text)
        self.code = code
        self.name = name


class RefusedError(FrameError):
    """The device refused the task with an error number `code`; `name` is the manual's name for it, if it has one."""

    def __init__(self, code: int, name: str | None = None) -> None:
        super().__init__("refused", f"the device refused the task: error {code}" + (f" ({name})" if name else ""))
        self.code = code
        self.name = name


class TelegramError(FieldscribeError):
    """Words of a telegram are not available: `status` is `missing` (not all arrived yet) or `torn` (inconsistent)."""

    def __init__(self, status: str, message: str) -> None:
        super().__init__(message)
        self.status = status


class NoReplyError(FieldscribeError, TimeoutError):
    """No answer arrived in time; if the last bytes received explain why, they are the `__cause__`."""

    status = "timeout"
    lost = True


def no_reply(what: str, error: TimeoutError) -> NoReplyError:
    """Return the error for an unanswered request, with what the transport reports of received bytes."""
    made = NoReplyError(f"{what}: {error}" if str(error) else what)
    made.received = getattr(error, "received", b"")
    return made


class LineError(FieldscribeError, ConnectionError):
    """The line itself failed: it cannot be opened, or the other side is gone; see the `__cause__`.

    `unsent` is true if the request was not sent.
    """

    status = "line"
    lost = True

    def __init__(self, message: str, *, unsent: bool = False) -> None:
        super().__init__(message)
        self.unsent = unsent
