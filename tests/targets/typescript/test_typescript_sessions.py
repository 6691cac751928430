"""How generated TypeScript talks to a device: values, limits that others set, few requests, refusals, variants."""

from __future__ import annotations

import json
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.simulation import Simulated, simulated
from fieldscribe.text import camel
from support.blocks import Registers, served
from support.node_device import NodeDevice, NodeError, bridged, node_device
from support.toolchains import succeed, tool

pytestmark = pytest.mark.full(seconds=2)

L200, FRONIUS, MM4, MPU2S = "hitachi_l200", "fronius_datamanager", "siemens_mm4", "woodward_mpu2s"
FRAMINGS = {L200: "rtu", FRONIUS: "tcp", MM4: "uss"}


@contextmanager
def running(folder: Path, name: str, settings: dict[str, Any] | None = None, **options: Any) -> Iterator[Any]:
    """Yield a simulated device with these settings, and the generated one with these options."""
    framing = FRAMINGS[name]
    with (
        simulated(name, on="tcp", framing=framing, **settings or {}) as drive,
        node_device(
            folder, name, {"kind": "tcp", "port": drive.port, "framing": framing}, unit=drive.unit, **options
        ) as node,
    ):
        yield drive, node


def status_of(node: NodeDevice, *call: Any) -> str:
    """The status of what a call raises."""
    with pytest.raises(NodeError) as raised:
        node(*call)
    return str(raised.value.status or raised.value.kind)


@pytest.fixture(scope="module")
def l200(folder: Path) -> Iterator[tuple[Simulated, NodeDevice]]:
    """A drive and its client."""
    with running(folder, L200, voltageClass="400V") as both:
        yield both


def test_a_value_is_written_and_read_by_attribute_name_and_code(l200: tuple[Simulated, NodeDevice]) -> None:
    drive, node = l200
    node("baseFrequency", "write", 47.5)
    assert drive.values["base_frequency"] == 47.5
    assert [node(each, "read") for each in ("baseFrequency", "base_frequency", "A020", "a020")] == [47.5] * 4
    assert node("baseFrequency", "readRaw") == 475


@pytest.mark.parametrize(
    ("call", "status"),
    [
        (("baseFrequency", "write", 400.1), "out_of_range"),
        (("baseFrequency", "write", "fifty"), "wrong_type"),
        (("baseFrequency", "writeRaw", 4001), "out_of_range"),
        (("outputFrequencyMonitor", "write", 1), "no_access"),
        (("motorPower", "write", 77), "unknown_value"),
        (("baseFrequency", "write", 50, {"keep": True}), "no_access"),
        ((None, "point", "A999"), "no_access"),
        ((None, "readMany", "statues"), "no_access"),
        ((None, "readMany", ["baseFrequency", "A999"]), "no_access"),
        ((None, "readAt", "holding", 0x1028, 5), "bad_count"),
        ((None, "readAt", "register", 0x1028), "bad_space"),
        ((None, "writeAt", "holding", 0x10000, 1), "bad_address"),
        (("enter", "send", "now"), "bad_value"),
    ],
)
def test_what_is_wrong_is_not_sent(l200: tuple[Simulated, NodeDevice], call: tuple[Any, ...], status: str) -> None:
    drive, node = l200
    before = drive.requests
    if call[0] == "outputFrequencyMonitor":
        assert status_of(node, *call) in (status, "TypeError")  # there is no such method
    else:
        assert status_of(node, *call) == status
    assert drive.requests == before


def test_a_limit_that_another_point_sets_is_read_before_each_write(l200: tuple[Simulated, NodeDevice]) -> None:
    drive, node = l200
    for rated in (60, 80):
        drive.values["motor_rated_frequency"] = rated
        assert status_of(node, "maximumFrequency", "write", rated - 1) == "out_of_range"
        node("maximumFrequency", "write", rated)
        assert drive.values["maximum_frequency"] == rated


