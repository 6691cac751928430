"""`write_at`: a point is read at one address and written at another, in all that speaks of addresses."""

from __future__ import annotations

import re

import pytest
from fieldscribe.conversation.decoder import decode
from fieldscribe.conversation.explanation import explain_point, write_text
from fieldscribe.conversation.lookup import find
from fieldscribe.export import export_model
from fieldscribe.families.frame_results import Options
from fieldscribe.families.modbus.frame_builder import write_requests
from fieldscribe.families.modbus.frames import crc16
from fieldscribe.resources import render
from fieldscribe.targets import c, docs, rust
from support.described import kitchen_sink
from support.models import named

DEVICE = kitchen_sink()


@pytest.mark.parametrize(
    ("item", "read", "written"),
    [
        ("wanted_speed", (0x6000, 0x6001), (0x6100, 0x6101)),
        ("wanted_torque", (0x6003, 0x6002), (0x6103, 0x6102)),  # `words: {f32: low first}` under bus
        ("wanted_name", tuple(range(0x6010, 0x600B, -1)), tuple(range(0x6110, 0x610B, -1))),
        ("wanted_gain_set_2", (0x6211,), (0x6311,)),
        ("wanted_gain_set_3", (0x6411,), (0x6411,)),  # `write_at: ~`
        ("wanted_voltage_small", (0x6012,), (0x6112,)),
        ("wanted_voltage_large", (0x6012,), (0x6113,)),
        ("channel_1_limit", (0x6500,), (0x6508,)),  # base + 8
        ("channel_2_limit", (0x6510,), (0x651C,)),  # the member says base + 12
        ("channel_2_label", (0x6511, 0x6512, 0x6513), (0x6519, 0x651A, 0x651B)),
        ("ramp_point_index_3", (0x1B02,), (0x1B12,)),  # by the rule of the group
        ("speed", (0x100,), (0x100,)),
    ],
)
def test_addresses(item: str, read: tuple[int, ...], written: tuple[int, ...]) -> None:
    point = named(DEVICE, item)
    assert (point.addresses, point.written.addresses) == (read, written)
    assert (point.write_place is None) == (read == written)


def test_each_place_has_its_numbers() -> None:
    point = named(DEVICE, "wanted_speed")
    assert (point.references, point.written.references) == ({"modicon": 24577}, {"modicon": 24833})


@pytest.mark.parametrize(
    ("what", "how"),
    [
        ("wire:6000h", "wire address 6000h (24576), holding"),
        ("wire:6100h", "wire address 6100h (24832), holding, to write"),
        ("modicon:24577", "modicon 24577"),
        ("modicon:24833", "modicon 24833, to write"),
    ],
)
def test_either_address_finds_it(what: str, how: str) -> None:
    [match] = find(DEVICE, what)
    assert (match.point.name, match.reading) == ("wanted_speed", how)


def test_it_is_explained() -> None:
    rows = dict(explain_point(DEVICE, named(DEVICE, "wanted_speed")).rows)
    assert rows["Written at"] == "6100h (24832) high, 6101h (24833) low, modicon 24833"
    assert "01 03 60 00 00 02" in rows["Read"]
    assert "01 10 61 00 00 02" in write_text(DEVICE, named(DEVICE, "wanted_speed"))
    assert "Written at" not in dict(explain_point(DEVICE, named(DEVICE, "speed")).rows)


def test_requests_write_there() -> None:
    assert (
        write_requests(DEVICE, named(DEVICE, "wanted_speed"), 2050, 1, "rtu")[0][1]
        .hex(" ")
        .startswith("01 10 61 00 00")
    )
    assert (
        write_requests(DEVICE, named(DEVICE, "wanted_light"), 1, 1, "rtu")[0][1]
        .hex(" ")
        .startswith("01 05 00 5a ff 00")
    )


@pytest.mark.parametrize(
    ("frame", "said", "finding"),
    [
        ("01 10 61 00 00 02 04 00 00 08 02", "wanted_speed = 20.5 rpm (raw 2050 = 00000802h): Wanted speed", ""),
        ("01 03 60 00 00 02", "wanted_speed: Wanted speed", ""),
        ("01 03 61 00 00 02", "wanted_speed: Wanted speed; it is read at 6000h (24576)", "it is read at 6000h (24576)"),
        (
            "01 10 60 00 00 02 04 00 00 08 02",
            "wanted_speed: Wanted speed; it is written at 6100h (24832)",
            "it is written at 6100h (24832)",
        ),
    ],
)
def test_frames_are_heard_at_the_right_address(frame: str, said: str, finding: str) -> None:
    data = bytes.fromhex(frame)
    [heard] = decode(DEVICE, {}, [(data + crc16(data).to_bytes(2, "little")).hex()], Options())
    [item] = heard.items
    assert (item.text, item.findings) == (said, (finding,) if finding else ())


def test_the_export_has_both_places() -> None:
    places = {point["name"]: point["places"] for point in export_model(DEVICE)["points"]}
    assert places["wanted_speed"] == [
        {"for": "read", "space": "holding", "address": 0x6000, "function": None},
        {"for": "write", "space": "holding", "address": 0x6100, "function": None},
    ]
    assert [place["for"] for place in places["speed"]] == ["read"]


def test_targets_say_it() -> None:
    header = dict(c.outputs(DEVICE, render))["c/kitchen_sink.h"]
    crate = "".join(dict(rust.outputs(DEVICE, render)).values())
    page = dict(docs.outputs(DEVICE, render))["docs/kitchen_sink.md"]
    assert re.search(r"#define KITCHEN_SINK_WANTED_SPEED_WRITE_ADDRESS +0x6100U", header)
    assert re.search(r"#define KITCHEN_SINK_WANTED_SECRET_WRITE_ADDRESS +0x6114U", header)
    assert "write_at 0x6100;" in crate
    assert "written at 6114h (24852)" in crate
    assert "written at 6100h (24832) high, 6101h (24833) low, modicon 24833" in page
