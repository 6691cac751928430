"""The description of the Siemens MICROMASTER 4 agrees with the second reading of its manual."""

from __future__ import annotations

import re
import struct
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import pytest
import yaml
from fieldscribe.families import uss
from second_reading import ROOT, Row, Seen, assert_same, device, each_row, rows

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.model import Code, Flag, Frame, Point

NAME = "siemens_mm4"

SETTLED: dict[tuple[str, str], str] = {
    ("parameter 1082", "unit"): "Fmax is a frequency (erratum maximum_frequency_unit)",
    ("parameter 2000", "unit"): "the frequency that 4000h stands for (erratum reference_frequency_unit)",
    ("parameter 2009", "default"): "line 459 means by default (errata by_failure, normalisation_default)",
    ("parameter 1820", "name"): "the reading names the parameter after its setting 1",
    ("parameter 2016", "name"): "the reading takes the sentence of line 489 for all four indices",
    ("parameter 2019", "name"): "the reading takes the sentence of line 489 for all four indices",
    ("STW(MM3) bit 3", "text"): "the table of STW has other names (erratum stw_bits_3_to_5_names)",
    ("STW(MM3) bit 4", "text"): "the table of STW has other names (erratum stw_bits_3_to_5_names)",
    ("STW(MM3) bit 12", "text"): "line 332 calls it not assigned, line 528 not used: the same",
    ("ZSW bit 3", "active"): "the polarity column is wrong, FA31h decides (erratum zsw_bit_3_polarity)",
    ("ZSW bit 5", "active"): "the polarity column is wrong, FA31h decides (erratum zsw_bit_5_polarity)",
    ("ZSW bit 9", "one"): "a slip of the pen (erratum zsw_bit_9_words)",
    ("task 5", "refusals"): "the response list names 7 and 8 for it (erratum task_5_refusal)",
    ("task 10", "refusals"): "the response list names 7 for it (erratum task_10_refusal)",
    ("task 15", "refusals"): "the response list names 7 and 8 for it (erratum task_15_refusal)",
    ("response 15", "tasks"): "task 15 is not possible and has no answer (erratum text_response)",
    ("PZD words, response", "words"): "the third and fourth are exchanged (errata hiw2_position, zsw2_position)",
    ("PWE2, single word", "place"): "with P2013 = 4 it holds the value itself (erratum pwe2_row_p2013_4)",
    ("write P1082 while running", "frames"): "the line names the request only, its words stand at line 265",
}
"""What the two readings saw differently, by row and fact, and why the description stays."""

