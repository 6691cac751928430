"""What a simulated device holds, takes and refuses, rule by rule, on a device that has a point for each."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import fieldscribe.simulation
import pytest
from fieldscribe.diagnostics import UnclearError
from fieldscribe.families.modbus.frames import frame
from fieldscribe.simulation import servers
from fieldscribe.simulation.bench import Bench, carry_out
from fieldscribe.simulation.device import MOST_COMPLAINTS, SimulatedDevice
from fieldscribe.simulation.line import KINDS, Fault, Faults, Line, Stream
from support.described import group, head, together, write

DEVICE = Path(__file__).parent / "ruled"


def line_of(device: Path = DEVICE, **settings: Any) -> Line:
    """A line with one such device, whose time stands."""
    bench: dict[str, object] = {key: settings.pop(key) for key in ("seed", "strict") if key in settings}
    bench |= {"lines": [{"devices": [{"device": str(device), **settings}]}], "time_scale": 0}
    (line,) = Bench(bench).lines
    return line


def device_of(**settings: Any) -> SimulatedDevice:
    return line_of(**settings).core.devices[0]


def said(line: Line, request: str) -> str:
    """The PDU of the answer to a PDU."""
    outcomes = Stream(line).received(frame("rtu", 1, 7, bytes.fromhex(request)))
    return " ".join(outcome.data[1:-2].hex() for outcome in outcomes)


RULES: dict[str, list[list[Any]]] = json.loads(Path(__file__).with_name("rules.json").read_text("utf-8"))
"""Values: the point, what is written, what is held or the error. Requests: PDU, reply, what is held, and why. Faults:
the text, what comes of `abcdef`, the delay, and whether the line breaks down."""

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


def test_first_values() -> None:
    """The same for every seed, where something in the description says them; else in range."""
    for seed in (0, 1, 2):
        device = device_of(seed=seed)
        values: Any = device.values
        assert {name: values[name] for name, value in STARTS.items() if value is not None} == {
            name: value for name, value in STARTS.items() if value is not None
        }
        assert 12 <= values["narrow"] <= 18  # from a quarter to three quarters
        assert 125 <= values["real"] <= 175  # likewise
        assert 25 <= values["wide"] <= 75  # of 0 to 100 where only the bits set bounds
        assert values["top"] <= values["given"]  # likewise
        assert device.memory.areas["holding", 0][18] >> 12 == 5


@pytest.mark.parametrize(("name", "written", "held"), RULES["values"])
def test_a_value(name: str, written: object, held: object) -> None:
    """Written from outside, as a test does; a text that is no value of the point is an error."""
    values: Any = device_of().values
    if held == "two" or (isinstance(held, str) and " " in held):
        with pytest.raises((ValueError, KeyError), match=held):
            values[name] = written
    else:
        values[name] = written
        assert values[name] == held


@pytest.mark.parametrize(("request_pdu", "reply", "held"), [row[:3] for row in RULES["requests"]])
def test_a_request(request_pdu: str, reply: str, held: dict[str, object]) -> None:
    line = line_of()
    device = line.core.devices[0]
    before = device.memory.areas["holding", 0].copy()
    assert said(line, request_pdu) == reply
    assert {name: device.values[name] for name in held} == held
    if reply.startswith("8"):
        assert device.memory.areas["holding", 0] == before


def test_a_restart_keeps_what_is_kept() -> None:
    """What no command stored is lost; each write of what is kept, and each command, wears the memory."""
    line = line_of()
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


def test_conditions_are_met_until_somebody_says_otherwise() -> None:
    line = line_of(unmet=["stopped"])
    device = line.core.devices[0]
    assert said(line, "06 0019 0001")[:2] == "86"
    device.conditions["stopped"] = True
    assert said(line, "06 0019 0001")[:2] == "06"
    with pytest.raises(ValueError, match="no write needs the condition `rested`; there are stopped"):
        device.meet(["rested"], holds=True)


def test_complaints_end_somewhere() -> None:
    line = line_of(strict=True)
    device = line.core.devices[0]
    said(line, "03 0016 0001")
    assert [each.rule for each in device.complaints] == ["a part of a number"]
    for number in range(MOST_COMPLAINTS + 5):
        device.complain("rule", str(number))
    assert len(device.complaints) == MOST_COMPLAINTS
    assert str(device.complaints[1]) == "rule: 0"


@pytest.mark.parametrize(("number", "reply"), [(4, "8604"), (0, "0600140001")])
def test_a_refusal_may_have_another_number(number: int, reply: str) -> None:
    """0 is an acceptance that does nothing."""
    line = line_of(refusals={"read_only": number}, values={"read": 9})
    assert said(line, "06 0014 0001") == reply
    assert line.core.devices[0].values["read"] == 9


@pytest.mark.parametrize(("text", "data", "delay", "drop"), RULES["faults"])
def test_a_fault(text: str, data: str, delay: float, drop: bool) -> None:
    """`?` is any byte, but where one is damaged, any other."""
    for seed in range(20):
        faults = Faults(seed)
        faults.waiting = [Fault.of(f"{text} x2"), Fault.of("silent x1")]
        made = [faults.outcome(b"abcdef", 0.0, lambda _, what: f"{what}!".encode()) for _ in range(4)]
        for outcome in made[:2]:
            assert (len(outcome.data), outcome.delay, outcome.drop) == (len(data), delay, drop)
            assert all(wanted in (b"?"[0], byte) for byte, wanted in zip(outcome.data, data.encode(), strict=True))
            assert outcome.fault == text.partition(" ")[0]
            assert "damaged" not in text or outcome.data != b"abcdef"
        assert [(outcome.data, outcome.fault) for outcome in made[2:]] == [(b"", "silent"), (b"abcdef", "")]
    assert {fault.partition(" ")[0] for fault, *_ in RULES["faults"]} == KINDS.keys()


def test_the_trace_says_what_was_not_refused() -> None:
    entries: list[str] = []
    line = line_of()
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
        ({"unit": 10}, "ruled has no unit 10"),
        ({"unit": 0}, "ruled has no unit 0"),
        ({"units": "1..x"}, "`1..x` is no interval"),
        ({"units": "1..10001"}, "`1..10001` is no interval"),
        ({"variants": {}}, "there is no key `variants` here"),
        ({"given": {"slot": 1}}, "no address depends on `slot=1`"),
        ({"values": {"given": "much"}}, "much"),
        ({"refusals": 3}, "`refusals` is a mapping"),
        ({"refusals": {"nosuch": 0}}, "modbus has no refusal `nosuch`"),
        ({"refusals": {"index": 0}}, "modbus has no refusal `index`"),
        ({"refusals": {"read_only": 256}}, "the number of `read_only` is a whole number from 0 to 255"),
        ({"refusals": {"read_only": True}}, "the number of `read_only` is a whole number from 0 to 255"),
        ({"device": "siemens_mm4", "refusals": {"format": 0}}, "uss has no refusal `format`"),
        (
            {"device": "siemens_mm4", "refusals": {"index": -1}},
            "the number of `index` is a whole number from 0 to 65535",
        ),
        ({"device": "woodward_mpu2s", "refusals": {"read_only": 0}}, "can has no refusal `read_only`"),
    ],
)
def test_wrong_settings(settings: dict[str, Any], message: str) -> None:
    with pytest.raises(UnclearError) as error:
        line_of(**settings)
    assert message in error.value.message


@pytest.mark.parametrize(("scale", "is_right"), [(0, True), (1_000_000, True), (1_000_001, False), (-0.1, False)])
def test_a_time_scale(scale: float, is_right: bool) -> None:
    settings = {"lines": [{"devices": [{"device": str(DEVICE)}]}], "time_scale": scale}
    if is_right:
        assert Bench(settings).clock.scale == scale
    else:
        with pytest.raises(UnclearError, match="a time scale is a number from 0"):
            Bench(settings)


def test_the_console_says_what_it_does_not_know() -> None:
    bench = Bench({"lines": [{"devices": [{"device": str(DEVICE), "units": "1..2"}]}], "time_scale": 0})
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
