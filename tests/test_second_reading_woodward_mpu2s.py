"""The description of the Woodward MPU2-S agrees with the second reading of its manual, fact by fact."""

from __future__ import annotations

import re
from fractions import Fraction
from math import floor
from typing import TYPE_CHECKING

import pytest
from second_reading import Row, Seen, assert_answered, assert_same, device, each_row, joined, rows

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Bound, Entry, Flag, Message, Point, Role

NAME = "woodward_mpu2s"

_AS_THE_SOURCE = "the formula is that of the source; the description has the sources' own (erratum)"
SETTLED: dict[tuple[str, str], str] = {
    ("4.2.10 id 507", "title"): "no title is printed; the description says whose factor it is",
    ("4.2.110 id 508", "title"): "no title is printed; the description says whose factor it is",
    ("4.2.21 id 68", "scale"): "factor and ranges contradict each other: no scale is taken (erratum)",
    ("4.2.21 id 68", "range_in_units"): "without a scale there are no limits in the unit (erratum)",
    ("4.2.78 id 298 bits 1..0", "enum"): "11 is printed as not defined: the enum does not allow it",
    ("4.2.80 id 300", "unit"): "a plain factor, as the formula calls it; a note says of what",
    ("4.2.81 id 301", "unit"): "a plain factor, as the formula calls it; a note says of what",
    ("4.2.136 id 125 bits 3..0", "title"): "the heading lacks Digitaleingänge (erratum)",
    ("4.2.154 id 193", "scale"): _AS_THE_SOURCE,
    ("4.2.155 id 194", "scale"): _AS_THE_SOURCE,
    ("4.2.158 id 196", "scale"): _AS_THE_SOURCE,
    ("4.2.159 id 197", "scale"): _AS_THE_SOURCE,
    ("word 25", "scale"): "QGNEXPO is in no word: no scale is taken (erratum)",
    ("word 31 bits 15..8", "title"): "the description adds Strom where Leistung is printed (erratum)",
    **{(f"word {nr}", "scale"): "not in this manual: left open (erratum)" for nr in range(61, 69)},
    ("analog_source 0", "title"): "without the full stop of the sentence",
    ("relay_event 8", "title"): "the blank in Sammelschienen Spannung is left out (erratum)",
    ("relay_event 20", "title"): "Aggregateüberdrehzahl without its e (erratum)",
    ("relay_event 69", "title"): "without the colon at its end (erratum)",
}
"""What the two readings saw differently, by row and fact, and why the description stays."""

