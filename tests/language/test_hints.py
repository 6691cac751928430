"""Hints lead out: what a hint says to write passes, and leads into no other finding."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from fieldscribe.diagnostics import Diagnostic
from support.described import compile_in, described, loaded_in

BUS = """
  framings: [rtu]
  units: 1..247
  functions: {01h: read_coils, 03h: read, 05h: write_coil, 06h: write, 10h: write_many}"""
MODE = "- {name: mode, at: 900, range: 0..5}\n"
_LINE = re.compile(r"`(([a-z_]+): .*?)`(?= |$|,|;|:)")

WRITTEN = {
    "scale: value = raw * 0.1": [
        "0.1",
        "x 0.1",
        '"0,1"',
        "0.1 V",
        "value = raw x 0.1",
        "value == raw * 0.1",
        "{factor: 0.1}",
    ],
    "scale: value = raw * 10": ["10", '"*10"'],
    "scale: value = raw / 65536": ["0.0000152588"],
    "scale: value = raw/10": ["raw/10"],
    "scale: value = raw / 10": ["1/10", '"1:10"'],
    "scale: value = raw * 10 ** -1": ["10^-1"],
    "scale: value = 0.1 * raw": ["y = 0.1 * x"],
    "range: 0..100": ["0-100", "0 to 100", "0...100", "{min: 0, max: 100}"],
    "range_in_units: 0.0..50.0": ["0.0-50.0"],
    "access: r": ["ro", "read-only"],
    "type: u32": ["u32_abcd", "DWORD", "uint32_be"],
    "special: {FFFFh: name_of_it}": ["[FFFFh]", "FFFFh"],
    "special: {8000h: name_of_it, 7FFFh: name_of_it_2}": ["[8000h, 7FFFh]"],
    "unit: Hz": ["0.1 Hz", "1/10 Hz"],
    "access: rw": ["R/W"],
    "type: s16": ["int16", "signed short"],
    "type: s32": ["INT32"],
    "type: f32": ["float", "real"],
    "type: f64": ["double"],
    "type: u16": ["uint16", "word", "U16"],
    "type: bit": ["bool"],
    "reserved: yes": ["1"],
    "words: low first": ["little endian, type: u32"],
    "changes: never": ["constant"],
    "steps: {0: 10}": ["10"],
    "bits: 15..8": ["15:8", "[8, 15]"],
    "bits: 3": ["b3"],
    "enum: {0: off, 1: on_line}": ["[Off, On line]"],
    "enum: {0: off, 1: on}": ['"0=off, 1=on"'],
    "flags: {0: ready, 1: fault}": ["[ready, fault]"],
    'section: "4.2"': ["4.2"],
    'when: "mode in (0, 1)"': ["mode in (0, 1)"],
    'range: "0, 1, 2"': ["0, 1, 2"],
    'title: "Speed, actual value"': ["Speed, actual value"],
}
"""What other tools and manuals write as the value of a key, by the line that is right."""

COUNTS = [
    "type: u32, decimals: 12, scale: value = raw * 0.1",
    "type: u32, decimals: 0, scale: value = raw * 0.1",
    "decimals: 1, scale: value = raw * 0.01",
    "type: s32, decimals: 12, scale: value = raw * 0.01",
    "type: u32, scale: value = raw * 0.0000152588",
    "type: s32, scale: value = raw * 0.000000011920929",
    "type: u32, scale: value = raw * 0.00001525878906",
    "type: u32, scale: value = raw * 0.0000000001",
    "type: u32, decimals: 3, scale: value = raw * 0.0000000001",
    "type: u32, decimals: 12, scale: value = raw * 0.0000000001",
    "scale: value = raw * 0.0000000000000001",
    "decimals: 0.01, scale: value = raw * 0.01",
]
"""Points whose counts do not fit, or whose decimals are wrong."""


def findings(folder: Path, facts: str) -> tuple[Diagnostic, ...]:
    """What is found of a point with these facts."""
    space = ", space: coil" if "type: bit" in facts or "type: bool" in facts else ""
    return found_in(f"- {{name: made, at: 1{space}, {facts}}}\n", folder)


def found_in(points: str, folder: Path) -> tuple[Diagnostic, ...]:
    """What is found of these points beside `mode`."""
    return compile_in(folder, described(MODE + points, bus=BUS))[1]


def told(hint: str) -> str:
    """The whole line that a hint shows; the first where it shows a choice."""
    found = _LINE.search(hint)
    if found is not None:
        return found[1]
    quoted = re.fullmatch(r'quote it: (".*")', hint)
    return "" if quoted is None else f"section: {quoted[1]}"


@pytest.mark.parametrize(("right", "wrong"), [(right, value) for right, values in WRITTEN.items() for value in values])
def test_the_line_that_a_hint_shows_works(tmp_path: Path, right: str, wrong: str) -> None:
    key = right.partition(":")[0]
    (first, *_) = (one for one in findings(tmp_path, f"{key}: {wrong}") if one.severity == "error")
    assert told(first.hint or "") == right
    _, separator, kind = wrong.partition(", type: ")
    assert not findings(tmp_path, right + separator + kind)


def applied(facts: str, hint: str) -> str:
    """The facts with what the hint says instead of what they said of that key, or without a key to leave out."""
    parts = re.split(r", (?=[a-z_]+: )", facts)
    if (superfluous := re.match(r"leave `(\w+)` out", hint)) is not None:
        return ", ".join(one for one in parts if not one.startswith(f"{superfluous[1]}: "))
    line = told(hint)
    key = line.partition(":")[0]
    return ", ".join([*(one for one in parts if not one.startswith(f"{key}: ")), line])


@pytest.mark.parametrize("facts", COUNTS)
def test_hints_about_decimals_lead_out(tmp_path: Path, facts: str) -> None:
    """Each hint is applied once; then nothing is wrong. A circle of hints would come back here."""
    found = [one for one in findings(tmp_path, facts) if one.severity == "error"]
    for one in found:
        assert told(one.hint or "") or (one.hint or "").startswith("leave `decimals` out"), one.hint
    if found:
        assert not findings(tmp_path, applied(facts, found[0].hint or ""))


@pytest.mark.parametrize(
    ("facts", "line"),
    [
        ("scale: value = raw * 0.0000152588", "value = raw / 65536"),
        ("scale: value = raw * 0.00610352", "value = raw * 100 / 16384"),
        ("scale: raw = value / 0.33333", "raw = value * 3"),
    ],
)
def test_a_cut_decimal_is_a_warning_that_can_be_followed(tmp_path: Path, facts: str, line: str) -> None:
    (only,) = findings(tmp_path, facts)
    assert (only.severity, only.rule) == ("warning", "cut-decimal")
    assert only.hint == f"write `{line}` to keep it exact"
    assert not findings(tmp_path, f"scale: {line}")


@pytest.mark.parametrize(
    ("facts", "rule", "hint"),
    [
        ("type: int128", "wrong-form", "write `type: bytes` with `length: 8`"),
        ("type: mac", "wrong-form", "write `type: bytes` with `notation: eui48`"),
        ("type: int48", "wrong-form", "write `type: s48`"),
        ("type: version", "wrong-form", "write `type: bytes` with `notation: version`"),
        ("type: datetime", "wrong-form", "such as `parts: [year, month, day]`"),
        ("type: text, length: 4", "missing-key", "write `characters` in place of `length`"),
        ("indices: 3", "missing-key", "such as `number + (index - 1) * 2`"),
        ("scale: [{when: mode == 0, rule: 0.1}]", "wrong-type", "`rule: value = raw * 0.1`"),
        ("scale: [{when: mode == 0, rule: x 0.1}]", "bad-formula", "`rule: value = raw * 0.1`"),
        ("no_value: [7FFFh]", "unknown-key", "`special: {7FFFh: {name: not_available, no_value: yes}}`"),
        ("size: 2", "unknown-key", "the `type` says how wide a number is"),
        ("byte_order: little", "unknown-key", "`words: low first`"),
        ("multiplier: 0.1", "unknown-key", "`scale: value = raw * 0.1`"),
        ("divisor: 10", "unknown-key", "`scale: value = raw / 10`"),
        ("offset: -40", "unknown-key", "what is added to a number stands in its rule"),
        ("precision: 1", "unknown-key", "did you mean `decimals`?"),
        ("readonly: true", "unknown-key", "write `access: r`"),
        ("writable: true", "unknown-key", "write `access: rw`"),
        ("writable: false", "unknown-key", "did you mean `access`?"),
        ("function: 3", "unknown-key", "the `space` says what is read and written"),
        ("min: 0", "unknown-key", "`range: low..high`"),
        ("comment: x", "unknown-key", "did you mean `note`?"),
        ("space: HR", "unknown-space", "write `space: holding`"),
        ("space: input_registers", "unknown-space", "write `space: input`"),
        ("format: int16", "unknown-format", "write `type: s16`"),
        ("unit: 10", "wrong-type", "a unit is a symbol such as `Hz`"),
        ("default: 50.0, scale: value = raw * 0.1", "wrong-type", "`default_in_units: 50.0`"),
        ("default: auto, enum: {0: off, 1: on}", "bad-number", "write a number, or one of off, on"),
        ("enum: {0: off, 1-3: on}", "bad-number", "write a row for each number"),
        ("enum: {0: {name: off, title: Off}}", "unknown-key", "`{name: off, en: Off}`"),
        ("flags: {bit0: ready}", "unknown-key", "write `0`"),
        ("flags: {0-3: mode_bits}", "unknown-key", "write `3..0`"),
        ("flags: {1: a1, 2: a2, 4: a3, 8: a4}", "looks-like-masks", "keys are bit numbers from 0"),
        ("flags: {0: {name: fault, inverted: true}}", "unknown-key", "write `active: 0`"),
        ("special: 65535", "wrong-type", "write `special: {65535: name_of_it}`"),
        ("when: mode is 1", "bad-formula", "write `mode == 1`"),
        ("when: if mode == 1", "bad-formula", "write `mode == 1`"),
        ('when: "mode in [0, 1]"', "bad-formula", "write `mode in (0, 1)`"),
        ('when: "mode in 0..1"', "bad-formula", "write `mode >= 0 and mode <= 1`"),
        ("when: mode == 1 || mode == 2", "bad-formula", "write `mode == 1 or mode == 2`"),
        ("when: {mode: 1}", "wrong-type", "write `when: mode == 1`"),
        ("printed: 40002", "wrong-type", "`printed: {wire: 40002}`"),
        ("printed: {modicon: 40002}", "unknown-key", "`numbering: {modicon: wire + 1}`"),
        ("line: 780-790", "wrong-type", "write the line where it begins: `line: 780`"),
        ("range: 0..FFFF", "unknown-point", "if a hexadecimal number is meant, write 0FFFFh"),
        ('range: ">= 0"', "bad-formula", "an interval has both ends"),
        ("range: 0.0..50.0", "bad-number", "write `range_in_units: 0.0..50.0`"),
        ("keeps: eeprom", "wrong-choice", "write `keeps: yes`"),
        ("digits: 4", "wrong-type", "write `digits: {count: 4, enum: …}`"),
        ("title: {english: X}", "unknown-key", "write `en`"),
        ("values: {0: off, 1: on}", "unknown-key", "did you mean `enum`?"),
        ("values: 0..4", "unknown-key", "did you mean `range`?"),
        (
            "keeps: choice",
            "wrong-choice",
            "write `keeps: yes`, `keeps: no`, or `keep_with` and the command that stores",
        ),
        ("type", "yaml-comma", "give it a value: `type: …`"),
        ("type: BYTE", "wrong-form", "write `type: u8` with the `bits: 7..0`"),
        ("type: string", "wrong-form", "write `type: text` with `characters: …`"),
        ("type: bool", "wrong-form", "one bit of a word is `bits: 0`"),
        ("default: $2a", "bad-number", "write 2Ah"),
        ("default: 16#FF", "bad-number", "write 0xFF"),
        ("default: 2a hex", "bad-number", "write 2Ah"),
    ],
)
def test_hints_name_what_is_meant(tmp_path: Path, facts: str, rule: str, hint: str) -> None:
    found = [one for one in findings(tmp_path, facts) if one.rule == rule]
    assert hint in (found[0].hint or "")


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("größe", "write `groesse`"),
        ("2nd_speed", "a name starts with a letter: `speed_2`, not `2nd_speed`"),
        ("Base Frequency", "write `base_frequency`"),
    ],
)
def test_names_are_made(tmp_path: Path, name: str, hint: str) -> None:
    assert found_in(f"- {{name: {name}, at: 1}}\n", tmp_path)[0].hint == hint


@pytest.mark.parametrize("at", ["1 - 2", "1..2"])
def test_a_point_of_two_words_stands_once(tmp_path: Path, at: str) -> None:
    assert "write `at: 1`" in (found_in(f"- {{name: made, at: {at}, type: u32}}\n", tmp_path)[0].hint or "")


def test_an_address_may_be_computed(tmp_path: Path) -> None:
    assert loaded_in(tmp_path, described("- {name: made, at: 1029h - 1}\n")).points[0].address == 0x1028


@pytest.mark.parametrize(
    ("right", "wrong", "hint"),
    [
        ("family: modbus", "family: Modbus RTU", "write `family: modbus`; rtu and tcp are `framings` under `bus`"),
        ("family: modbus", "family: canopen", "the family can is for a maker's own messages"),
        ("language: en", "language: German", "write `language: de`"),
        ("units: 1..247", "units: 1-247", "write 1..247"),
        ("units: 1..247", "units: [1, 247]", "write `units: 1..247`"),
        ("units: 1..247", "units: 1..247\n  gaps: {holding: [100-200]}", "write 100..200"),
        ("units: 1..247", "units: 1..247\n  words: little", "write `words: low first`"),
        ("units: 1..247", "units: 1..247\n  baud: 9600", "`serial: {baud: 9600}`"),
        ("framings: [rtu]", "framings: [RTU]", "did you mean `rtu`?"),
        ("functions: {01h: read_coils,", "functions: {read_coils: 1,", "the number stands first: `1: read_coils`"),
        ("group: main", "name: main", "did you mean `group`?"),
        ('source: {document: manual, section: "1"}', "source: page 5", 'section: "page 5"}`'),
        ("space: holding", "space: HR", "write `space: holding`"),
        ("space: holding", "space: holding\nnumbering: {modicon: +1}", "write a formula: wire + 1"),
        ("group:", "frames: [{name: f, bytes: [1, 3, 0]}]\ngroup:", "write `bytes: 01 03 00`"),
        ("group:", "frames: [{name: f, bytes: 0x01 0x3}]\ngroup:", "write `bytes: 01 03`"),
        ("---", "groups: [{group: a, space: holding}]\n---", "a group is a part: `group: …`, `space: …` and `points"),
        ("---", "access: rw\n---", "below a line `---` or in a file under `parts`"),
        ("group: main", "group: {name: main}", "write `group: main` and its other keys below"),
        ("group: main", "group: main\nvendor: Maker", "this key belongs in the head of device.yaml"),
        ("group: main", "group: main\nwords: 3", "a text has `characters: 6`, bytes"),
        ("group: main", "group: main\nword_order: low first", "the order of words is `words: high first` or"),
        ("---", "variants: {size: {title: Size, values: [a, 2]}}\n---", "write `values: {a: {}, 2: {}}`"),
        ("---", "variants: {size: {values: [a, b, c, d, e, f, g, h]}}\n---", "g: {}, h: {}}`"),
        (
            "---",
            "variants: {size: {values: [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q]}}\n---",
            "for example {200V: {title: 200 V",
        ),
    ],
)
def test_hints_for_the_whole_file(tmp_path: Path, right: str, wrong: str, hint: str) -> None:
    text = described(MODE, bus=BUS)
    assert right in text
    hints = [one.hint or "" for one in compile_in(tmp_path, text.replace(right, wrong, 1))[1]]
    assert any(hint in one for one in hints), hints
    assert len(hints) == 1 or "group" in right, hints


def test_a_number_for_people_is_no_address(tmp_path: Path) -> None:
    (first, *_) = found_in("- {name: made, at: 4x0010}\n", tmp_path)
    assert "on the wire it is 9, in the space `holding`" in (first.hint or "")


@pytest.mark.parametrize(
    "facts",
    [
        "flags: {0Fh: last, 0x0: first, H'3..02h: middle}",
        "fixed: {0Ah: 1, 3h..0: 0}, bits: 15",
        "enum: {FFh: off, 0x10: on, 0b11: third}",
        "special: {FFFFh: broken}",
        "steps: {0Ah: 10}",
    ],
)
def test_numbers_as_keys_are_taken_as_manuals_write_them(tmp_path: Path, facts: str) -> None:
    assert not findings(tmp_path, facts)


def test_the_two_notations_of_a_key_are_one_number(tmp_path: Path) -> None:
    (only,) = findings(tmp_path, "flags: {10: ten, 0Ah: also_ten}")
    assert "bit 10 is given twice" in only.message


WIDE = [
    ("range: 0..4294967295", "scale: raw = value / k / k", "`k` a narrower `range` that ends at 2147483647 at most"),
    ("range: -20..20, type: s16", "scale: value = raw * 10 ** k", "`k` a narrower `range` within -18..18"),
    ("range: 0..5", "scale: value = raw * 9223372036854775808", "take the unit with another prefix"),
]


@pytest.mark.parametrize(("factor", "scale", "way_out"), WIDE)
def test_a_scale_that_is_too_wide_names_a_way_that_works(factor: str, scale: str, way_out: str, tmp_path: Path) -> None:
    kind = "" if "type" in factor else ", type: u32"
    said = f"- {{name: k, at: 10, {factor}{kind}}}\n- {{name: a, at: 0, type: u32, {scale}}}\n"
    (one,) = found_in(said, tmp_path)
    assert "bits" in one.message
    assert one.hint is not None
    assert way_out in one.hint
    room = re.search(r"ends at (\d+)|within (\S+)", one.hint)
    if room is not None:
        narrow = f"range: {room[2] or f'0..{room[1]}'}"
        assert not found_in(re.sub(r"range: [-.\d]+", narrow, said, count=1), tmp_path)