def test_a_group_comes_in_few_requests_and_a_refused_point_costs_none(l200: tuple[Simulated, NodeDevice]) -> None:
    drive, node = l200
    drive.values["base_frequency"] = 47.5
    node(None, "forget")
    before = drive.requests
    coils = node(None, "readMany", "coils")
    assert (len(coils), drive.requests - before) == (24, 2)
    found = node(None, "readMany", ["baseFrequency", "A999"], {"errors": "return"})
    assert (found["baseFrequency"], found["A999"]["error"]["status"]) == (47.5, "no_access")


def test_addresses_that_are_refused_between_points_are_not_asked_for_again(folder: Path) -> None:
    """Only those: what a point has read is read across."""
    line = Registers(dict.fromkeys({*range(0x1017, 0x101C)} - {0x101A}, 1))
    over = {"kind": "tcp", "framing": "rtu"}
    with served(line) as port, node_device(folder, L200, {**over, "port": port}, unit=1) as node:
        for names, asked in (
            (["frequencySource", "maximumFrequency"], [(0x1018, 4), (0x1018, 1), (0x101B, 1)]),
            (["frequencySource", "maximumFrequency"], [(0x1018, 1), (0x101B, 1)]),
            (["motorDirection", "runSource"], [(0x1017, 3)]),
        ):
            line.asked.clear()
            node(None, "readMany", names, {"errors": "return"})
            assert line.asked == asked


def test_a_command_and_words_without_meaning(l200: tuple[Simulated, NodeDevice]) -> None:
    drive, node = l200
    node("enter", "send")
    node(None, "writeAt", "holding", 0x1028, 500)
    assert (drive.values["base_frequency"], node(None, "readAt", "holding", 0x1028)) == (50, [500])


def test_failures_are_counted_and_retried_but_commands_are_not(l200: tuple[Simulated, NodeDevice]) -> None:
    drive, node = l200
    node.set(retries=1)
    drive.fault("silent x1")
    assert node("baseFrequency", "readRaw") > 0
    drive.fault("silent x1")
    with pytest.raises(NodeError, match=r"unit \d+ did not reply to function 0\dh") as raised:
        node("enter", "send")
    assert raised.value.status == "timeout"
    node.set(retries=0)


@pytest.mark.parametrize(
    ("name", "options", "status"),
    [
        (L200, {"voltageClass": "300V"}, "bad_variant"),
        (L200, {"unit": 33}, "bad_unit"),
        (FRONIUS, {"unit": "1"}, "bad_unit"),
        (MM4, {"link": {"pkw": 5, "pzd": 2}}, "bad_link"),
        (MM4, {"link": {"pkw": 4, "pzd": 9}}, "bad_link"),
        (MM4, {}, "bad_link"),
    ],
)
def test_a_device_that_cannot_be_is_not_made(folder: Path, name: str, options: dict[str, Any], status: str) -> None:
    line = {"kind": "tcp", "port": 1, "framing": FRAMINGS[name]}
    with node_device(folder, name, line, **{"unit": 1, **options}) as node:
        assert status_of(node, None, "table") == status


@pytest.mark.parametrize(("name", "framing"), [(L200, "tcp"), (L200, "uss"), (MM4, "rtu")])
def test_a_line_that_frames_otherwise_is_refused(folder: Path, name: str, framing: str) -> None:
    line = {"kind": "tcp", "port": 1, "framing": framing}
    options = {"link": {"pkw": 4, "pzd": 2}} if name == MM4 else {}
    with node_device(folder, name, line, unit=1, **options) as node:
        assert status_of(node, None, "table") == "bad_framing"


def test_a_device_says_what_it_is(folder: Path) -> None:
    with running(folder, FRONIUS) as (drive, node):
        assert node(None, "identify") == {}
        drive.values["manufacturer"] = "Somebody"
        assert status_of(node, None, "identify") == "other_device"


def test_a_number_that_a_scale_needs_is_remembered_if_it_never_changes(folder: Path) -> None:
    """All others are read again for each value."""
    with running(folder, FRONIUS) as (drive, node):
        for point, factor, second in (
            ("dc_voltage", "dc_voltage_exponent", 5),
            ("rated_power", "rated_power_exponent", 50),
        ):
            drive.values[factor], drive.values[point] = 0, 50
            name = camel(point)
            assert node(name, "read") == 50
            drive.values[factor] = -1
            assert node(name, "read") == second
        node(None, "forget")
        assert node("ratedPower", "read") == node("ratedPower", "readRaw") / 10


