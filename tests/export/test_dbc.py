"""The CAN database: cantools and our own frames, in both directions, say the same numbers."""

from __future__ import annotations

import random
import re
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from typing import Any

import cantools
import pytest
from cantools.database.can import Database
from fieldscribe.arithmetic import codec
from fieldscribe.arithmetic.words import raw_of
from fieldscribe.cli import main
from fieldscribe.export import ExportError, export_form
from fieldscribe.families.can import of_bus
from fieldscribe.families.can.dbc import export
from fieldscribe.families.can.dbc_signals import decimal, point_signals
from fieldscribe.families.can.frames import CanFrame, Receiver, build, identifier, parse
from fieldscribe.model import Device, Entry, Enum, Message, Point, Role, Special, Unit
from fieldscribe.text import dbc_string
from fieldscribe.wording.numbers import fixed_rule
from support.described import made, shipped
from support.models import named, point, sample_device, titles

DEVICE = shipped("woodward_mpu2s")
TELEGRAM = DEVICE.telegrams[0]
CYCLIC = next(one for one in DEVICE.messages if one.name == TELEGRAM.message)
SLOTS = -(-TELEGRAM.words // CYCLIC.words)
POINTS = tuple(one for one in DEVICE.points if one.telegram == TELEGRAM.name)
PARAMETERS = ("read_request", "write_request", "read_answer", "write_answer")
UNIT = 1


def exported(device: Device, unit: int | None = None) -> str:
    """The text of the database."""
    return export(device, unit).decode("latin-1")


@lru_cache
def database(unit: int = UNIT) -> Database:
    """The database as cantools reads it, strictly."""
    return loaded(exported(DEVICE, unit))


def loaded(text: str) -> Database:
    """What cantools reads, strictly."""
    found = cantools.database.load_string(text, "dbc", strict=True)
    assert isinstance(found, cantools.database.can.Database)
    return found


def decoded(frame: CanFrame, unit: int = UNIT, *, scaling: bool = False) -> dict[str, Any]:
    """What cantools says of a frame."""
    message = database(unit).get_message_by_frame_id(frame.id)
    return dict(message.decode(frame.data, decode_choices=False, scaling=scaling))  # type: ignore[arg-type]  # it takes bytes


def slot_frame(slot: int, words: list[int]) -> CanFrame:
    """A frame of the telegram."""
    data = bytes((0xDD, slot)) + b"".join(word.to_bytes(2, "big") for word in words)
    return CanFrame(identifier(CYCLIC, UNIT), data)


def named_parts(one: Point) -> list[tuple[str, int]]:
    """The signals of a point, with their words: one, or a high and a low one where the words are in two frames."""
    slots = {address // CYCLIC.words for address in one.addresses}
    if len(slots) == 1:
        unsettled = "" if one.generated or one.reserved else "_raw"
        return [(one.name + unsettled, one.addresses[0] // CYCLIC.words)]
    return [(f"{one.name}_{half}", at // CYCLIC.words) for half, at in zip(("high", "low"), one.addresses, strict=True)]


def test_the_head_of_a_database() -> None:
    """In the order of the format: version, symbols, bit timing, nodes, and then the messages."""
    before, messages = exported(DEVICE, UNIT).split("\nBO_ ", 1)
    lines = before.splitlines()
    assert lines[:3] == [f'VERSION "{DEVICE.id} {DEVICE.version}"', "", "NS_ :"]
    assert lines[-4:] == ["", "BS_:", "", f"BU_: master unit_{UNIT}"]
    assert all(line.startswith("\t") for line in lines[3:-4])
    assert "BU_:" not in messages


def test_a_signal_is_written_as_the_format_has_it() -> None:
    """Multiplexed ones say by which number; nothing is said where there is nothing to say."""
    text = exported(DEVICE, UNIT) + exported(made("kitchen_can"), 1)
    signals = [line for line in text.splitlines() if line.startswith(" SG_ ")]
    form = r" SG_ \w+( M| m\d+M?)? : \d+\|\d+@[01][+-] \(\S+,\S+\) \[\S+\|\S+\] \"[^\"]*\" \w+"
    assert [line for line in signals if not re.fullmatch(form, line)] == []
    assert len(signals) > 100
    assert not [line for line in text.splitlines() if line.startswith("CM_") and line.endswith('"";')]


@pytest.mark.parametrize(("last", "listed"), [(0x101F, True), (0x1020, False)], ids=["32 codes", "33 codes"])
def test_a_long_band_of_special_codes_is_only_in_the_comment(last: int, listed: bool) -> None:
    band = Special(0x1000, last, "fault", titles("Fault"), True)
    ((signal, _, _),) = point_signals(sample_device(), point("speed", 1, specials=(band,)), CYCLIC)
    assert signal.values == (tuple((raw, "fault") for raw in range(0x1000, last + 1)) if listed else ())
    assert ("No quantity" in signal.comment) is not listed


def test_every_word_is_a_signal() -> None:
    names = {name for one in POINTS for name, _ in named_parts(one)}
    message = database().get_message_by_frame_id(0x321)
    assert names <= {signal.name for signal in message.signals}
    assert len(POINTS) >= TELEGRAM.words - 2
    assert {len(signal.multiplexer_ids or ()) for signal in message.signals if signal.name != "message"} == {1}


@pytest.mark.parametrize("seed", range(8))
def test_cantools_reads_what_we_read(seed: int) -> None:
    chance = random.Random(seed)
    words = [chance.choice((chance.getrandbits(16), 0, 0xFFFF, 0x8000, 0x7FFF)) for _ in range(SLOTS * CYCLIC.words)]
    frames = [slot_frame(slot, words[slot * 3 : slot * 3 + 3]) for slot in range(SLOTS)]
    receiver = Receiver(TELEGRAM, CYCLIC, UNIT)
    assert all(receiver.take(frame) for frame in [*frames, *frames])
    plain = [decoded(frame) for frame in frames]
    scaled = [decoded(frame, scaling=True) for frame in frames]
    for one in POINTS:
        status, found = receiver.words(one.addresses)
        assert status == "ok"
        raw, parts = raw_of(one, found), named_parts(one)
        theirs = [plain[slot][name] for name, slot in parts]
        assert (theirs[0] if len(theirs) == 1 else theirs[0] << 16 | theirs[1]) == raw, one.name
        if one.generated and fixed_rule(one) is not None and len(parts) == 1:
            value = codec.decode(one, raw, {})
            assert scaled[parts[0][1]][one.name] == pytest.approx(float(value), rel=1e-12), one.name


@pytest.mark.parametrize("seed", range(8))
def test_we_read_what_cantools_writes(seed: int) -> None:
    chance = random.Random(seed)
    message = database().get_message_by_frame_id(0x321)
    receiver = Receiver(TELEGRAM, CYCLIC, UNIT)
    raws: dict[str, int] = {}
    for slot in [*range(SLOTS), *range(SLOTS)]:
        signals = [signal for signal in message.signals if signal.multiplexer_signal == "visualisation_multiplexer"]
        here = [signal for signal in signals if slot in (signal.multiplexer_ids or ())]
        for signal in here:
            low = -(1 << signal.length - 1) if signal.is_signed else 0
            raws.setdefault(signal.name, chance.randrange(low, low + (1 << signal.length)))
        chosen = {signal.name: raws[signal.name] for signal in here}
        data = message.encode(
            {"message": 0xDD, "visualisation_multiplexer": slot, **chosen}, scaling=False, strict=False
        )
        assert receiver.take(CanFrame(0x321, data))
    for one in POINTS:
        parts = [raws[name] for name, _ in named_parts(one)]
        raw = raw_of(one, receiver.words(one.addresses)[1])
        assert raw == (parts[0] if len(parts) == 1 else parts[0] << 16 | parts[1]), one.name


@pytest.mark.parametrize("name", PARAMETERS)
@pytest.mark.parametrize("unit", [0, 1, 30])
def test_parameter_messages(name: str, unit: int) -> None:
    """All ids up to the last of the device and some beyond, with any word."""
    chance = random.Random(unit)
    message = next(one for one in DEVICE.messages if one.name == name)
    carries = any(role.kind == "raw" for role in message.roles)
    theirs = database(unit).get_message_by_frame_id(identifier(message, unit))
    last = max(at for one in DEVICE.points if one.space == "parameter" for at in one.addresses)
    for address in (*range(last + 2), 0x7FFF, 0xFFFF):
        raw = chance.getrandbits(16) if carries else 0
        status, frame = build(message, DEVICE.bus.units, unit, address, raw)
        assert status == "ok"
        found = decoded(frame, unit)
        checksum = int.from_bytes(frame.data[6:], "big")
        expected = {
            "message": frame.data[0],
            f"{name}_unit": unit,
            f"{name}_parameter": address,
            f"{name}_checksum": checksum,
        }
        expected |= {f"{name}_value": raw} if carries else {f"{name}_byte_4": 0, f"{name}_byte_5": 0}
        assert found == expected
        again = CanFrame(frame.id, theirs.encode(found, scaling=False))
        assert again == frame
        parsed = parse(message, unit, again)
        assert (parsed.status, parsed.address, parsed.raw) == ("ok", address, raw)


def test_parameters_are_named() -> None:
    status, frame = build(DEVICE.messages[3], DEVICE.bus.units, UNIT, 739, 0)
    assert status == "ok"
    named_ones = database().get_message_by_frame_id(0x321).decode(frame.data)
    assert isinstance(named_ones, dict)
    assert str(named_ones["read_answer_parameter"]) == "fault_text_terminal_62 1"
    assert str(named_ones["message"]) == "read_answer"


def test_what_a_database_cannot_say_is_in_comments() -> None:
    signals = {one.name: one for one in database().get_message_by_frame_id(0x321).signals}
    power = signals["generator_active_power"]
    assert (power.scale, power.offset, power.unit, power.is_signed) == (1, 0, None, True)
    assert "Raw: the value is raw x 10^generator_power_exponent.raw W" in (power.comment or "")
    assert "bits 7..6 fault_class_3: 0 Inactive, 3 Active" in (signals["present_fault_classes"].comment or "")
    assert "cannot put them together" in (signals["operating_hours_high"].comment or "")
    assert "does not settle its scale" in (signals["generator_reactive_power_raw"].comment or "")
    assert "byte 6 is bytes 0, 2, 4 combined" in (signals["read_answer_checksum"].comment or "")
    assert signals["generator_frequency"].unit == "Hz"
    assert dict(signals["mains_state"].choices or {}) == {0: "absent", 255: "present"}
    specifics = database().dbc
    assert specifics is not None
    assert specifics.attributes["Baudrate"].value == 125000


def hostile() -> Device:
    """A CAN device with texts that want to end strings, and names that are too long."""
    text = 'a "quoted"; \\ CM_ "x";\n\u202eπ°\\'
    enum = Enum("states", (Entry(0, "off", titles(text), None), Entry(1, "on", titles(text), None)), False)
    facts: dict[str, Any] = {"space": "telegram", "telegram": "cycle", "access": "r", "title": titles(text)}
    long = "a_name_that_is_much_longer_than_thirty_two_characters"
    points = (
        point(f"{long}_1", 0, unit=Unit('"\n°C', "celsius", "temperature"), **facts),
        point(f"{long}_2", 1, "s16", enum=enum, **facts),
        point("wide", 2, "s32", **facts),
        point("swapped", 4, "u32", order=(5, 4), **facts),
        point("group", 6, "s8", bits=(9, 5), **facts),
        point("message", 7, **facts),
    )
    words = tuple(Role("word", number) for number in range(6))
    cyclic = replace(
        CYCLIC, name="cycle", title=titles(text), roles=(Role("constant", 1), Role("multiplexer", 0), *words)
    )
    telegram = replace(TELEGRAM, name="cycle", message="cycle", words=9)
    return replace(
        sample_device(points), family="can", bus=DEVICE.bus, messages=(cyclic,), telegrams=(telegram,), frames=()
    )


def test_hostile_texts_stay_strings() -> None:
    device = hostile()
    text = exported(device, 0)
    text.encode("latin-1")
    found = loaded(text)
    message = found.get_message_by_frame_id(0x320)
    assert message.name == "cycle"
    names = {signal.name for signal in message.signals}
    assert {
        *("swapped_high", "swapped_low", "wide_high", "wide_low", "group", "message", "cycle_word_8"),
        device.points[0].name,
    } <= names
    assert all("\n" not in line for line in text.split("\n"))
    data = bytes((1, 0)) + bytes.fromhex("0102 FFFE 8000")
    plain = message.decode(data, scaling=False, decode_choices=False)
    assert isinstance(plain, dict)
    assert plain[device.points[1].name] == -2
    assert plain["wide_high"] == 0x8000
    group = message.decode(bytes((1, 2)) + bytes.fromhex("03E0 0000 0000"), scaling=False, decode_choices=False)
    assert isinstance(group, dict)
    assert group["group"] == -1


@pytest.mark.parametrize(
    ("text", "string"), [('say "x"', "\"say 'x'\""), ("a\\", '"a/"'), ("a\nb\u202e", '"a b"'), ("°C π", '"°C ?"')]
)
def test_strings(text: str, string: str) -> None:
    assert dbc_string(text) == string


@pytest.mark.parametrize(
    ("number", "text"), [("1/100", "0.01"), ("-3", "-3"), ("1/3", "0.3333333333333333"), ("0", "0")]
)
def test_decimals(number: str, text: str) -> None:
    assert decimal(Fraction(number)) == text


def test_little_endian_layouts() -> None:
    words = (Role("word", 1), Role("word", 0), Role("word", 3), Role("word", 2), Role("word", 5), Role("word", 4))
    cyclic = replace(CYCLIC, roles=(*CYCLIC.roles[:2], *words))
    device = replace(DEVICE, messages=(cyclic,))
    message = loaded(exported(device)).get_message_by_frame_id(0x321)
    data = bytes((0xDD, 0, 1, 0, 0x88, 0x13, 0, 0))
    found = message.decode(data)
    assert isinstance(found, dict)
    assert found["generator_frequency"] == 50
    receiver = Receiver(TELEGRAM, cyclic, 1)
    assert receiver.take(CanFrame(0x321, data))
    assert receiver.words((1,)) == ("ok", (5000,))


def test_a_point_may_have_the_name_of_what_selects() -> None:
    twin = replace(named(DEVICE, "reserved_word_49"), name="message")
    points = tuple(twin if one.name == "reserved_word_49" else one for one in DEVICE.points)
    message = loaded(exported(replace(DEVICE, points=points))).get_message_by_frame_id(0x321)
    found = message.decode(slot_frame(16, [7, 0, 0]).data, decode_choices=False)
    assert isinstance(found, dict)
    assert (found["message"], found["message_2"]) == (0xDD, 7)


def _scattered() -> Device:
    roles = (*CYCLIC.roles[:2], *(Role("word", number) for number in (0, 2, 1, 3, 4, 5)))
    return replace(DEVICE, messages=(replace(CYCLIC, roles=roles),))


def _alike() -> Device:
    return replace(DEVICE, messages=(CYCLIC, replace(CYCLIC, name="other")))


def _overlapping() -> Device:
    twin = replace(named(DEVICE, "generator_frequency"), name="twin")
    return replace(DEVICE, points=(*DEVICE.points, twin))


@pytest.mark.parametrize(
    ("device", "unit", "why"),
    [
        (sample_device(), None, "sample_drive is a modbus device"),
        (shipped("siemens_mm4"), None, "siemens_mm4 is a uss device"),
        (DEVICE, 31, "units are 0 to 30"),
        (DEVICE, -1, "units are 0 to 30"),
        (_scattered(), None, "not neighbours"),
        (_alike(), None, "no byte tells the messages visualisation, other apart"),
        (_overlapping(), None, "twin and generator_frequency share bits"),
    ],
)
def test_refusals(device: Device, unit: int | None, why: str) -> None:
    with pytest.raises(ExportError, match=why):
        export_form("dbc", device, unit)


def test_extended_identifiers() -> None:
    device = replace(DEVICE, bus=replace(DEVICE.bus, family_facts=replace(of_bus(DEVICE.bus), identifier_bits=29)))
    message = loaded(exported(device)).get_message_by_frame_id(0x321, force_extended_id=True)
    assert message.is_extended_frame


def test_a_message_alone_needs_no_selector() -> None:
    alone: Message = replace(next(one for one in DEVICE.messages if one.name == "read_request"))
    found = loaded(exported(replace(DEVICE, messages=(alone,), telegrams=()))).messages[0]
    assert found.name == "read_request"
    assert not found.is_multiplexed()
    assert found.signals[0].name == "read_request_byte_0"


@pytest.mark.full(seconds=0.7)
def test_the_command(capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    assert main(["export", "dbc", "woodward_mpu2s", "--unit", "3", "--variant", "voltage=400V"]) == 0
    out = capfdbinary.readouterr().out
    assert out.decode("latin-1") == exported(DEVICE, 3)
    assert loaded(out.decode("latin-1")).get_message_by_frame_id(0x323)
    all_of_it = b"is not for the form json\n  hint: leave it out: the model has all variants, and belongs to no unit"
    for words, message in (
        (["dbc", "hitachi_l200"], b""),
        (["dbc", "woodward_mpu2s", "--unit", "99"], b""),
        (["json", "woodward_mpu2s", "--unit", "1"], b"--unit " + all_of_it),
        (["json", "woodward_mpu2s", "--variant", "voltage=400V"], b"--variant " + all_of_it),
    ):
        assert main(["export", *words]) == 2
        told = capfdbinary.readouterr()
        assert told.out == b""
        assert told.err.startswith(b"fieldscribe: " + message)