ANSWERS: dict[int, tuple[str, ...] | str] = {
    1: ("frequency_ramp_factor",),
    2: ("battery_undervoltage_delay_minimum",),
    3: ("overcurrent_1_title",),
    4: ("analog_source_23",),
    5: ("telegram_reactive_power_exponent",),
    6: ("telegram_current_exponent_name",),
    7: ("generator_overfrequency_bit",),
    8: ("generator_monitoring_texts",),
    9: ("shutdown_bit",),
    10: ("reactive_power_delay_ids",),
    11: ("synchronisation_minimum_sign",),
    12: ("input_digit_order", "input_digit_base"),
    13: ("telegram_identification_base",),
    14: ("telegram_pairs_of_bits",),
    15: (
        "parameter_sign",
        "telegram_signed_power",
        "telegram_reactive_power_sign",
        "telegram_unsigned_words",
        "telegram_exponent_sign",
        "voltage_factors",
    ),
    16: ("voltage_factors",),
    17: "400 is printed in all 16 places alike, and nothing contradicts it",
    18: "the limits are printed as they are taken; that they form no pattern contradicts nothing",
    19: ("unit_numbers",),
    20: ("refused_requests", "write_answer_value"),
    21: ("password_use",),
    22: ("parameter_persistence",),
    23: ("relay_last_word", "event_without_number_0"),
    24: ("telegram_analog_input_scale",),
    25: ("telegram_word_69_remark",),
    26: ("telegram_terminal_4_breaker",),
    27: "no contradiction: bits are changed by reading the word first, so their neighbours keep",
    28: ("synchronisation_bit_note",),
    29: ("power_measurement_bit_row",),
    30: ("input_bit_rows",),
    31: ("input_fault_class_column",),
    32: "ids need not be regular; each is printed once",
    33: ("telegram_digital_input_count", "fault_text_terminals"),
    34: ("row_multiplexer_rule",),
    35: ("telegram_length_limit",),
    36: ("telegram_chapter",),
    37: ("parameter_chapter",),
    38: ("access_chapter",),
    39: ("manual_versions",),
    40: ("message_pause",),
    41: "no contradiction: byte 0 and the CAN id tell all five messages apart",
    42: "the reader found both forms of the checksum to agree",
    43: "the reader found the numbers of all words to agree",
    44: "the reader found the pairs of cos phi to agree; test above computes them",
    45: ("telegram_state_other_values", "telegram_busbar_state_unit"),
    46: ("telegram_fault_word_order",),
    47: (
        "telegram_busbar_voltage_title",
        "telegram_mains_fault_titles",
        "telegram_unbalanced_load_title",
        "event_unbalanced_load_title",
    ),
    48: ("event_earth_title", "event_overcurrent_titles"),
    49: "a list of the internal words, which are reserved in the description",
    50: ("generator_rated_frequency_title",),
    51: ("busbar_transformer_title",),
    52: ("contents_chapter_2_titles",),
    53: ("analog_heading",),
    54: ("input_9_12_title",),
    55: ("overcurrent_1_title",),
    56: ("fault_text_example",),
    57: ("range_row_titles",),
    58: (
        "interface_control_text",
        "active_power_controller_text",
        "relay_priority_words",
        "visualisation_message_title",
        "analog_mains_power_titles",
    ),
    59: "no contradiction: both enums are closed, as printed",
    60: "no contradiction: the entries are taken as printed",
    61: ("analog_active_power_unit",),
    62: ("analog_cos_phi_definition", "analog_cos_phi_sides", "analog_cos_phi_numbers"),
    63: ("analog_input_limits", "analog_input_or"),
    64: ("analog_terminals_91_93",),
    65: "no contradiction: the wording is taken as printed",
    66: ("event_parallel_title", "event_switching_done", "analog_appendix_title"),
    67: ("event_mains_breaker",),
    68: "the reader found the worked example to agree",
    69: "roundings: the printed value, encoded, gives the printed raw number",
    70: "the reader found all other ranges and formulas to agree",
}
"""The errata for each finding of the second reader, or why it needs none."""

UNITS: dict[str | None, str] = {
    **dict.fromkeys((None, "1", "Byte", "Bits", "Doppelbits", "Intern", "Skalierbar"), ""),
    "deg": "°",
}
"""What the reader noted where the description has another sign, or a number without a unit."""

UNNAMED = re.compile("(?i)intern|frei|reserve")
"""Bits and words that the manual gives no meaning."""


def key(row: Row) -> str:
    """What tells a row from the others: the section with its id and bits, or the number in a list."""
    bits = f" bits {row['bits'][0]}..{row['bits'][1]}" if row.get("bits") else ""
    if row["kind"] == "parameter":
        return f"{row['section']} id {row['id'][0]}{bits}{'' if row['variant'] is None else ' ' + row['variant']}"
    if row["kind"] == "telegram":
        return f"word {row['nr']}{bits}"
    return f"{row['kind']} {row.get('number', row.get('name'))}"


@each_row(NAME, key)
def test_the_description_says_what_the_second_reading_says(row: Row) -> None:
    found = list(FACTS[row["kind"]](row))
    assert found, "the description has nothing of it"
    assert_same(found, key(row), SETTLED)


def test_what_is_settled_was_read() -> None:
    keys = [key(row) for row in rows(NAME)]
    assert len(set(keys)) == len(keys)
    assert {of for of, _ in SETTLED} <= set(keys)


