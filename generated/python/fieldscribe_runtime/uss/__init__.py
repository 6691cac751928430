# SPDX-License-Identifier: 0BSD
"""The USS family: telegrams with a parameter part and process data, and devices over a transport."""

from ..facts import Telegram
from .descriptors import (
    AsyncStoredHandle,
    AsyncStoredWriteHandle,
    Stored,
    StoredHandle,
    StoredWriteHandle,
    StoredWriteOnly,
)
from .device import AsyncUssDevice, AsyncUssTransport, UssDevice, UssTransport
from .frames import (
    Link,
    Profile,
    Reply,
    Request,
    broadcast,
    build,
    check_link,
    check_request,
    parse,
    reply_size,
)
from .session import UssSession

__all__ = [
    "AsyncStoredHandle",
    "AsyncStoredWriteHandle",
    "AsyncUssDevice",
    "AsyncUssTransport",
    "Link",
    "Profile",
    "Reply",
    "Request",
    "Stored",
    "StoredHandle",
    "StoredWriteHandle",
    "StoredWriteOnly",
    "Telegram",
    "UssDevice",
    "UssSession",
    "UssTransport",
    "broadcast",
    "build",
    "check_link",
    "check_request",
    "parse",
    "reply_size",
]
