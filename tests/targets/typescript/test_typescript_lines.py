"""Generated TypeScript over real lines: every point of simulated devices, and faults that the next request survives."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.arithmetic import codec
from fieldscribe.simulation import Simulated, simulated
from fieldscribe.text import camel
from support.node_device import NodeDevice, NodeError, bridged, node_device

VARIANTS = {
    "hitachi_l200": {"voltage_class": "400V"},
    "siemens_mm4": {"model": "mm440", "interface": "rs485"},
    "woodward_mpu2s": {"voltage": "400V"},
}
VALUES = {
    "eastron_sdm630": {"system_type": "three_phase_four_wire"},  # else some points do not exist
    "siemens_mm4": {"uss_pzd_length_index_0": "4", "uss_pzd_length_index_1": "4"},
}
LINK = {"siemens_mm4": {"link": {"pkw": 127, "pzd": 4}}}
LEAST = {
    "eastron_sdm630": 98,
    "fronius_datamanager": 200,
    "hitachi_l200": 234,
    "jumo_controller": 23,
    "nord_sk5xxe": 12,
    "siemens_mm4": 29,
    "woodward_mpu2s": 240,
}
"""How many points are read, at the least."""
WRITTEN = {
    "eastron_sdm630": 8,
    "fronius_datamanager": 31,
    "hitachi_l200": 190,
    "jumo_controller": 9,
    "nord_sk5xxe": 6,
    "siemens_mm4": 26,
    "woodward_mpu2s": 180,
}
"""How many points are written, at the least."""
ONCE = ("password_level_2",)
LINES = [
    ("eastron_sdm630", "tcp", "rtu", "tcp"),
    ("fronius_datamanager", "tcp", "tcp", "tcp"),
    ("hitachi_l200", "tcp", "rtu", "tcp"),
    ("jumo_controller", "tcp", "rtu", "tcp"),
    ("nord_sk5xxe", "tcp", "rtu", "tcp"),
    ("siemens_mm4", "tcp", "uss", "tcp"),
    ("woodward_mpu2s", "can", "", "can"),
    ("hitachi_l200", "serial", "rtu", "serial"),
    ("siemens_mm4", "serial", "uss", "serial"),
    ("hitachi_l200", "serial", "rtu", "modbus-serial"),
    ("fronius_datamanager", "tcp", "tcp", "modbus-serial"),
]
"""Device, where it answers, the framing, and the line of the runtime."""


@contextmanager
def connected(
    folder: Path, device: str, on: str, framing: str, kind: str, **settings: Any
) -> Iterator[tuple[Simulated, NodeDevice]]:
    """Yield a simulated device, and the generated one in node that talks to it."""
    variants = VARIANTS.get(device, {})
    made = [f"{axis}={value}" for axis, value in variants.items()]
    settings |= {"framing": framing} if framing else {}
    with simulated(device, on=on, variants=made, values=VALUES.get(device, {}), **settings) as drive:
        options = {camel(axis): value for axis, value in variants.items()} | LINK.get(device, {})
        with (
            _line(drive, on, kind) as line,
            node_device(folder, device, line | {"framing": framing}, unit=drive.unit, **options) as node,
        ):
            yield drive, node


@contextmanager
def _line(drive: Simulated, on: str, kind: str) -> Iterator[dict[str, Any]]:
    if on != "can":
        yield {"kind": kind, "path": drive.path} if on == "serial" else {"kind": kind, "port": drive.port}
        return
    with bridged(drive.url.rpartition("/")[2]) as port:
        yield {"kind": kind, "port": port}


CODEC = {"special", "not_a_number", "zero_factor", "no_case", "overflow", "malformed", "unknown_value", "out_of_range"}
"""What a value of a simulated device may lack; the vectors say when."""


def raw_of(found: Any) -> int:
    """The raw number that a device in node gave."""
    return int(found["bigint"]) if isinstance(found, dict) else int(found)


def value_of(node: NodeDevice, attribute: str) -> Any:
    """The value of a point; None where its number has none."""
    try:
        return node(attribute, "read")
    except NodeError as error:
        if error.status in CODEC:
            return None
        raise


@pytest.mark.full(seconds=6)
@pytest.mark.parametrize(
    ("device", "on", "framing", "kind"), [pytest.param(*line, id=" ".join(line)) for line in LINES]
)
def test_every_readable_point(folder: Path, device: str, on: str, framing: str, kind: str) -> None:
    """Each point that can be read has the raw number that the device holds, alone and with its group."""
    with connected(folder, device, on, framing, kind) as (drive, node):
        table = {one["name"]: one for one in node(None, "table")}
        points = [
            point
            for point in drive.device.layout.points.values()
            if point.generated and point.readable and point.variant is None and point.space != "signal"
        ]
        groups: dict[str, dict[str, Any]] = {}
        for point in points:
            attribute = table[point.name]["attribute"]
            if point.text is None:
                assert raw_of(node(attribute, "readRaw")) == drive.device.memory.raw(point.name), point.name
            value = value_of(node, attribute)
            if point.group not in groups:
                groups[point.group] = node(None, "readMany", point.group, {"errors": "return"})
            if value is not None:
                assert groups[point.group][camel(point.name)] == value, point.name
        assert len(points) >= LEAST[device]


def test_points_that_do_not_exist_now_are_left_out_of_groups(folder: Path) -> None:
    """The phases of a meter, by its wiring; one that is asked for by name is read, and its condition told."""
    with connected(folder, *LINES[0], strict=True) as (meter, node):
        meter.values["system_type"] = "single_phase_two_wire"
        group = node(None, "readMany", "measurements")
        assert ("phase1Voltage" in group, "phase2Voltage" in group, meter.device.complaints) == (True, False, [])
        with pytest.raises(NodeError, match="it exists only when systemType == three_phase_four_wire") as refused:
            node("phase2Voltage", "read")
        assert (refused.value.status, refused.value.point) == ("exception", "phase_2_voltage")
        assert refused.value.facts["existsWhen"] == "systemType == three_phase_four_wire"
        meter.device.complaints.clear()


@pytest.mark.full(seconds=6)
@pytest.mark.parametrize("line", [pytest.param(line, id=" ".join(line)) for line in LINES[:7]])
def test_every_writable_point(folder: Path, line: tuple[str, str, str, str]) -> None:
    """The device holds what was written, for each point that has another raw number beside that which it holds."""
    written = 0
    with connected(folder, *line) as (drive, node):
        table = {one["name"]: one for one in node(None, "table")}
        for point in drive.device.layout.points.values():
            if not (point.generated and point.writable) or point.text is not None or point.variant is not None:
                continue
            if "length" in point.name or point.name in ONCE:  # the link would change, or a password would be set
                continue
            raw = next((raw for raw in (*point.outer, *point.outer[:1]) if takes(drive, point.name, raw)), None)
            if raw is None:
                continue
            try:
                node(table[point.name]["attribute"], "writeRaw", raw)
            except NodeError as error:
                assert error.kind in ("ExceptionReplyError", "RefusedError"), (point.name, error)
                continue
            assert drive.device.memory.raw(point.name) == raw, point.name
            written += 1
    assert written >= WRITTEN[line[0]]


def takes(drive: Simulated, name: str, raw: int) -> bool:
    """Whether a point may be written so, and would change."""
    try:
        codec.check(drive.device.layout.points[name], raw, drive.device.memory.settings)
    except codec.CodecError:
        return False
    return raw != drive.device.memory.raw(name)


RTU_LINE, TCP_LINE, USS_LINE, CAN_LINE, SERIAL = LINES[2], LINES[1], LINES[5], LINES[6], LINES[7]
ASKED = {
    "hitachi_l200": "baseFrequency",
    "fronius_datamanager": "deviceAddress",
    "siemens_mm4": "maximumFrequency",
    "woodward_mpu2s": "generatorFrequencySetpoint",
}
COMMON = {"silent": "timeout", "check": "bad_crc", "exception": "exception"}
OF_RTU = {"late 0.45": "timeout", "doubled": "ok"}
FAULTS = {
    RTU_LINE: COMMON
    | OF_RTU
    | {"cut": "timeout", "noise": "timeout", "damaged 3": "bad_crc", "unit": "wrong_unit", "drop": "line"},
    TCP_LINE: COMMON
    | {"check": "wrong_transaction", "unit": "wrong_unit", "function": "wrong_function", "doubled": "ok"},
    SERIAL: COMMON | OF_RTU,
    USS_LINE: COMMON | {"check": "wrong_check", "unit": "wrong_unit", "exception": "refused", "late 0.45": "timeout"},
    CAN_LINE: {"silent": "timeout", "check": "timeout (wrong_check)"},
    LINES[9]: COMMON,
}
"""What is wrong once on a line, and the status of the request that it strikes, with what is wrong with a CAN frame."""


@pytest.mark.full(seconds=2)
@pytest.mark.parametrize("line", [pytest.param(line, id=" ".join(line)) for line in FAULTS])
def test_a_fault_has_its_error_and_passes(folder: Path, line: tuple[str, str, str, str]) -> None:
    """The request that a fault strikes says so, by status; the next one works, and a retry hides the fault."""
    with connected(folder, *line) as (drive, node):
        point = ASKED[line[0]]
        if line is CAN_LINE:
            node.set(patience=0.3)
        expected = node(point, "readRaw")
        for fault, status in FAULTS[line].items():
            node.set(retries=0)
            drive.fault(f"{fault} x1")
            assert outcome(node, point, expected) == status, fault
            assert node(point, "readRaw") == expected, fault
            node.set(retries=1)
            drive.fault(f"{fault} x1")
            assert outcome(node, point, expected) == (status if status in ("exception", "refused") else "ok"), fault


def outcome(node: NodeDevice, point: str, expected: Any) -> str:
    """The status of reading a point, which gives what is expected where it is ok."""
    try:
        assert node(point, "readRaw") == expected
    except NodeError as error:
        frame = re.search(r" \(wrong_\w+\)", str(error))
        return f"{error.status}{frame[0] if frame else ''}"
    return "ok"
