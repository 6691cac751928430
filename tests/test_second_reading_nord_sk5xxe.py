"""The description of the NORD SK 5xxE agrees with the second reading of its manual, fact by fact."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from second_reading import Row, Seen, assert_answered, assert_same, device, drafts, each_row, rows

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fieldscribe.model import Flag, Frame, Point

NAME = "nord_sk5xxe"

_READ_TOO = "any parameter can be read with 03h, and P050 is called one (erratum process_data_access)"
_RAW = "not printed; the raw word is taken, without a sign (erratum setpoint_scale or actual_value_scale)"
_BEFORE = "the description cites the table of addresses, the reader where the number of the parameter stands"
SETTLED: dict[tuple[str, str], str] = {
    **{(f"register {address}", "access"): _READ_TOO for address in range(3200, 3206)},
    **{(f"register {address}", "type"): _RAW for address in (*range(3201, 3206), *range(3265, 3270))},
    ("register 3200", "title"): "with the abbreviation that stands at line 368",
    ("register 3264", "title"): "with the abbreviation that stands at line 418",
    ("control word bit 12", "zero"): "the footnote says what 0 is: clockwise",
    ("control word bit 13", "zero"): "printed for 0 and 1 alike: the title of the flag says it",
    ("control word bit 13", "one"): "printed for 0 and 1 alike: the title of the flag says it",
    ("status word bit 10", "one"): "the manual has starten behind it, the reader left it out",
    ("status word bit 13", "one"): "the manual has starten behind it, the reader left it out",
    ("P050", "line"): _BEFORE,
    ("P051", "line"): _BEFORE,
}
"""What the two readings saw differently, by row and fact, and why the description stays."""

ANSWERS: dict[int, tuple[str, ...] | str] = {
    1: ("p607_index_2_decimal",),
    2: ("p543_set_2_binary",),
    3: ("p543_set_4_binary",),
    4: ("p543_example_6_set",),
    5: ("table_1_references",),
    6: ("process_data_index_base",),
    7: ("process_data_index_base",),
    8: ("case_4_heading",),
    9: ("table_1_incoming",),
    10: "no contradiction: the printed addresses are those of the frames",
    11: "no contradiction: the six bits of the array index hold all indices that are named",
    12: ("p543_indices",),
    13: "leading zeros change no number; the compiler holds the printed binary numbers against the addresses",
    14: ("single_elements", "further_elements"),
    15: ("coil_addresses",),
    16: ("read_process_data_reply_crc",),
    17: ("crc_byte_order",),
    18: "no contradiction: two states of one word, neither is said to be the other",
    19: ("example_2_twice",),
    20: ("setpoint_scale",),
    21: ("p103_title",),
    22: ("state_after_047f",),
    23: ("setpoint_scale",),
    24: ("setpoint_scale", "actual_value_scale"),
    25: ("parameter_types",),
    26: ("parameter_types",),
    27: ("control_word_write",),
    28: ("units", "p512_default"),
    29: ("baud_115000",),
    30: "no contradiction: a point between thousands",
    31: "no contradiction: one code of P509 is printed, none of P511; the enum of P509 is open",
    32: "no contradiction: one setting is printed, and it is taken",
    33: ("terminating_resistor",),
    34: ("terminating_resistor",),
    35: "no contradiction: the cells of a table out of their order; P502 and P513 are points without a meaning",
    36: ("exceptions", "function_counts"),
    37: "lost pictures: nothing was taken from them",
    38: ("control_word_set_01",),
    39: ("control_word_acknowledge_row",),
    40: "no contradiction: an empty text stays empty",
    41: ("control_word_direction",),
    42: ("control_word_function_480",),
    43: ("status_word_other_types",),
    44: ("status_word_function_481",),
    45: ("status_word_direction",),
    46: ("status_word_bus_control",),
    47: "no contradiction: both flags are named by what 1 means or marked as active at 0",
    48: "no contradiction: the sentence is hard to read, and nothing else speaks of it",
    49: "no contradiction: a reserved bit, and a bit whose 0 has a meaning; the note says that it must be 1",
    50: "misprints of words that were not taken",
    51: ("process_data_access",),
}
"""The errata for each finding of the second reader, or why it needs none."""


def key(row: Row) -> str:
    """What tells a row from the others."""
    keys: dict[str, Callable[[], str]] = {
        "register": lambda: f"register {row['address']}",
        "bit": lambda: f"{row['word']} bit {row['bit']}",
        "parameter": lambda: f"P{row['number']:03}",
        "address_example": lambda: str(row["name"]),
        "frame": lambda: str(row["name"]),
        "bus": lambda: f"{row['what']} at {row['line']}",
    }
    return keys[row["kind"]]()


@each_row(NAME, key)
def test_the_description_says_what_the_second_reading_says(row: Row) -> None:
    found = list(FACTS[row["kind"]](row))
    assert found, "the description has nothing of it"
    assert_same(found, key(row), SETTLED)


def test_what_is_settled_was_read() -> None:
    keys = [key(row) for row in rows(NAME)]
    assert len(set(keys)) == len(keys)
    assert {of for of, _ in SETTLED} <= set(keys)
    assert set(BUS) <= {row["what"] for row in rows(NAME) if row["kind"] == "bus"}


def test_every_finding_is_answered() -> None:
    assert_answered(NAME, ANSWERS)


def test_every_point_was_read_twice() -> None:
    registers = {row["address"] for row in rows(NAME) if row["kind"] == "register"}
    numbers = {row["number"] for row in rows(NAME) if row["kind"] == "parameter"}
    assert [point.name for point in device(NAME).points if point.generated and point.address not in registers] == []
    assert [point.name for point in device(NAME).points if number_of(point) not in numbers] == []


def test_every_flag_was_read_twice() -> None:
    read = {(row["address"], row["bit"]) for row in rows(NAME) if row["kind"] == "bit"}
    bits = {(point.address, bit) for point in device(NAME).points for flag in point.flags for bit in bits_of(flag)}
    assert bits == read


def test_every_frame_was_read_twice() -> None:
    read = [bytes.fromhex(row["bytes"]) for row in rows(NAME) if row["kind"] == "frame"]
    assert [frame.printed for frame in device(NAME).frames] == read


# Registers and their bits


def at(address: int) -> Point:
    """The point that holds the word."""
    return next(point for point in device(NAME).points if point.address == address)


def named(name: str) -> Point:
    return next(point for point in device(NAME).points if point.name == name)


def of_register(row: Row) -> Iterator[Seen]:
    point = at(row["address"])
    beside = [one.code for one in device(NAME).points if one.source.line == row["line"]]
    chosen = re.findall(r"P54[36]\[\d]", row["name_de"])
    yield {
        "address": (point.addresses, (int(row["address_hex"], 16),)),
        "words": (point.words, row["words"]),
        "type": (point.type, row["type"]),
        "access": (point.access, row["access"]),
        "title": (point.title["de"], row["name_de"].partition(" (")[0]),
        "line": (point.source.line, row["line"]),
        "reference": ([code for code in beside if code is not None and re.match("P74[01]", code)], [row["reference"]]),
        "chosen by": ([code for code in chosen if code in point.note["en"]], chosen),
        "generated": (point.generated, True),
    }


def bits_of(flag: Flag) -> range:
    return range(flag.low, flag.low + flag.width)


def of_bit(row: Row) -> Iterator[Seen]:
    for flag in at(row["address"]).flags:
        if row["bit"] not in bits_of(flag):
            continue
        seen: Seen = {
            "mask": (f"0x{1 << row['bit']:04X}", row["mask_computed"]),
            "word": (at(row["address"]).title["en"].casefold(), row["word"]),
        }
        values = {value.raw: value.title["de"] for value in flag.values}
        if flag.width == 1:
            texts = {name: (values.get(raw), row[name]) for raw, name in ((0, "zero"), (1, "one"))}
            yield seen | {name: (short(ours), short(theirs)) for name, (ours, theirs) in texts.items()}
        else:
            sets = re.findall(r"([01]{2})'? = set (\d)", row["doubt"])
            pairs = {int(digits, 2): f"{flag.title['de']} {one}" for digits, one in sets}
            yield seen | {
                "values": ({raw: values[raw] for raw in pairs}, pairs),
                "one": (f"{flag.title['de']} Bit {row['bit'] - flag.low}", row["one"].rpartition(" ")[0]),
            }


def short(text: str | None) -> str | None:
    """What is printed, without what stands in brackets, the reader's own words, and what holds for other types."""
    return text and text.removeprefix("SK 5xxE: ").partition(" (")[0]