FINDINGS: dict[int, tuple[str, ...] | str] = {
    1: ("pnu_page_weights",),
    2: "the table and the width of the bits do not exclude each other",
    3: "no contradiction: P3950 is the last number named",
    4: ("read_numbers_from_2",),
    5: ("hiw2_position", "zsw2_position"),
    6: ("answer_source_index_3",),
    7: ("interface_indices",),
    8: ("answer_source_interfaces", "command_source_numbers"),
    9: "a fact, not a contradiction: the lengths follow from the answer",
    10: ("second_control_word_display",),
    11: "said to be of MICROMASTER 3, no point",
    12: "consistent",
    13: ("source_type",),
    14: ("answer_source_type",),
    15: ("u32_pairs",),
    16: ("pwe2_row_p2013_4",),
    17: ("firmware_1_05_words",),
    18: ("error_value_place",),
    19: ("next_task_error_name",),
    20: ("error_answer_second_word",),
    21: ("parameter_kind_words",),
    22: "a page break in the text",
    23: "two words for the same",
    24: ("mantissa_notation",),
    25: ("pkw_length_0",),
    26: ("variable_length_four_words",),
    27: ("hsw_sign",),
    28: "silent: reading all elements is not generated",
    29: "no contradiction: line 247 allows both tasks",
    30: ("documented_only_types", "integer_parameters_type", "ramp_times_type"),
    31: "lines 150 and 207 leave 127 only",
    32: ("task_5_refusal", "task_10_refusal", "task_15_refusal"),
    33: ("task_5_refusal", "task_15_refusal"),
    34: ("text_response",),
    35: "both lists agree",
    36: "consistent",
    37: ("eeprom_tasks_ram",),
    38: ("error_list_heading",),
    39: "English words that were left over",
    40: ("wrong_index_or_no_array",),
    41: ("wrong_index_or_no_array", "wrong_index_task_1"),
    42: ("limit_errors_words",),
    43: ("error_102_tasks", "error_204_open"),
    44: "the note of the bus says that the list is open",
    45: ("error_5_name",),
    46: "no contradiction: request and answer are told apart by their direction",
    47: ("stw_bit_2_order",),
    48: "how the text was taken from the page",
    49: ("stw_bit_7_quote", "stw_bit_7_edge"),
    50: ("stw_bit_10_scope",),
    51: ("stw_bit_15_order",),
    52: "consistent",
    53: ("stw_changed_bits",),
    54: ("stw_bits_3_to_5_names", "loading_time"),
    55: "consistent",
    56: ("external_fault_polarity",),
    57: "no contradiction: four words bring HSW2 too",
    58: "consistent",
    59: ("zsw_bit_3_polarity",),
    60: ("zsw_bit_5_polarity",),
    61: ("zsw_bit_12_at_rest",),
    62: ("zsw_bit_8_at_rest",),
    63: "consistent",
    64: ("zsw_bit_6_spelling", "zsw_bit_9_words", "zsw_bit_11_words"),
    65: ("hsw_40_hertz",),
    66: ("hsw_number_words",),
    67: ("by_failure", "normalisation_default"),
    68: ("presets_section_name",),
    69: ("hsw_sign", "hsw_range", "hiw_scale_with_other_source"),
    70: ("pzd_four_or_eight", "pzd_length_range", "answer_source_count", "words_5_to_8"),
    71: ("two_word_pzd",),
    72: "consistent",
    73: ("off_time_words",),
    74: "consistent",
    75: ("bcc_seven_digits",),
    76: "a sample of the rule, no telegram",
    77: "consistent",
    78: "consistent",
    79: ("bcc_stx_sign",),
    80: "consistent",
    81: ("invalid_message_with_invalid_message",),
    82: ("slave_count",),
    83: ("byte_order",),
    84: ("baud_codes",),
    85: ("broadcast_unused_bit", "broadcast_mask_words_3_4"),
    86: ("broadcast_pkw_length",),
    87: ("broadcast_both_words",),
    88: "consistent",
    89: ("rs232_recognised", "firmware_1_05_words"),
    90: "consistent",
    91: "consistent",
}
"""What looked wrong to the second reader: the errata that say it, or why there is none."""

KINDS = {"task": "functions", "response": "responses", "error": "exceptions"}
WORDS = {"STW": "control_word", "STW(MM3)": "control_word", "ZSW": "status_word", "STW2": "second_control_word"}
LEVELS = {f"access_level_{level}": level for level in (2, 3)}
TYPES = {"float": "f32", None: None}
PLAIN = {None: "", "words": ""}
"""What a reader noted as a unit and is a plain number here."""
UNTYPED = {
    "integer_parameters_type",
    "single_word_sign",
    "status_word_parameter_type",
    "source_type",
    "answer_source_type",
}
"""The errata that say how a type was taken which the manual does not print."""


def key_of(row: Row) -> str:
    kind = row["kind"]
    if kind == "parameter":
        return f"parameter {row['number']}" + ("" if row["index"] is None else f"[{row['index']}]")
    if kind == "bit":
        return f"{row['word']} bit {row['bit']}"
    if kind == "scale":
        return f"scale {row['word']} {row['when']}"
    return f"{kind} {row['number']}" if kind in KINDS else str(row.get("what") or row["name"])


@each_row(NAME, key_of)
def test_the_description_says_what_the_second_reading_says(row: Row) -> None:
    found = list(FACTS[row["kind"]](row))
    assert found
    assert_same(found, key_of(row), SETTLED)


def test_every_point_was_read_twice() -> None:
    read = {(row["number"], row["index"]) for row in rows(NAME) if row["kind"] == "parameter"}
    words = {word for row in rows(NAME) if row["kind"] == "layout" for word in row.get("words", ())}
    missing = [
        point.item
        for point in device(NAME).points
        if point.code not in words and not {(point.address, None), (point.address, point.index)} & read
    ]
    assert missing == []


