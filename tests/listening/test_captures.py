"""Captures say the same, whatever packets were lost, doubled or out of order; damaged files are an error."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from random import Random

import pytest
from fieldscribe.listening.captures import chunks_of
from fieldscribe.listening.chunks import BYTES, MESSAGE, STREAM, Chunk, Packet
from fieldscribe.listening.packets import Packets, PacketWriter, is_packet_file, read_packets
from fieldscribe.user_errors import UnclearError
from support.captured import classic, segment

PACKETS = [Packet(1700000000.000125, 1, b"\1\2\3"), Packet(1700000001.5, 147, b""), Packet(0.0, 227, bytes(300))]


def written() -> bytes:
    """The packets as pcapng."""
    stream = io.BytesIO()
    writer = PacketWriter(stream)
    for packet in PACKETS:
        writer.write(packet)
    return stream.getvalue()


def read(data: bytes) -> list[Packet]:
    """The packets in a file."""
    assert is_packet_file(data)
    return list(read_packets(io.BytesIO(data)))


def test_packets_are_read_as_they_were_written() -> None:
    assert read(written()) == PACKETS


@pytest.mark.parametrize("order", "<>")
@pytest.mark.parametrize(("magic", "parts"), [(0xA1B2C3D4, 1_000_000), (0xA1B23C4D, 1_000_000_000)])
def test_pcap_of_any_order_and_resolution(order: str, magic: int, parts: int) -> None:
    head = struct.pack(f"{order}IHHiIII", magic, 2, 4, 0, 0, 65535, 147)
    packets = read(head + struct.pack(f"{order}IIII", 7, parts // 2, 2, 2) + b"\5\6")
    assert packets == [Packet(7.5, 147, b"\5\6")]


@pytest.mark.parametrize("whole", [written(), classic([b"\1\2\3", b"\4"])], ids=["pcapng", "pcap"])
def test_what_is_cut_off_anywhere_is_an_error_behind_what_is_whole(whole: bytes) -> None:
    many = read(whole)
    ends = []
    for size in range(4, len(whole)):
        packets = read_packets(io.BytesIO(whole[:size]))
        got: list[Packet] = []
        try:
            got.extend(packets)
            ends.append(size)
        except UnclearError as error:
            assert "cut off" in error.message
        assert got == many[: len(got)]
    assert len(ends) <= len(many) + 3  # between two packets, nothing is missing


def test_lying_lengths_are_an_error_and_read_nothing_large() -> None:
    for lie in (0xFFFFFFFF, 1 << 24, 0):
        for head in (
            classic([]) + struct.pack("<IIII", 0, 0, lie or 1 << 30, 0),
            written()[:28] + struct.pack("<II", 6, lie),
        ):
            with pytest.raises(UnclearError):
                read(head + bytes(64))


def heard(*segments: bytes) -> bytes:
    """The bytes that these packets bring to the device, in order."""
    packets = Packets(frozenset({502}))
    chunks = [chunk for data in segments for chunk in packets.chunks(Packet(0.0, 1, data))]
    assert all(chunk.kind == STREAM and chunk.place == "10.0.0.1:4000" for chunk in chunks)
    return b"".join(b"|" * chunk.fresh + chunk.data for chunk in chunks)


ONE, TWO, THREE = segment(0xFFFFFFFE, b"abcd"), segment(2, b"efg"), segment(5, b"hi")


@pytest.mark.parametrize(
    ("segments", "expected"),
    [
        ([ONE, TWO, THREE], b"|abcdefghi"),
        ([ONE, THREE, TWO], b"|abcdefghi"),
        ([ONE, ONE, TWO, TWO, ONE, THREE], b"|abcdefghi"),
        ([ONE, segment(0, b"cdefgh"), THREE], b"|abcdefghi"),
        ([ONE, segment(2, b"", flags=4), segment(900, b"xy")], b"|abcd"),
        ([segment(2, b"", flags=2), segment(3, b"xy")], b"xy"),
        ([ONE, *(segment(1000 + place, b"x") for place in range(40))], b"|abcd|" + 40 * b"x"),
        ([ONE[:40], ONE[:53], b"", ONE[:12] + b"\x08\x06" + ONE[14:]], b""),
        ([ONE[:12] + b"\x81\x00\x00\x05" + ONE[12:]], b"|abcd"),
    ],
    ids=["in order", "out of order", "doubled", "overlapping", "reset", "from the start", "lost", "cut", "vlan"],
)
def test_a_connection_gives_each_byte_once(segments: list[bytes], expected: bytes) -> None:
    assert heard(*segments) == expected


def test_messages_and_bytes_of_lines() -> None:
    packets = Packets(frozenset())
    message = bytes.fromhex("80000321 03000000 010203")
    assert list(packets.chunks(Packet(1.0, 227, message))) == [Chunk(1.0, MESSAGE, b"\1\2\3", identifier=0x321)]
    assert next(packets.chunks(Packet(1.0, 113, bytes(14) + b"\0\x0c" + message))).identifier == 0x321
    assert list(packets.chunks(Packet(1.0, 227, message[:9]))) == []
    assert list(packets.chunks(Packet(1.0, 147, b"\1"))) == [Chunk(1.0, BYTES, b"\1")]


def hostile() -> Iterator[bytes]:
    """Files that somebody made on purpose, or that a disk has damaged."""
    random = Random(26)
    whole = [written(), classic([ONE, TWO, b"", bytes(70)])]
    for start in (*(data[:28] for data in whole), b"", b"\x0a\x0d\x0d\x0a"):
        for _ in range(300):
            yield start + random.randbytes(random.randrange(200))
    for data in whole:
        for place in range(len(data)):
            yield data[:place] + bytes((data[place] ^ 1 << random.randrange(8),)) + data[place + 1 :]


def test_any_file_ends_in_chunks_or_an_error() -> None:
    for data in hostile():
        try:
            for chunk in chunks_of(io.BufferedReader(io.BytesIO(data)), frozenset({502}), lambda _: None):
                assert len(chunk.data) < 1 << 20
        except UnclearError as error:
            assert error.message
