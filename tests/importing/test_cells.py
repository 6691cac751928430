"""What single cells and heads are taken for, in English and German notation."""

from __future__ import annotations

from fractions import Fraction

import pytest
from fieldscribe.importing import numbers, yaml_text
from fieldscribe.importing.addresses import Number, numberings_of, reference_of, settled
from fieldscribe.importing.cell_text import clean, one_line
from fieldscribe.importing.columns import said_columns
from fieldscribe.importing.head_words import role_of
from fieldscribe.importing.labels import labels_in
from fieldscribe.importing.meaning import meaning_of
from fieldscribe.importing.naming import Names, snake
from fieldscribe.importing.said import take_apart
from fieldscribe.importing.words_of_rows import access_of, bits_of, half_of, type_of


@pytest.mark.parametrize(
    ("text", "ranges"),
    [
        ("0-4000", ["0..4000"]),
        ("0,0 – 400,0 Hz", ["0..400 Hz"]),
        ("0.0 to 400.0", ["0..400"]),
        ("1-\n300000", ["1..300000"]),
        ("0…500ms", ["0..500 ms"]),
        ("-70 bis -99", ["-99..-70"]),
        ("zwischen 10% und 150%", ["10..150 %"]),
        ("between 0.5 and 2 kHz", ["0.5..2 kHz"]),
        ("0.00~650.00", ["0..650"]),
        ("330-390\n660-780", ["330..390", "660..780"]),
        ("10240 bis 17920, dies entspricht 40Hz bis 70Hz.", ["10240..17920", "40..70 Hz"]),
        ("1 (Hz/s) bis 50 (Hz/s)", ["1..50 Hz/s"]),
        ("30-max. Freq.", []),
    ],
)
def test_ranges(text: str, ranges: list[str]) -> None:
    assert [f"{span.as_yaml} {span.unit}".strip() for span in numbers.spans(text)] == ranges


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("0, 1, 2,\n3, 10", [0, 1, 2, 3, 10]),
        ("0,1,2", [0, 1, 2]),
        ("1 oder 2 Stop bits", [1, 2]),
        ("0,1", None),
        ("5", None),
    ],
)
def test_lists(text: str, values: list[int] | None) -> None:
    assert numbers.listed(text) == values


@pytest.mark.parametrize(
    ("text", "labels"),
    [
        ("2 choices:\n00 .. off\n01 .. on", {0: "off", 1: "on"}),
        ("0 = off, 1 = on; 2 = auto", {0: "off", 1: "on", 2: "auto"}),
        ("00 (keypad), 01 (terminal)\n02 (bus)", {0: "keypad", 1: "terminal", 2: "bus"}),
        ("0: Off 1: On", {0: "Off", 1: "On"}),
        ("00 .. unbe-\nkannt\n01 .. ein", {0: "unbekannt", 1: "ein"}),
        ("0 ... 100 %", {}),
        ("1 (Hz/s) bis 50 (Hz/s)", {}),
        ("no numbers", {}),
    ],
)
def test_labels(text: str, labels: dict[int, str]) -> None:
    assert labels_in(text) == labels


@pytest.mark.parametrize(
    ("head", "role"),
    [
        ("Fkt.-Nr", "code"),
        ("Reg. (hex)", "address"),
        ("Modbus address", "address"),
        ("Coil-Nr. (dez)", "address"),
        ("Start Register", "address"),
        ("Funktion", "name"),
        ("R/W", "access"),
        ("Zugriff", "access"),
        ("Wertebereich", "range"),
        ("Unit", "unit"),
        ("Factory setting", "default"),
        ("Werkseinstellung", "default"),
        ("Res.", "step"),
        ("Grundwert", "step or default"),
        ("Data type", "type"),
        ("Beschreibung", "description"),
        ("Berechnungsformel:", "formula"),
        ("Min.", "least"),
        ("CRC", None),
        ("A sentence that is much too long to be the head of a column of a table", None),
    ],
)
def test_heads(head: str, role: str | None) -> None:
    assert role_of(head) == role


@pytest.mark.parametrize(
    ("cells", "taken"),
    [
        (
            {"range": "0-4000", "step": "0,1 Hz", "description": "0,0 - 400,0 Hz"},
            ("0..4000", None, "value = raw * 0.1", "Hz", 0),
        ),
        ({"range": "0.0 to 400.0", "step": "0.1", "unit": "Hz"}, (None, "0..400", "value = raw * 0.1", "Hz", 0)),
        ({"range": "0-400", "step": "0.1", "unit": "Hz"}, (None, None, "value = raw * 0.1", "Hz", 1)),
        ({"range": "0-50", "description": "0,0 - 5,0 s"}, ("0..50", None, "value = raw * 0.1", "s", 1)),
        ({"range": "5 bis 256, dies entspricht 0,02Hz bis 1,00Hz"}, ("5..256", None, "raw = value * 256", "Hz", 0)),
        (
            {"range": "20-140", "step": "0.1 Hz", "description": "2.0 - 14.0 kHz"},
            ("20..140", None, "value = raw * 0.1", "kHz", 1),
        ),
        ({"range": "0-999999", "step": "0.01 Hz", "description": "0.00 - 99999"}, ("0..999999", None, "~", "Hz", 1)),
        ({"range": "0.0 to 5.0 V"}, (None, "0..5", "~", "V", 1)),
        ({"step": "10", "unit": "V"}, (None, None, "~", "V", 1)),
        ({"unit": "1/100 Hz"}, (None, None, "value = raw * 0.01", "Hz", 0)),
        ({"formula": "Wert = f[Hz] * 256 (1/Hz)"}, (None, None, "raw = value * 256", "", 0)),
        ({"formula": "Wert = U[V] * FACTOR / 400"}, (None, None, "~", "", 1)),
        ({"range": "(b082 x\n10)-600", "step": "0.1 Hz"}, ("b082 * 10 .. 600", None, "value = raw * 0.1", "Hz", 0)),
        ({"range": "30-max. Freq.", "step": "1 Hz"}, (None, None, None, "Hz", 1)),
        ({"unit": "sacks"}, (None, None, None, "", 1)),
        (
            {"least": "-40.0", "greatest": "125.0", "step": "0.1", "unit": "°C"},
            (None, "-40..125", "value = raw * 0.1", "°C", 0),
        ),
    ],
)
def test_what_raw_numbers_mean(cells: dict[str, str], taken: tuple[object, ...]) -> None:
    meaning = meaning_of(take_apart(cells, ""), None)
    assert (meaning.range, meaning.range_in_units, meaning.scale, meaning.unit, len(meaning.questions)) == taken


