"""A generated Python package in a temporary folder, and a device that answers from a dict: for the tests of Python."""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from shutil import copytree
from typing import Any

from fieldscribe.model import Device
from fieldscribe.targets import python as target

from support.files import generate
from support.places import ROOT


def write_package(device: Device, out: Path) -> Path:
    """Generate the device's package and the runtime; return the folder to import them from."""
    folder = generate(device, out, target) / "python"
    if changed := os.environ.get("FIELDSCRIBE_PACKAGES"):  # where mutants are judged
        copytree(Path(changed) / "fieldscribe_runtime", folder / "fieldscribe_runtime", dirs_exist_ok=True)
    return folder


def imported(folder: Path, package: str) -> Iterator[Any]:
    """Yield the package with its own copy of the runtime; afterwards the earlier modules are back."""
    before = {name: module for name, module in sys.modules.items() if _is_generated(name, package)}
    for name in before:
        del sys.modules[name]
    sys.path.insert(0, str(folder))
    importlib.invalidate_caches()
    try:
        yield importlib.import_module(package)
    finally:  # a test that fails changes nothing for the next
        sys.path.remove(str(folder))
        for name in [name for name in sys.modules if _is_generated(name, package)]:
            del sys.modules[name]
        sys.modules.update(before)


def _is_generated(module: str, package: str) -> bool:
    return module.partition(".")[0] in (package, "fieldscribe_runtime")


def error(function: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
    """Return the error that a call raises; a call without an error fails the test."""
    try:
        result = function(*arguments, **options)
    except Exception as raised:
        return raised
    raise AssertionError(f"no error, but {result!r}")


def status(function: Callable[..., Any], *arguments: Any) -> tuple[str, str]:
    """Return the status and the message of the error that a call raises; `ok` if it raises none."""
    try:
        function(*arguments)
    except Exception as raised:
        return getattr(raised, "status", ""), str(raised)
    return "ok", ""


def assert_formatted(package: Path) -> None:
    """Hold a package against ruff's defaults, at a line length that is harder than ours."""
    for words in (("check", str(package.parent)), ("format", "--diff", str(package))):
        command = [sys.executable, "-m", "ruff", *words, "--isolated", "--no-cache", "--config", "line-length=88"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


def typed_findings(program: str, folder: Path, package: str, work: Path) -> str:
    """What mypy finds, strictly, in a package and a program that uses it, but for the lines that end in `# E: code`.

    Empty if it finds exactly those.
    """
    (work / "program.py").write_text(program, encoding="utf-8")
    known = ROOT / ".cache/mypy" / os.environ.get("PYTEST_XDIST_WORKER", "alone")  # the standard library takes longest
    options = ("--strict", "--no-error-summary", "--config-file", "", "--cache-dir", str(known))
    command = [sys.executable, "-m", "mypy", *options, "program.py", str(folder / package)]
    environment = {"MYPYPATH": str(folder), "PATH": ""}
    done = subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True, check=False)
    lines = enumerate(program.split("\n"), 1)
    expected = {f"{number} {line.partition('# E: ')[2]}" for number, line in lines if "# E: " in line}
    found = [line for line in done.stdout.splitlines() if ": error: " in line]
    seen = {
        f"{line.split(':')[1]} {line.rpartition('[')[2].rstrip(']')}" for line in found if line.startswith("program.py")
    }
    fine = seen == expected and len(found) == len(expected) and not done.stderr
    return "" if fine else f"{done.stdout}{done.stderr}expected: {sorted(expected)}"


class Slave:
    """A device on a line of RTU, TCP or bare PDUs, working on plain dicts.

    `log` says what it was asked (function, address, count). It is written against the protocol and not with
    the runtime's own functions.
    """

    def __init__(self, framing: str = "rtu") -> None:
        self.framing = framing
        self.words: dict[int, int] = {}
        self.coils: dict[int, int] = {}
        self.log: list[tuple[int, int, int]] = []
        self.refuses: dict[int, int] = {}

    def exchange(self, request: bytes) -> bytes:
        """The reply to a request."""
        if self.framing == "tcp":
            return self._tcp(request)
        if self.framing == "pdu":
            return request[:1] + self._answer(request[1:])
        pdu = self._answer(request[1:-2])
        frame = request[:1] + pdu
        return b"" if request[0] == 0 else frame + _crc(frame)

    def _tcp(self, request: bytes) -> bytes:
        pdu = self._answer(request[7:])
        return request[:4] + (len(pdu) + 1).to_bytes(2, "big") + request[6:7] + pdu

    def _answer(self, pdu: bytes) -> bytes:
        function, address, third = pdu[0], int.from_bytes(pdu[1:3], "big"), int.from_bytes(pdu[3:5], "big")
        count = third if function in (1, 3, 15, 16) else 1
        self.log.append((function, address, count))
        if codes := [self.refuses[at] for at in range(address, address + count) if at in self.refuses]:
            return bytes([function | 0x80, codes[0]])
        if function == 1:
            bits = sum(self.coils.get(address + place, 0) << place for place in range(count))
            size = (count + 7) // 8
            return bytes([1, size]) + bits.to_bytes(size, "little")
        if function == 3:
            data = b"".join(self.words.get(address + place, 0).to_bytes(2, "big") for place in range(count))
            return bytes([3, len(data)]) + data
        if function == 5:
            self.coils[address] = int(third == 0xFF00)
        elif function == 6:
            self.words[address] = third
        else:
            for place in range(count):
                self.words[address + place] = int.from_bytes(pdu[6 + 2 * place : 8 + 2 * place], "big")
        return pdu[:5]


class Awaited:
    """A peer for async devices: the methods of a blocking one, awaited."""

    def __init__(self, peer: Any) -> None:
        self.peer = peer

    def __getattr__(self, name: str) -> Any:
        return getattr(self.peer, name)

    async def exchange(self, request: bytes) -> bytes:
        """The reply to a request."""
        reply: bytes = self.peer.exchange(request)
        return reply

    async def send(self, frame: Any) -> None:
        """Take a frame."""
        self.peer.send(frame)

    async def receive(self) -> Any:
        """The next frame."""
        return self.peer.receive()


def _crc(data: bytes) -> bytes:
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ 0xA001 if value & 1 else value >> 1
    return value.to_bytes(2, "little")
