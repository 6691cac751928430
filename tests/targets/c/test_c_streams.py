"""Receivers in C pick answers out of any stream: noise before, between and in answers, joined ones, bytes as they come.

What they ought to find is worked out here, from the bytes of the answer alone.
"""

from __future__ import annotations

import subprocess
from collections.abc import Collection, Iterator
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
BYTES = range(256)


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
        """The bytes of the shortest answer to what is asked."""
        if self.line == USS:
            return 4 + 2 * ((3 if self.first == VARIABLE else self.first) + self.second)
        return (5 if self.line == RTU else 9) + self._items(self.second)

    def _items(self, count: int) -> int:
        """How many bytes an answer has beyond a refusal, which says nothing but its code."""
        return {1: (count + 7) // 8, 3: 2 * count}.get(self.first, 3)

    def answer(self, data: Random) -> bytes:
        """A good answer with any content, or a refusal, or one of another length than was asked for."""
        if self.line == USS:
            length = self.least + data.choice([0, 0, 0, 1, 2, 6])
            telegram = bytes([2, length - 2, self.unit]) + data.randbytes(length - 4)
            return telegram + bcc(telegram)
        items = data.choice([self.second, self.second, self.second, 0, 7])
        content = data.randbytes(self._items(items) + (self.first == 6))
        if self.first != 6:
            content = bytes([len(content)]) + content
        code, content = data.choice([(self.first, content)] * 3 + [(self.first | 0x80, data.randbytes(1))])
        body = bytes([self.unit, code]) + content
        return body + crc(body) if self.line == RTU else bytes([1, 2, 0, 0, 0, len(body)]) + body

    def whole(self, data: bytes) -> int:
        """How many bytes an answer has that begins with these, or 0."""
        known, length = self._beginning(data)
        begins = all(byte in allowed for byte, allowed in zip(data, known, strict=False)) and length <= self.size
        frame = data[:length]
        good = {RTU: crc(frame[:-2]) == frame[-2:], TCP: True, USS: bcc(frame) == b"\0"}[self.line]
        return length if begins and (good or len(data) < length) else 0

    def _beginning(self, data: bytes) -> tuple[list[Collection[int]], int]:
        """What the first bytes of an answer may be, and how many bytes it has as far as these say."""
        functions = (self.first, self.first | 0x80)
        if self.line == USS:
            return [(2,), range(2, 256), (self.unit,)], data[1] + 2 if len(data) > 1 else 4
        if self.line == TCP:
            length = 6 + int.from_bytes(data[4:6]) if len(data) > 5 else 9
            return [(1,), (2,), (0,), (0,), BYTES, BYTES if length > 8 else (), (self.unit,), functions], length
        answers = len(data) > 1 and data[1] == self.first
        more = 3 if self.first == 6 else data[2] if len(data) > 2 else 0
        return [(self.unit,), functions], 5 + more * answers


def answers_in(asked: Asked, stream: bytes) -> Iterator[str]:
    """The answers and how many bytes were dropped for each, also the one that is left over when the line is silent."""
    begun, dropped = b"", 0
    for at in range(len(stream)):
        begun += stream[at : at + 1]
        while begun and not (whole := asked.whole(begun)):
            begun, dropped = begun[1:], dropped + 1
        if begun and len(begun) >= whole:
            yield f"{dropped + len(begun) - whole}:{begun[:whole].hex()}"
            begun, dropped = b"", 0
    for rest in (begun[at:] for at in range(len(begun))):
        if len(rest) >= (whole := asked.whole(rest)) > 0:
            yield f"{dropped + len(begun) - whole}:{rest[:whole].hex()}"
            return
    yield f"{dropped}:{len(begun)}"


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
        longer = asked.answer(data)[:3] + bytes([254])  # or whatever looks so
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
                [longer, good],
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
        expected = ["none"] if asked.least > asked.size else list(answers_in(asked, stream))
        assert line.split() == expected, (asked, at_once, stream.hex())
