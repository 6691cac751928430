"""What single cells print, in English and German notation; what is not clear is nothing."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import pytest
from fieldscribe.importing import cells
from fieldscribe.importing.draft_text import Names, comment, label_map, scalar, snake
from fieldscribe.importing.headings import role_of


@pytest.mark.parametrize(
    ("cell", "values"),
    [
        ("16", [16]),
        ("0010", [10]),
        ("0x10", [16]),
        ("1Ah", [26]),
        ("H'1F", [31]),
        ("17 (11h)", [17, 17]),
        ("1019h/\n1018h", [0x1019, 0x1018]),
        ("40001, 40002", [40001, 40002]),
        ("", []),
        ("1-16", None),
        ("40001-40002", None),
        ("-5", None),
        ("1A", None),
        ("1.5", None),
        ("h", None),
        ("123456789", None),
        ("see 17", None),
        ("²", None),
    ],
)
def test_addresses_are_taken_as_they_stand_or_not_at_all(cell: str, values: list[int] | None) -> None:
    found = cells.addresses_in(cell, is_hex=False)
    assert (None if found is None else [address.value for address in found]) == values


def test_a_column_of_hexadecimal_numbers_needs_no_marks() -> None:
    found = cells.addresses_in("10/1A/2h", is_hex=True)
    assert found == [("10", 16, True), ("1A", 26, True), ("2h", 2, True)]
    assert cells.addresses_in("10", is_hex=False) == [("10", 10, False)]
    assert [cells.looks_hex(cell) for cell in ("1A", " 00ff ", "10", "AB", "1Ah", "A")] == [True, True, *[False] * 4]


@pytest.mark.parametrize(
    ("cell", "text", "unit", "in_units"),
    [
        ("0-4000", "0..4000", "", False),
        ("0,0 – 400,0 Hz", "0..400", "Hz", True),
        ("0.0 to 400.5", "0..400.5", "", True),
        ("1-\n300000", "1..300000", "", False),
        ("0…500ms", "0..500", "ms", True),
        ("-70 bis -20", "-70..-20", "", False),
        ("zwischen 10% und 150%", "10..150", "%", True),
        ("between 0.5 and 2 kHz", "0.5..2", "kHz", True),
        ("0.00~650.00", "0..650", "", True),
        ("0.000 to 3.000", "0..3", "", True),
        ("0.5 to 3.000", "0.5..3", "", True),
        ("0, 1, 2,\n3, 10", "0, 1, 2, 3, 10", "", False),
        ("0,1,2", "0, 1, 2", "", False),
        ("-1; 1", "-1, 1", "", False),
    ],
)
def test_ranges(cell: str, text: str, unit: str, in_units: bool) -> None:
    assert cells.range_in(cell) == (text, unit, in_units)


@pytest.mark.parametrize(
    "cell",
    [
        "",
        "5",
        "0,1",
        "30-max. Freq.",
        "(b082 x 10)-600",
        "330-390\n660-780",
        "5..0",
        "0-5 sacks",
        "0-5 Hz, 2-3 s",
        "x 0-5",
        "0 bis 3.000",
        "0,5 bis 3.000 Hz",
        "1,000-2,000",
    ],
)
def test_a_cell_with_more_than_one_range_has_none(cell: str) -> None:
    assert cells.range_in(cell) is None


@pytest.mark.parametrize(
    ("cell", "quantity"),
    [
        ("0,1 Hz", (Fraction(1, 10), "Hz")),
        ("1/100 s", (Fraction(1, 100), "s")),
        ("1/1000", (Fraction(1, 1000), "")),
        ("x 0.1", (Fraction(1, 10), "")),
        ("*10", (Fraction(10), "")),
        ("\u22122.5 °C", (Fraction(-5, 2), "°C")),
        ("Hz", None),
        ("3.000", None),
        ("0.001", (Fraction(1, 1000), "")),
        ("1/3 s", (Fraction(1), "/3 s")),
        ("", None),
    ],
)
def test_quantities(cell: str, quantity: tuple[Fraction, str] | None) -> None:
    assert cells.quantity_in(cell) == quantity


@pytest.mark.parametrize(
    ("cell", "labels"),
    [
        ("00 .. off\n01 .. on", {"0": "off", "1": "on"}),
        ("0x0A: low\n0x0B: high", {"10": "low", "11": "high"}),
        ("0 = off, 1 = on; 2 = auto", {"0": "off", "1": "on", "2": "auto"}),
        ("00 (keypad), 01 (terminal)\n02 (bus)", {"0": "keypad", "1": "terminal", "2": "bus"}),
        ("0: Off 1: On", {"0": "Off", "1": "On"}),
        ("0 = off, 0 = on", {}),
        ("0 = off", {}),
        ("\n".join(f"{n} = x" for n in range(512)), {str(n): "x" for n in range(512)}),
        ("\n".join(f"{n} = x" for n in range(513)), {}),
        (f"0 = {'x' * 121}, 1 = y", {"0": "x" * 120, "1": "y"}),
        ("0 ... 100 %", {}),
        ("1 (Hz/s) bis 50 (Hz/s)", {}),
        ("no numbers", {}),
        ("", {}),
    ],
)
def test_labels(cell: str, labels: dict[str, str]) -> None:
    assert cells.labels_in(cell) == labels


READERS: dict[str, Callable[[str], object]] = {
    "access": cells.access_in,
    "type": cells.type_in,
    "bits": cells.bits_in,
    "unit": cells.unit_in,
    "space": cells.space_in,
    "reserved": cells.is_reserved,
}
WORDS = Path(__file__).with_name("words.txt").read_text("utf-8")
"""Who reads them, what they mean, and the words; nothing between commas is an empty cell."""


@pytest.mark.parametrize("row", WORDS.splitlines())
def test_words_of_cells(row: str) -> None:
    reader, meaning, words = (part.strip() for part in row.split("|"))
    listed = [word.strip() for word in words.split(",")]
    assert {word: str(READERS[reader](word)) for word in listed} == dict.fromkeys(listed, meaning)


def test_text_of_cells() -> None:
    assert cells.clean("<b>0 .. off</b><br>1 .. *1 on &amp; go") == "0 .. off\n1 .. *1 on & go"
    assert cells.clean("**bold** __x__ 2*3") == "bold x 2*3"
    assert cells.one_line("Frequenz-\nvorgabe *1") == "Frequenzvorgabe"
    assert [cells.phrase(cell) for cell in ("—", "--", "-5", " a\nb ")] == ["", "", "-5", "a b"]


HEADINGS: dict[str | None, list[str]] = {
    "code": ["Fkt.-Nr", "Parameter no."],
    "address": ["Reg. (hex)", "Modbus address", "Coil-Nr. (dez)", "Start Register", "Adresse", "PNU"],
    "name": ["Funktion", "Bezeichnung"],
    "access": ["R/W", "Zugriff"],
    "range": ["Wertebereich", "Min-Max"],
    "least": ["Min."],
    "greatest": ["Maximalwert"],
    "unit": ["Unit", "Maßeinheit"],
    "default": ["Factory setting", "Werkseinstellung"],
    "step": ["Res.", "Auflösung"],
    "type": ["Data type", "Daten-\ntyp"],
    "length": ["Length", "Anzahl Register"],
    "bits": ["Bit"],
    "space": ["Register type", "FC"],
    "description": ["Beschreibung", "Remarks"],
    "formula": ["Berechnungsformel:"],
    None: ["Nr.", "Grundwert", "Colour", "", "A sentence that is much too long to be the head of a column of a table"],
}


@pytest.mark.parametrize("role", HEADINGS)
def test_usual_headings(role: str | None) -> None:
    assert {heading: role_of(heading) for heading in HEADINGS[role]} == dict.fromkeys(HEADINGS[role], role)


def test_names_are_short_and_unique() -> None:
    assert snake("Überlast-Alarm der Schwelle (OL)", "x") == "ueberlast_alarm_schwelle_ol"
    assert snake("1. Hochlaufzeit", "f002") == "f002_1_hochlaufzeit"
    assert snake("t > 5 % °C", "x") == "t_above_5_percent_deg_c"
    assert snake("äöüÄÖÜß", "x") == "aeoeueaeoeuess"
    assert [snake(title, "x") for title in ("", "---", "The", "9")] == ["x", "x", "the", "x_9"]
    assert snake("word " * 40, "x") == "_".join(["word"] * 9)
    names = Names()
    assert [names.give("speed", "f004") for _ in range(4)] == ["speed", "speed_f004", "speed_2", "speed_3"]
    assert [names.give("torque") for _ in range(3)] == ["torque", "torque_2", "torque_3"]


def test_blocks_of_labels() -> None:
    labels = {"0": "Off", "1": "off", "7..4": "Eingang"}
    assert label_map(labels, "", "en") == (
        '\n  0: {name: "off", en: "Off"}\n  1: {name: off_1, en: "off"}\n  7..4: {name: eingang, en: Eingang}'
    )
    assert label_map({"7..4": "A", "3..2": "A"}, "", "en") == (
        "\n  7..4: {name: a, en: A}\n  3..2: {name: a_3_2, en: A}"
    )
    assert label_map({"3": "Ein"}, "title", "de") == "\n  3: {name: ein, title: {en: Ein, de: Ein}}"


@pytest.mark.parametrize(
    ("text", "yaml"),
    [
        ("Base frequency", "Base frequency"),
        ("off", '"off"'),
        ("a: b", '"a: b"'),
        ("x # y", '"x # y"'),
        ("- a", '"- a"'),
        ("4136", '"4136"'),
        ("a\n---\nb", "a --- b"),
        ('"}, x: [', '"\\"}, x: ["'),
        ("x\u202ey", "xy"),
        ("", '""'),
    ],
)
def test_text_stays_text(text: str, yaml: str) -> None:
    assert scalar(text) == yaml
    assert "\n" not in comment(text)


def test_long_questions_are_cut() -> None:
    assert comment("x" * 400) == f"# ? {'x' * 400}"
    assert comment("x" * 401) == f"# ? {'x' * 400} …"
