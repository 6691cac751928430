"""Captures say the same, whatever packets were lost, doubled or out of order; damaged files are an error."""

from __future__ import annotations

import io
import json
import struct
from collections.abc import Iterator
from random import Random

import pytest
from fieldscribe.diagnostics import UnclearError
from fieldscribe.listening.captures import Packets, chunks_of
from fieldscribe.listening.chunks import BYTES, MESSAGE, STREAM, ByteCutter, Chunk, Packet, timed
from fieldscribe.listening.packet_files import PacketWriter, is_packet_file, read_packets
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


def test_a_packet_without_time_belongs_to_the_first_interface() -> None:
    head, simple = written()[:48], struct.pack("<IIIIII", 3, 20, 3, 0x00030201, 20, 0)[:20]
    assert read(head + simple) == [Packet(None, 1, b"\1\2\3\0")]
    assert read(head[:28] + simple) == []


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("01:02:03.5 RX: 01 03", 3723.5),
        ("[2026-01-02 10:20:30,25] 01 03", 1767349230.25),
        ("2026-13-02 00:01:01 01 03", 61.0),
        ("1700000000.25 01 03", 1700000000.25),
        ("01 03", None),
    ],
)
def test_the_time_of_a_line_in_a_log(text: str, seconds: float | None) -> None:
    found, rest = timed(text)
    assert (found, rest[-5:]) == (seconds, "01 03")


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


def in_ip6(data: bytes) -> bytes:
    """The segment of an Ethernet frame in a packet of IPv6 between two addresses."""
    ends = bytes.fromhex("fe80000000000000000000000000000a 20010db800000000000000000000000b")
    tcp = data[34:]
    return bytes(12) + b"\x86\xdd" + struct.pack(">IHBB", 6 << 28, len(tcp), 6, 64) + ends + tcp


def test_connections_are_told_apart() -> None:
    """By both ends and both ports, of either protocol; what comes back belongs to the client, too."""
    other = (first := segment(7, b"abcd"))[:36] + b"\x01\xf7" + first[38:]
    packets = Packets(frozenset({502, 503}))
    frames = segment(1, b"12"), other, segment(3, b"34"), segment(500, b"ok", back=True), in_ip6(segment(9, b"xy"))
    chunks = [chunk for data in frames for chunk in packets.chunks(Packet(0.0, 1, data))]
    assert [(chunk.data, chunk.place, chunk.sent, chunk.fresh) for chunk in chunks] == [
        (b"12", "10.0.0.1:4000", True, True),
        (b"abcd", "10.0.0.1:4000", True, True),
        (b"34", "10.0.0.1:4000", True, False),
        (b"ok", "10.0.0.1:4000", False, True),
        (b"xy", "[fe80:0:0:0:0:0:0:a]:4000", True, True),
    ]


def counted_size(data: bytes, is_first: bool) -> int:
    """Frames of this test begin with their size, up to 8."""
    del is_first
    return 0 if not 1 < data[0] < 9 else data[0] if len(data) >= data[0] else -1


@pytest.mark.parametrize(
    ("chunks", "expected"),
    [
        ([(0.0, "0301", False), (0.1, "02", False)], ["030102"]),
        ([(0.0, "0301", False), (0.11, "02", False)], ["!0301", "!02"]),
        ([(0.0, "0301", False), (-0.01, "02", False)], ["!0301", "!02"]),
        ([(0.0, "0301", False), (0.01, "02", True)], ["!0301", "!02"]),
        ([(0.0, "0301", False), (0.01, "", False), (0.02, "02", False)], ["!0301", "!02"]),
        ([(None, "0301", False), (None, "02", False)], ["030102"]),
        ([(0.0, "ff0301", False), (0.05, "02", False)], ["!ff", "030102"]),
        ([(0.0, "08010301", False), (0.05, "02", False)], ["!0801", "030102"]),
        ([(0.0, "0402030102", False)], ["04020301", "!02"]),
        ([(0.0, "ff" * 20, False)], ["!" + "ff" * 8]),
    ],
    ids=str,
)
def test_a_frame_ends_by_its_size_or_in_a_silence(
    chunks: list[tuple[float | None, str, bool]], expected: list[str]
) -> None:
    """What is no frame (`!`) ends where nothing comes for a while, and where bytes are lost."""
    cutter = ByteCutter(counted_size, 8, "rtu", 0)
    given = [Chunk(time, BYTES, bytes.fromhex(data), fresh=fresh) for time, data, fresh in chunks]
    cuts = [*(cut for chunk in given for cut in cutter.take(chunk)), *cutter.rest()]
    assert [f"{'!' * cut.damaged}{cut.data.hex()}" for cut in cuts] == expected
    assert all(cut.framing == "rtu" for cut in cuts)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ({"time": 1.5, "delay": 0.25, "request": "01 03", "answer": "01 83"}, ["1.500000 01 03", "1.750000 01 83"]),
        ({"time": 2, "delay": 0, "request": "01 05", "answer": ""}, ["2.000000 01 05"]),
        ({"time": "soon", "request": "01"}, ['{"time": "soon", "request": "01"}']),
        ("01 03 00", ["01 03 00"]),
    ],
    ids=str,
)
def test_a_trace_has_requests_and_answers_with_their_times(line: object, expected: list[str]) -> None:
    frames: list[str] = []
    text = line if isinstance(line, str) else json.dumps(line)

    def chunk_of(frame: str) -> Chunk:
        frames.append(frame)
        return Chunk(None, BYTES, b"")

    found = chunks_of(io.BufferedReader(io.BytesIO(text.encode())), frozenset(), chunk_of)
    assert len(list(found)) == len(expected)
    assert frames == expected


@pytest.mark.parametrize("text", ["title\n01 03\nend\n", "01 03\n" + "no frame\n" * 1100])
def test_a_log_may_have_lines_without_a_frame(text: str) -> None:
    def chunk_of(line: str) -> Chunk | None:
        return Chunk(None, BYTES, b"\1") if line == "01 03" else None

    found = chunks_of(io.BufferedReader(io.BytesIO(text.encode())), frozenset(), chunk_of)
    assert len(list(found)) == 1


def test_messages_and_bytes_of_lines() -> None:
    packets = Packets(frozenset())
    message = bytes.fromhex("80000321 03000000 010203")
    assert list(packets.chunks(Packet(1.0, 227, message))) == [Chunk(1.0, MESSAGE, b"\1\2\3", identifier=0x321)]
    for protocol in (b"\0\x0c", b"\0\x0d"):
        assert next(iter(packets.chunks(Packet(1.0, 113, bytes(14) + protocol + message)))).identifier == 0x321
    assert next(iter(packets.chunks(Packet(1.0, 227, b"\0\0\x0f" + message[3:])))).identifier == 0x721
    assert next(iter(packets.chunks(Packet(1.0, 227, b"\x81\xff" + message[2:])))).identifier == 0x1FF0321
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