def test_every_finding_is_answered() -> None:
    assert_answered(NAME, ANSWERS)


def test_every_point_was_read_twice() -> None:
    read = {point.item for row in rows(NAME) if row["kind"] in PLACES for point in PLACES[row["kind"]](row)}
    assert [point.item for point in device(NAME).points if point.item not in read] == []


@pytest.mark.parametrize(("enum", "kind"), [("relay_event", "relay_event"), ("analog_source", "analog_source")])
def test_every_entry_was_read_twice(enum: str, kind: str) -> None:
    assert list(entries(enum)) == [row["number"] for row in rows(NAME) if row["kind"] == kind]


def test_every_message_was_read_twice() -> None:
    read = {row["name"] for row in rows(NAME) if row["kind"] == "message"}
    assert {one.title["de"] for one in device(NAME).messages} == read


# Parameters


def parameters(row: Row) -> list[Point]:
    """The points at a row's id in its section: those with its bits, or those that write these bits as a constant."""
    found = [
        point
        for point in device(NAME).points
        if point.space == "parameter"
        and point.source.section == row["section"]
        and set(point.addresses) <= set(row["id"])
        and point.variant in (None, f"voltage={row['variant']}")
    ]
    if row["bits"] is None:
        return found
    high, low = row["bits"]
    there = [point for point in found if point.bits and point.bits[0] >= high and low >= point.bits[1]]
    return there or [point for point in found if point.fixed is not None]


def of_parameter(row: Row) -> Iterator[Seen]:
    points = parameters(row)
    if row["type"] == "relay record":
        yield of_record(points, row)
    for point in points if row["type"] != "relay record" else ():
        if row["bits"] is None or list(point.bits or ()) == row["bits"]:
            yield common(point, row) | of_whole(point, row)
        elif flag := flag_at(point, *row["bits"]):
            yield common(point, row) | of_flag(flag, row)
        else:
            yield common(point, row) | of_constant(point, row)


def common(point: Point, row: Row) -> Seen:
    """What all parts of a word share."""
    return {
        "address": (list(point.addresses), row["id"]),
        "line": (point.source.line, row["line"]),
        "access": (point.access, row["access"]),
        "relay": (part_of_relay(point.title["de"]), part_of_relay(row["title_de"])),
    }


def of_whole(point: Point, row: Row) -> Seen:
    seen: Seen = {
        "type": (kind_of(point), row["type"]),
        "bits": (list(point.bits) if point.bits else None, row["bits"]),
        "code": (point.code, row["title_de"].split()[0] if row["title_de"].startswith("KW") else None),
        "unit": (point.unit.symbol, UNITS.get(row["unit"], row["unit"])),
        "scale": (scale(point), printed_scale(row["formula"])),
        "uses": (factors(point), row["uses"]),
    }
    if not point.record:
        seen["title"] = (plain_title(point.title["de"]), plain_title(row["title_de"]))
    if row["enum"]:
        seen["enum"] = (texts(enum_of(point), row["enum"]), printed_texts(row["enum"]))
    if row["raw_range"]:
        seen["range"] = ranges(point, row["raw_range"].partition(" (list")[0])
    if row["range_in_units"]:
        seen["range_in_units"] = in_units(point, row["range_in_units"])
    return seen


def kind_of(point: Point) -> str:
    if point.text or point.digits:
        return point.form
    return "bit group" if point.bits else point.type


def of_constant(point: Point, row: Row) -> Seen:
    mask, constant = (point.fixed.mask, point.fixed.bits) if point.fixed else (0, 0)
    high, low = row["bits"]
    return {
        "bits": (f"{mask:b}", f"{(1 << high + 1) - (1 << low):b}"),
        "range": (str(constant), row["raw_range"]),
    }


