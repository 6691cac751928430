"""Rows that only a new edition has come as drafts in the form of the rows beside them, and compile when pasted."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.cli import main

if TYPE_CHECKING:
    from pathlib import Path

OLD = """# Wärmepumpe

| Register, Gruppe „H“ (Heizung) | | | | | | |
|---|---|---|---|---|---|---|
| Nr. | Funktion | R/W | Beschreibung | Reg. (hex) | Bereich | Auflösung |
| H01 | Sollwert | R/W | 20,0 - 55,0 °C | 0011h/<br>0010h | 200-550 | 0,1 °C |
| H02 | Hysterese | R/W | 0,5 - 5,0 °C | 0012h/<br>0011h | 5-50 | 0,1 °C |
| H03 | Betriebsart | R/W | 2 Wahlmöglichkeiten:<br>00 .. aus<br>01 .. ein | 0013h/<br>0012h | 0, 1 | — |

Ende.
"""
DEVICE = """fieldscribe: 1
device: pump
version: 1.0.0
vendor: Example
model: HP 12
title: {en: Heat pump}
family: modbus
documents: {manual: {title: Wärmepumpe, language: de, access: {r: [R], rw: [R/W]}, file: old.txt}}
bus: {framings: [rtu], units: 1..247, functions: {03h: read_holding_registers, 06h: write_register}}
looked_through: [{lines: 1..5, why: Heads.}]
parts:
- heating.yaml
"""
HEATING = """group: heating
title: {en: Heating, de: Heizung}
space: holding
access: rw
source: {document: manual, section: Gruppe H}
numbering: {modicon: wire + 1}
points:
  - code: H01
    name: setpoint
    title: {en: Setpoint, de: Sollwert}
    at: 0010h
    range: 200..550
    scale: value = raw * 0.1
    unit: °C
    line: 6
    printed: {modicon: 0011h, wire: 0010h, range: 200..550, range_in_units: 20.0..55.0, resolution: 0.1 °C}
  - code: H02
    name: hysteresis
    title: {en: Hysteresis, de: Hysterese}
    at: 0011h
    range: 5..50
    scale: value = raw * 0.1
    unit: °C
    line: 7
    printed: {modicon: 0012h, wire: 0011h, range: 5..50, range_in_units: 0.5..5.0, resolution: 0.1 °C}
  - code: H03
    name: mode
    title: {en: Mode, de: Betriebsart}
    at: 0012h
    range: 0, 1
    enum: {0: {name: "off", en: "Off", de: aus}, 1: {name: "on", en: "On", de: ein}}
    line: 8
    printed: {modicon: 0013h, wire: 0012h, range: "0, 1", choices: 2}
"""
DELAY = "| H09 | Verzögerung | R | 0 - 30 s | 0019h/<br>0018h | 0-30 | 1 s |\n"
PUMP = "| H10 | Pumpe | R/W | 00 .. aus<br>07 .. Dauerlauf | 001Ah/<br>0019h | 0, 7 | — |\n"
SECTION = """| Register, Gruppe „K“ (Kühlung) | | | | | | |
|---|---|---|---|---|---|---|
| Nr. | Funktion | R/W | Beschreibung | Reg. (hex) | Bereich | Auflösung |
| K01 | Sollwert | R | 10,0 - 25,0 °C | 0021h/<br>0020h | 100-250 | 0,1 °C |
Fuß der Seite
| K02 | Frostschutz | R | 2,0 - 5,0 °C | 0022h/<br>0021h | 20-50 | 0,1 °C |

