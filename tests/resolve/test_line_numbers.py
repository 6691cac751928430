"""Times and settings of the line that programs compute with."""

from __future__ import annotations

import pytest
from support.described import made, shipped

CASES = {
    "hitachi_l200": {
        "timing_silent_characters_tenths": 35,
        "timing_response_delay_ms_max": 1000,
        "serial_parity_odd": 2,
    },
    "jumo_controller": {"timing_silent_characters": 3, "timing_response_time_ms_max": 250, "serial_baud_38400": 2},
    "nord_sk5xxe": {"serial_data_bits": 8, "serial_stop_bits": 1},
    "siemens_mm4": {"serial_baud_most": 57600, "serial_slaves_most": 31},
    "woodward_mpu2s": {"timing_pause_between_messages_ms": 100},
}


@pytest.mark.parametrize("device", CASES)
def test_numbers_of_the_line(device: str) -> None:
    assert CASES[device].items() <= shipped(device).bus.line_numbers.items()


def test_texts_and_lists_of_choices_are_no_numbers() -> None:
    assert list(made("kitchen_sink").bus.line_numbers) == [
        *("timing_silent_characters_tenths", "timing_response_ms_min", "timing_response_ms_max"),
        *("serial_baud_9600", "serial_baud_19200", "serial_data_bits"),
    ]
    assert list(shipped("siemens_mm4").bus.line_numbers) == list(CASES["siemens_mm4"])
