"""The description of the JUMO controller agrees with the second reading of its manual, fact by fact."""

from __future__ import annotations

import re
import struct
from typing import TYPE_CHECKING, Any

from second_reading import Row, Seen, assert_answered, assert_same, device, drafts, each_row, rows

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fieldscribe.model import Flag, Frame, Point

NAME = "jumo_controller"

_CONTRADICTION = "bit number and mask contradict each other: no flag is bound"
SETTLED: dict[tuple[str, str], str] = {
    ("register at 493", "title"): "the heading says 6, eight are listed (erratum binary_inputs_count)",
    ("register at 502", "title"): "no title is printed; the reader made one in brackets",
    ("register at 363", "title"): "no title is printed; the description has the address",
    ("register at 217", "title"): "no title is printed; the description has the address",
    ("register 0x3100 at 332", "access"): "setpoints are written in the text on broadcast (erratum setpoint_access)",
    ("register 0x3102 at 332", "access"): "setpoints are written in the text on broadcast (erratum setpoint_access)",
    ("register at 411", "access"): "a parameter; there is no write-only access in the manual (erratum pb1_access)",
    **{(f"bit at {line}", "flag"): f"{_CONTRADICTION} (erratum controller_status_bits)" for line in (480, 481)},
    **{(f"bit at {line}", "flag"): f"{_CONTRADICTION} (erratum binary_signals_bits)" for line in range(526, 532)},
    ("frame at 376", "meaning"): "each frame carries one half of the value, and its point takes both",
    ("error 8", "name"): "the same in other words",
}
"""What the two readings saw differently, by row and fact, and why the description stays."""

NO_POINT = {191: "only the example of an address that does not exist"}
"""Registers that the reader noted and that are none, by line."""

ANSWERS: dict[int, tuple[str, ...] | str] = {
    1: ("limit_comparators_address",),
    2: ("missing_sections",),
    3: ("addresses_not_listed",),
    4: ("timer_commands_end",),
    5: ("value_00ce_meaning",),
    6: ("value_0077_meaning",),
    7: ("setpoint_2_address", "setpoint_access"),
    8: ("pb1_access",),
    9: "no point: the address is the example of one that does not exist",
    10: ("section_and_timer_units",),
    11: ("addresses_not_listed",),
    12: ("timers_of_binary_signals",),
    13: ("controller_status_bits",),
    14: ("controller_status_bits",),
    15: ("controller_status_bits",),
    16: ("binary_input_8_bit",),
    17: ("binary_input_7_bit",),
    18: ("binary_inputs_order",),
    19: ("binary_inputs_count",),
    20: ("binary_signals_bits",),
    21: ("binary_signals_bits",),
    22: ("binary_signals_bits",),
    23: ("binary_signals_bits",),
    24: ("binary_signals_bits",),
    25: ("binary_signals_bits",),
    26: ("binary_signals_bits",),
    27: ("binary_output_control_constant",),
    28: ("binary_output_control_rows",),
    29: ("controller_commands_mask",),
    30: ("timer_commands_mask",),
    31: ("operation_commands_mask",),
    32: ("binary_outputs_mask_6",),
    33: ("switching_states",),
    34: ("binary_outputs_mask_6", "command_titles"),
    35: "no contradiction: two words show the control contacts, in the same bits",
    36: "no contradiction: a page break inside a table",
    37: "no contradiction: how commands behave is not said; they are flags of a word that is read and written",
    38: "no contradiction: the remark stands in the rows of the hold functions, and in their titles",
    39: ("long_sign",),
    40: ("float_exponent",),
    41: "the reader found the orders of words to agree; the test of the bus computes both examples",
    42: "no contradiction: how a PC stores a number is no fact of the device",
    43: ("protocol_integer",),
    44: "no contradiction: wording",
    45: ("unit_addresses",),
    46: ("default_settings",),
    47: ("write_registers_max",),
    48: ("character_bits",),
    49: ("character_bits",),
    50: "no contradiction: the codes are taken from the table of settings, the other table has none",
    51: ("character_time",),
    52: "no contradiction: the pauses are taken as printed",
    53: "no contradiction: the time of processing and the least time of an answer are two times",
    54: ("time_t2",),
    55: ("minimum_response_delay_place",),
    56: "no contradiction: three codes are printed, and three are taken",
    57: ("bits_read",),
    58: ("read_unknown_address_crc", "read_unknown_address_reply_crc"),
    59: ("crc_byte_order",),
    60: "no contradiction: notation",
    61: ("crc_scheme",),
    62: "no contradiction: the manual does not speak of it",
    63: "no contradiction: the broadcast is taken, and units begin at 1",
    64: "no contradiction: sentences that the layout split",
    65: "no contradiction: codes and texts are paired in their order",
    66: "no contradiction: the settings of the plast series say so",
    67: "no contradiction: wiring, which the description does not have",
    68: "no contradiction: wiring, which the description does not have",
    69: ("examples_keeps",),
    70: "no contradiction: the number is printed four times alike",
    71: ("setup_path",),
    72: "no contradiction: the note of the examples says it",
    73: ("character_time",),
    74: "no contradiction: empty pages",
}
"""The errata for each finding of the second reader, or why it needs none."""