"""


class Pump:
    """The description in parts, in a folder with both editions and a glossary."""

    def __init__(self, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.folder, self.capsys = folder, capsys
        self.parts = folder / "pump"
        self.parts.mkdir()
        (folder / "old.txt").write_text(OLD, "utf-8")
        (folder / "glossary.yaml").write_text("terms:\n  Pumpe: [pump, pumping]\n", "utf-8")
        self.write(DEVICE, HEATING)

    def write(self, device: str, heating: str) -> None:
        """The description's files."""
        (self.parts / "device.yaml").write_text(device, "utf-8")
        (self.parts / "heating.yaml").write_text(heating, "utf-8")

    def audit(self, new: str) -> dict[str, Any]:
        """What a new edition means for it."""
        (self.folder / "new.txt").write_text(new, "utf-8")
        files = ["--manual", str(self.folder / "new.txt"), "--old", str(self.folder / "old.txt")]
        assert main(["audit", str(self.parts), *files, "--format", "json"]) in (0, 1)
        report: dict[str, Any] = json.loads(self.capsys.readouterr().out)
        return report

    def drafts(self, new: str) -> list[dict[str, Any]]:
        """The drafts for a new edition."""
        return [draft for finding in self.audit(new)["findings"] for draft in finding["drafts"]]

    def findings(self) -> list[dict[str, Any]]:
        """What `check` says of it."""
        main(["check", str(self.parts), "--format", "json"])
        findings: list[dict[str, Any]] = json.loads(self.capsys.readouterr().out)["findings"]
        return findings


