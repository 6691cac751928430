# SPDX-License-Identifier: 0BSD
"""What generated devices are made of: points, forms, frames and devices. It needs nothing but Python 3.11."""

from .descriptors import ByVariant, ReadOnly, ReadWrite, WriteOnly, renamed
from .device import AsyncDevice, AsyncTransport, Device, Transport
from .errors import (
    AccessError,
    CodecError,
    ExceptionReply,
    FieldscribeError,
    FrameError,
    MissingRawError,
    NoCaseError,
    NotANumberError,
    NoValueError,
    RangeError,
    RequestError,
    ResultOverflowError,
    UnknownValueError,
    WrongLengthError,
    ZeroFactorError,
)
from .forms import F32, F64, S8, S16, S32, S64, U8, U16, U32, U64, Bit, Flags, Floating, Integer, Named, OrNone, Scaled
from .modbus import Profile
from .planner import Block
from .points import Place, Point, coil, discrete, holding, input_register
from .rules import Case, Factor, Limit, Rule
from .session import PointTable, Value
from .words import Field, Flag

__all__ = [
    "F32",
    "F64",
    "S8",
    "S16",
    "S32",
    "S64",
    "U8",
    "U16",
    "U32",
    "U64",
    "AccessError",
    "AsyncDevice",
    "AsyncTransport",
    "Bit",
    "Block",
    "ByVariant",
    "Case",
    "CodecError",
    "Device",
    "ExceptionReply",
    "Factor",
    "Field",
    "FieldscribeError",
    "Flag",
    "Flags",
    "Floating",
    "FrameError",
    "Integer",
    "Limit",
    "MissingRawError",
    "Named",
    "NoCaseError",
    "NoValueError",
    "NotANumberError",
    "OrNone",
    "Place",
    "Point",
    "PointTable",
    "Profile",
    "RangeError",
    "ReadOnly",
    "ReadWrite",
    "RequestError",
    "ResultOverflowError",
    "Rule",
    "Scaled",
    "Transport",
    "UnknownValueError",
    "Value",
    "WriteOnly",
    "WrongLengthError",
    "ZeroFactorError",
    "coil",
    "discrete",
    "holding",
    "input_register",
    "renamed",
]
