# SPDX-License-Identifier: 0BSD
"""What generated devices are made of: points, forms and devices. It needs nothing but Python 3.11.

Each bus family is a package of its own (`modbus`, `can`, `uss`) with its frames, its session and its devices; what
stands beside these packages knows no bus. The names of Modbus are here too.
"""

from .commands import Command
from .descriptors import ByVariant, ReadOnly, ReadWrite, WriteOnly, renamed
from .device import AnyAsyncDevice, AnyDevice
from .errors import (
    AbsentError,
    AccessError,
    CodecError,
    EchoError,
    ExceptionReplyError,
    FieldscribeError,
    FrameError,
    LineError,
    MissingRawError,
    NoCaseError,
    NoReplyError,
    NotANumberError,
    OtherDeviceError,
    RangeError,
    RefusedError,
    RequestError,
    ResultOverflowError,
    SpecialCodeError,
    TelegramError,
    UnknownValueError,
    WaitError,
    WrongLengthError,
    WrongTypeError,
    ZeroFactorError,
)
from .facts import (
    Documented,
    Identification,
    Place,
    Telegram,
    coil,
    discrete,
    holding,
    input_register,
    parameter,
    telegram,
)
from .forms import (
    BIT,
    F32,
    F64,
    S8,
    S16,
    S32,
    S64,
    U8,
    U16,
    U32,
    U64,
    Bit,
    Flags,
    Integer,
    Named,
    Type,
)
from .layouts import Layout
from .modbus import (
    AsyncModbusDevice,
    AsyncTransport,
    Block,
    ModbusDevice,
    Profile,
    Transport,
)
from .named import NamedNumber, renamed_classes
from .points import Point
from .quantities import Floating, Scaled
from .rules import Case, Factor, Limit, Rule
from .session import Value
from .special import Codes, Special
from .steps import Step, SteppedCommand, StepWord
from .table import PointTable
from .texts import Digits, Text
from .words import Field, Flag, Word
from .wrappers import WithCodes, WithWritableCodes

Device = ModbusDevice
AsyncDevice = AsyncModbusDevice

__all__ = [
    "BIT",
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
    "AbsentError",
    "AccessError",
    "AnyAsyncDevice",
    "AnyDevice",
    "AsyncDevice",
    "AsyncModbusDevice",
    "AsyncTransport",
    "Bit",
    "Block",
    "ByVariant",
    "Case",
    "CodecError",
    "Codes",
    "Command",
    "Device",
    "Digits",
    "Documented",
    "EchoError",
    "ExceptionReplyError",
    "Factor",
    "Field",
    "FieldscribeError",
    "Flag",
    "Flags",
    "Floating",
    "FrameError",
    "Identification",
    "Integer",
    "Layout",
    "Limit",
    "LineError",
    "MissingRawError",
    "ModbusDevice",
    "Named",
    "NamedNumber",
    "NoCaseError",
    "NoReplyError",
    "NotANumberError",
    "OtherDeviceError",
    "Place",
    "Point",
    "PointTable",
    "Profile",
    "RangeError",
    "ReadOnly",
    "ReadWrite",
    "RefusedError",
    "RequestError",
    "ResultOverflowError",
    "Rule",
    "Scaled",
    "Special",
    "SpecialCodeError",
    "Step",
    "StepWord",
    "SteppedCommand",
    "Telegram",
    "TelegramError",
    "Text",
    "Transport",
    "Type",
    "UnknownValueError",
    "Value",
    "WaitError",
    "WithCodes",
    "WithWritableCodes",
    "Word",
    "WriteOnly",
    "WrongLengthError",
    "WrongTypeError",
    "ZeroFactorError",
    "coil",
    "discrete",
    "holding",
    "input_register",
    "parameter",
    "renamed",
    "renamed_classes",
    "telegram",
]
