"""Errors: their status, what they are at the same time, what they hold, and their messages."""

from __future__ import annotations

import copy
import pickle

from conformance.package import Package

_STATUS = {
    "FieldscribeError": "error",
    "CodecError": "error",
    "RangeError": "out_of_range",
    "NotANumberError": "not_a_number",
    "WrongTypeError": "wrong_type",
    "UnknownValueError": "unknown_value",
    "ZeroFactorError": "zero_factor",
    "NoCaseError": "no_case",
    "ResultOverflowError": "overflow",
    "SpecialCodeError": "special",
    "MalformedError": "malformed",
    "WrongLengthError": "wrong_length",
    "MissingRawError": "missing_raw",
    "AccessError": "no_access",
    "NoReplyError": "timeout",
}


def check_status(package: Package) -> None:
    """Each error has its status, and its place among the errors of Python."""
    runtime = package.runtime
    assert {name: getattr(runtime, name).status for name in _STATUS} == _STATUS
    kinds = {runtime.CodecError: ValueError, runtime.WrongTypeError: TypeError, runtime.RequestError: ValueError}
    kinds |= {runtime.NoReplyError: TimeoutError, runtime.FrameError: runtime.FieldscribeError}
    assert all(issubclass(kind, base) for kind, base in kinds.items())
    codec = [name for name in _STATUS if issubclass(getattr(runtime, name), runtime.CodecError)]
    assert codec == list(_STATUS)[1:13]


def check_contents(package: Package) -> None:
    """Errors hold what programs ask for, and say it."""
    runtime = package.runtime
    error = runtime.RangeError("it is too much")
    assert (str(error), error.point) == ("it is too much", None)
    error.point = "A1 speed"
    assert str(error) == "A1 speed: it is too much"
    for kind in (runtime.RequestError, runtime.FrameError, runtime.TelegramError):
        assert (kind("some", "why").status, str(kind("some", "why"))) == ("some", "why")
    assert runtime.FrameError("some", "why").words == ()
    special = runtime.SpecialCodeError("off", "it is off")
    assert (special.special, str(special)) == ("off", "it is off")
    echo = runtime.EchoError("another", (1, 2), (3, 4))
    assert (echo.status, echo.written, echo.answered, str(echo)) == ("echo_mismatch", (1, 2), (3, 4), "another")


def check_refusals(package: Package) -> None:
    """What a device refuses with has its number and its name."""
    exception, refused = package.runtime.ExceptionReplyError, package.runtime.RefusedError
    one, other = exception(2, "bad_address"), exception(0x11)
    assert (one.code, one.name, one.status) == (2, "bad_address", "exception")
    assert str(one) == "the device answered exception 02h (bad_address)"
    assert (str(other), other.name) == ("the device answered exception 11h", None)
    one, other = refused(101, "no_access"), refused(7)
    assert (one.code, one.name, one.status) == (101, "no_access", "refused")
    assert str(one) == "the device refused the task: error 101 (no_access)"
    assert (str(other), other.name) == ("the device refused the task: error 7", None)


def check_copies(package: Package) -> None:
    """An error that crosses to another process, or is copied, says and holds the same."""
    runtime = package.runtime
    errors = [runtime.RangeError("too much"), runtime.ExceptionReplyError(2, "bad_address"), runtime.RefusedError(7)]
    errors += [runtime.SpecialCodeError("off", "it is off"), runtime.EchoError("another", (1, 2), (3, 4))]
    errors += [kind("some", "why") for kind in (runtime.RequestError, runtime.FrameError, runtime.TelegramError)]
    for error in errors:
        error.point = "A1 speed"
        for twin in (pickle.loads(pickle.dumps(error)), copy.copy(error)):
            assert (type(twin), str(twin), vars(twin)) == (type(error), str(error), vars(error))
