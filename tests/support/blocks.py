"""Registers with chains of blocks, sound and hostile ones, and a device that answers from them."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress

from support.python_package import Slave

SUNS = (0x5375, 0x6E53)


def chain(at: int, *blocks: tuple[int, list[int]], end: int = 0xFFFF) -> dict[int, int]:
    """The registers of a marker and of blocks, each with its id and its words."""
    words = [*SUNS]
    for block, held in blocks:
        words += [block, len(held), *held]
    words += [end, 0]
    return dict(enumerate(words, at))


INVERTER = (103, [250, 0xFFFF, 0, 0, 0, 7])
MODULES = (160, [11, 21, 0, 31, 12, 22, 0, 32])
"""Two elements of four words."""
FOUND = chain(50000, (1, [9]), INVERTER, MODULES)


class Registers(Slave):
    """Answers from registers; what is not there is refused. `asked` has the first address and count of each read."""

    def __init__(self, held: Mapping[int, int]) -> None:
        super().__init__()
        self.held = dict(held)
        self.asked: list[tuple[int, int]] = []

    def _answer(self, pdu: bytes) -> bytes:
        address, count = int.from_bytes(pdu[1:3], "big"), int.from_bytes(pdu[3:5], "big")
        if pdu[0] == 6:
            self.held[address] = count
            return pdu
        if pdu[0] == 16:
            for place in range(count):
                self.held[address + place] = int.from_bytes(pdu[6 + 2 * place : 8 + 2 * place], "big")
            return pdu[:5]
        self.asked.append((address, count))
        places = range(address, address + count)
        if not self.held.keys() >= set(places):
            return bytes((pdu[0] | 0x80, 2))
        words = [self.held[place] for place in places]
        return bytes((pdu[0], 2 * count)) + b"".join(word.to_bytes(2, "big") for word in words)


HOSTILE = {
    "no_marker": ({40000: 0, 40001: 0}, "no_marker"),
    "endless": (dict.fromkeys(range(50000, 65536), 0) | dict(enumerate(SUNS, 50000)), "bad_chain"),
    "too long": (chain(50000, (7, [0] * 3)) | {50003: 0xFFFF}, "bad_chain"),
    "to the last word": (chain(50000) | {50002: 5, 50003: 65535 - 50004 + 1}, "bad_chain"),
    "cut off": (dict(list(chain(50000, (7, [0])).items())[:5]), "exception"),
    "without the block": (chain(50000, (7, [])), "no_block"),
    "short": (chain(50000, (103, [250])), "behind_end"),
}


@contextmanager
def served(line: Registers) -> Iterator[int]:
    """Yield a port of this machine at which the device answers frames of RTU, one connection after the other."""
    server = socket.create_server(("127.0.0.1", 0))
    threading.Thread(target=_answer, args=(server, line), daemon=True).start()
    try:
        yield server.getsockname()[1]
    finally:
        server.close()


def _answer(server: socket.socket, line: Registers) -> None:
    with suppress(OSError):
        while True:
            connection, _ = server.accept()
            while request := connection.recv(256):
                with suppress(TimeoutError):  # no answer
                    connection.sendall(line.exchange(request))