def of_flag(flag: Flag, row: Row) -> Seen:
    own = {entry.raw: entry.title["de"] for entry in flag.values}
    seen: Seen = {"enum": (texts(own, row["enum"]), printed_texts(row["enum"]))}
    if not part_of_relay(row["title_de"]):
        seen["title"] = (flag.title["de"], row["title_de"].partition(": ")[2])
    return seen


def flag_at(point: Point, high: int, low: int) -> Flag | None:
    above = point.bits[1] if point.bits else 0
    return next((one for one in point.flags if (one.low + above, one.width) == (low, high - low + 1)), None)


def of_record(points: list[Point], row: Row) -> Seen:
    return {
        "address": (sorted({one for point in points for one in point.addresses}), row["id"]),
        "line": ({point.source.line for point in points}, {row["line"]}),
        "access": ({point.access for point in points}, {row["access"]}),
        "title": ({point.title["de"].partition(":")[0] for point in points}, {row["title_de"]}),
    }


# The telegram


def words(row: Row) -> list[Point]:
    """The points in a row's word."""
    found = [one for one in device(NAME).points if one.space == "telegram" and row["nr"] - 1 in one.addresses]
    return [one for one in found if row["bits"] is None or list(one.bits or ()) == row["bits"]]


def of_telegram(row: Row) -> Iterator[Seen]:
    points = words(row)
    if row["bits"] is None and len(points) > 1:  # its parts have rows of their own
        yield {
            "parts": ([point.bits for point in points], [(15, 8), (7, 0)]),
            "line": ({point.source.line for point in points}, {row["line"]}),
        }
        return
    for point in points:
        place = point.addresses.index(row["nr"] - 1)  # the low word of two has a row of its own, the next
        assert point.source.line is not None
        yield {
            "nr": (place_of(point, place), (row["nr"], row["mux"], row["word"])),
            "line": (point.source.line + place, row["line"]),
            "bits": (list(point.bits) if point.bits else None, row["bits"]),
            "title": (plain_title(point.title["de"]), plain_title(re.sub(" (High|Low)wort$", "", row["name_de"]))),
            "access": (point.access, "r"),
            "unit": (point.unit.symbol, UNITS.get(row["unit"], row["unit"])),
            "scale": (scale(point, place), printed_scale(row["formula"])),
            "flags": (named_bits(point), printed_bits(row["flags"])),
            "enum": (enum_of(point), printed_bytes(row["flags"])),
            "reserved": (point.reserved, row["internal"] or bool(UNNAMED.fullmatch(row["name_de"]))),
            "pairs": pairs(point, row["formula"]),
        }


def place_of(point: Point, place: int) -> tuple[object, ...]:
    if place == 0:
        return tuple(point.references[name] for name in ("nr", "mux", "word"))
    wire = point.addresses[place]
    return wire + 1, wire // 3, wire % 3 + 1


def named_bits(point: Point) -> dict[tuple[int, int], str]:
    return {(flag.low + flag.width - 1, flag.low): flag.title["de"] for flag in point.flags}


def printed_bits(flags: Mapping[str, str] | None) -> dict[tuple[int, int], str]:
    named = {bits: name for bits, name in (flags or {}).items() if bits.strip("F0") or bits == "0"}
    ends = {bits: [int(end) for end in bits.split("..")] for bits in named}
    return {(ends[bits][0], ends[bits][-1]): name for bits, name in named.items() if not UNNAMED.fullmatch(name)}


def printed_bytes(flags: Mapping[str, str] | None) -> dict[int, str]:
    return {int(byte, 16): name for byte, name in (flags or {}).items() if byte in ("FF", "00")}


def pairs(point: Point, formula: str | None) -> tuple[object, object]:
    """Words printed with their values, and what the scale makes of the words."""
    printed = re.findall(r"([0-9A-F]{4}) = ([+-]?[0-9.]+)", formula or "")
    wanted = [Fraction(value) for _, value in printed]
    raw = [int(word, 16) for word, _ in printed]
    signed = [one - (1 << 16) if point.info.signed and one >> 15 else one for one in raw]
    return [one / point.scale[0].rule.ratio for one in signed] if point.scale else [], wanted


