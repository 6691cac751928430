"""Other people's Modbus clients, each asked in the same way: a function, an address, and how many items or which."""

from __future__ import annotations

import importlib
import re
import subprocess
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import serial
from fieldscribe.simulation import Simulated
from pymodbus import FramerType
from pymodbus.client import ModbusSerialClient, ModbusTcpClient

READS = (1, 2, 3, 4)
REFUSAL = 5
"""The bytes of an exception over RTU."""
Ask = Callable[[int, int, Sequence[int]], list[int]]
"""Sends a request: a function, an address, and for reads the count, for writes the items; returns what was read."""


class Refused(Exception):  # noqa: N818  # it is an answer
    """The device answered with an exception."""

    def __init__(self, code: int) -> None:
        super().__init__(code)
        self.code = code


@contextmanager
def pymodbus(device: Simulated, framing: str) -> Iterator[Ask]:
    """Return what asks by pymodbus."""
    rtu = FramerType.RTU
    client: Any = (
        ModbusSerialClient(device.path, framer=rtu)
        if device.path
        else ModbusTcpClient("127.0.0.1", port=device.port, framer=rtu if framing == "rtu" else FramerType.SOCKET)
    )
    reads = (client.read_coils, client.read_discrete_inputs, client.read_holding_registers, client.read_input_registers)
    writes = {5: client.write_coil, 6: client.write_register, 15: client.write_coils, 16: client.write_registers}

    def ask(function: int, address: int, items: Sequence[int]) -> list[int]:
        if function in READS:
            reply = reads[function - 1](address, count=items[0], device_id=device.unit)
        else:
            values = [bool(item) for item in items] if function in (5, 15) else list(items)
            reply = writes[function](address, values[0] if function < 15 else values, device_id=device.unit)
        if reply.isError():
            raise Refused(reply.exception_code)
        if function not in READS:
            return []
        return [int(bit) for bit in reply.bits[: items[0]]] if function < 3 else list(reply.registers)

    assert client.connect()
    try:
        yield ask
    finally:
        client.close()


_WORDS = {1: "illegal function", 2: "illegal data address", 3: "illegal data value", 4: "device failure"}
_WORDS |= {8: "memory parity error"}
"""What minimalmodbus says in place of an exception's number; others it says."""


class _Port(serial.Serial):
    """A port that hands out a refusal, which is shorter than the answer that is waited for."""

    def read(self, size: int = 1) -> bytes:
        head: bytes = super().read(min(size, REFUSAL))
        return head if len(head) < REFUSAL or head[1] & 0x80 else head + super().read(size - REFUSAL)


@contextmanager
def minimal_modbus(device: Simulated, framing: str) -> Iterator[Ask]:
    """Return what asks by minimalmodbus over a serial port."""
    assert framing == "rtu"
    minimalmodbus: Any = importlib.import_module("minimalmodbus")  # it says no types
    with _Port(device.path, 115200, timeout=5) as port:
        unit = minimalmodbus.Instrument(port, device.unit)

        def ask(function: int, address: int, items: Sequence[int]) -> list[int]:
            try:
                return _exchanged(unit, function, address, items)
            except minimalmodbus.SlaveReportedException as error:
                known = next((code for code, words in _WORDS.items() if words in str(error)), 0)
                raise Refused(known or int(re.findall(r"error code (\d+)", str(error))[0])) from error
            except minimalmodbus.InvalidResponseError as error:
                if not str(error).startswith(f"Wrong functioncode: {function | 0x80} "):
                    raise
                raise Refused(5) from error  # which it takes for no refusal, and then for another function

        yield ask


def _exchanged(unit: Any, function: int, address: int, items: Sequence[int]) -> list[int]:
    if function in (1, 2):
        return list(unit.read_bits(address, items[0], function))
    if function in (3, 4):
        return list(unit.read_registers(address, items[0], function))
    if function == 5:
        unit.write_bit(address, items[0], function)
    elif function == 15:
        unit.write_bits(address, list(items))
    elif function == 6:
        unit.write_register(address, items[0], functioncode=function)
    else:
        unit.write_registers(address, list(items))
    return []


@contextmanager
def of_program(program: Path, device: Simulated, framing: str) -> Iterator[Ask]:
    """Return what asks by a program: a line for each request, a line for each answer."""
    words = [str(program), "serial" if device.path else framing, device.path or str(device.port), str(device.unit)]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as running:
        assert running.stdin is not None
        assert running.stdout is not None
        to, of = running.stdin, running.stdout

        def ask(function: int, address: int, items: Sequence[int]) -> list[int]:
            count = [] if function in READS else [len(items)]
            print(function, address, *count, *items, file=to, flush=True)
            kind, *numbers = of.readline().split() or ["nothing"]
            if kind == "refused":
                raise Refused(int(numbers[0]))
            assert kind == "ok", (kind, *numbers)
            return [int(number) for number in numbers]

        try:
            yield ask
        finally:
            to.close()
