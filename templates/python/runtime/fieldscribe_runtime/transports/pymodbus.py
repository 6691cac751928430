# SPDX-License-Identifier: 0BSD
"""A client of pymodbus that a program has already, with its retries, its framer and its log.

from pymodbus.client import ModbusTcpClient
from fieldscribe_runtime.transports.pymodbus import PymodbusLine

with PymodbusLine(ModbusTcpClient("192.168.0.20")) as line:
drive = HitachiL200(line, unit=1)
"""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, Protocol

from ..errors import LineError
from ..modbus.frames import TCP

try:
    from pymodbus.exceptions import ConnectionException, ModbusIOException
    from pymodbus.pdu import ModbusPDU
except ModuleNotFoundError as missing:
    hint = 'this needs pymodbus: pip install "fieldscribe-runtime[pymodbus]"'
    raise ModuleNotFoundError(hint, name=missing.name) from None

if TYPE_CHECKING:
    from typing import Self


class Client(Protocol):
    """What is needed of a client: any of `pymodbus.client` that blocks has it."""

    def connect(self) -> bool:
        """Connect, if it is not connected."""

    def execute(self, no_response_expected: bool, request: ModbusPDU) -> Any:
        """Carry a request."""

    def close(self) -> Any:
        """Disconnect."""


class AsyncClient(Protocol):
    """The same of a client that is awaited."""

    @property
    def connected(self) -> bool:
        """Whether it is connected."""

    async def connect(self) -> bool:
        """Connect."""

    def execute(self, no_response_expected: bool, request: ModbusPDU) -> Any:
        """Carry a request."""

    def close(self) -> Any:
        """Disconnect."""


_HEAD = 7
"""Bytes before the function in a frame of Modbus TCP."""


class _Request(ModbusPDU):
    """A request whose bytes are known."""

    def __init__(self, frame: bytes) -> None:
        super().__init__(dev_id=frame[_HEAD - 1])
        self.function_code = frame[_HEAD]
        self._data = frame[_HEAD + 1 :]

    def encode(self) -> bytes:
        """What stands behind the function."""
        return self._data

    def decode(self, data: bytes) -> None:
        """Requests are not read here."""
        raise NotImplementedError

    def get_response_pdu_size(self) -> int:
        """Nobody knows."""
        return 0


def _reply(request: bytes, answer: ModbusPDU) -> bytes:
    """The answer as a frame of Modbus TCP."""
    pdu = bytes([answer.function_code]) + answer.encode()
    return request[:4] + (len(pdu) + 1).to_bytes(2, "big") + bytes([answer.dev_id]) + pdu


def _raised(error: Exception) -> Exception:
    """What devices expect in place of pymodbus' own."""
    return LineError(str(error)) if isinstance(error, ConnectionException) else TimeoutError(str(error))


class PymodbusLine:
    """A client for devices, whatever it is connected by. Leaving the context closes it."""

    framing = TCP
    """How requests are handed over; what travels is the client's own framing."""

    def __init__(self, client: Client) -> None:
        self.client = client
        self._turn = threading.Lock()

    def exchange(self, request: bytes) -> bytes:
        """Send a request and return the reply; raises TimeoutError and LineError."""
        silent = request[_HEAD - 1] == 0
        with self._turn:
            try:
                if not self.client.connect():
                    raise LineError("the client cannot connect")
                answer: Any = self.client.execute(silent, _Request(request))
            except (ConnectionException, ModbusIOException) as error:
                raise _raised(error) from error
        return b"" if silent else _reply(request, answer)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.client.close()


class AsyncPymodbusLine:
    """An async client for async devices. Leaving the context closes it."""

    framing = TCP

    def __init__(self, client: AsyncClient) -> None:
        self.client = client

    async def exchange(self, request: bytes) -> bytes:
        """Send a request and return the reply; raises TimeoutError and LineError."""
        silent = request[_HEAD - 1] == 0
        try:
            if not self.client.connected and not await self.client.connect():
                raise LineError("the client cannot connect")
            answer: Any = await self.client.execute(silent, _Request(request))
        except (ConnectionException, ModbusIOException) as error:
            raise _raised(error) from error
        return b"" if silent else _reply(request, answer)

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        self.client.close()
