"""What the tests of transports share: the transports of a generated package, and a frame that is none of its device."""

from __future__ import annotations

import importlib
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

import can

NOISE = can.Message(arbitration_id=1, is_remote_frame=True, is_extended_id=False)


def transport(name: str) -> Any:
    """Return a module of transports, of the same copy of the runtime as the device."""
    return importlib.import_module(f"fieldscribe_runtime.transports.{name}")


def behind_a_gateway(device: Any) -> Any:
    """Return the class of a drive that speaks RTU as it is reached over TCP, through a gateway."""
    return type("Gateway", (device,), {"PROFILE": device.PROFILE.replaced(framings=("rtu", "tcp"))})


@contextmanager
def socket_end(answer: Any) -> Iterator[int]:
    """The port of an end in the network which answers each request of each connection by a function."""

    def serve(line: socket.socket) -> None:
        with line, suppress(OSError):
            while request := line.recv(256):
                line.sendall(answer(request))

    def listen() -> None:
        with suppress(OSError):
            while True:
                threading.Thread(target=serve, args=(listening.accept()[0],), daemon=True).start()

    with socket.create_server(("127.0.0.1", 0)) as listening:
        threading.Thread(target=listen, daemon=True).start()
        yield listening.getsockname()[1]
        listening.shutdown(socket.SHUT_RDWR)


def with_word(request: bytes, word: int) -> bytes:
    """An RTU answer to a request of one register."""
    body = request[:2] + bytes((2, 0, word))
    crc: int = importlib.import_module("fieldscribe_runtime.modbus").crc(body)
    return body + crc.to_bytes(2, "little")