# Parameters and their addresses


def number_of(point: Point) -> int:
    """The number in the code: 543 of P543, 50 of P050[1]."""
    found = re.match(r"P(\d+)", str(point.code))
    assert found is not None
    return int(found[1])


def element_of(point: Point) -> int:
    """The index, which may stand in the code only."""
    found = re.search(r"\[(\d+)]", str(point.code))
    return int(found[1]) if found else point.index or 1


def array_index(case: str, chosen: int, index: int) -> int:
    """The four cases at lines 253 to 279."""
    return {"1": 0, "2": chosen - 1, "3": index - 1, "4": (index - 1) * 4 + chosen - 1}[case]


def of_parameter(row: Row) -> Iterator[Seen]:
    points = [point for point in device(NAME).points if number_of(point) == row["number"]]
    lines = [point.source.line for point in points]
    for point in points:
        chosen, index = point.set or 1, element_of(point)
        if row["case"] in ("1", "2", "3", "4"):
            address = (row["number"] << 6) + array_index(row["case"], chosen, index)
        else:  # the manual does not say which case: only the first element lies at the same place in all of them
            address = row["base_address"] if (chosen, index) == (1, 1) else None
        yield {
            "address": (point.address, address),
            "sets": (max(one.set or 0 for one in points) or None, row["sets"]),
            "default": (point.default, 0 if "factory setting 0" in row["meaning"] else None),
            "enum": (entries(point), {int(raw): text.replace(" ", "") for raw, text in row.get("values", {}).items()}),
            "line": (bool({*lines} & {row["line"], *row.get("lines", ())}), True),
            "generated": (point.generated, row["number"] in (50, 51)),
        }


