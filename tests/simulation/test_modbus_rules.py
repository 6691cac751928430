"""A simulated Modbus device without a line: bytes in, bytes out, by the rules of the manual."""

from __future__ import annotations

import json
import random
from pathlib import Path

import pytest
from fieldscribe.families.modbus.frames import crc16, frame
from fieldscribe.simulation.bench import Bench
from fieldscribe.simulation.device import SimulatedDevice
from fieldscribe.simulation.line import Fault, Line, Stream
from support.described import described, write


def line_of(name: str, *units: int, framing: str = "rtu", strict: bool = False, **settings: object) -> Line:
    devices = [{"device": name, "unit": unit, "behaviour": False, **settings} for unit in units or (1,)]
    line = {"tcp": "", "framing": framing, "devices": devices}
    (made,) = Bench({"lines": [line], "strict": strict, "time_scale": 0}).lines
    return made


def said(line: Line, request: str, unit: int = 1) -> str:
    """The PDU of the answer to a PDU, in hexadecimal; empty without one."""
    outcomes = Stream(line).received(frame(line.core.framing, unit, 7, bytes.fromhex(request)))
    return " ".join((each.data[7:] if line.core.framing == "tcp" else each.data[1:-2]).hex() for each in outcomes)


def device_of(line: Line) -> SimulatedDevice:
    return line.core.devices[0]


REQUESTS = [
    ("hitachi_l200", "03 1028 0001", "030201f4"),
    ("hitachi_l200", "03 1028 0005", "8303"),  # four registers at most
    ("hitachi_l200", "03 1028 0000", "8303"),
    ("hitachi_l200", "04 1028 0001", "8401"),
    ("hitachi_l200", "2b 0e01 00", "ab01"),
    ("hitachi_l200", "03 0030 0001", "8302"),  # the gap
    ("hitachi_l200", "03 0003 0001", "8302"),  # a hole
    ("hitachi_l200", "06 1028 0258", "0610280258"),
    ("hitachi_l200", "06 1028 ffff", "8621"),
    ("hitachi_l200", "06 0002 0001", "0600020001"),
    ("hitachi_l200", "06 1001 0001", "8622"),  # a monitor
    ("hitachi_l200", "05 0000 ff00", "050000ff00"),
    ("hitachi_l200", "05 0000 1234", "8503"),
    ("hitachi_l200", "08 0000 abcd", "080000abcd"),
    ("hitachi_l200", "06 0900 1234", "0609001234"),  # ENTER takes any number
    ("eastron_sdm630", "04 0000 0002", "040443660000"),
    ("eastron_sdm630", "06 0000 0002", "8601"),
    ("eastron_sdm630", "10 0200 0001 02 0000", "9002"),  # nothing is there
    ("jumo_controller", "05 0000 ff00", "8501"),
    ("nord_sk5xxe", "03 ffff 0002", "8302"),
    ("fronius_datamanager", "03 9c40 0004", "030853756e5300010041"),  # SunS, then model 1
]


@pytest.mark.parametrize(("name", "request_pdu", "reply"), REQUESTS)
@pytest.mark.parametrize("framing", ["rtu", "tcp"])
def test_requests_are_answered_or_refused_as_the_manual_says(
    name: str, request_pdu: str, reply: str, framing: str
) -> None:
    line = line_of(name, framing=framing)
    device_of(line).values.update({"A020": 50} if name == "hitachi_l200" else {})
    assert said(line, request_pdu) == reply