def test_every_frame_was_read_twice() -> None:
    read = {(row["line"], part) for row in rows(NAME) if row["kind"] == "example" for part in telegrams(row)}
    assert [one.name for one in device(NAME).frames if (one.source.line, one.printed) not in read] == []


@pytest.mark.parametrize("number", range(1, 92))
def test_every_finding_of_the_second_reader_is_answered(number: int) -> None:
    text = (ROOT / f"tests/readings/{NAME}_findings.md").read_text("utf-8")
    assert len(FINDINGS) == len(re.findall(r"(?m)^\d+\. ", text))
    answer = FINDINGS[number]
    if not isinstance(answer, str):
        assert set(answer) <= {erratum.id for erratum in device(NAME).errata}


# ---- Parameters ----


def parameter(row: Row) -> Iterator[Seen]:
    found = [one for one in device(NAME).points if one.space == "parameter" and one.address == row["number"]]
    points = [one for one in found if row["index"] in (None, one.index)]
    if "device" in row:  # of another device
        yield {"points": ([point.name for point in points], [])}
        return
    assert points
    yield {"indices": (indices(row, points), sorted(map(int, row.get("indices", ()))))}
    for point in points:
        yield facts(row, point)


def indices(row: Row, points: list[Point]) -> list[int]:
    return sorted({point.index for point in points if point.index is not None}) if "indices" in row else []


def facts(row: Row, point: Point) -> Seen:
    prefix = "r" if "access" in row or "as_source" in row else "P"
    seen: Seen = {
        "line": (point.source.line in {line for one in of_number(row) for line in one["lines"]}, True),
        "code": (point.code, f"{prefix}{row['number']:04}"),
        "level": ([LEVELS[one] for one in point.conditions if one in LEVELS], [row["level"]] if row["level"] else []),
        "unit": (point.unit.symbol, PLAIN.get(row["unit"], row["unit"])),
        "typed": (typed(point, row), True),
    }
    if "derived_wire" in row:
        number, place = uss.parameter_words(0, row["number"], row["index"] or 0)
        wire = row["derived_wire"]
        seen["wire"] = ((number, place), (wire["pnu"], int(wire["ind"][:-1], 16)))
    if "access" in row:
        seen["access"] = (point.access, "r")
    if "words" in row and point.generated:
        seen["words"] = (point.words, row["words"])
    if row["index"] is not None or len(of_number(row)) == 1:  # else the rows of the indices have it
        shift = 1 << 16 if point.words == 2 else 1  # the number of a source is the high word
        seen["default"] = (point.default, None if row["default"] is None else Fraction(row["default"]) * shift)
    if not row["name_de"].startswith("("):
        seen["name"] = (plain_name(point.title["de"]), plain_name(row["name_de"]))
    if "words_bits" in row:
        seen["bits"] = (point.flags, telegram_point(WORDS[row["words_bits"]]).flags)
    for pattern, value in row.get("examples", {}).items():
        shown = {frame.meaning.get(point.name) for frame in device(NAME).frames}
        seen[f"example {value}"] = (decoded(int(pattern, 16)), Fraction(value))
        seen[f"frame {value}"] = (int(pattern, 16) in shown, True)
    return seen | values(row, point)


def of_number(row: Row) -> list[Row]:
    return [one for one in rows(NAME) if one["kind"] == "parameter" and one["number"] == row["number"]]


def typed(point: Point, row: Row) -> bool:
    """Whether the type is the one that the reading has, or an erratum says how it was taken."""
    said = TYPES.get(row["type"], row["type"])
    return not point.generated or point.type == said or (said is None and not UNTYPED.isdisjoint(point.errata))


def plain_name(text: str) -> str:
    return re.sub(r" \(Quelle .*\)|,.*| / .*", "", text).lower()


def values(row: Row, point: Point) -> Seen:
    """The numbers that the reading gives a meaning: of the enum, of sources, or the longest of a range."""
    keys = list(row["values"] or ())
    named = {entry.raw for entry in point.enum.entries} if point.enum else {one.low for one in point.specials}
    if named:
        return {"values": (named, {int(one) for one in keys if one.isdigit()})}
    sources = [int(one.partition(".")[0]) for one in keys if re.fullmatch(r"\d\d+(\.\d+)?", one)]
    described = {one.address for one in device(NAME).points if one.space == "parameter"}
    highs = {int(one[-1]) for one in keys if re.fullmatch(r"0\.\.\d|max \d", one)}
    limits = {one.allowed.intervals[0].high for one in device(NAME).points if one.name == point.name and highs}
    return {"sources": (described.issuperset(sources), True), "limits": (limits, highs)}