def key(row: Row) -> str:
    """What tells a row from the others."""
    if row["kind"] == "bus":
        return f"{row['what']} at {row['line']}" if WHATS.count(row["what"]) > 1 else str(row["what"])
    if row["kind"] == "register" and row["line"] == 332:
        return f"register {row['address_hex']} at 332"
    return f"{row['kind']} at {row['line']}"


WHATS = [row["what"] for row in rows(NAME) if row["kind"] == "bus"]


@each_row(NAME, key)
def test_the_description_says_what_the_second_reading_says(row: Row) -> None:
    found = list(FACTS[row["kind"]](row))
    assert found or row["line"] in NO_POINT, "the description has nothing of it"
    assert_same(found, key(row), SETTLED)


def test_what_is_settled_was_read() -> None:
    keys = [key(row) for row in rows(NAME)]
    assert len(set(keys)) == len(keys)
    assert {of for of, _ in SETTLED} | set(BUS) <= set(keys)


def test_every_finding_is_answered() -> None:
    assert_answered(NAME, ANSWERS)


def test_every_point_was_read_twice() -> None:
    registers = {row["address"] for row in rows(NAME) if row["kind"] == "register"}
    assert [point.name for point in device(NAME).points if point.address not in registers] == []


def test_every_flag_was_read_twice() -> None:
    read = {(row["word"], row["one"]) for row in rows(NAME) if row["kind"] == "bit" and row["bit"] is not None}
    unread = [
        (point.name, flag.name)
        for point in device(NAME).points
        for flag in point.flags
        if (word_of(point), text_of(flag)) not in read and flag.title["de"] not in OUTPUTS_2_TO_9
    ]
    assert unread == []


def test_every_frame_was_read_twice() -> None:
    read = [whole(row) for row in rows(NAME) if row["kind"] == "frame"]
    assert [frame.printed for frame in device(NAME).frames] == read


# Registers and their bits

TYPES = {"int": "u16", "long": "u32", "f32": "f32"}
"""What the manual calls a type; of neither integer it says whether it has a sign (erratum long_sign)."""
OUTPUTS_2_TO_9 = [f"Ausgang {number}" for number in range(2, 10)]
"""The outputs whose rows are dots."""
NOT_PRINTED = "(not printed; likely 0x0024)"


def of_register(row: Row) -> Iterator[Seen]:
    first, last = (row["lines"] if "lines" in row else [row["line"]] * 2)[:2]
    for point in device(NAME).points:
        if row["line"] in NO_POINT or point.address != row["address"]:
            continue
        assert point.source.line is not None
        yield {
            "address": (word_of(point), row["address_hex"] or NOT_PRINTED),
            "words": (point.words, row["words"]),
            "type": (point.type, TYPES[row["type"]]),
            "word order": (order_of(point), row["word_order"]),
            "access": (point.access, row["access"]),
            "title": (point.title["de"], row["name_de"]),
            "unit": (point.unit.symbol, "s" if row["meaning"].endswith(", s") else ""),
            "line": (first <= point.source.line <= last, True),
            "generated": (point.generated, row["address"] is not None),
        }


def word_of(point: Point) -> str:
    return NOT_PRINTED if point.address is None else f"0x{point.address:04X}"


def order_of(point: Point) -> str | None:
    if point.words == 1:
        return None
    return "high first" if point.addresses[0] < point.addresses[1] else "low first"


def of_bit(row: Row) -> Iterator[Seen]:
    (point,) = [point for point in device(NAME).points if word_of(point) == row["word"]]
    if row["bit"] is None:  # the dots between outputs 1 and 10
        yield {"dots": ([flag.title["de"] for flag in point.flags if 1 <= flag.low <= 8], OUTPUTS_2_TO_9)}
        return
    mask = int(row["mask_printed"].removeprefix("0x"), 16)
    always = point.fixed.bits if point.fixed else 0
    flags = {flag.low: flag for flag in point.flags if 1 << flag.low | always == mask}
    if not flags:
        yield {"flag": (None, row["one"])}
    for low, flag in flags.items():
        told = flags_as_written(point)[low].get("printed", {})
        yield {
            "flag": (text_of(flag), row["one"]),
            "zero": (next((value.title["de"] for value in flag.values if value.raw == 0), None), row["zero"]),
            "printed": ((told.get("bit"), int(str(told.get("mask")), 0)), (row["bit"], mask)),
            "bit": (low, row["mask_bit"] if always == 0 else row["bit"]),
            "erratum": (misprinted(flag.name), row["agree"] is False and always == 0),
        }