def test_bytes_are_cut_into_requests_however_they_come() -> None:
    rnd = random.Random(7)
    for framing in ("rtu", "tcp"):
        line = line_of("hitachi_l200", framing=framing)
        requests = [bytes.fromhex(text) for _, text, _ in REQUESTS[:4] if text[:2] == "03"]
        requests.append(bytes.fromhex("100001000204000a0001"))
        bytes_ = b"".join(frame(framing, 1, place, pdu) for place, pdu in enumerate(requests * 20))
        whole = [each.data for each in Stream(line).received(bytes_)]
        assert len(whole) == 20 * len(requests)
        stream, parted, at = Stream(line), [], 0
        while at < len(bytes_):
            size = rnd.randint(1, 13)
            parted += [each.data for each in stream.received(bytes_[at : at + size])]
            at += size
        assert parted == whole
        behind = Stream(line_of("hitachi_l200", framing=framing))
        assert len(behind.received(b"\x01\x03\xff" + frame(framing, 1, 1, requests[0]))) == 1
        noise = Stream(line_of("hitachi_l200", framing=framing))
        for _ in range(200):
            noise.received(rnd.randbytes(rnd.randint(1, 30)))
            noise.received(b"", quiet=True)
            assert noise.waiting == b""
            assert len(noise.received(frame(framing, 1, 1, requests[0]))) == 1


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("framing", ["rtu", "tcp"])
def test_no_bytes_make_it_fall_over(framing: str) -> None:
    rnd, line = random.Random(1), line_of("hitachi_l200", 1, 2, framing=framing)
    stream = Stream(line)
    for _ in range(20_000):
        pdu = bytearray(bytes((rnd.choice((1, 3, 5, 6, 8, 15, 16, 43, 0)),)) + rnd.randbytes(rnd.randint(0, 12)))
        data = bytearray(frame(framing, rnd.choice((0, 1, 2, 9, 255)), 1, bytes(pdu)))
        for _ in range(rnd.randint(0, 2)):
            data[rnd.randrange(len(data))] = rnd.randrange(256)
        for outcome in stream.received(bytes(data), quiet=rnd.random() < 0.3):
            if framing == "rtu":
                assert crc16(outcome.data[:-2]).to_bytes(2, "little") == outcome.data[-2:]
        assert len(stream.waiting) <= 4096
    stream.received(b"", quiet=True)
    assert len(stream.received(frame(framing, 1, 1, bytes.fromhex("0310280001")))) == 1


def test_a_broadcast_is_carried_out_and_not_answered() -> None:
    line = line_of("hitachi_l200", 1, 2, 3)
    assert said(line, "06 1028 0258", unit=0) == ""
    assert [device.values["A020"] for device in line.core.devices] == [60, 60, 60]
    assert said(line, "10 1028 0001 02 01f4", unit=0) == ""  # 10h is not broadcast
    assert device_of(line).values["A020"] == 60
    assert said(line, "03 1028 0001", unit=9) == ""


def test_answers_take_their_time() -> None:
    line = line_of("hitachi_l200")
    device_of(line).values["C078"] = 250
    (outcome,) = Stream(line).received(frame("rtu", 1, 0, bytes.fromhex("0310280001")))
    assert outcome.delay == 0.25


STRICT: list[tuple[str, str, str]] = [
    ("04 1028 0001", "function", ""),
    ("03 1028 0005", "format: function 03h takes 4 items at most, not 5", "line 138"),
    ("03 002e 0004", "address: holding 46 to 49 crosses the gap 002Fh to 08FFh", "line 138"),
    ("03 0003 0001", "address: nothing is at holding 3", "line 138"),
    ("03 1014 0001", "a part of a number: a read has a part of F002 acceleration_time", "line 741"),
    ("06 1028 ffff", "out of range: A020 base_frequency does not take raw 65535", "line 780"),
    ("06 1001 0001", "read only: d001 output_frequency can only be read", "line 669"),
]


@pytest.mark.parametrize(("request_pdu", "what", "where"), STRICT)
def test_a_strict_device_says_which_line_of_the_manual(request_pdu: str, what: str, where: str) -> None:
    line = line_of("hitachi_l200", strict=True)
    said(line, request_pdu)
    (complaint,) = device_of(line).complaints
    assert str(complaint).startswith(what)
    assert where in str(complaint)


@pytest.mark.parametrize(
    ("pauses", "complains"),
    [("000000000", 1), ("666666666", 1), ("700000000", 1), ("777777777", 0), ("x00000000", 0), ("x000000000", 1)],
)
def test_a_strict_device_counts_cyclic_writes_to_memory_that_wears(pauses: str, complains: int) -> None:
    """Ten within a minute; an `x` is a minute."""
    line = line_of("hitachi_l200", strict=True)
    device = device_of(line)
    for pause in f"0{pauses}":
        device.clock.advance(int(pause.replace("x", "60")))
        said(line, "06 0900 0000")
    assert device.wear == {"enter": len(pauses) + 1}
    said_so = [str(complaint) for complaint in device.complaints]
    assert len(said_so) == complains
    for one in said_so:
        assert "cyclic writes: enter wrote the memory 10 times" in one
        assert "line 567" in one