def test_other_rows_say_how_a_column_prints_its_ranges() -> None:
    said = take_apart({"range": "0-400", "step": "0.1", "unit": "Hz"}, "")
    assert meaning_of(said, "raw").range == "0..400"
    assert meaning_of(said, "units").questions == ["is the range 0..400 raw, or in the unit?"]


@pytest.mark.parametrize(
    ("votes", "around", "address"),
    [
        ([16, 16, 16, 16], (None, None), 16),
        ([4119, 4119, 4119, 4219], (None, None), 4119),
        ([4385, 4385, 4369, 4369], (4381, 4390), 4385),
        ([4385, 4369], (None, None), None),
        ([], (1, 5), None),
    ],
)
def test_the_most_numbers_say_the_address(
    votes: list[int], around: tuple[int | None, int | None], address: int | None
) -> None:
    assert settled(votes, *around)[0] == address


@pytest.mark.parametrize(
    ("printed", "offsets", "space"),
    [
        ([(1, 0), (2, 1), (9, 8)], [1, 0], None),
        ([(40001,), (40002,)], [40001], "holding"),
        ([(300001,), (300017,)], [300001], "input"),
        ([(5,), (7,)], [0], None),
    ],
)
def test_numberings(printed: list[tuple[int, ...]], offsets: list[int], space: str | None) -> None:
    rows = [[Number((0, slot), value, str(value)) for slot, value in enumerate(row)] for row in printed]
    numberings = numberings_of(rows)
    assert ([numberings.offsets[0, slot] for slot in range(len(offsets))], numberings.space) == (offsets, space)


def test_a_reference_begins_with_the_digit_of_its_space() -> None:
    assert [reference_of(number) for number in (40001, 10017, 400001, 40000, 4097, 20001)] == [
        (40001, "holding"),
        (10001, "discrete"),
        (400001, "holding"),
        None,
        None,
        None,
    ]


def test_words_of_rows() -> None:
    assert [access_of(cell) for cell in ("R/W", "RO", "nur lesen", "—", "perhaps")] == ["rw", "r", "r", "none", None]
    assert [type_of(cell)[0] for cell in ("UINT16", "Unsigned 32 bit", "float", "INT", "BCD")] == [
        "u16",
        "u32",
        "f32",
        None,
        None,
    ]
    assert half_of("Energy (high word)") == ("Energy", "high")
    assert half_of("d004 (low)") == ("d004", "low")
    assert half_of("High") == ("High", "")
    assert [bits_of("", cell) for cell in ("Bit 11 (from 0)", "Word")] == ["11", None]
    assert [bits_of(cell, "") for cell in ("15 + 14", "7..4", "99")] == ["15..14", "7..4", None]


def test_text_of_cells() -> None:
    assert clean("<b>0 .. off</b><br>1 .. *1 on &amp; go") == "0 .. off\n1 .. *1 on & go"
    assert one_line("Frequenz-\nvorgabe *1") == "Frequenzvorgabe"
    assert clean(r"$\frac{1}{100}\text{ Hz}$") == "(1/100) Hz"


def test_names_are_short_and_given_once() -> None:
    assert snake("Überlast-Alarm Schwelle (OL)") == "ueberlast_alarm_schwelle_ol"
    assert snake("1. Hochlaufzeit", "f002") == "f002_1_hochlaufzeit"
    assert len(snake("word " * 40)) <= 48
    names = Names()
    assert [names.give("speed", "f004") for _ in range(4)] == ["speed", "speed_f004", "speed_2", "speed_3"]


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
    assert yaml_text.text(text) == yaml
    assert "\n" not in yaml_text.question(text)


def test_decimals_are_exact() -> None:
    shown = [numbers.decimal(Fraction(text)) for text in ("0.1", "-2.50", "400", "1/8", "-0.001")]
    assert shown == ["0.1", "-2.5", "400", "0.125", "-0.001"]


@pytest.mark.parametrize("said", ["code", "code=0", "code=x", "colour=1", "=1", "code=99999999"])
def test_columns_that_are_none(said: str) -> None:
    with pytest.raises(ValueError, match="column"):
        said_columns(said)