def decoded(raw: int) -> Fraction:
    return Fraction(struct.unpack(">f", raw.to_bytes(4, "big"))[0])


# ---- Bits ----


def telegram_point(name: str) -> Point:
    return next(one for one in device(NAME).points if one.name == name)


def bit(row: Row) -> Iterator[Seen]:
    flag = next(one for one in telegram_point(WORDS[row["word"]]).flags if one.low == row["bit"])
    if "mm4" in row:
        yield {"text": (words_of(row) <= words_of_flag(flag), True)}
        return
    texts = {entry.raw: entry.title.get("de") for entry in flag.values}
    if not texts:  # one text for the bit
        yield {"text": (flag.title["de"], row["one"])}
        return
    seen: Seen = {
        "zero": (texts.get(0), None if row["zero"] == "-" else row["zero"]),
        "one": (texts.get(1), None if row["one"] == "-" else row["one"]),
    }
    answers = {"JA": 1, "NEIN": 0}
    if row["printed_one"][2:] in answers:
        seen["active"] = (flag.active, answers[row["printed_one"][2:]])
    yield seen


def words_of(row: Row) -> set[str]:
    """What the comparison with MICROMASTER 3 calls a bit of MICROMASTER 4."""
    text = row["one"] if row["mm4"].startswith("Gleich") else row["mm4"]
    return set(re.findall(r"\w+", re.sub(r"\(.*\)", "", text)))


def words_of_flag(flag: Flag) -> set[str]:
    titles = (flag.title, *(entry.title for entry in flag.values))
    return {word for title in titles for word in re.findall(r"\w+", title.get("de", ""))}


# ---- Tasks, responses, errors ----


def code(row: Row) -> Iterator[Seen]:
    codes: tuple[Code, ...] = getattr(device(NAME).bus, KINDS[row["kind"]])
    found = next(one for one in codes if one.number == row["number"])
    if row["kind"] == "task":
        yield {
            "answers": (found.answers, tuple(row["answers"])),
            "refusals": (found.refusals, tuple(row["negative"])),
            "told": (told(found.title["en"]), told(row["meaning"])),
        }
    elif row["kind"] == "response":
        yield {
            "tasks": (found.answers, tuple(row["tasks"])),
            "told": (told(found.title["en"]), told(row["meaning"])),
        }
    else:
        yield {"tasks": (found.answers, tuple(row["tasks"] or ()))}


def told(text: str) -> set[str]:
    """The words of a title that tell it from the other ones."""
    words = ("array", "double", "eeprom", "ram", "not possible", "reserved", "description", "text", "not used")
    return {word for word in words if re.search(rf"\b{word}\b", text.lower())}


# ---- Words of a telegram ----

VALUE, HIGH, LOW = 0x12345678, 0x1234, 0x5678
BITS: dict[str, Callable[[], int]] = {
    "PKE bits 15-12": lambda: uss.parameter_words(15, 0, 0)[0],
    "PKE bits 10-0": lambda: every(uss.parameter_words(0, number, 0)[0] for number in range(2000)),
    "IND bits 15-12": lambda: every(uss.parameter_words(0, page * 2000, 0)[1] for page in range(16)),
    "IND bits 7-0": lambda: every(uss.parameter_words(0, 0, index)[1] for index in range(256)),
    "PKE bit 11": lambda: 0,
    "IND bits 11-10": lambda: 0,
    "IND bits 9-8": lambda: 0,
}
"""The bits of the two words that name a parameter; the reserved ones are never set."""


def every(words: Iterable[int]) -> int:
    found = 0
    for word in words:
        found |= word
    return found


def sent(p2013: int, width: int, task: int, value: int) -> tuple[int, ...]:
    """The words of the parameter part of a request."""
    request = uss.Request(3, task, 1000, 0, width, value)
    status, data = uss.build(device(NAME).bus, uss.Link(p2013, 0), request)
    assert status == "ok"
    return tuple(int.from_bytes(data[at : at + 2], "big") for at in range(3, len(data) - 1, 2))