@pytest.fixture
def pump(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Pump:
    return Pump(tmp_path, capsys)


def test_a_row_is_drafted_as_its_neighbours_are_written(pump: Pump) -> None:
    [draft] = pump.drafts(OLD.replace("| H03", DELAY + "| H03"))
    assert draft["place"] == f"below {pump.parts}/heating.yaml:17:11"
    assert draft["yaml"].splitlines() == [
        "  - code: H09",
        "    name: verzoegerung  # ? in English",
        "    title: {de: Verzögerung}  # ? en",
        "    at: 0018h",
        "    access: r",
        "    range: 0..30",
        "    unit: s",
        "    line: 8",
        "    printed: {modicon: 0019h, wire: 0018h, range: 0..30, range_in_units: 0..30, resolution: 1 s}",
    ]


def test_rows_side_by_side_stand_one_below_the_other(pump: Pump) -> None:
    rows = DELAY + PUMP + DELAY.replace("H09", "H11").replace("0019h/<br>0018h", "001Bh/<br>001Ah")
    first, second, third = pump.drafts(OLD.replace("| H01", rows + "| H01"))
    assert (first["place"], first["kind"]) == (f"above {pump.parts}/heating.yaml:8:11", "a point")
    assert [second["place"], third["place"]] == ["below the point of line 6", "below the point of line 7"]


def test_what_is_known_in_english_is_not_asked_for(pump: Pump) -> None:
    """The glossary has the title, the description itself one of the labels."""
    [draft] = pump.drafts(OLD.replace("\nEnde", PUMP + "\nEnde"))
    assert draft["yaml"].splitlines()[1:8] == [
        "    name: pump",
        "    title: {en: Pump, de: Pumpe}",
        "    at: 0019h",
        "    range: 0, 7",
        "    enum:",
        '      0: {name: aus, en: "Off", de: aus}',
        "      7: {name: dauerlauf, de: Dauerlauf}  # ? en",
    ]


def test_a_new_section_is_drafted_with_its_group(pump: Pump) -> None:
    [first] = pump.drafts(OLD.replace("Ende", SECTION + "Ende"))
    assert first["place"] == f"in a file of its own, named under `parts` below {pump.parts}/device.yaml:12:3"
    assert first["yaml"].splitlines()[:9] == [
        "group: kuehlung  # ? in English",
        "title: {de: Kühlung}  # ? en",
        "space: holding",
        "numbering: {modicon: wire + 1}",
        "access: r",
        "source: {document: manual, section: Gruppe K}",
        "looked_through: [{lines: 10..12, why: Heads of the table.}]",
        "points:",
        "- code: K01",
    ]
    assert "  name: setpoint_k01" in first["yaml"]
    assert "\n- code: K02\n  name: frostschutz  # ? in English" in first["yaml"]
    above, below = SECTION.split("Fuß der Seite\n")
    _, second = pump.drafts(OLD.replace("Ende.", f"{above}Ende.\n{below}"))
    assert (second["place"], second["kind"]) == ("in the group of line 13", "a point")
    assert second["yaml"].startswith("- code: K02")


def test_what_the_description_cannot_tell_is_asked_for(pump: Pump) -> None:
    table = "## 4.2 Diagnose\n\nAdresse\tParameter\tBedeutung\tAuflösung\n700\tP7\tAktueller Strom\t0,1 A\n"
    [draft] = pump.drafts(OLD.replace("Ende.", table))
    assert "  at: ~  # ? the row prints 700" in draft["yaml"].splitlines()
    assert 'source: {document: manual, section: "4.2"}' in draft["yaml"]
    assert "space: holding  # ? is it?" in draft["yaml"]


@pytest.mark.parametrize("rows", [DELAY, PUMP, DELAY + PUMP])
def test_a_pasted_row_compiles_but_for_what_is_asked(rows: str, pump: Pump) -> None:
    new = OLD.replace("\nEnde", rows + "\nEnde")
    drafted = "\n".join(draft["yaml"] for draft in pump.drafts(new))
    pump.write(DEVICE, HEATING + drafted + "\n")
    asked = [number for number, line in enumerate((HEATING + drafted).splitlines(), 1) if "# ?" in line]
    assert {finding["line"] for finding in pump.findings()} <= set(asked)
    answered = drafted.replace("{de: Verzögerung}", "{en: Delay, de: Verzögerung}").replace("  # ? en", "")
    pump.write(DEVICE, HEATING + answered + "\n")
    assert pump.findings() == []
    report = pump.audit(new)
    assert report["explained"], [finding["reasons"] for finding in report["findings"]]


def test_a_pasted_group_compiles_but_for_what_is_asked(pump: Pump) -> None:
    new = "Zweite Ausgabe.\n\n" + OLD.replace("Ende", SECTION + "Ende")
    [draft] = pump.drafts(new)
    answered = draft["yaml"].replace("title: {de:", "title: {en: Cooling, de:") + "\n"
    (pump.parts / "cooling.yaml").write_text(answered, "utf-8")
    (pump.parts / "device.yaml").write_text(DEVICE + "- cooling.yaml\n", "utf-8")
    assert pump.findings() == []
    reasons = [reason["text"] for finding in pump.audit(new)["findings"] for reason in finding["reasons"]]
    assert reasons == [], reasons


RULED = """group: ruled
title: {en: Setpoints, de: Sollwerte}
space: holding
access: rw
addressing: number * 64 + index - 1
source: {document: manual, section: Sollwerte}
points:
- {code: "P5[2]", name: first, title: {en: First, de: Sollwert 1}, at: 5, index: 2, line: 4, printed: {wire: 321}}
- {code: "P5[3]", name: second, title: {en: Second, de: Sollwert 2}, at: 5, index: 3, line: 5, printed: {wire: 322}}
"""
ROWS = "# Sollwerte\n\nAdresse     Bezeichnung\n321         Sollwert 1\n322         Sollwert 2\n"


def test_an_address_by_rule_has_the_number_and_index_of_its_run(pump: Pump) -> None:
    """Also where blanks alone part the columns."""
    (pump.folder / "old.txt").write_text(ROWS, "utf-8")
    pump.write(DEVICE, RULED)
    [draft] = pump.drafts(ROWS + "325         Zusatzwert\n")
    assert draft["yaml"].splitlines() == [
        '- code: "P5[6]"',
        "  name: zusatzwert  # ? in English",
        "  title: {de: Zusatzwert}  # ? en",
        "  at: 5",
        "  index: 6",
        "  line: 6",
        "  printed: {wire: 325}",
    ]
    pasted = draft["yaml"].replace("{de:", "{en: Extra, de:")
    pump.write(DEVICE, RULED + pasted + "\n")
    assert pump.findings() == []
