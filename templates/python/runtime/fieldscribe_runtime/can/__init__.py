# SPDX-License-Identifier: 0BSD
"""The CAN family: messages of 8 bytes, multiplexed telegrams, and devices over a transport."""

from ..facts import Telegram
from .decoder import Decoder
from .device import (
    AsyncCanDevice,
    AsyncCanTransport,
    AsyncWaitingCanTransport,
    CanDevice,
    CanTransport,
    WaitingCanTransport,
)
from .frames import Frame, Message, Profile, Role, build, parse
from .packing import pack
from .receiver import Receiver
from .session import CanSession
from .signals import Packing, Signal

__all__ = [
    "AsyncCanDevice",
    "AsyncCanTransport",
    "AsyncWaitingCanTransport",
    "CanDevice",
    "CanSession",
    "CanTransport",
    "Decoder",
    "Frame",
    "Message",
    "Packing",
    "Profile",
    "Receiver",
    "Role",
    "Signal",
    "Telegram",
    "WaitingCanTransport",
    "build",
    "pack",
    "parse",
]