def answer(p2013: int, *words: int, task: int = 1) -> uss.Reply:
    request = uss.Request(3, task, 1082)
    return uss.parse(device(NAME).bus, uss.Link(p2013, 0), request, uss.telegram(3, words))


PLACES: dict[str, tuple[int, int, int, int]] = {
    "PWE1, single word": (2, 1, 2, LOW),
    "PWE1, single word, P2013 = 4": (2, 1, 2, 0),
    "PWE1, double word": (3, 2, 2, HIGH),
    "PWE2, single word": (2, 1, 3, 0),
    "PWE2, single word, P2013 = 4": (2, 1, 3, LOW),
    "PWE2, double word": (3, 2, 3, LOW),
}
"""Which word of the parameter part holds what: the task and words of the value, the word and what it holds."""


def layout(row: Row) -> Iterator[Seen]:
    what = row["what"]
    if what in BITS:
        mask = BITS[what]()
        high, _, low = re.sub(r"\D*(\d+)\D*(\d*)", r"\1-\2", what.partition("bit")[2]).partition("-")
        span = (2 << int(high)) - (1 << int(low or high))
        yield {"mask": (mask, span if mask else 0)}
        if "weights" in row:
            weighs = {
                str(uss.parameter_words(0, weight * 2000, 0)[1].bit_length() - 1): weight for weight in (1, 2, 4, 8)
            }
            yield {"weights": (weighs, row["weights"])}
    elif what in PLACES:
        task, width, at, holds = PLACES[what]
        value = VALUE if width == 2 else LOW
        yield {"place": ([sent(one, width, task, value)[at] for one in row["p2013"]], [holds] * len(row["p2013"]))}
    elif "page" in row:
        first, last = row["range"]
        page = int(row["ind_high_nibble"][0], 16) << 12
        names = uss.parameter_words(0, first, 0), uss.parameter_words(0, last, 0)
        yield {"words": (names, ((0, page), (1999, page)))}
    elif "words" in row:
        name = {"request": "task", "response": "answer"}[row["direction"]]
        carried = {one.address: one.code for one in device(NAME).points if one.telegram == name}
        yield {"words": ([carried[at] for at in range(4)], row["words"])}
    else:
        yield LAYOUTS[what]()


def source_format() -> Seen:
    flags = telegram_point("p0731_source").flags
    return {"halves": (sorted((one.low, one.width) for one in flags), [(0, 16), (16, 16)])}


def ports() -> Seen:
    found = {one.variant: one.index for one in device(NAME).points if one.name == "uss_normalisation"}
    return {"indices": (found, {"interface=rs485": 0, "interface=rs232": 1})}


def said(*phrases: str) -> Seen:
    """What is a sentence of the note of the bus."""
    return {phrase: (phrase in device(NAME).bus.note["en"], True) for phrase in phrases}


LAYOUTS: dict[str, Callable[[], Seen]] = {
    "frame": lambda: {"bytes": (uss.telegram(3, (0x047F, 0x3333)), bytes.fromhex("02 06 03 047F 3333 7C"))},
    "PNU": lambda: {"page": (uss.parameter_words(0, 3950, 0), (1950, 0x8000))},
    "PNU limit": lambda: {
        "largest": (max(one.address or 0 for one in device(NAME).points if one.space == "parameter") < 4000, True)
    },
    "PWE1, single word, all elements": lambda: said("where 255 means all elements (P2013 = 127 only)"),
    "PWE1, double word, all elements": lambda: said("where 255 means all elements (P2013 = 127 only)"),
    "PWE2, double word, all elements": lambda: said("where 255 means all elements (P2013 = 127 only)"),
    "PWE1, error": lambda: {"error": (answer(127, 0x743A, 0, 17).error, 17)},
    "PWE2, error: id does not exist or not accessible": lambda: {"error": (answer(127, 0x743A, 0, 0, 7).error, 0)},
    "PWE2, error: value not permitted or new limit": lambda: {"error": (answer(127, 0x743A, 0, 104, 7).error, 104)},
    "PWE in a read request": lambda: {"values": (sent(127, 0, 1, 0)[2:], (0, 0))},
    "U32 (BiCo)": source_format,
    "float": lambda: {"value": (decoded(0x42480000), Fraction(50))},
    "types": lambda: {
        "words": ({one.type: one.words for one in device(NAME).points if one.generated}, {"u16": 1, "u32": 2, "f32": 2})
    },
    "PKW length, P2013 = 3 or 4": lambda: {
        "sent": ([len(sent(one, 0, 1, 0)) for one in (3, 4)], [3, 4]),
        "other": (answer(4, 0x143A, 0, 0).status, "wrong_length"),
    },
    "PKW length, P2013 = 127": lambda: {
        "sent": (len(sent(127, 0, 1, 0)), 4),
        "word": (answer(127, 0x143A, 0, 6).value, 6),
        "double word": (answer(127, 0x243A, 0, HIGH, LOW).value, VALUE),
    },
    "PZD length": lambda: {"words": (device(NAME).bus.pzd, (0, 8))},
    "STW2": lambda: {"word": (telegram_point("second_control_word").address, 3)},
    "ports of USS parameters": ports,
}


