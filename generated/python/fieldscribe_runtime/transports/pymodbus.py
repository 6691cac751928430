# SPDX-License-Identifier: 0BSD
"""A line over a pymodbus client of your program, with its retries, its framer and its log.

    from pymodbus.client import ModbusSerialClient
    from fieldscribe_runtime.transports.pymodbus import PymodbusLine

    with PymodbusLine(ModbusSerialClient("/dev/ttyUSB0", baudrate=9600)) as line:
        drive = HitachiL200(line, unit=1)

It works for every Modbus device: the client adds the framing itself.
"""

from __future__ import annotations

import threading
from inspect import iscoroutinefunction
from time import monotonic
from typing import TYPE_CHECKING, Any, Protocol

from ..errors import LineError
from ..modbus.frames import PDU
from ..receiving import Broadcast, Reply
from . import checks

try:
    from pymodbus.exceptions import ConnectionException, ModbusIOException
    from pymodbus.pdu import ModbusPDU
except ModuleNotFoundError as missing:
    hint = "this needs pymodbus: pip install pymodbus"
    raise ModuleNotFoundError(hint, name=missing.name) from None

if TYPE_CHECKING:
    from typing import Self


class Client(Protocol):
    """The methods that a client needs: every blocking client of `pymodbus.client` has them."""

    def connect(self) -> bool:
        """Connect, if it is not connected."""

    def execute(self, no_response_expected: bool, request: ModbusPDU) -> Any:
        """Carry a request."""

    def close(self) -> Any:
        """Disconnect."""


class AsyncClient(Protocol):
    """The same for an async client."""

    @property
    def connected(self) -> bool:
        """Whether it is connected."""

    async def connect(self) -> bool:
        """Connect."""

    def execute(self, no_response_expected: bool, request: ModbusPDU) -> Any:
        """Carry a request."""

    def close(self) -> Any:
        """Disconnect."""


class _Request(ModbusPDU):
    """A request with given bytes."""

    def __init__(self, request: bytes) -> None:
        super().__init__(dev_id=request[0])
        self.function_code = request[1]
        self._data = request[2:]

    def encode(self) -> bytes:
        """Return the bytes after the function."""
        return self._data

    def decode(self, data: bytes) -> None:
        """Do nothing: requests are not parsed here."""
        raise NotImplementedError

    def get_response_pdu_size(self) -> int:
        """Return the size as unknown."""
        return 0


def _reply(answer: ModbusPDU) -> bytes:
    """Return the bytes of the unit that answered, and of the answer."""
    return bytes([answer.dev_id, answer.function_code]) + answer.encode()


def _check(client: Any, takes: str, *, awaits: bool) -> None:
    """Raises RequestError (bad_transport) unless this is a client of the right kind."""
    checks.object_with("the client", takes, client, "connect", "execute", "close")
    if iscoroutinefunction(client.connect) is not awaits:
        checks.refuse("the client", takes, client)


def _raised(error: Exception) -> Exception:
    """Return the error that devices expect for an error of pymodbus."""
    return LineError(str(error)) if isinstance(error, ConnectionException) else TimeoutError(str(error))


class PymodbusLine:
    """A line for devices over any blocking client. Leaving the context closes it."""

    framing = PDU
    """The form of requests for the client, which adds its own framing."""

    def __init__(self, client: Client) -> None:
        _check(client, "one of pymodbus that blocks, as in ModbusTcpClient('192.168.0.20')", awaits=False)
        self.client = client
        self._turn = threading.Lock()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.client}>"

    def exchange(self, request: bytes) -> bytes:
        """Send a request and return the reply; raises TimeoutError and LineError."""
        silent = isinstance(request, Broadcast)
        with self._turn:
            try:
                if not self.client.connect():
                    raise LineError("the client cannot connect", unsent=True)
                since = monotonic()
                answer: Any = self.client.execute(silent, _Request(request))
            except (ConnectionException, ModbusIOException) as error:
                raise _raised(error) from error
            return b"" if silent else Reply.timed(_reply(answer), since)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.client.close()


class AsyncPymodbusLine:
    """A line for async devices over an async client. Leaving the context closes it."""

    framing = PDU

    def __init__(self, client: AsyncClient) -> None:
        _check(client, "one of pymodbus that is awaited, as in AsyncModbusTcpClient('192.168.0.20')", awaits=True)
        self.client = client

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.client}>"

    async def exchange(self, request: bytes) -> bytes:
        """Send a request and return the reply; raises TimeoutError and LineError."""
        silent = isinstance(request, Broadcast)
        try:
            if not self.client.connected and not await self.client.connect():
                raise LineError("the client cannot connect", unsent=True)
            answer: Any = await self.client.execute(silent, _Request(request))
        except (ConnectionException, ModbusIOException) as error:
            raise _raised(error) from error
        return b"" if silent else _reply(answer)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        self.client.close()