def test_a_strict_device_keeps_the_pause_between_frames() -> None:
    devices = [{"device": "hitachi_l200", "behaviour": False}]
    settings = {"serial": "", "speed": 9600, "devices": devices}
    (line,) = Bench({"lines": [settings], "strict": True, "time_scale": 0}).lines
    clock = device_of(line).clock
    for pause in (1.0, 0.001, 0.5):
        clock.advance(pause)
        said(line, "03 1028 0001")
    assert [str(each).partition(":")[0] for each in device_of(line).complaints] == ["turnaround"]


def test_the_trace_has_each_request_with_its_answer() -> None:
    entries: list[str] = []
    line = line_of("hitachi_l200")
    line.trace = entries.append
    said(line, "03 1028 0005")
    assert json.loads(entries[0]) == {
        "time": 0.0,
        "line": "hitachi_l200",
        "unit": 1,
        "request": frame("rtu", 1, 0, bytes.fromhex("0310280005")).hex(),
        "answer": frame("rtu", 1, 0, b"\x83\x03").hex(),
        "delay": 0.0,
        "refused": "function 03h takes 4 items at most, not 5",
        "fault": None,
    }


def test_the_first_request_of_a_client_decides_the_framing() -> None:
    """A gateway and a serial server at the same port; noise before the first request decides nothing."""
    line, pdu = line_of("hitachi_l200", framing="any"), bytes.fromhex("0310280001")
    for framing in ("rtu", "tcp"):
        stream = Stream(line)
        assert stream.received(b"\x07\xff\x00", quiet=True) == []
        request = frame(framing, 1, 3, pdu)
        assert stream.received(request[:5]) == []
        (first,), (second,) = stream.received(request[5:]), stream.received(request)
        assert first.data == second.data == frame(framing, 1, 3, bytes.fromhex("030201f4"))


def test_faults_come_so_many_times_and_with_their_chance() -> None:
    line = line_of("hitachi_l200")
    line.faults.waiting.extend(map(Fault.of, ("exception x2", "silent x1", "function 25%")))
    said_by = [said(line, "03 1028 0001")[:2] for _ in range(400)]
    assert said_by[:3] == ["83", "83", ""]
    assert 60 < said_by.count("43") < 140
    assert [fault.kind for fault in line.faults.waiting] == ["function"]


def test_a_point_whose_condition_does_not_hold_is_refused_where_the_simulator_is_strict() -> None:
    """The second phase of a meter, by its wiring; alone, and inside a longer read."""
    strict, plain = line_of("eastron_sdm630", strict=True), line_of("eastron_sdm630")
    requests = ("04 0000 0002", "04 0002 0002", "04 0000 0004")
    for line in (strict, plain):
        device_of(line).values["system_type"] = "single_phase_two_wire"
    assert [said(plain, request)[:2] for request in requests] == ["04", "04", "04"]
    assert [said(strict, request)[:4] for request in requests] == ["0404", "8402", "8402"]
    text = "absent: phase_2_voltage exists only when system_type == three_phase_four_wire (manual, line 71)"
    assert str(device_of(strict).complaints[0]) == text
    device_of(strict).values["system_type"] = "three_phase_four_wire"
    assert [said(strict, request)[:2] for request in requests] == ["04", "04", "04"]


def test_a_write_of_half_of_what_belongs_together_is_refused(tmp_path: Path) -> None:
    """Whole, the limits of each count as the request brings them."""
    points = (
        "- {name: low, at: 0, range: 0..high, write_with: [high]}\n"
        "- {name: high, at: 1, range: low..100, write_with: [low]}\n"
    )
    write(tmp_path, described(points))
    line = line_of(str(tmp_path), strict=True, values={"low": 10, "high": 20})
    assert said(line, "06 0000 0005")[:2] == "86"
    assert said(line, "10 0000 0002 04 0032 003c") == "1000000002"
    assert said(line, "10 0000 0002 04 003c 0032")[:2] == "90"
    assert [device_of(line).values[name] for name in ("low", "high")] == [50, 60]
    assert [each.rule for each in device_of(line).complaints] == ["together", "out of range"]