# ---- Examples ----

PARTS = {None: "pkw", "PZD": "pzd", "broadcast mask": "broadcast"}


def telegrams(row: Row) -> list[bytes]:
    return [bytes.fromhex(part) for part in row["words"].partition("->")[0].split("/")]


def example(row: Row) -> Iterator[Seen]:
    if row.get("part") == "BCC":
        yield {"check": (uss.check_byte(telegrams(row)[0]), int(row["words"][-2:], 16))}
        return
    printed = telegrams(row)
    here = [one for one in device(NAME).frames if one.source.line == row["line"]]
    frames = [one for one in here if one.printed in printed and one.direction == row["direction"]]
    yield {"frames": (sorted({one.printed for one in frames}), sorted(set(printed)))}
    for frame in frames:
        yield {
            "part": (frame.framing, PARTS[row.get("part")]),
            "p2013": (frame.pkw, row["p2013"]),
            **meaning(frame, row["meaning"]),
        }


def meaning(frame: Frame, text: str) -> Seen:
    """What the reading says that an example means: a task, a response, an error, a value, the first bit of STW."""
    seen: Seen = {}
    if found := re.search(r"(?:task|response) (\d+)", text):
        seen["code"] = (frame.printed[0] >> 4, int(found[1]))
    if found := re.search(r"error (\d+)", text):
        error = int(found[1])
        seen["error"] = (int.from_bytes(frame.printed[4:6], "big"), error)
        seen["known"] = (error in {one.number for one in device(NAME).bus.exceptions}, True)
    elif found := re.search(r"(?:value |= |, )(\d+(?:\.\d+)?)(?: changed)?$", text):
        seen["value"] = ([value_of(name, raw) for name, raw in frame.meaning.items()], [Fraction(found[1])])
    if text.startswith("O"):  # ON and OFF1
        control_word = frame.meaning["control_word"]
        seen["on"] = (control_word & 1, int(text.startswith("ON,") or control_word == 0x047F))
    return seen


def value_of(name: str, raw: int) -> Fraction:
    return decoded(raw) if telegram_point(name).info.floating else Fraction(raw)


# ---- Scales ----


def scale(row: Row) -> Iterator[Seen]:
    if row["when"] is None:
        for code_of in row["word"].split(", "):
            point = next(one for one in device(NAME).points if one.code == code_of)
            yield {"scale": (point.scale, None)}
        return
    point = next(one for one in device(NAME).points if one.code == row["word"])
    cases = {case.raw: case.rule for case in point.scale or ()}
    yield {
        "cases": ([one.point for one in point.scale or ()], ["uss_normalisation"] * 2),
        "by P2000": ([(one.point, one.power) for one in cases[0].factors], [("reference_frequency", -1)]),
        "hundredths": ((cases[1].ratio, cases[1].factors), (100, ())),
        "3333h": (round(Fraction(0x3333) * 50 / cases[0].ratio, 2), 40),
    }


# ---- The bus ----


def bus(row: Row) -> Iterator[Seen]:
    yield BUS[row["what"]](row["value"])


def variant_values(axis: str) -> dict[str, Any]:
    path = ROOT / f"descriptions/{NAME}/device.yaml"
    found: dict[str, Any] = yaml.safe_load(path.read_text("utf-8"))["variants"][axis]["values"]
    return found


