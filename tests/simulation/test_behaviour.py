"""The shipped behaviours by the clock alone: drives that ramp, trip and are reset, a genset that synchronises."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import pytest
from fieldscribe.simulation.bench import layout_of, rules_of
from fieldscribe.simulation.device import Clock, SimulatedDevice


def running(name: str) -> SimulatedDevice:
    """A device with its behaviour, whose time stands but for `advance`."""
    return SimulatedDevice(layout_of(name), clock=Clock(0), rules=rules_of(name))


Step = tuple[dict[str, object], float, dict[str, object]]
"""What is written, how many seconds pass then, and what is read behind them."""

L200: list[Step] = [
    ({}, 1, {"output_frequency": 0, "inverter_status": "stopped", "ready": "ready"}),
    ({"network_frequency_setpoint": 30.0, "run_command": "run"}, 0, {"output_frequency": 0, "run_mode": "on"}),
    ({}, 2.5, {"output_frequency": 12.5, "inverter_status": "running", "rotation_direction": "forward"}),
    ({"F002": 5.0}, 1, {"output_frequency": 22.5, "motor_current": 40, "output_voltage": 45}),
    ({}, 5, {"output_frequency": 30}),
    ({"load": 110}, 0, {"motor_current": 110, "overload": "on"}),
    ({"A004": 25, "A003": 25}, 1, {"output_frequency": 27.5}),
    ({"A004": 50, "load": 20, "direction_command": "reverse"}, 5.5, {"output_frequency": 0, "overload": "off"}),
    ({}, 1, {"output_frequency": 10, "rotation_direction": "reverse", "direction_status": "reverse"}),
    ({"external_trip": "trip"}, 0, {"output_frequency": 0, "alarm": "tripped", "ready": "not_ready", "trip_count": 1}),
    (
        {"external_trip": "no_trip"},
        9,
        {"inverter_status": "tripped", "trip_1_error": 12, "trip_1_output_frequency": 10},
    ),
    ({"run_command": "stop", "trip_reset": "reset"}, 0, {"alarm": "normal", "inverter_status": "stopped"}),
    (
        {"trip_reset": "no_reset", "overvoltage": 1},
        1,
        {"trip_count": 2, "trip_1_error": "overvoltage", "trip_2_error": 12},
    ),
    ({"trip_reset": "reset"}, 0, {"alarm": "normal"}),
    ({"trip_reset": "no_reset", "direction_command": "forward", "run_command": "run"}, 9, {"output_frequency": 30}),
    ({"A063": 31, "A064": 2}, 1, {"output_frequency": 29}),  # within the jump it stays below
    ({"network_frequency_setpoint": 33.0}, 2, {"output_frequency": 33}),  # at its end it does not
    ({"A067": 33, "A068": 0.5, "A063": 0}, 2, {"output_frequency": 32.5}),
    ({"A067": 0, "A204": 40, "A203": 40, "F202": 1.0, "second_set": 1}, 0.0125, {"output_frequency": 33}),
    ({"network_frequency_setpoint": 45.0}, 1, {"output_frequency": 40, "output_voltage": 100}),
    ({"A201": "f001_or_a020", "A220": 20}, 2, {"output_frequency": 32}),
    ({"second_set": 0}, 1, {"output_frequency": 42}),
]
MM4: list[Step] = [
    ({"STW": 0x047E, "HSW": 40.0}, 1, {"ZSW": 0xFA31, "HIW": 0}),  # the manual's examples, lines 381 to 385
    ({"STW": 0x047F}, 4, {"ZSW": 0xFA37, "HIW": 20.001220703125}),
    ({}, 6, {"ZSW": 0xFF37, "HIW": 39.9993896484375}),
    ({"STW": 0x047E}, 20, {"ZSW": 0xFA31, "HIW": 0}),
    ({"STW": 0x057E}, 1.5, {"HIW": 4.998779296875}),
    ({"STW": 0x067E}, 4, {"ZSW": 0xBF37, "r0052": 0xBF37}),
    ({"STW": 0x0C7F}, 10, {"ZSW": 0xBF37}),
    ({"short_circuit": 1}, 0, {"HIW": 0, "ZSW": 0xFA78}),
    ({"short_circuit": 0, "STW": 0x0CFF}, 0, {"ZSW": 0xFA70}),
    ({"STW": 0x0C7E}, 0, {"ZSW": 0xFA31}),
    ({"STW": 0x047D}, 0, {"ZSW": 0xFA60}),
    ({"STW": 0x047E, "silent_master": 1}, 5, {"ZSW": 0xFA31}),
    ({"uss_telegram_off_time_index_0": 500}, 0.4, {"ZSW": 0xFA31}),
    ({}, 0.2, {"ZSW": 0xFA78}),
]
MPU2S: list[Step] = [
    ({}, 1, {"generator_frequency": 0, "generator_state": "absent", "mains_state": "present", "battery_voltage": 24}),
    ({"run_engine": 1}, 3, {"generator_frequency": 30, "generator_voltage_l1_l2": 0}),
    ({}, 4, {"generator_frequency": 50.1, "generator_voltage_l1_l2": 400, "generator_state": "present"}),
    (
        {"slip": 0.5, "synchronise": 1, "breaker_enable": 1},
        9,
        {"generator_active_power": 0, "generator_frequency": 50.5},
    ),
    ({"slip": 0.1}, 2, {"generator_frequency": 50, "control_register_2": 0xF03C}),
    ({}, 8, {"generator_active_power": 150000, "generator_current_l1": 217}),
    ({"generator_power_setpoint_1": 50}, 2, {"generator_active_power": 110000}),
    ({"mains_frequency_wanted": 56}, 0.2, {"generator_frequency": 56, "present_fault_classes": 0}),
    ({}, 0.2, {"present_fault_classes": 0xC0, "generator_active_power": 0}),
    ({"run_engine": 0, "mains_frequency_wanted": 50}, 9, {"generator_frequency": 0, "generator_state": "absent"}),
    ({"control_register_1": 0x0C00}, 0, {"present_fault_classes": 0, "internal_faults_1": 0}),
    ({"battery": 12, "battery_undervoltage_delay": 2}, 3, {"present_fault_classes": 0x0C}),
]


@pytest.mark.parametrize(("name", "steps"), [("hitachi_l200", L200), ("siemens_mm4", MM4), ("woodward_mpu2s", MPU2S)])
@pytest.mark.parametrize("stride", [None, pytest.param(0.37, marks=pytest.mark.full(seconds=0.2))])
def test_shipped_behaviours(name: str, steps: list[Step], stride: float | None) -> None:
    """Each device holds what its steps say, no matter how often it is asked meanwhile."""
    device = running(name)
    for number, (written, seconds, held) in enumerate(steps):
        for point, value in written.items():
            device.values[point] = value  # type: ignore[assignment]  # as a test would write it
        for passed in _parts(seconds, stride):
            device.clock.advance(passed)
            device.advance()
        assert {point: device.values[point] for point in held} == held, number


def _parts(seconds: float, stride: float | None) -> Iterator[float]:
    """The seconds, in strides if there are any."""
    passed = 0.0
    while stride is not None and passed + stride < seconds:
        yield stride
        passed += stride
    yield seconds - passed


def test_a_day_passes_at_once() -> None:
    """Hours of standing time are one event, not millions of cycles."""
    drive = running("hitachi_l200")
    started = drive.values["power_on_time"]
    drive.clock.advance(24 * 3600)
    assert drive.values["power_on_time"] == started + 24  # type: ignore[operator]  # a number
    assert Fraction(drive.values["load"]) == 40
