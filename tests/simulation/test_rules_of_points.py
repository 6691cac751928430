"""What a simulated device holds, takes and refuses, rule by rule, on a device that has a point for each."""

from __future__ import annotations

import json
from pathlib import Path

import fieldscribe.simulation
import pytest
from fieldscribe.diagnostics import UnclearError
from fieldscribe.families.modbus.frames import frame
from fieldscribe.simulation import servers
from fieldscribe.simulation.bench import Bench, carry_out
from fieldscribe.simulation.device import MOST_COMPLAINTS, SimulatedDevice
from fieldscribe.simulation.line import KINDS, Fault, Faults, Line, Stream
from support.described import described, group, head, together, write

POINTS = """\
- {name: given, at: 0, default: 7, range: 0..9}
- {name: named, at: 1, enum: {3: three, 1: one}}
- {name: bits, at: 2, flags: {0: on, 1: {name: fault, active: 0}}, fixed: {15: 1}}
- {name: digits, at: 3, digits: {count: 2, enum: {0: none, 1: some}}}
- {name: volts, at: 4, unit: V, scale: value = raw / 10}
- {name: hertz, at: 5, unit: Hz, range: 0..100}
- {name: narrow, at: 6, range: 10..20}
- {name: wide, at: 7, type: s32}
- {name: real, at: 9, type: f32, range_in_units: 100..200}
- {name: label, at: 11, type: text, characters: 4}
- {name: address, at: 13, type: bytes, notation: ipv4}
- {name: clock, at: 15, per_word: 1, parts: [hour, minute]}
- {name: signed, at: 17, type: s16, range: -5..5, special: {7FFFh: {name: none, writable: yes}, 7FFEh: broken}}
- {name: low, at: 18, bits: 3..0, range: 0..9, fixed: {15..12: 5}}
- {name: high, at: 18, bits: 11..4}
- {name: top, at: 19, range: 0..given}
- {name: read, at: 20, access: r}
- {name: written, at: 21, access: w}
- {name: pair, at: 22, type: u32, words: low first}
- {name: stepped, at: 24, range: 0..100, steps: {0: 5, 50: 10}}
- {name: locked, at: 25, conditions: [stopped]}
- {name: kept, at: 26, keeps: yes}
- {name: lost, at: 27, keeps: no}
- {name: stored, at: 28, keep_with: save}
- {name: busy, at: 29, bits: 0, access: r}
- {name: only, at: 30, when: named == one}
- {name: apart, at: 31, write_at: 41}
- {name: exponent, at: 32, type: s16, range: -3..3}
- {name: scaled, at: 33, scale: value = raw * 10 ** exponent, unit: A}
- {name: first, at: 34, write_with: [second]}
- {name: second, at: 35, write_with: [first]}
- {name: packed, at: 36, coding: bcd, range: 0..9999}
- {name: usual, at: 37, default_in_units: 2.5, scale: value = raw / 10}
"""
SAVE = "{name: save, function: 06h, at: 50, value: 1, wears: 1000, busy: busy}"
HEAD = {
    "commands": f"[{SAVE}, {{name: any, function: 06h, at: 51, value: any}}]",
    "bus": "{framings: [rtu], units: 1..9, broadcast: 0, gaps: {holding: [60..70]}, "
    "functions: {03h: {name: read, max: 8}, 06h: write, 10h: {name: write_many, max: 4}}}",
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write(tmp_path, described(POINTS, **HEAD))
    return tmp_path


def line_of(folder: Path, **settings: object) -> Line:
    """A line with one such device, whose time stands."""
    bench: dict[str, object] = {key: settings.pop(key) for key in ("seed", "strict") if key in settings}
    bench |= {"lines": [{"devices": [{"device": str(folder), **settings}]}], "time_scale": 0}
    (line,) = Bench(bench).lines
    return line


def device_of(folder: Path, **settings: object) -> SimulatedDevice:
    return line_of(folder, **settings).core.devices[0]


def said(line: Line, request: str) -> str:
    """The PDU of the answer to a PDU."""
    outcomes = Stream(line).received(frame("rtu", 1, 7, bytes.fromhex(request)))
    return " ".join(outcome.data[1:-2].hex() for outcome in outcomes)


STARTS: dict[str, object] = {
    "given": 7,  # its default
    "usual": 2.5,
    "named": "three",  # the first name
    "bits": 0x8000,  # off, with what is fixed
    "digits": 0,
    "volts": 230,  # what is usual of the quantity
    "hertz": 50,
    "label": "labe",  # its own name
    "address": "0.0.0.0",
    "exponent": 0,  # exponents at their lowest: with a range around 0, at 0
    "written": None,
}


def test_first_values(folder: Path) -> None:
    """The same for every seed, where something in the description says them; else in range."""
    for seed in (0, 1, 2):
        values = device_of(folder, seed=seed).values
        assert {name: values[name] for name, value in STARTS.items() if value is not None} == {
            name: value for name, value in STARTS.items() if value is not None
        }
        assert 12 <= values["narrow"] <= 18  # type: ignore[operator]  # from a quarter to three quarters
        assert 125 <= values["real"] <= 175  # type: ignore[operator]
        assert 25 <= values["wide"] <= 75  # type: ignore[operator]  # of 0 to 100 where only the bits set bounds
        assert values["top"] <= values["given"]  # type: ignore[operator]
        assert device_of(folder, seed=seed).memory.areas["holding", 0][18] >> 12 == 5


VALUES: list[tuple[str, object, object]] = [
    ("given", 9, 9),
    ("given", 65535, 65535),  # whatever the rules say
    ("given", 65536, "given cannot hold 65536: raw 65536 is outside 0..65535"),
    ("given", -1, "given cannot hold -1: raw -1 is outside 0..65535"),
    ("named", "one", "one"),
    ("named", 1, "one"),
    ("named", 2, 2),
    ("named", "two", "two"),
    ("volts", 12.34, 12.3),
    ("volts", "12.5 V", 12.5),
    ("volts", "12.35", 12.4),  # half away from zero
    ("signed", "none", "none"),
    ("signed", 0x7FFE, "broken"),
    ("signed", -32768, -32768),
    ("real", 1.5, 1.5),
    ("label", "ABCD", "ABCD"),
    ("address", "10.0.0.1", "10.0.0.1"),
    ("clock", "23:59", "23:59:00"),
    ("packed", 1234, 1234),
    ("low", 15, 15),
    ("low", 16, "low cannot hold 16: raw 16 is outside 0..15"),
    ("pair", 0x12345, 0x12345),
    ("scaled", float("inf"), "scaled cannot hold inf"),
    ("nothing", 1, "has no point `nothing`"),
]


@pytest.mark.parametrize(("name", "written", "held"), VALUES)
def test_a_value(name: str, written: object, held: object, folder: Path) -> None:
    """Written from outside, as a test does; a text that is no value of the point is an error."""
    device = device_of(folder)
    if held == "two" or (isinstance(held, str) and " " in held):
        with pytest.raises((ValueError, KeyError), match=held):
            device.values[name] = written  # type: ignore[assignment]  # as a test writes it
    else:
        device.values[name] = written  # type: ignore[assignment]
        assert device.values[name] == held


REQUESTS: list[tuple[str, str, dict[str, object]]] = [
    ("06 0000 0005", "0600000005", {"given": 5}),
    ("06 0000 000a", "8603", {"given": 7}),  # out of range
    ("06 0001 0002", "8603", {"named": "three"}),  # no such name
    ("06 0011 7fff", "0600117fff", {"signed": "none"}),
    ("06 0011 7ffe", "8603", {}),  # a code that is not written
    ("06 0011 fffb", "060011fffb", {"signed": -5}),
    ("06 0012 5003", "0600125003", {"low": 3, "high": 0}),
    ("06 0012 a003", "8603", {}),  # with other fixed bits
    ("06 0002 8003", "0600028003", {"bits": 0x8003}),
    ("06 0002 0003", "8603", {}),  # without the fixed bit
    ("06 0013 0007", "0600130007", {"top": 7}),
    ("06 0013 0008", "8603", {}),  # above `given`
    ("06 0014 0001", "8604", {}),  # only read
    ("03 0015 0001", "8302", {}),  # only written
    ("06 0015 0001", "0600150001", {}),
    ("10 0016 0002 04 2345 0001", "1000160002", {"pair": 0x12345}),
    ("06 0016 0001", "8602", {}),  # half of a number
    ("06 0018 0007", "0600180007", {"stepped": 5}),
    ("06 0018 0044", "0600180044", {"stepped": 60}),
    ("06 0019 0001", "0600190001", {"locked": 1}),
    ("06 001e 0001", "8602", {}),  # it does not exist while `named` is three
    ("06 0029 0009", "0600290009", {"apart": 9}),  # where it is written
    ("06 001f 0009", "8602", {}),  # not where it is read
    ("03 0029 0001", "8302", {}),
    ("10 0022 0002 04 0001 0002", "1000220002", {"first": 1, "second": 2}),
    ("06 0022 0001", "8604", {}),  # without the other
    ("06 0024 1234", "0600241234", {"packed": 1234}),
    ("06 0024 123a", "8603", {}),  # no decimal digit
    ("06 0064 0001", "8602", {}),  # nothing is there
    ("03 003a 0008", "8302", {}),  # the gap
    ("03 0000 0009", "8303", {}),  # eight at most
    ("05 0000 ff00", "8501", {}),  # no such function
    ("06 0033 1234", "0600331234", {}),  # a command of any number
    ("06 0032 0002", "8602", {}),  # one of another number
]


@pytest.mark.parametrize(("request_pdu", "reply", "held"), REQUESTS)
def test_a_request(request_pdu: str, reply: str, held: dict[str, object], folder: Path) -> None:
    line = line_of(folder)
    device = line.core.devices[0]
    before = device.memory.areas["holding", 0].copy()
    assert said(line, request_pdu) == reply
    assert {name: device.values[name] for name in held} == held
    if reply.startswith("8"):
        assert device.memory.areas["holding", 0] == before


def test_a_restart_keeps_what_is_kept(folder: Path) -> None:
    """What no command stored is lost; each write of what is kept, and each command, wears the memory."""
    line = line_of(folder)
    device = line.core.devices[0]
    names = ("given", "kept", "lost", "stored")
    device.values.update(dict.fromkeys(names, 1))
    for address in (0, 26, 27, 28):
        assert said(line, f"06 {address:04x} 0005")[:2] == "06"
    device.restart()
    assert [device.values[name] for name in names] == [5, 5, 1, 1]
    said(line, "06 001c 0006")
    said(line, "06 0032 0001")
    assert (device.values["busy"], device.wear) == (1, {"kept": 1, "save": 1})
    device.clock.advance(60)
    assert device.values["busy"] == 0
    said(line, "06 001c 0007")
    said(line, "06 001c 0008")
    device.restart()
    assert device.values["stored"] == 6


def test_conditions_are_met_until_somebody_says_otherwise(folder: Path) -> None:
    line = line_of(folder, unmet=["stopped"])
    device = line.core.devices[0]
    assert said(line, "06 0019 0001")[:2] == "86"
    device.conditions["stopped"] = True
    assert said(line, "06 0019 0001")[:2] == "06"
    with pytest.raises(ValueError, match="no write needs the condition `rested`; there are stopped"):
        device.meet(["rested"], holds=True)


def test_complaints_end_somewhere(folder: Path) -> None:
    line = line_of(folder, strict=True)
    device = line.core.devices[0]
    said(line, "03 0016 0001")
    assert [each.rule for each in device.complaints] == ["a part of a number"]
    for number in range(MOST_COMPLAINTS + 5):
        device.complain("rule", str(number))
    assert len(device.complaints) == MOST_COMPLAINTS
    assert str(device.complaints[1]) == "rule: 0"


@pytest.mark.parametrize(("number", "reply"), [(4, "8604"), (0, "0600140001")])
def test_a_refusal_may_have_another_number(number: int, reply: str, folder: Path) -> None:
    """0 is an acceptance that does nothing."""
    line = line_of(folder, refusals={"read_only": number}, values={"read": 9})
    assert said(line, "06 0014 0001") == reply
    assert line.core.devices[0].values["read"] == 9


FAULTS: list[tuple[str, bytes, float, bool]] = [
    ("silent", b"", 0, False),
    ("late", b"abcdef", 1, False),
    ("late 0.5", b"abcdef", 0.5, False),
    ("cut", b"abc", 0, False),
    ("cut 4", b"abcd", 0, False),
    ("cut 99", b"abcdef", 0, False),
    ("doubled", b"abcdefabcdef", 0, False),
    ("check", b"check!", 0, False),
    ("unit", b"unit!", 0, False),
    ("function", b"function!", 0, False),
    ("exception", b"exception!", 0, False),
    ("drop", b"", 0, True),
    ("drop 2", b"ab", 0, True),
    ("damaged", b"?bcdef", 0, False),
    ("damaged 2", b"ab?def", 0, False),
    ("damaged 99", b"abcde?", 0, False),
    ("noise", b"???abcdef", 0, False),
    ("noise 2", b"ab???cdef", 0, False),
]


@pytest.mark.parametrize(("text", "data", "delay", "drop"), FAULTS)
def test_a_fault(text: str, data: bytes, delay: float, drop: bool) -> None:
    """`?` is any byte, but where one is damaged, any other."""
    for seed in range(20):
        faults = Faults(seed)
        faults.waiting = [Fault.of(f"{text} x2"), Fault.of("silent x1")]
        made = [faults.outcome(b"abcdef", 0.0, lambda _, what: f"{what}!".encode()) for _ in range(4)]
        for outcome in made[:2]:
            assert (len(outcome.data), outcome.delay, outcome.drop) == (len(data), delay, drop)
            assert all(wanted in (b"?"[0], byte) for byte, wanted in zip(outcome.data, data, strict=True))
            assert outcome.fault == text.partition(" ")[0]
            assert "damaged" not in text or outcome.data != b"abcdef"
        assert [(outcome.data, outcome.fault) for outcome in made[2:]] == [(b"", "silent"), (b"abcdef", "")]
    assert {fault.split()[0] for fault, *_ in FAULTS} == KINDS.keys()


def test_the_trace_says_what_was_not_refused(folder: Path) -> None:
    entries: list[str] = []
    line = line_of(folder)
    line.trace = entries.append
    line.faults.waiting.append(Fault.of("late 0.1234567 x1"))
    said(line, "06 0000 0005")
    entry = json.loads(entries[0])
    assert (entry["refused"], entry["fault"], entry["delay"], entry["unit"]) == (None, "late", 0.123457, 1)


BASED = together(
    head(given="{slot: {range: 1..3}}", variants="{size: {values: {small: {}, large: {}}}}"),
    group("- {name: level, at: 0, default: 4}\n", base="slot * 100", group="moved"),
    group("- {name: kind, at: 5, variants: {size=small: {default: 1}, size=large: {default: 2}}}\n"),
)


@pytest.mark.parametrize(
    ("settings", "reads"),
    [
        ({}, {100: "0004", 5: "0001", 200: ""}),
        ({"given": {"slot": 2}}, {200: "0004", 100: ""}),
        ({"variant": {"size": "large"}}, {5: "0002"}),
        ({"unit": 247, "units": "1..1"}, {100: "0004"}),
    ],
)
def test_a_device_of_a_bench(settings: dict[str, object], reads: dict[int, str], tmp_path: Path) -> None:
    write(tmp_path, BASED)
    line = line_of(tmp_path, **settings)
    assert {at: said(line, f"03 {at:04x} 0001")[4:] for at in reads} == reads


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"unit": True}, "`unit` is a whole number"),
        ({"seed": True}, "`seed` is a whole number"),
        ({"strict": 1}, "`strict` is yes or no"),
        ({"values": []}, "`values` is a mapping"),
        ({"unmet": "stopped"}, "`unmet` is a list"),
        ({"unit": 10}, "made_up has no unit 10"),
        ({"unit": 0}, "made_up has no unit 0"),
        ({"units": "1..x"}, "`1..x` is no interval"),
        ({"units": "1..10001"}, "`1..10001` is no interval"),
        ({"variants": {}}, "there is no key `variants` here"),
        ({"given": {"slot": 1}}, "no address depends on `slot=1`"),
        ({"values": {"given": "much"}}, "much"),
        ({"refusals": 3}, "`refusals` is a mapping"),
    ],
)
def test_wrong_settings(settings: dict[str, object], message: str, folder: Path) -> None:
    with pytest.raises(UnclearError) as error:
        line_of(folder, **settings)
    assert message in error.value.message