def terminals(_: Any) -> Seen:
    found = {name: (one["terminal_p"], one["terminal_n"]) for name, one in variant_values("model").items()}
    return {"terminals": (found, {"mm410": (9, 10), "mm420": (14, 15), "mm430": (29, 30), "mm440": (29, 30)})}


def interfaces(value: dict[str, str]) -> Seen:
    found = variant_values("interface")
    option = {"rs232": found["rs232"]["option"], "titles": [one["title"][:12] for one in found.values()]}
    return {
        "index": ({name: one["index"] for name, one in found.items()}, {"rs485": 0, "rs232": 1}),
        "option": (option["rs232"] in value["RS232"], True),
        "names": (option["titles"], ["RS485 (USS2)", "RS232 (USS1)"]),
    }


def serial(name: str) -> Callable[[Any], Seen]:
    return lambda value: {name: (list(device(NAME).bus.serial[name]), [str(value)])}


def in_note(*phrases: str) -> Callable[[Any], Seen]:
    return lambda _: said(*phrases)


def broken(_: Any) -> Seen:
    """A telegram with a wrong check byte is no answer."""
    *good, check = uss.telegram(3, (0x143A, 0, 6))
    reply = uss.parse(device(NAME).bus, uss.Link(127, 0), uss.Request(3, 1, 1082), bytes((*good, check ^ 1)))
    return {"status": (reply.status, "wrong_check"), **said("drops a broken telegram without an answer")}


BUS: dict[str, Callable[[Any], Seen]] = {
    "slaves max": serial("slaves_most"),
    "masters": in_note("Only the master starts an exchange"),
    "STX": lambda value: {"start": (uss.telegram(3, ())[0], int(value[:-1], 16))},
    "LGE": lambda _: {"length": (uss.telegram(3, (0,) * 6)[1], 14)},
    "total length": lambda _: {"length": (len(uss.telegram(3, (0,) * 6)), 16)},
    "total length max": lambda value: said(f"it has at most {value} bytes"),
    "ADR": lambda _: {"units": (device(NAME).bus.units, (0, 31))},
    "BCC": lambda _: {"all": (uss.check_byte(uss.telegram(3, (0x047F, 0x3333))), 0)},
    "bad telegram": broken,
    "wrong PKW length": in_note("a PKW of another length than P2013 fixes too"),
    "broadcast ADR": lambda _: {"address": (device(NAME).bus.broadcast, 1 << 5)},
    "broadcast PKW": in_note("its PKW part of four words is a mask"),
    "broadcast mask word 1": in_note("bit n of the first word lets PZD n count (bit 0 is not used)"),
    "broadcast mask word 2": in_note("the second word says which bits of STW count"),
    "broadcast mask words 3, 4": in_note("words 3 and 4 serve STW2 only"),
    "broadcast bit 10": in_note("bit 10 must be one of them"),
    "broadcast parameters": in_note("parameters cannot be read or written by broadcast"),
    "broadcast PZD": lambda _: {
        "words": (uss.broadcast(device(NAME).bus, uss.Link(127, 2), (6, 0xFFFF, 0, 0), (0x047F, 0))[0], "ok")
    },
    "broadcast answer": in_note("A broadcast is not answered"),
    "baud max": serial("baud_most"),
    "timeout": lambda _: {"fault": (device(NAME).bus.timing["fault_after_off_time"], "F070")},
    "terminals": terminals,
    "ports": interfaces,
    "PZD words max": lambda value: {
        "words": (
            {name: one["pzd"] for name, one in variant_values("model").items()},
            {f"mm{model}": most for models, most in value.items() for model in models_of(models)},
        )
    },
    "MM420 firmware 1.05": lambda _: {
        "single word": (uss.Link(4, 0, single_first=True).single_last, False),
        "bit 15": ("Bit 15 does nothing" in telegram_point("control_word").note["en"], True),
    },
    "character format, gaps, timing": lambda _: {
        "silent": (set(device(NAME).bus.timing), {"telegram_off_time", "fault_after_off_time"})
    },
}


def models_of(text: str) -> list[str]:
    return re.findall(r"\d+", text)


FACTS: dict[str, Callable[[Row], Iterator[Seen]]] = {
    "parameter": parameter,
    "bit": bit,
    "task": code,
    "response": code,
    "error": code,
    "layout": layout,
    "example": example,
    "scale": scale,
    "bus": bus,
}
