"""What a new edition changes is told once, with what it is; what holds no fact is a remark, and asks for nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from fieldscribe.audit.editions import Edition, compare
from fieldscribe.audit.editions.changes import Editions
from fieldscribe.audit.editions.report import as_lines
from fieldscribe.audit.editions.telling import is_prose, is_reference, turned
from fieldscribe.audit.editions.vocabulary import is_one_spelling, is_respelled
from fieldscribe.audit.pages import page_lines
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_analysis
from support.described import group, head, together, write

if TYPE_CHECKING:
    from pathlib import Path

    from fieldscribe.audit.editions import Comparison
    from fieldscribe.resolve.analysis import Analysis

FILLING = "".join(f"Chapter {chapter}, about this and that.\n\n" for chapter in "abcdefghijklmnop")
OLD = f"""# Heat pump

Modes ..... 3
Words ..... 7

{FILLING}
## Registers

| Code | Title | Register | Range | Step |
|------|-------|----------|-------|------|
| H01 | Flow temperature | 0010h | 0-900 | 0.1 K |
| H02 | Target temperature | 0011h | 200-550 | 0.1 K |
| H03 | {"Mode of the whole plant, with all that belongs to it, " * 4}| 0012h | 0-2 | - |
| H04 | Delay | 0013h | 0-30 | - |

{FILLING}
## Words

Status word at 0020h

3\tleft or right\t
\t0\tturns left
\t1\tturns right
4\tready\t
\t1\tready

The plant frees the ramp. See page 3-12.

{FILLING}"""
POINTS = """- {code: H01, name: flow, at: 0010h, range: 0..900, scale: value = raw * 0.1, unit: K, line: 43}
- {code: H02, name: target, at: 0011h, range: 200..550, scale: value = raw * 0.1, unit: K, line: 44}
- {code: H03, name: mode, at: 0012h, range: 0..2, line: 45}
- {code: H04, name: delay, at: 0013h, range: 0..30, line: 46}
- name: status
  at: 0020h
  line: 83
  flags:
    3: {name: direction, values: {0: {name: left, en: turns left}, 1: {name: right, en: turns right}}}
  lines: {flags: 85..87}