def text_of(flag: Flag) -> str:
    """The title, and what 1 means behind it; what the manual says besides the reader left out."""
    one = next((value.title["de"] for value in flag.values if value.raw == 1), "")
    return f"{flag.title['de']} {one}".strip()


def flags_as_written(point: Point) -> dict[int, Any]:
    return {int(str(bit)): written for bit, written in drafts(NAME)[point.item].get("flags").items()}


def misprinted(flag: str) -> bool:
    """Whether an erratum gives the flag another bit than is printed."""
    return any(one.id == f"{flag}_bit" for one in device(NAME).errata)


# Frames


def whole(row: Row) -> bytes:
    """The bytes with their checksum, which two frames leave out."""
    return bytes.fromhex(row["bytes"] + ("" if row["crc_right"] else row["crc_computed"]))


def of_frame(row: Row) -> Iterator[Seen]:
    first, last = (row["lines"] if "lines" in row else [row["line"]] * 2)[:2]
    decoded = {
        name: value for name, value in row.get("decoded", {}).items() if "high" not in name and "s32" not in name
    }
    for frame in device(NAME).frames:
        if (frame.printed, frame.direction) == (whole(row), row["direction"]):
            assert frame.source.line is not None
            left_out = any(one.endswith("_crc") for one in frame.errata)
            yield {
                "crc": (frame.corrected[-2:].hex(" ").upper(), row["crc_computed"]),
                "valid": (frame.valid, True),
                "left out": (left_out, row["crc_right"] is None),
                "line": (first <= frame.source.line <= last, True),
                "meaning": (values_of(frame), list(decoded.values())),
            }


def values_of(frame: Frame) -> list[float]:
    return [struct.unpack(">f", raw.to_bytes(4, "big"))[0] for raw in frame.meaning.values()]


# The bus


def of_bus(row: Row) -> Iterator[Seen]:
    what, value = row["what"], str(row["value"])
    bus = device(NAME).bus
    if found := re.fullmatch(r"(Prot|bdrt|dFt) code (\d)", what):
        setting = {"Prot": "protocol", "bdrt": "baud", "dFt": "format"}[found[1]]
        yield {"setting": (plain(bus.serial[setting][found[2]]), plain(value))}
    elif what.startswith("error ") and what[6:].isdigit():
        yield {"name": ({one.number: one.name.replace("_", " ") for one in bus.exceptions}[int(what[6:])], value)}
    elif what == "character format and bit count":
        form, _, bits = value.partition(": ")
        yield {"bits": (bits_of(form), int(bits))}
    elif isinstance(answer := BUS[key(row)], str):
        yield {}
    else:
        ours, theirs = answer(value)
        yield {what: (ours, theirs)}


def plain(text: str) -> str:
    """A setting without its small words."""
    text = text.casefold().replace("-master", " master").replace(", plast series only", " (plast only)")
    return re.sub(" (bits?|baud)\\b", "", text)


def bits_of(form: str) -> int:
    """How many bits besides the start bit the format of a character has that the description knows."""
    found = re.match(r"(\d) bit, (no|even|odd)\b.*, (\d) stop", form)
    assert found is not None
    data, parity, stop = found.groups()
    known = [plain(one) for one in device(NAME).bus.serial["format"].values()]
    assert any(re.fullmatch(f"{data} data, {stop} stops?, {parity} parity", one) for one in known), known
    return int(data) + int(stop) + (parity != "no")


def sent(kind: str, pattern: bytes) -> str:
    """A value of four bytes, the high one first, in the order of bytes that points of this type have on the line."""
    point = next(point for point in device(NAME).points if point.type == kind)
    halves = dict(zip(point.addresses, (pattern[:2], pattern[2:]), strict=True))
    return b"".join(halves[address] for address in sorted(halves)).hex(" ").upper()


def in_note(text: str) -> tuple[bool, bool]:
    """A fact in words."""
    return text in device(NAME).bus.note["en"], True


def in_note_of_examples(text: str) -> tuple[bool, bool]:
    (note,) = [group.note["en"] for group in device(NAME).groups if group.name == "examples"]
    return text in note, True


def most(*functions: int) -> set[int | None]:
    return {code.most for code in device(NAME).bus.functions if code.number in functions}


def types(words: int) -> set[str]:
    return {point.type for point in device(NAME).points if point.words == words}


