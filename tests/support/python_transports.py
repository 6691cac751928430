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
    """The port of an end that answers each request of each connection by a function, whole or in parts."""

    def serve(line: socket.socket) -> None:
        with line, suppress(OSError):
            line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            while request := line.recv(256):
                reply = answer(request)
                for part in (reply,) if isinstance(reply, bytes) else reply:
                    line.sendall(part)

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


@contextmanager
def parameters_on(channel: str, *, chatters: bool = True) -> Iterator[dict[tuple[int, int], int]]:
    """Units 1 and 2 on python-can: their parameters by unit and id. If they chatter, telegrams come all the time."""
    far, stop, held = can.Bus(channel, interface="virtual"), threading.Event(), dict[tuple[int, int], int]()

    def send(unit: int, data: list[int]) -> None:
        far.send(can.Message(arbitration_id=0x320 + unit, data=data, is_extended_id=False))

    def serve() -> None:
        while not stop.is_set():
            message = far.recv(0.01)
            if message is not None and message.arbitration_id == 0x33F:
                data = list(message.data)
                key = data[1], data[2] << 8 | data[3]
                if data[0] == 0xEE:
                    held[key] = data[4] << 8 | data[5]
                data = [*data[:4], *divmod(held.get(key, 0), 256)]
                send(key[0], [*data, data[0] ^ data[2] ^ data[4], data[1] ^ data[3] ^ data[5]])
            for unit in (1, 2) if chatters else ():
                send(unit, [0xDD, 0, 0, 0, 0, unit, 0, 0])

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        yield held
    finally:
        stop.set()
        thread.join(2)
        far.shutdown()
