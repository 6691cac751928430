"""Generated TypeScript devices, driven in a process of node: `device("baseFrequency", "read")`."""

from __future__ import annotations

import json
import shutil
import socket
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import can
from fieldscribe.text import camel, pascal

from support.places import TESTS
from support.toolchains import npm_package, tool
from support.typescript_packages import SHIPPED, install

DRIVER = TESTS / "targets/typescript/programs/driver.mjs"
PEERS = ("serialport", "modbus-serial")
_FRAME = 13
"""The bytes of a frame on the bridge: identifier, length, data."""


class NodeError(Exception):
    """What a device in node raised: `status`, `point`, and what else the error holds."""

    def __init__(self, error: dict[str, Any]) -> None:
        super().__init__(error.get("message"))
        self.facts = error
        self.status, self.kind, self.point = error.get("status"), error["kind"], error.get("point")


class NodeDevice:
    """A device in node: a call gives its result, or raises NodeError."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def __call__(self, on: str | None, call: str, *arguments: Any) -> Any:
        """Return what a method of a point, a command, or of the device itself gives."""
        return self._asked({"call": call, "arguments": arguments} | ({} if on is None else {"on": on}))

    def set(self, **numbers: Any) -> None:
        """Set attributes of the device."""
        self._asked({"set": {camel(name): number for name, number in numbers.items()}})

    def _asked(self, request: dict[str, Any]) -> Any:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(json.dumps(request) + "\n")
        self._process.stdin.flush()
        answer = json.loads(self._process.stdout.readline())
        if "error" in answer:
            raise NodeError(answer["error"])
        return answer["result"]


def installed(folder: Path) -> Path:
    """Return a folder with the shipped packages and their peers, as npm lays them out, and the driver."""
    modules = install(folder, [path for path in SHIPPED.iterdir() if path.name != "fieldscribe-runtime"])
    for peer in PEERS:
        (modules / peer).symlink_to(npm_package(peer))
    shutil.copy(DRIVER, folder)
    return folder


@contextmanager
def node_device(folder: Path, device: str, line: dict[str, Any], **options: Any) -> Iterator[NodeDevice]:
    """Run a device over a line, such as {"kind": "tcp", "port": 5020}, as long as the context lasts."""
    made = [device.replace("_", "-"), pascal(device), json.dumps(line), json.dumps(options)]
    command = [tool("node"), str(folder / DRIVER.name), *made]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=folder) as process:
        try:
            yield NodeDevice(process)
        finally:
            assert process.stdin is not None
            process.stdin.close()
            with suppress(subprocess.TimeoutExpired):
                process.wait(5)
            process.kill()


@contextmanager
def bridged(channel: str) -> Iterator[int]:
    """Yield the port at which a virtual bus of python-can is reached: each frame is 13 bytes."""
    server = socket.create_server(("127.0.0.1", 0))
    bus = can.Bus(channel, interface="virtual")
    threading.Thread(target=_serve, args=(server, bus), daemon=True).start()
    try:
        yield server.getsockname()[1]
    finally:
        server.close()
        bus.shutdown()


def _serve(server: socket.socket, bus: can.BusABC) -> None:
    with suppress(OSError):
        connection, _ = server.accept()
        notifier = can.Notifier(bus, [lambda message: _forward(connection, message)])
        while len(data := connection.recv(_FRAME, socket.MSG_WAITALL)) == _FRAME:
            identifier = int.from_bytes(data[:4], "big")
            body = data[5 : 5 + data[4]]
            is_extended = bool(identifier >> 31)
            bus.send(can.Message(arbitration_id=identifier & 0x1FFFFFFF, data=body, is_extended_id=is_extended))
        notifier.stop()


def _forward(connection: socket.socket, message: can.Message) -> None:
    head = message.arbitration_id.to_bytes(4, "big") + bytes([len(message.data)])
    with suppress(OSError):
        connection.sendall(head + bytes(message.data).ljust(8, b"\0"))