# The lists and the messages


def entries(enum: str) -> dict[int, Entry]:
    return {entry.raw: entry for one in device(NAME).enums if one.name == enum for entry in one.entries}


def of_entry(row: Row) -> Iterator[Seen]:
    """An event or a source; of a source the quantity is compared, not the kinds of value that follow it."""
    entry = entries(row["kind"]).get(row["number"])
    if entry is not None:
        printed = re.sub(r" Temperatur.*| \[(?!T).*", "", row["name_de"])
        yield {"title": (plain_title(entry.title["de"]), plain_title(printed))}


def of_message(row: Row) -> Iterator[Seen]:
    direction = {"master to slave": "request", "slave to master": "response"}.get(row["direction"], "cyclic")
    for one in device(NAME).messages:
        if one.title["de"] == row["name"]:
            yield {
                "direction": (one.direction, direction),
                "can_id": (f"0x{one.can_id:X}" + " + Geraetenummer" * one.adds_unit, row["can_id"]),
                "line": (one.source.line, row["line"]),
                "bytes": (dict(enumerate(map(said, one.roles))), {int(at): text for at, text in row["bytes"].items()}),
                "checksum": (sums(one), printed_sums(row["checksum"])),
            }


def said(role: Role) -> str:
    """A byte of a message in the reader's words."""
    high = (role.kind in ("address", "raw") and role.number == 8) or (role.kind == "word" and role.number % 2 == 0)
    half = "High-Byte" if high else "Low-Byte"
    return {
        "constant": f"0x{role.number:02X}" if role.number else "0",
        "unit": "Slave-Nr.",
        "multiplexer": "Muxnummer (from 0)",
        "address": f"ID (Adresse) {half}",
        "raw": f"Datenwort {half}",
        "word": f"Datenwort {role.number // 2 + 1} {half}",
        "xor": f"Prüfsumme {'High' if role.number & 1 else 'Low'}-Byte",
    }[role.kind]


def sums(message: Message) -> dict[int, list[int]]:
    """The bytes that each byte of the checksum combines."""
    return {
        at: [bit for bit in range(8) if role.number >> bit & 1]
        for at, role in enumerate(message.roles)
        if role.kind == "xor"
    }


def printed_sums(text: str | None) -> dict[int, list[int]]:
    found = re.findall(r"byte (\d) = ([^;(]*)", text or "")
    return {int(at): [int(one) for one in re.findall(r"\d", terms)] for at, terms in found}


# Numbers and names


def ranges(point: Point, text: str) -> tuple[object, object]:
    """The raw numbers allowed, and those printed: whole numbers, limits with a factor, characters, or digits."""
    if point.text is not None:
        return point.text.characters, int(text.partition(" ")[0])
    if point.digits is not None:
        greatest = int(str(max(enum_of(point))) * point.digits.count)
        return [(0, greatest)], [tuple(map(int, re.findall(r"\d{4}", text)))]
    if "*" in text:
        return [f"{limit(one.low)}..{limit(one.high)}" for one in point.allowed.intervals], [text]
    own = joined((int(limit(one.low)), int(limit(one.high))) for one in point.allowed.intervals)
    return own, joined((int(low), int(high)) for low, high in spans(text))


def limit(bound: Bound) -> str:
    if isinstance(bound, int):
        return str(bound)
    (factor,) = bound.rule.factors
    return f"{bound.rule.ratio * 400}*{code_of(factor.point)}/400"


def in_units(point: Point, text: str) -> tuple[object, object]:
    """The limits in the unit, both in steps of the last digit that is printed."""
    steps = 10 ** max(len(number.partition(".")[2]) for span in spans(text) for number in span)
    printed = joined((int(Fraction(low) * steps), int(Fraction(high) * steps)) for low, high in spans(text))
    if not point.generated:
        return None, printed
    ends = [(value(point, one.low), value(point, one.high)) for one in point.allowed.intervals]
    return joined((rounded(low * steps), rounded(high * steps)) for low, high in ends), printed