"""


@pytest.fixture(scope="module")
def subject(tmp_path_factory: pytest.TempPathFactory) -> Analysis:
    looked_through = "\n- {lines: 3..38, why: Prose.}\n- {lines: 48..81, why: Prose.}\n- {lines: 88..124, why: Prose.}"
    text = together(head(looked_through=looked_through), group(POINTS, access="rw"))
    subject = load_analysis(write(tmp_path_factory.mktemp("noise") / "plant", text), Report())
    assert subject is not None
    return subject


def _compared(subject: Analysis, new: str) -> Comparison:
    return compare(subject, Edition("old", OLD, None), Edition("new", new, None))[0]


def _with(old: str, new: str) -> str:
    assert OLD.count(old) == 1, old
    return OLD.replace(old, new)


def _with_feet(foot: str) -> str:
    """The text with a foot of a page, with its number, behind each chapter d."""
    pieces = OLD.split("Chapter d")
    return pieces[0] + "".join(f"{foot.format(page + 7)}\n\nChapter d{piece}" for page, piece in enumerate(pieces[1:]))


HEAD = "# Heat pump: **Modbus**\n\nOf: controllers of 2020\n\n"
THREE = OLD.replace("Chapter e", f"{HEAD}Chapter e").replace("Chapter l", f"{HEAD}Chapter l")
HEADED = OLD.replace("Chapter g", f"{HEAD}Chapter g").replace("Chapter m", f"{HEAD}Chapter m")
BITS = OLD.replace("4\tready\t\n\t1\tready", "4\tset, low\t00 = one 01 = two 10 = three\n5\tset, high\t")


def _in_both_rows(old: str) -> str:
    return old.replace(" 10 = three\n5\tset, high\t", "\n5\tset, high\t10 = three")


REMARKS = {
    # what holds no fact, as text: its kind
    "feet that count": (_with_feet("Heat pump B-{}"), "heads_and_feet"),
    "numbers of pages": (_with_feet("{}"), "heads_and_feet"),
    "one foot that says so": (_with("## Words", "Edition 2 of 2025, page 4 of 9\n\n## Words"), "heads_and_feet"),
    "cover": (f"Manual\n\nOrder number 4711, for firmware 1.1.\n\n{OLD}", "front_matter"),
    "cover with the title": (f"# Heat pump\n\nOrder number 4711.\n\n{OLD}", "front_matter"),
    "contents with tabs": (_with("..... 7", "..... 7\nContents\nRegisters\t5\nWords\t7"), "contents"),
    "a line of the contents": (_with("Words .....", "Registers ..... 5\nWords ....."), "contents"),
    "list of editions": (
        _with("## Registers", "## History\n\n| Edition | Of |\n| 1 | March 2020 |\n| 2 | 01.05.2025 |\n\n## Registers"),
        "list_of_editions",
    ),
    "a heading": (_with("Status word at", "## 7 of 9: Status\n\nStatus word at"), "headings"),
    "a pointer": (
        _with("The plant frees", "Terminals are described in the appendix.\n\nThe plant frees"),
        "references",
    ),
    "another page": (_with("See page 3-12", "See page 3-14"), "references"),
    "a table over two pages": (
        _with("| H03", "\n| Code | Title | Register | Range | Step |\n|---|---|---|---|---|\n| H03"),
        "repeated_heads",
    ),
    "spelling": (_with("frees the ramp", "freed the Ramp"), "wording"),
    "another word": (_with("frees the ramp", "releases the ramp"), "wording"),
    "English put into German": (_with("The plant frees the", "Die Anlage gibt die"), "wording"),
}


@pytest.mark.parametrize(("new", "kind"), REMARKS.values(), ids=REMARKS)
def test_what_holds_no_fact_is_one_remark(subject: Analysis, new: str, kind: str) -> None:
    outcome = _compared(subject, new)
    assert ([remark.kind for remark in outcome.remarks], outcome.findings) == ([kind], [])
    assert outcome.explained
    assert "remark" in _told(outcome)[0]


SET_AGAIN = {
    # layout of an old text: the kind of the remark
    "the head of a page more": (HEADED, HEADED.replace("The plant", f"{HEAD}The plant", 1), "heads_and_feet"),
    "the head of a page more, set otherwise": (
        HEADED,
        HEADED.replace("The plant", "## Heat pump: Modbus\n\n\nOf: controllers of 2020\n\nThe plant", 1),
        "heads_and_feet",
    ),
    "heads in one line": (THREE, THREE.replace(HEAD, "Heat pump, Modbus, controllers of 2020\n\n"), "heads_and_feet"),
    "a cell over two rows": (BITS, _in_both_rows(BITS), "moved"),
    "the same cell in one": (_in_both_rows(BITS), BITS, "moved"),
}  # fmt: skip


@pytest.mark.parametrize(("old", "new", "kind"), SET_AGAIN.values(), ids=SET_AGAIN)
def test_what_is_set_again_is_one_remark(subject: Analysis, old: str, new: str, kind: str) -> None:
    outcome = compare(subject, Edition("old", old, None), Edition("new", new, None))[0]
    assert ([remark.kind for remark in outcome.remarks], outcome.findings) == ([kind], [])


NOT_SET_AGAIN = {
    # what only looks like it
    "a head with another number": (HEADED, HEADED.replace("The plant", f"{HEAD.replace('2020', '2021')}The plant", 1)),
    "heads that say something new": (THREE, THREE.replace(HEAD, "Heat pump, Modbus, controllers of 2021\n\n")),
    "one of its lines": (HEADED, HEADED.replace("The plant", "Of: controllers of 2020\n\nThe plant", 1)),
    "an entry that is another": (BITS, _in_both_rows(BITS).replace("10 = three", "10 = two")),
    "all entries of a cell": (
        BITS.replace(" 01 = two 10 = three", ""),
        BITS.replace("00 = one 01 = two 10 = three\n5\tset, high\t", "\n5\tset, high\t00 = one"),
    ),
    "a sentence in another row": (
        BITS.replace("00 = one 01 = two 10 = three", "Is set. Only with 2."),
        BITS.replace("00 = one 01 = two 10 = three\n5\tset, high\t", "Is set.\n5\tset, high\tOnly with 2."),
    ),
    "an abbreviation": (OLD.replace("the ramp", "the ramp OFF"), OLD.replace("the ramp", "the ramp ON")),
}


@pytest.mark.parametrize(("old", "new"), NOT_SET_AGAIN.values(), ids=NOT_SET_AGAIN)
def test_what_only_looks_like_it_is_a_finding(subject: Analysis, old: str, new: str) -> None:
    assert compare(subject, Edition("old", old, None), Edition("new", new, None))[0].findings


FINDINGS = {
    # what may hold one: kinds and words of the findings
    "two bits": (
        _with("0\tturns left\n\t1\tturns right", "0\tturns right\n\t1\tturns left"),
        [("swapped", (("left", "right"),))],
    ),
    "a new row above a changed one": (
        _with("| H02", "| H09 | Boost | 0019h | 0-1 | - |\n| H02").replace("200-550", "200-600"),
        [("added", (("", "H09 | Boost | 0019h | 0-1 | -"),)), ("changed", (("550", "600"),))],
    ),
    "a changed row above one that is gone": (
        _with("| 0-2 | - |\n| H04 | Delay | 0013h | 0-30 | - |", "| 0-2, 9 | - |"),
        [("changed", (("", ", 9"),)), ("removed", (("H04 | Delay | 0013h | 0-30 | -", ""),))],
    ),
    "a row in place of another": (
        _with("| H04 | Delay | 0013h | 0-30 | - |", "| H07 | Boost | 0019h | 0-1 | 1 s |"),
        [("removed", (("H04 | Delay | 0013h | 0-30 | -", ""),)), ("added", (("", "H07 | Boost | 0019h | 0-1 | 1 s"),))],
    ),
    "a number in words": (
        _with("The plant frees", "Three plants free"),
        [("changed", (("The plant frees", "Three plants free"),))],
    ),
    "a number in lines that were looked through": (
        _with("The plant frees", "After 9 it frees"),
        [("changed", (("The plant", "After 9 it"),))],
    ),
    "what turns a sentence round": (_with("frees the", "never frees the"), [("changed", (("", "never"),))]),
    "whole numbers": (_with("0-900 | 0.1 K", "0-900 | 0.5 K"), [("changed", (("0.1", "0.5"),))]),
    "a sentence with a number": (
        _with("The plant frees", "It waits for 20 ms, see page 3.\n\nThe plant frees"),
        [("added", (("", "It waits for 20 ms, see page 3."),))],
    ),
    "an equal line at two places": (
        OLD.replace("Chapter d,", "It waits for 20 ms.\n\nChapter d,", 2),
        [("added", (("", "It waits for 20 ms."),))],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("new", "findings"), FINDINGS.values(), ids=FINDINGS)
def test_what_may_hold_a_fact_is_one_finding(
    subject: Analysis, new: str, findings: list[tuple[str, tuple[tuple[str, str], ...]]]
) -> None:
    outcome = _compared(subject, new)
    assert [(finding.kind, finding.words) for finding in outcome.findings] == findings
    assert (outcome.explained, outcome.remarks) == (False, [])
    assert all(".yaml:" in line for line in _told(outcome) if line.split(": ")[1:2] == [findings[0][0]])


@pytest.mark.parametrize(("now", "ids"), [("frees the BCC", ["of_ramp"]), ("frees  the Ramp", []), ("frees ramp", [])])
def test_an_erratum_is_looked_at_where_its_line_has_another_word(tmp_path: Path, now: str, ids: list[str]) -> None:
    said = "line: 91, printed: It frees a ramp., taken: A stop., why: So., certainty: likely"
    erratum = f"\nerrata:\n- {{id: of_ramp, where: Ramp, {said}}}"
    looked_through = "\n- {lines: 3..38, why: Prose.}\n- {lines: 48..81, why: Prose.}\n- {lines: 88..124, why: Prose.}"
    text = together(head(looked_through=looked_through + erratum), group(POINTS, access="rw"))
    subject = load_analysis(write(tmp_path / "plant", text), report := Report())
    assert subject is not None, report
    outcome = _compared(subject, _with("frees the ramp", now))
    assert ([doubt.erratum for doubt in outcome.doubts], outcome.findings) == (ids, [])


COLUMNS = "# Heat pump\n\nDirection\t1\t2\t3\t4\nto it\tSTW\tHSW\tHSW2\tSTW2\nfrom it\tZSW\tHIW\tZSW2\tHIW2\n"
OF_COLUMNS = """- {code: ZSW2, name: status, at: 3, line: 5, lines: {address: 3}}
- {code: HIW2, name: actual, at: 4, line: 5, lines: {address: 3}}
"""


FOLLOWED = OF_COLUMNS.replace("at: 3", "at: 5").replace("at: 4", "at: 3").replace("at: 5", "at: 4")


@pytest.mark.parametrize(("points", "missing"), [(OF_COLUMNS, 2), (FOLLOWED, 0)], ids=["as it was", "followed"])
def test_cells_that_changed_places_stand_below_other_numbers(tmp_path: Path, points: str, missing: int) -> None:
    subject = load_analysis(write(tmp_path / "plant", together(head(), group(points, access="r"))), Report())
    assert subject is not None
    new = COLUMNS.replace("ZSW2\tHIW2", "HIW2\tZSW2")
    outcome = compare(subject, Edition("old", COLUMNS, None), Edition("new", new, None))[0]
    [finding] = outcome.findings
    assert (finding.kind, finding.words, finding.explained) == ("swapped", (("ZSW2", "HIW2"),), missing == 0)
    assert sum("address" in reason.said for reason in finding.reasons) == missing


def test_equal_lines_name_all_their_places(subject: Analysis) -> None:
    outcome = _compared(subject, FINDINGS["an equal line at two places"][0])
    assert [place.new for place in outcome.findings[0].places] == [(12, 12), (56, 56)]
    assert "2 places: lines 12, 56 in the new edition" in _told(outcome)[0]


def test_a_long_line_is_shown_around_its_change(subject: Analysis) -> None:
    told = _told(_compared(subject, _with("0012h | 0-2", "0012h | 0-5")))
    [shown] = [line for line in told if line.startswith("  + ")]
    assert shown.endswith("| 0012h | 0-5 | - |")
    assert len(shown) < 180


@pytest.mark.parametrize(("old", "new"), [("\tready\t", "\tready left\t"), ("left or right", "left")])
def test_a_label_that_got_or_lost_words_is_told_though_they_are_known(subject: Analysis, old: str, new: str) -> None:
    [finding] = _compared(subject, _with(old, new)).findings
    assert any(not was or not now for was, now in finding.words)


def test_equal_lines_that_changed_alike_are_told_once_however_they_break(subject: Analysis) -> None:
    old = OLD.replace("Chapter d,", "It waits for (ca. 20 ms) and so on.\n\nChapter d,")
    pieces = old.replace("20 ms", "30 ms").split("(ca. 30")
    new = f"{pieces[0]}(ca.\n30{'(ca. 30'.join(pieces[1:])}"
    outcome = compare(subject, Edition("old", old, None), Edition("new", new, None))[0]
    assert [len(finding.places) for finding in outcome.findings] == [3]


def test_a_section_behind_a_row_that_both_are_new_is_another_finding(subject: Analysis) -> None:
    last = "| H04 | Delay | 0013h | 0-30 | - |\n"
    row, section = "| H05 | Pause | 0014h | 0-30 | - |\n", "\n## Pauses\n\nA pause of 20 s ends so.\n"
    told = [finding.now for finding in _compared(subject, _with(last, last + row + section)).findings]
    assert [lines[0] for lines in told] == [row.strip(), "## Pauses"]


def test_lines_that_end_alike_keep_their_ends_where_a_section_moved_behind_them() -> None:
    part = ["## Answers", "", "An answer has four fields, and each of them holds one word of the request", ""]
    other = ["## Saving", "", "Words that were written are kept until the plant is switched off.", ""]
    behind = ["New words follow here.", "", "## Lists"]
    editions = Editions("\n".join([*part, *other, behind[-1]]), "\n".join([*other, *part, *behind]))
    assert [(change.kind, change.new) for change in editions.changes] == [("added", (9,))]


@pytest.mark.parametrize(
    ("before", "fits"),
    [
        ("siehe Seite 3-", True),
        ("siehe Seite 3\u2013", True),
        ("auf S. ", True),
        ("Kapitel A-", True),
        ("Seiten 1 bis 3-", False),
        ("von 3-", False),
        ("page 12 - ", False),
    ],
)
def test_numbers_of_pages_and_chapters(before: str, fits: bool) -> None:
    assert is_reference(f"{before}44.", len(before) + 1) == fits


@pytest.mark.parametrize(
    ("printed", "taken", "row", "fixed"),
    [
        ("0.00 %", "0.01 %", "| H01 | Rate, 0.00 to 9 | 0010h | 0-900 | {} |", True),  # stands beside, too
        ("0.1 Hz", "0.1 kHz", "| H01 | Rate, 2 to 90 kHz | 0010h | 0-900 | {} |", True),  # only the unit
        ("0.1 Hz", "0.1 kHz", "| H01 | Rate, 2 to 90 kHz | 0011h | 0-900 | 0.1 Hz |", False),
    ],
)
def test_an_erratum_that_was_mended_can_go(tmp_path: Path, printed: str, taken: str, row: str, fixed: bool) -> None:
    documents = "{manual: {title: Manual, language: en, file: old}}"
    step = f'printed: {{resolution: "{printed}"}}'
    scale, unit = taken.split()
    rate = f'range: 0..900, scale: value = raw * {scale}, unit: "{unit}"'
    points = f"- {{code: H01, name: rate, at: 0010h, {rate}, line: 3, {step}}}\n"
    facts = f'{step}, taken: {{resolution: "{taken}"}}'
    erratum = f"- {{id: rate_step, point: H01, line: 3, {facts}, why: It says so., certainty: likely}}\n"
    text = together(head(documents=documents), group(points, access="rw") + f"errata:\n{erratum}")
    report = Report()
    subject = load_analysis(write(tmp_path / "plant", text), report)
    assert subject is not None, report.findings
    head_of_table = "| Code | Title | Register | Range | Step |\n|---|---|---|---|---|\n"
    old, new = (head_of_table + row.format(step) + "\n" for step in (printed, taken))
    if not fixed:
        old = old.replace("0011h", "0010h")
    outcome = compare(subject, Edition("old", old, None), Edition("new", new, None))[0]
    assert [void.is_corrected for finding in outcome.findings for void in finding.void] == [True] * fixed


def test_a_removed_row_is_told_once(subject: Analysis) -> None:
    [finding] = _compared(subject, _with("| H04 | Delay | 0013h | 0-30 | - |\n", "")).findings
    assert [(reason.kind, reason.subjects) for reason in finding.reasons] == [("gone", ("delay",))]


def _told(outcome: Comparison) -> list[str]:
    return ["".join(text for _, text in line) for line in as_lines(outcome, everything=False)]


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ("Antwort-Telegramm", "Antworttelegramm", True),
        ("Tip-Richtung", "Tipprichtung", True),
        ("Proze\u00dfdaten", "Prozessdaten", True),
        ("9 - 12", "912", False),
        ("mode 3", "mode 4", False),
        ("Ist-Wert", "Soll-Wert", False),
    ],
)
def test_spellings_of_a_text(old: str, new: str, same: bool) -> None:
    assert is_one_spelling(old, new) == is_one_spelling(new, old) == same


@pytest.mark.parametrize(
    ("was", "now", "told"),
    [
        ("drei Codes", "vier Codes", ["vier", "drei"]),
        ("das Dreifache", "das Dreieinhalbfache", ["Dreieinhalbfache", "Dreifache"]),
        ("drei Codes", "three codes", []),
        ("Run right", "Rechtslauf", []),
        ("even", "ungerade", ["ungerade", "even"]),
        ("auch im Lauf", "nur im Halt", ["nur"]),
        ("wird gelesen", "wird nicht gelesen", ["nicht"]),
        ("eine Anlage", "die Anlage", []),
    ],
)
def test_what_words_tell(was: str, now: str, told: list[str]) -> None:
    assert turned([(was.split(), now.split())]) == told


@pytest.mark.parametrize(
    ("line", "prose"),
    [
        ("Die einzelnen Slaves erstellen keine Antwort auf einen Broadcast.", True),
        ("Beispiel: P0700 auf den Wert 5 setzen (0700= 2BC (hex))", True),
        ("und Parit\u00e4t", True),
        ("PZD-Telegramme mit anderer L\u00e4nge", False),
        ("Index 2 = Ist-Wert 2 (HIW2) als Standardeinstellung von allen Umrichtern", False),
        ("Bit 4R/WHandbetrieb umschalten (=0x0010) und alles das noch dazu", False),
        ("| P102 | Die Zeit, in der die Anlage ihre Drehzahl erreicht haben soll. |", False),
        ("P1062 = Tippen Verrundungszeit", False),
    ],
)
def test_what_is_running_text(line: str, prose: bool) -> None:
    assert is_prose(line) == prose


PAGES = ["1 Words", "Manual, page 7", "2 Registers", *(f"row {row} is 8" for row in range(10))]


def test_heads_and_feet_are_lines_that_count_pages_and_what_repeats_beside_them() -> None:
    lines = [line.replace("page 7", f"page {page}") for page in range(7, 11) for line in (*PAGES, str(page), "")]
    assert [lines[number - 1] for number in sorted(page_lines(lines))[:4]] == [
        "1 Words",
        "Manual, page 7",
        "2 Registers",
        "7",
    ]
    assert len(page_lines(lines)) == 15  # the last foot counts no page below it
    assert page_lines([line.replace("page", "entry") for line in lines]) == frozenset()


def test_a_section_with_another_number_is_the_one_with_its_title() -> None:
    was = ["2.8.2 Terminals", "Two wires lead to it.", "", "2.8.3 Loops", "A loop of its own.", "", "Further text."]
    now = [line.replace("2.8.", "2.9.") for line in was]
    assert Editions("\n".join(was), "\n".join(now)).changes == ()


@pytest.mark.parametrize(
    ("old", "new", "same"),
    [
        ("Anschlu\u00df", "Anschluss", True),
        ("vorgeben", "Vorgeben", True),
        ("freigeben", "freigegeben", True),
        ("register", "registers", True),
        ("k\u00fchlen", "kuhlen", True),
        ("synchron", "asynchron", False),
        ("Eingang", "Ausgang", False),
        ("maximum", "minimum", False),
        ("signal", "signed", False),
        ("A020", "A021", False),
        ("high", "higher", False),
    ],
)
def test_spellings_of_a_word(old: str, new: str, same: bool) -> None:
    assert is_respelled(old, new) == is_respelled(new, old) == same


def test_a_row_that_prints_an_access_where_it_had_none_is_a_finding(tmp_path: Path) -> None:
    documents = "{manual: {title: Manual, language: en, file: old, access: {r: [R], rw: [R/W]}}}"
    points = "- {name: quick_start, at: 0010h, access: none, range: 0..1, line: 3}\n"
    text = together(head(documents=documents), group(points, access="rw"))
    subject = load_analysis(write(tmp_path / "plant", text), Report())
    assert subject is not None
    old = "| Title | Access | Register | Range |\n|---|---|---|---|\n| Quick start | - | 0010h | 0-1 |\n"
    new = old.replace("| - |", "| R/W |")
    (finding,) = compare(subject, Edition("old", old, None), Edition("new", new, None))[0].findings
    assert (finding.kind, finding.words) == ("changed", (("-", "R/W"),))
    assert ": access none is not there" in [reason.said for reason in finding.reasons]


@pytest.mark.parametrize(("mark", "doubts"), [("- ", []), ("", ["setting"])])
def test_an_erratum_of_an_entry_does_not_speak_of_a_new_one_below_it(
    tmp_path: Path, mark: str, doubts: list[str]
) -> None:
    errata = (
        "\n- {id: setting, point: P01, line: 3, printed: P01 has no unit., taken: None., why: x, certainty: likely}"
    )
    points = "- {code: P01, name: delay, at: 0010h, default: 4, line: 3}\n"
    subject = load_analysis(
        write(tmp_path / "plant", together(head(errata=errata), group(points, access="rw"))), Report()
    )
    assert subject is not None
    old = f"Settings:\n\n{mark}P01 at 0010h to 4\n{mark}Then start\n"
    new = old.replace("0010h to 4\n", f"0010h to 4\n{mark}P07 at 0017h to 9\n")
    outcome = compare(subject, Edition("old", old, None), Edition("new", new, None))[0]
    assert ([doubt.erratum for doubt in outcome.doubts], len(outcome.findings)) == (doubts, 1)
