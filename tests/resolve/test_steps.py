"""Commands with steps: the words of each request, computed by hand."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import pytest
from fieldscribe.conversation.decoder import decode
from fieldscribe.conversation.explanation import explain_other_items
from fieldscribe.export import export_model
from fieldscribe.families.frame_results import Options
from fieldscribe.families.modbus.frames import crc16
from fieldscribe.model import Device, SteppedCommand
from support.described import compile_in, described, group, head, kitchen_sink, loaded_in, together


def _command(device: Device, name: str) -> SteppedCommand:
    return next(command for command in device.stepped_commands if command.name == name)


class Request(NamedTuple):
    """What a step reads and writes with, where, the words, and the bits of each."""

    read: int | None
    write: int | None
    address: int
    words: tuple[int, ...]
    masks: tuple[int, ...] = (0xFFFF,)


BY_HAND: list[tuple[str, dict[str, int], list[Request]]] = [
    ("start_engine", {}, [Request(None, 0x10, 0x7420, (35701, 29834), (0xFFFF, 0xFFFF))]),
    (
        "close_breaker",
        {"unit": 3, "delay": -5},
        [
            Request(None, 0x10, 0x7420, (3, 2, 65532), (0xFFFF,) * 3),
            Request(None, 6, 0x7424, (65525,)),
            Request(3, None, 0x7402, (0,)),
        ],
    ),
    (
        "ask",
        {"item": 15, "from": 2},
        [
            Request(None, 0x10, 0x7400, (1, 0), (0xFFFF, 0xFFFF)),
            Request(3, 6, 0x7403, (0x0304,), (0x030E,)),  # 3 in bits 9..8, 2 in bits 3..1
            Request(3, 6, 0x7403, (0x0004,), (0x000E,)),
            Request(3, None, 0x7403, (0x8004,), (0x800E,)),
            Request(None, 0x0F, 0x7420, (1, 0, 1), (0xFFFF,) * 3),
        ],
    ),
    (
        "set_power",
        {},
        [
            Request(None, 0x10, 0x7404, (0xFFF1, 0xFFFF), (0xFFFF, 0xFFFF)),  # -15, the low word first
            Request(None, 0x10, 0x7406, (0xCCCD, 0x3DCC), (0xFFFF, 0xFFFF)),  # 3DCCCCCDh, the low word first
        ],
    ),
]


@pytest.mark.parametrize(("name", "arguments", "requests"), BY_HAND, ids=[name for name, _, _ in BY_HAND])
def test_words_are_those_by_hand(name: str, arguments: dict[str, int], requests: list[Request]) -> None:
    """Values of points, formulas of arguments, bits of words."""
    command = _command(kitchen_sink(), name)
    for step, request in zip(command.steps, requests, strict=True):
        words = tuple(word.of(arguments) for word in step.words)
        assert (step.read, step.write, step.address, words) == request[:4]
        assert tuple(word.mask for word in step.words) == request.masks


def test_constant_bits_are_written_with_bits(tmp_path: Path) -> None:
    """A word whose other bits are always one has them; a step that waits looks at its bits alone."""
    points = "- {name: mode, at: 1, bits: 3..0, fixed: {15: 1, 14: 0}}\n- {name: whole, at: 2, fixed: {0: 1}}\n"
    commands = "[{name: go, steps: [{write: {mode: 5}}, {wait: {mode: 5}, within: 3 min}, {write: {whole: 9}}]}]"
    device, findings = compile_in(tmp_path, described(points, commands=commands))
    assert device is not None, findings
    first, second, third = _command(device, "go").steps
    assert [(step.words[0].constant, step.words[0].mask) for step in (first, second, third)] == [
        (0x8005, 0xC00F), (5, 0x000F), (9, 0xFFFF),
    ]  # fmt: skip
    assert (second.within, third.read) == (180_000, None)


def test_low_bytes_come_first_where_the_point_says_so(tmp_path: Path) -> None:
    """Of numbers of a word, of several, and of bits with the constant bits beside them."""
    points = "- {name: one, at: 1, bytes: low first}\n- {name: two, at: 2, type: u32, bytes: low first}\n"
    points += "- {name: bits, at: 4, bits: 3..0, fixed: {15: 1}, bytes: low first}\n"
    steps = "[{write: {one: 1234h}}, {write: {two: 12345678h}}, {write: {bits: 5}}, {wait: {bits: 5}, within: 1 s}]"
    device, findings = compile_in(tmp_path, described(points, commands=f"[{{name: go, steps: {steps}}}]"))
    assert device is not None, findings
    words = [[(word.constant, word.mask) for word in step.words] for step in _command(device, "go").steps]
    assert words == [
        [(0x3412, 0xFFFF)], [(0x3412, 0xFFFF), (0x7856, 0xFFFF)], [(0x0580, 0x0F80)], [(0x0500, 0x0F00)],
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("what", "readings"),
    [
        ("4104", ["go wire address 1008h (4104), holding: step 1", "stop wire address 1008h (4104), holding: step 2"]),
        ("4105", ["go modicon 4105: step 1; wire address 1009h (4105), holding: step 1", "stop modicon 4105: step 2"]),
        ("modicon:4106", ["go modicon 4106: step 1"]),
        ("404105", ["go reference 404105: step 1", "stop reference 404105: step 2"]),
        ("name:4104", []),
        ("1", []),  # a point has it
        ("5", ["stop wire address 0005h (5), holding: step 3"]),  # a point has it from its base
    ],
)
def test_an_address_that_only_steps_write_leads_to_their_command(
    tmp_path: Path, what: str, readings: list[str]
) -> None:
    steps = "{write: {one: 5}}, {at: 4104, words: [7]}, {at: 5, words: [8]}"
    commands = f"[{{name: go, steps: [{{at: 4104, words: [1, 2]}}]}}, {{name: stop, steps: [{steps}]}}]"
    groups = group("- {name: one, at: 1}\n"), group("- {name: two, at: 5}\n", group="based", base="slot * 10")
    device = loaded_in(tmp_path, together(head(commands=commands, given="{slot: {range: 1..2}}"), *groups))
    found = explain_other_items(device, what)
    assert [f"{one.heading.split()[1][:-1]} {reading}" for [reading], one in found] == readings


def test_export_and_explanation_have_each_step() -> None:
    """The exported model has the words, the explanation a row and the frames of each request."""
    exported = next(one for one in export_model(kitchen_sink())["stepped_commands"] if one["name"] == "ask")
    assert exported["arguments"] == {"item": [0, 15], "from": [1, 3]}
    assert exported["steps"][1]["words"] == [{"constant": 768, "factor": 2, "argument": "from", "mask": 0x030E}]
    assert len(exported["steps"][0]["when"]["any"]) == 2
    [(_, explanation)] = explain_other_items(kitchen_sink(), "ask")
    rows = [(label, text) for label, text in explanation.rows if label in ("Run", "Step 2", "Frame 2")]
    written = (
        "mailbox_low.raw = from, mailbox_high = 3: write 768 + 2 * from in the bits 030Eh to holding 29699 (7403h)"
    )
    assert rows == [
        ("Run", "by caller, item 0..15, from 1..3"),
        ("Step 2", f"{written} with function 06h, read with function 03h before"),
        ("Frame 2", "01 03 74 03 00 01 6F FA"),
        ("Frame 2", "01 06 74 03 03 02 E3 0B"),
    ]


@pytest.mark.parametrize(
    ("frame", "text"),
    [
        ("01 10 74 20 00 03 06 00 03 00 02 FF FC", "command close_breaker, step 1: Close breaker; unit = 3"),
        ("01 10 74 20 00 03 06 00 03 00 02 FF FD", "no point is described here"),
        ("01 10 74 20 00 03 06 00 21 00 02 FF DE", "no point is described here"),
        ("01 06 74 24 FF F5", "command close_breaker, step 2: Close breaker; delay = -5"),
        ("01 06 74 24 FF F4", "no point is described here"),
        ("01 06 74 00 00 01", "mailbox_code"),
        ("01 0F 74 20 00 03 01 05", "command ask, step 5: Ask"),
    ],
)
def test_decoding_names_the_step(frame: str, text: str) -> None:
    """A request that no point explains is a step of a command, with the arguments that give its words."""
    data = bytes.fromhex(frame)
    whole = data + crc16(data).to_bytes(2, "little")
    result = decode(kitchen_sink(), {}, [whole.hex(" ")], Options(framing="rtu"))[0]
    assert text in " ".join(str(item) for item in result.items)