@pytest.mark.parametrize(("scale", "is_right"), [(0, True), (1_000_000, True), (1_000_001, False), (-0.1, False)])
def test_a_time_scale(scale: float, is_right: bool, folder: Path) -> None:
    settings = {"lines": [{"devices": [{"device": str(folder)}]}], "time_scale": scale}
    if is_right:
        assert Bench(settings).clock.scale == scale
    else:
        with pytest.raises(UnclearError, match="a time scale is a number from 0"):
            Bench(settings)


def test_the_console_says_what_it_does_not_know(folder: Path) -> None:
    bench = Bench({"lines": [{"devices": [{"device": str(folder), "units": "1..2"}]}], "time_scale": 0})
    assert carry_out(bench, "dance") == "there is no `dance`; `help` lists what there is"
    assert carry_out(bench, "get given") == "1 given = 7\n2 given = 7"
    assert carry_out(bench, " @2  set given = 3 ") == ""
    assert carry_out(bench, "get given") == "1 given = 7\n2 given = 3"
    assert carry_out(bench, "@1 unmet stopped") == ""
    assert [device.conditions["stopped"] for device in bench.lines[0].core.devices] == [False, True]
    assert carry_out(bench, "met stopped") == ""
    assert bench.lines[0].core.devices[0].conditions["stopped"]
    with pytest.raises(UnclearError, match="`-5` is no number of seconds"):
        carry_out(bench, "advance -5")


def test_the_room_offers_what_tests_use() -> None:
    assert (fieldscribe.simulation.simulated, fieldscribe.simulation.Simulated) == (
        servers.simulated,
        servers.Simulated,
    )
    with pytest.raises(AttributeError, match="nothing"):
        fieldscribe.simulation.nothing  # noqa: B018  # it is looked up