_WIRING = "wiring, which the description does not have"
BUS: dict[str, Callable[[str], tuple[object, object]] | str] = {
    "float format": lambda _: (sent("f32", struct.pack(">f", 1.0)), "00 00 3F 80"),
    "float word order": lambda text: ({order_of(one) for one in points_of("f32")}, {text[-14:].replace(" word", "")}),
    "float example 3000": lambda text: (sent("f32", struct.pack(">f", 3000.0)), modbus_of(text)),
    "long example 66051": lambda text: (sent("u32", struct.pack(">I", 66051)), modbus_of(text)),
    "type char, byte": "no row has it",
    "type int": lambda _: (types(1), {"u16"}),
    "type long": lambda _: (types(2), {"u32", "f32"}),
    "type float": lambda _: (types(2), {"u32", "f32"}),
    "function 0x03 or 0x04": lambda _: (titles(3, 4), ["Lesen von n Worten"] * 2),
    "function 0x06": lambda _: (titles(6), ["Schreiben eines Worts"]),
    "function 0x10": lambda _: (titles(16), ["Schreiben von n Worten"]),
    "read, max words": lambda text: (most(3, 4), {int(text)}),
    "write, max words": lambda text: (most(16), {int(text.split()[0])}),
    "unit address range": lambda text: (device(NAME).bus.units, (1, int(text.split(",")[0].split()[2]))),
    "unit address setting Adr": lambda _: (printed_of("unit_addresses").endswith("up to 255."), True),
    "broadcast": lambda text: (device(NAME).bus.broadcast, int(text.partition(",")[0].split()[1])),
    "slaves per line": lambda text: in_note(f"At most {text} devices"),
    "number of error codes": lambda text: (len(device(NAME).bus.exceptions), int(text)),
    "error response": lambda _: (frame_named("read_unknown_address_reply").printed[1:3], bytes([0x03 | 0x80, 2])),
    "no answer when at 194": lambda _: in_note("Silence: a wrong checksum"),
    "no answer when at 195": lambda _: in_note("an instruction that is incomplete or too long"),
    "no answer when at 200": lambda _: in_note("zero words asked for"),
    "max gap between characters": lambda text: (device(NAME).bus.timing["silent_characters"], text.split()[0]),
    "t0 end of frame": lambda text: (device(NAME).bus.timing["silent_characters"], text.split()[0]),
    "t1 max processing time": lambda text: (text in device(NAME).bus.timing["response_time"], True),
    "min response time, setting": lambda text: (
        device(NAME).bus.timing["minimum_response_delay"].partition(",")[0],
        text.partition(";")[0].replace("…", ".."),
    ),
    "min response time, use": "why a master needs the time, no fact of the device",
    "t2": lambda _: ("its length is not printed" in device(NAME).bus.timing["after_response"], True),
    "query during processing": lambda text: in_note(f"the first is {text}"),
    "query during answer": lambda _: in_note("the second spoils what is on the bus"),
    "character time": lambda _: (bool(printed_of("character_time")), True),
    "terminator": _WIRING,
    "terminator check": _WIRING,
    "current loop": _WIRING,
    "setup interface": lambda _: in_note("inactive while the setup interface is used"),
    "setpoint writes": lambda _: in_note_of_examples(
        "does not hold setpoints that come over the bus against their limits"
    ),
    "EEPROM warning": lambda _: in_note_of_examples("bears about 10000 writes"),
    "EEPROM switch-off path": lambda _: in_note_of_examples("bit parameter 2 in the setup program"),
    "CRC": lambda _: ({frame.valid for frame in device(NAME).frames}, {True}),
    "transmission": lambda text: (device(NAME).bus.framings, (text.partition(",")[0].casefold(),)),
    "frame structure": lambda _: (device(NAME).bus.framings, ("rtu",)),
    "plast series": lambda _: (sum("plast" in one for one in settings()), 3),
}
"""What the description says of each fact of the bus, or why it has none; codes and formats are looked up above."""


def modbus_of(text: str) -> str:
    """The bytes behind `MODBUS` in the reader's words."""
    return text.partition("MODBUS ")[2].partition(";")[0]


def points_of(kind: str) -> list[Point]:
    return [point for point in device(NAME).points if point.type == kind]


def titles(*functions: int) -> list[str]:
    return [code.title["de"] for code in device(NAME).bus.functions if code.number in functions]


def printed_of(erratum: str) -> str:
    return next(one.printed for one in device(NAME).errata if one.id == erratum)


def frame_named(name: str) -> Frame:
    return next(frame for frame in device(NAME).frames if frame.name == name)


def settings() -> list[str]:
    return [text for setting in device(NAME).bus.serial.values() for text in setting.values()]


FACTS = {"register": of_register, "bit": of_bit, "frame": of_frame, "bus": of_bus}
"""How the facts of a row are looked up, by its kind."""
