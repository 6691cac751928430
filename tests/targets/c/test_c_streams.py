"""Receivers in C pick answers out of any stream: noise before, between and in answers, joined ones, bytes as they come.

What they ought to find is worked out here, from the bytes of the answer alone.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest
from support.c_device import SANITIZERS, WARNINGS
from support.places import ROOT
from support.toolchains import succeed, tool

HERE = ROOT / "tests/targets/c"
RTU, TCP, USS = 0, 1, 2
VARIABLE = 127


def crc(data: bytes) -> bytes:
    """The checksum of Modbus, bit by bit."""
    register = 0xFFFF
    for byte in data:
        register ^= byte
        for _ in range(8):
            register = register >> 1 ^ (0xA001 if register & 1 else 0)
    return register.to_bytes(2, "little")


def bcc(data: bytes) -> bytes:
    """The check of USS."""
    check = 0
    for byte in data:
        check ^= byte
    return bytes([check])


class Asked(NamedTuple):
    """What is asked over which line: function and items for Modbus, words of both parts for USS; the buffer's bytes."""

    line: int
    unit: int
    first: int
    second: int
    size: int = 300

    @property
    def least(self) -> int:
        """The bytes of the shortest good answer."""
        if self.line == USS:
            return 4 + 2 * ((3 if self.first == VARIABLE else self.first) + self.second)
        return self._beginnings()[0][1]

    def answer(self, data: Random) -> bytes:
        """A good answer, with any content."""
        if self.line == USS:
            length = self.least + (2 * data.randrange(6) if self.first == VARIABLE else 0)
            telegram = bytes([2, length - 2, self.unit]) + data.randbytes(length - 4)
            return telegram + bcc(telegram)
        head, whole = data.choice([*self._beginnings()[:1] * 3, self._beginnings()[1]])
        content = head + data.randbytes(whole - len(head) - (2 if self.line == RTU else 0))
        return content + (crc(content) if self.line == RTU else b"")

    def whole(self, data: bytes) -> int:
        """How many bytes an answer has that begins with these, or 0."""
        if self.line == USS:
            return self._telegram(data)
        for head, whole in self._beginnings():
            if data[: len(head)] == head[: len(data)]:
                good = self.line == TCP or len(data) < whole or crc(data[: whole - 2]) == data[whole - 2 : whole]
                return whole if good else 0
        return 0

    def _beginnings(self) -> list[tuple[bytes, int]]:
        """How an answer begins and how long it is, and the same of a refusal."""
        count = {1: (self.second + 7) // 8, 3: 2 * self.second}.get(self.first)
        content = (b"", 6) if count is None else (bytes([count]), 3 + count)
        bodies = ((bytes([self.unit, self.first]) + content[0], content[1]), (bytes([self.unit, self.first | 0x80]), 3))
        if self.line == RTU:
            return [(head, length + 2) for head, length in bodies]
        return [(bytes([1, 2, 0, 0, 0, length]) + head, length + 6) for head, length in bodies]

    def _telegram(self, data: bytes) -> int:
        length = data[1] + 2 if len(data) > 1 else self.least
        longer = self.first == VARIABLE and self.least < length <= self.size and length % 2 == 0
        begins = data[0] == 2 and (longer or length == self.least) and (len(data) < 3 or data[2] == self.unit)
        return length if begins and (len(data) < length or bcc(data[: length - 1]) == data[length - 1 : length]) else 0


def answers_in(asked: Asked, stream: bytes) -> Iterator[tuple[int, bytes]]:
    """The answers, and how many bytes were dropped for each."""
    begun, dropped = b"", 0
    for at in range(len(stream)):
        begun += stream[at : at + 1]
        while begun and not (whole := asked.whole(begun)):
            begun, dropped = begun[1:], dropped + 1
        if begun and len(begun) >= whole:
            yield dropped + len(begun) - whole, begun[:whole]
            begun, dropped = b"", 0


ASKED = (
    *(Asked(line, 5, function, items) for line in (RTU, TCP) for function, items in ((1, 9), (3, 1), (3, 4), (6, 1))),
    *(Asked(RTU, 1, 3, 2, size) for size in (0, 4, 8, 9, 10)),
    *(Asked(USS, 3, pkw, pzd, size) for pkw, pzd in ((4, 2), (0, 2), (VARIABLE, 1)) for size in (11, 18, 300)),
)


def stream_of(asked: Asked, data: Random) -> bytes:
    """Answers, noise that looks like one, answers with a wrong byte, in any order."""
    pieces = []
    for _ in range(data.randrange(1, 6)):
        good = asked.answer(data)
        hurt = bytearray(good)
        hurt[data.randrange(len(hurt))] ^= 1 << data.randrange(8)
        noise = bytes(data.choice([*good[:9], 0, 255, data.randrange(256)]) for _ in range(data.randrange(12)))
        cut = good[: data.randrange(len(good))]
        odd = bytes([2, 13, asked.unit, *data.randbytes(11)])  # over USS: a good check, but half a word
        other = asked.answer(data)
        pieces += data.choice(
            (
                [good],
                [noise, good],
                [bytes(hurt)],
                [cut, other, noise],
                [cut, good],
                [noise],
                [good, good],
                [odd + bcc(odd)],
            )
        )
    return b"".join(pieces)


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Both receivers with all sanitizers; every buffer and every piece has exactly its length."""
    made = tmp_path_factory.mktemp("streams") / "streams"
    folders = (f"-I{ROOT / 'templates/c/runtime'}", f"-I{ROOT / 'tests/fuzz'}")
    flags = ("-std=c99", "-O1", *WARNINGS, *SANITIZERS["clang"], *folders)
    assert not succeed([tool("clang"), *flags, "-o", made, HERE / "streams.c"])
    return made


def found(program: Path, cases: list[tuple[Asked, int, bytes]]) -> list[str]:
    def packed(asked: Asked, at_once: int, stream: bytes) -> bytes:
        numbers = b"".join(number.to_bytes(2, "little") for number in (asked.size, at_once, len(stream)))
        return bytes(asked[:4]) + numbers + stream

    data = b"".join(packed(*case) for case in cases)
    done = subprocess.run([program], input=data, capture_output=True, check=False, timeout=300)
    assert done.returncode == 0, done.stderr.decode()
    return done.stdout.decode().splitlines()


@pytest.mark.full(seconds=6)
def test_answers_are_found_in_any_stream(program: Path) -> None:
    data = Random(20261122)
    cases = []
    for _ in range(6000):
        asked = data.choice(ASKED)
        cases.append((asked, data.choice([1, 1, 2, 7, 300]), stream_of(asked, data)))
    lines = found(program, cases)
    assert len(lines) == len(cases)
    for (asked, at_once, stream), line in zip(cases, lines, strict=True):
        expected = [f"{dropped}:{answer.hex()}" for dropped, answer in answers_in(asked, stream)]
        if asked.least > asked.size:
            expected = ["none"]
        assert line.split() == expected, (asked, at_once, stream.hex())