def test_a_parameter_is_kept_if_the_caller_says_so(folder: Path) -> None:
    with running(folder, MM4, link={"pkw": 127, "pzd": 2}) as (drive, node):
        for keep, left in ((True, 40), (False, 40)):
            node("maximumFrequency", "write", 40 if keep else 45, {"keep": keep})
            drive.restart()
            assert node("maximumFrequency", "read") == left
        assert status_of(node, "controlWord", "write", 0, {"keep": True}) == "no_access"


def test_a_word_beyond_the_link_is_told(folder: Path) -> None:
    """A setpoint that no telegram carries is neither sent nor taken for written."""
    with running(folder, MM4, link={"pkw": 127, "pzd": 1}) as (drive, node):
        before = drive.requests
        for call in (("mainSetpoint", "writeRaw", 1), ("mainActualValue", "readRaw"), (None, "readAt", "task", 1)):
            assert status_of(node, *call) == "bad_link"
        assert drive.requests == before


def test_process_data_falls_back_to_nothing_after_a_failure(folder: Path) -> None:
    with running(folder, MM4, link={"pkw": 127, "pzd": 2}) as (drive, node):
        node("mainSetpoint", "writeRaw", 0x2000)
        assert node(None, "readAt", "task", 1) == [0x2000]
        drive.fault("silent x1")
        assert status_of(node, "mainSetpoint", "writeRaw", 0x3000) == "timeout"
        assert node(None, "readAt", "task", 1) == [0]


def test_a_broadcast_counts_for_the_words_of_its_mask(folder: Path) -> None:
    """Bit 10 of the control word is always 1, so the mask may not leave it out."""
    with running(folder, MM4, link={"pkw": 127, "pzd": 2}) as (drive, node):
        node(None, "broadcast", [4, 0xFFFF, 0, 0], [0x0400, 0x2000])
        until = time.monotonic() + 5
        while drive.values["main_setpoint"] != 25 and time.monotonic() < until:  # no reply says that it has come
            time.sleep(0.01)
        assert (drive.values["control_word"], drive.values["main_setpoint"]) == (0x0400, 25)
        for mask, words in (([6, 0xFBFF, 0, 0], [0x0400, 0x1000]), ([6, 0xFFFF, 0, 0], [0, 0x1000])):
            assert status_of(node, None, "broadcast", mask, words) == "bad_value"
        assert drive.values["main_setpoint"] == 25


@pytest.mark.parametrize(("offset", "expected"), [(0, 0.5), (2, 2), (3, "wrong_length"), (-1, "wrong_length")])
def test_a_value_anywhere_in_bytes(offset: int, expected: Any, l200: tuple[Simulated, NodeDevice]) -> None:
    _, node = l200
    call = ("baseFrequency", "decodeBytes", [0, 5, 0, 20], offset)
    assert (status_of(node, *call) if isinstance(expected, str) else node(*call)) == expected


def test_a_telegram_that_nobody_sends_is_told(folder: Path) -> None:
    with (
        simulated(MPU2S, on="can") as drive,
        bridged(drive.url.rpartition("/")[2]) as port,
        node_device(folder, MPU2S, {"kind": "can", "port": port}, unit=drive.unit) as node,
    ):
        cyclic = next(one["attribute"] for one in node(None, "table") if one["telegram"])
        assert node(cyclic, "readRaw") is not None
        drive.fault("silent")
        node.set(patience=0.2, freshFor=0)
        assert status_of(node, cyclic, "readRaw") == "timeout"


def test_any_bytes_are_safe(folder: Path) -> None:
    """Whatever comes in place of a reply or a frame is an error with a status, and never anything else."""
    shutil.copy(Path(__file__).parent / "programs/any_bytes.mjs", folder)
    seen = json.loads(succeed([tool("node"), "any_bytes.mjs"], cwd=folder))
    assert {"bad_crc", "wrong_transaction", "wrong_check", "wrong_id", "long_frame", "ok"} <= seen.keys()
