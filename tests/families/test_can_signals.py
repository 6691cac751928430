"""Signals of messages: cantools, our frames and the commands say the same of the same bytes."""

from __future__ import annotations

import random

import cantools
import pytest
from fieldscribe.arithmetic.words import raw_of
from fieldscribe.cli import main
from fieldscribe.families.can import signals
from fieldscribe.families.can.dbc import export
from fieldscribe.model import Message
from support.described import made
from support.places import TESTS

pytestmark = pytest.mark.usefixtures("loads_once")

DEVICE = made("kitchen_can")
FOLDER = str(TESTS / "devices" / "kitchen_can")
CARRIERS = [message for message in DEVICE.messages if message.fields]
FRAMES = 300


def raws_of(message: Message, data: bytes) -> dict[str, float]:
    """The raw numbers of the signals that come in these bytes, by the names that a database gives them."""
    words = signals.words_of(message, data)
    came = {at for part, when in signals.parts(message) if signals.comes(message, when, words) for at in part}
    return {
        point.code or point.name: raw_of(point, [words[at] for at in point.addresses])
        for point in DEVICE.points
        if point.telegram == message.name and point.shape.wire_type != "f32" and came.issuperset(point.addresses)
    }


@pytest.mark.parametrize("message", CARRIERS, ids=lambda message: message.name)
def test_cantools_reads_the_same_raw_numbers(message: Message) -> None:
    database = cantools.database.load_string(export(DEVICE).decode("latin-1"), "dbc", strict=False)
    theirs = next(one for one in database.messages if one.name == message.name)  # type: ignore[union-attr]  # a DBC
    chance = random.Random(message.name)
    compared = 0
    for _ in range(FRAMES):
        data = chance.randbytes(message.length)
        if message.name == "sensors":
            data = bytes([chance.choice((1, 2, 3, 4, 5)) << 4 | data[0] & 15, chance.choice((5, 6, 7)) << 5, *data[2:]])
        try:
            found = theirs.decode(data, decode_choices=False, scaling=False)
        except cantools.database.DecodeError:
            continue
        ours = raws_of(message, data)
        assert {name: raw for name, raw in dict(found).items() if name != "oil_temperature"} == ours
        compared += 1
    assert compared > FRAMES // 4


@pytest.mark.parametrize("message", CARRIERS, ids=lambda message: message.name)
def test_what_is_put_in_comes_out(message: Message) -> None:
    for number, field in enumerate(message.fields):
        for raw in (1, (1 << field.width) - 1, 0x5A5A5A5A5A5A5A5A & (1 << field.width) - 1):
            words = signals.words_of(message, signals.data_of(message, {number: raw}))
            assert sum(words[field.word + at] << 16 * (field.words - 1 - at) for at in range(field.words)) == raw


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("decode 0CF00405#F17D7D401F0000F0", ["engine_speed = 1000 rpm (raw 8000 = 1F40h)", "torque = 0 %"]),
        ("decode 0CF00405#FFFFFFFFFFFFFFFF", ["engine_speed = no_speed", "backlash = -1", "level"]),
        ("decode 125#3FFF00000000", ["pressure = -0.1 bar"]),
        ("decode 125#40DFFFFFFFFF", ["part_width = 137438953471"]),
        ("decode 125#40A00FFF0000", ["part_length = 15 mm"]),
        ("decode 125#60A00FFF0000", ["page = 6"]),
        ("decode 125#3FFF", ["every message has 6 bytes, here are 2"]),
        ("encode --frame SPN190 8", ["engine_speed is read only"]),
        ("encode --frame speed_setpoint 50", ["18EA1100#204E00"]),
        ("encode --frame trim_setpoint -1", ["18EA1100#0000FC"]),
        ("explain part_length", ["13 bits from bit 12 on, high byte first of the message sensors", "every 1000 ms"]),
        ("explain run_command", ["Bits", "bit 0 of the message limits", "message limits"]),
    ],
)
def test_the_commands_know_signals(arguments: str, said: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    command, *others = arguments.split()
    options = [each for each in others if each.startswith("--")]
    main([command, *options, FOLDER, "--", *(each for each in others if each not in options)])
    captured = capsys.readouterr()
    for text in said:
        assert text in captured.out + captured.err, captured.out + captured.err
    if command == "decode" and "60A0" in arguments:
        assert "part" not in captured.out