def spans(text: str) -> list[tuple[str, str]]:
    """`1..5, 7` as (first, last)."""
    parts = [re.sub(r" \(.*", "", part).partition("..") for part in text.split(", ")]
    return [(first, last or first) for first, _, last in parts]


def value(point: Point, bound: Bound) -> Fraction:
    """A limit in the unit; a factor of the limit and of the scale is the same."""
    ratio = point.scale[0].rule.ratio if point.scale else Fraction(1)
    return (bound if isinstance(bound, int) else bound.rule.ratio) / ratio


def rounded(number: Fraction) -> int:
    return floor(number + Fraction(1, 2))


Scale = tuple[Fraction, dict[str, int]]
"""raw = value * ratio * each factor to its power; a factor that is an exponent begins with `10 ** `."""


def scale(point: Point, place: int = 0) -> Scale | str:
    """The rule of one word of a point."""
    weight = 1 if point.text else 1 << 16 * (len(point.addresses) - 1 - place)
    if point.reason is not None and "scale" in point.reason:
        return "open"
    if point.scale is None:
        return Fraction(1, weight), {}
    if len(point.scale) > 1:
        return f"as {point.scale[0].point} says"
    rule = point.scale[0].rule
    return rule.ratio / weight, {"10 ** " * one.ten_to + code_of(one.point): one.power for one in rule.factors}


def printed_scale(text: str | None) -> Scale:
    wanted, _, terms = (text or "raw = value").partition(";")[0].partition(" = ")
    ratio, factors = Fraction(1), dict[str, int]()
    for sign, ten_to, operand in re.findall(r"([*/]) (10 \*\* )?([\w.]+)", terms):
        power = (1 if sign == "*" else -1) * (1 if wanted == "raw" else -1)
        if operand[0].isdigit():
            ratio *= Fraction(operand) ** power
        else:
            factors[ten_to + operand] = power
    return ratio, factors


def factors(point: Point) -> list[str]:
    """The points whose values the scale needs, with their ids."""
    used = {one.point: None for case in point.scale or () for one in case.rule.factors}
    return [f"{one.code} ({one.address})" for name in used for one in device(NAME).points if one.name == name]


def code_of(name: str) -> str:
    return next(str(point.code) for point in device(NAME).points if point.name == name)


def enum_of(point: Point) -> dict[int, str]:
    enum = point.digits.enum if point.digits else point.enum
    return {one.raw: one.quantity or one.title["de"] for one in enum.entries} if enum else {}


def texts(own: Mapping[int, str], printed: Mapping[str, str]) -> dict[int, str]:
    """The description's short names, replaced by the printed text that each stands in."""
    there = printed_texts(printed)
    return {raw: there[raw] if name.casefold() in there.get(raw, "").casefold() else name for raw, name in own.items()}


def printed_texts(printed: Mapping[str, str]) -> dict[int, str]:
    """What is printed by number; more than one digit is a pattern of bits."""
    return {int(digits, 2 if len(digits) > 1 else 10): text for digits, text in printed.items()}


def plain_title(text: str) -> str:
    return re.sub(r"cos ?[φϕ]", "cos phi", re.sub(r" ?/ ?", "/", text))


def part_of_relay(text: str) -> tuple[str, ...]:
    """The relay, and which of its events."""
    found = re.search(r"Relais (\d).*(erst|zweit|dritt)", text)
    return found.groups() if found else ()


FACTS = {
    "parameter": of_parameter,
    "telegram": of_telegram,
    "relay_event": of_entry,
    "analog_source": of_entry,
    "message": of_message,
}
"""How the facts of a row are looked up, by its kind."""
PLACES = {"parameter": parameters, "telegram": words}
"""Where the points of a row are found, for the kinds that have points."""
