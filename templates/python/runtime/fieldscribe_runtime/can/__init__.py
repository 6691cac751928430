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
from .receiver import Receiver
from .session import CanSession

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
    "Profile",
    "Receiver",
    "Role",
    "Telegram",
    "WaitingCanTransport",
    "build",
    "parse",
]