def entries(point: Point) -> dict[int, str]:
    return {one.raw: one.title["de"].replace(" ", "") for one in point.enum.entries} if point.enum else {}


def of_address_example(row: Row) -> Iterator[Seen]:
    chosen, index = row["set"] or 1, row["index"] or 1
    for point in device(NAME).points:
        if (number_of(point), point.set or 1, element_of(point)) == (row["number"], chosen, index):
            wire = drafts(NAME)[point.item].get("printed")["wire"]
            shown = {int(row["printed"]["hex"], 16), row["printed"]["dec"], int(binary(row), 2)}
            wrong = [one for one in ("hex", "dec", "binary") if row["agrees"][one] is False]
            yield {
                "address": (point.address, row["computed"]["dec"]),
                "array index": (point.address and point.address & 63, row["array_index"]),
                "line": (point.source.line, 115 if row["number"] == 50 else row["line"]),
                "printed": ({int(str(one), 0) for one in wire}, shown),
                "misprints": (len([one for one in point.errata if re.search("binary|decimal", one)]), len(wrong)),
            }


def binary(row: Row) -> str:
    """The whole binary number, or that of the parameter where only this one is printed and no index adds to it."""
    of_number = str(row["printed"]["shifted_binary"])
    return str(row["printed"]["binary"] or (of_number if row["array_index"] == 0 else f"{row['printed']['dec']:b}"))


# Frames


def of_frame(row: Row) -> Iterator[Seen]:
    found = [frame for frame in device(NAME).frames if frame.printed == bytes.fromhex(row["bytes"])]
    for frame in found:
        decoded = {int(address): value for address, value in row.get("decoded", {}).items()}
        assert frame.source.line is not None
        yield {
            "direction": (frame.direction, row["direction"]),
            "valid": (frame.valid, row["crc_right"]),
            "crc": (frame.corrected[-2:].hex(" ").upper(), row["crc_computed"]),
            "line": (row["lines"][0] <= frame.source.line <= row["lines"][1], True),
            "meaning": (raw_numbers(frame), {at: int(str(value), 0) for at, value in decoded.items()}),
        }


def raw_numbers(frame: Frame) -> dict[int | None, int]:
    return {named(name).address: raw for name, raw in frame.meaning.items()}


# The bus


def of_bus(row: Row) -> Iterator[Seen]:
    what = row["what"]
    if what.startswith("function "):
        code = next(one for one in device(NAME).bus.functions if one.number == int(what[9:11], 16))
        yield {"title": (code.title["de"], row["value"].partition(":")[0])}
    elif what.startswith("X14 pin") and what not in BUS:
        wire = row["value"].removeprefix("RS485 ").partition(",")[0].replace("GND", "ground")
        yield {"pin": (f"{what[4:]} is {wire}" in device(NAME).bus.note["en"], True)}
    elif isinstance(answer := BUS[what], str):
        yield {}
    else:
        ours, theirs = answer(row)
        yield {what: (ours, theirs)}


def serial(setting: str) -> str:
    (said,) = device(NAME).bus.serial[setting].values()
    return said.partition(",")[0]


def in_note(text: str) -> tuple[bool, bool]:
    """A fact in words."""
    return text in device(NAME).bus.note["en"], True


def case(which: str, *names: str) -> tuple[object, object]:
    """The addresses of the parameters that are printed as examples of a case."""
    points = [point for point in device(NAME).points if point.name.startswith(names)]
    wanted = [number_of(point) * 64 + array_index(which, point.set or 1, element_of(point)) for point in points]
    return [point.address for point in points], wanted


def table_of_case_4(row: Row) -> tuple[object, object]:
    cells = {
        (int(which[7:9]), place): int(cell, 16)
        for which, cells in row["value"].items()
        if which.startswith("array")
        for place, cell in enumerate(cells, 1)
    }
    points = [point for point in device(NAME).points if point.code == "P543" and (point.index or 0) <= 3]
    return {(point.index, point.set): point.address and point.address - (543 << 6) for point in points}, cells


_OTHER_LINE = "not of the RS485 line, or wiring that the bus does not show"
BUS: dict[str, Callable[[Row], tuple[object, object]] | str] = {
    "address rule": lambda _: (
        {one.name for one in device(NAME).points if one.address and one.address >> 6 != number_of(one)},
        set(),
    ),
    "address case 1": lambda _: case("1", "p601"),
    "address case 2": lambda _: case("2", "acceleration_time"),
    "address case 3": lambda _: case("3", "p607"),
    "address case 4": lambda _: case("4", "actual_value_source"),
    "array index table (case 4)": table_of_case_4,
    "frame structure": lambda _: (device(NAME).bus.framings, ("rtu",)),
    "unit address": lambda row: (f"the USS address, {named('uss_address').code}", row["value"]),
    "unit address, reserved": lambda _: in_note("P512 at a unit address other than 0 and 2"),
    "P512 factory setting": lambda row: (named("uss_address").default, row["value"]),
    "P509 required setting": lambda row: (
        entries(named("control_word_source")),
        {int(row["value"][1]): row["value"][4:].replace(" ", "")},
    ),
    "P511 baud rate factory setting": lambda row: (str(row["value"]) in named("uss_baud_rate").note["en"], True),
    "baud rates": lambda row: (serial("baud"), row["value"]),
    "data bits": lambda row: (serial("data_bits"), str(row["value"])),
    "parity": lambda row: (serial("parity"), row["value"].partition(" ")[0]),
    "stop bits": lambda row: (serial("stop_bits"), str(row["value"])),
    "connection": lambda _: in_note("terminal X14"),
    "bus pair to use": lambda _: in_note("The bus is RS485"),
    "X14 pin 4": _OTHER_LINE,
    "X14 pin 5": _OTHER_LINE,
    "X14 pin 6": _OTHER_LINE,
    "X14 supply": _OTHER_LINE,
    "terminator fixed": _OTHER_LINE,
    "terminator switch USS": _OTHER_LINE,
    "terminator switch CAN": _OTHER_LINE,
    "control word value 1151": lambda row: (command("switch_on"), (3200, 1151, int(row["value"][:6], 16))),
    "control word value": lambda row: (
        command("make_ready_to_switch_on" if "ready" in row["value"] else "switch_on"),
        (3200, int(row["value"][:6], 16), int(row["value"][:6], 16)),
    ),
    "first command": lambda _: (command("make_ready_to_switch_on"), (3200, 0x047E, 0x047E)),
    "read example": lambda row: (row["value"].split()[3] in named("status_word").note["en"], True),
    "setpoint scale example": lambda row: (
        (row["value"].split()[0] in named("setpoint_1").note["en"], named("setpoint_1").scale),
        (True, None),
    ),
    "read count": lambda _: (
        [named(name).address for name in ("status_word", "actual_value_1", "actual_value_2", "actual_value_3")],
        [3264 + place for place in range(4)],
    ),
    "write start": lambda row: (str(named("control_word").address), row["value"].split()[0]),
    "direction rule": lambda _: (
        [value.title["de"] for flag in named("control_word").flags if flag.low == 12 for value in flag.values],
        ["Drehrichtung rechts ein", "Drehrichtung links ein"],
    ),
    "further document": "another manual",
    "NOT PRINTED: exception codes": lambda _: (device(NAME).bus.exceptions, ()),
    "NOT PRINTED: maximum words per request": lambda _: ({one.most for one in device(NAME).bus.functions}, {None}),
    "NOT PRINTED: broadcast": lambda row: (device(NAME).bus.broadcast, row["value"]),
    "NOT PRINTED: timing (end of frame, response time)": lambda _: (device(NAME).bus.timing, {}),
    "NOT PRINTED: persistence RAM/EEPROM of writes": lambda _: ({one.keeps for one in device(NAME).points}, {None}),
    "NOT PRINTED: coil addresses of bus IN/OUT bits": lambda _: (
        {one.space for one in device(NAME).points},
        {"holding"},
    ),
    "NOT PRINTED: word order of 32-bit parameters": lambda _: (
        {one.words for one in device(NAME).points if one.generated},
        {1},
    ),
    "NOT PRINTED: P511 codes": lambda row: (named("uss_baud_rate").enum, row["value"]),
    "NOT PRINTED: unit address range": lambda _: ("units" in {one.id for one in device(NAME).errata}, True),
}
"""What the description says of each fact of the bus, or why it has none; functions and pins are looked up above."""


def command(name: str) -> tuple[int, int | None, int | None]:
    """Where and what a command writes; and again, as the manual prints it in two notations."""
    one = next(one for one in device(NAME).commands if one.name == name)
    return one.address, one.value, one.value


FACTS = {
    "register": of_register,
    "bit": of_bit,
    "parameter": of_parameter,
    "address_example": of_address_example,
    "frame": of_frame,
    "bus": of_bus,
}
"""How the facts of a row are looked up, by its kind."""
