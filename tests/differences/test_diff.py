"""`fieldscribe diff`: what it compares, how it says it, and how it ends."""

from __future__ import annotations

import json
import stat
from collections.abc import Callable
from itertools import pairwise, permutations
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.differences.changes import as_data, compared
from fieldscribe.differences.rendering import as_markdown, as_text
from fieldscribe.differences.sides import Side
from fieldscribe.export import export_model
from support.described import loaded, made
from support.diff_command import EDITED, POINTS, Diff, Result

KITCHENS = ("kitchen_sink", "kitchen_can", "kitchen_uss", "kitchen_codes")


def test_json(diff: Diff) -> None:
    told = json.loads(diff("old", "new", "--format", "json").out)
    assert told["step"] == "major"
    assert told["changes"][0] == {
        "class": "wire",
        "device": "made_up",
        "point": "speed",
        "fact": "address",
        "old": 16,
        "new": 17,
        "places": {"old": "old/device.yaml:15", "new": "new/device.yaml:15"},
        "symbols": told["changes"][0]["symbols"],
        "symbols_missing": [],
        "rename": False,
    }
    symbols = told["changes"][0]["symbols"]
    assert "MADE_UP_SPEED_ADDRESS" in symbols["c"]
    assert symbols["python"] == ["speed"]
    assert "Speed" in symbols["rust"]
    assert [(each["class"], each["point"], each["fact"]) for each in told["changes"][1:]] == [
        ("behaviour", "state", "range"),
        ("behaviour", "state", "entry wait"),
    ]
    entry = told["changes"][2]
    assert entry["places"] == {"old": "old/device.yaml:18", "new": "new/device.yaml:18"}
    assert entry["symbols"] == {
        "c": ["MADE_UP_STATE_WAIT"],
        "python": ["WAIT"],
        "rust": ["Wait"],
        "typescript": ["WAIT"],
    }


TEXT = """\
made_up 1.0.0
  breaks on the wire
    speed: address 16 (0010h) -> 17 (0011h)
      old/device.yaml:15 -> new/device.yaml:15
      c: MADE_UP_SPEED_ADDRESS, MADE_UP_SPEED_RAW_MIN, MADE_UP_SPEED_RAW_MAX and 7 more
      python: speed
      rust: Speed
      typescript: speed
  changes behaviour
    state: range 0..1 -> 0..2
      old/device.yaml:18 -> new/device.yaml:18
      c: MADE_UP_STATE_ADDRESS, MADE_UP_STATE_RAW_MIN, MADE_UP_STATE_RAW_MAX and 7 more
      python: state
      rust: State
      typescript: state
    state: entry wait is new
      old/device.yaml:18 -> new/device.yaml:18
      c: MADE_UP_STATE_WAIT
      python: WAIT
      rust: Wait
      typescript: WAIT
  the version must take a major step: 2.0.0 or more, it says 1.0.0

3 differences
"""
MARKDOWN = """\
## made\\_up 2.0.0

a major step of the version: 1.0.0 \N{RIGHTWARDS ARROW} 2.0.0

### Breaks on the wire

- `speed`: address 16 \\(0010h\\) \N{RIGHTWARDS ARROW} 17 \\(0011h\\) \
(c `MADE_UP_SPEED_ADDRESS`, `MADE_UP_SPEED_RAW_MIN`, \
`MADE_UP_SPEED_RAW_MAX` and 7 more; python `speed`; rust `Speed`; typescript `speed`)

"""


def test_text(diff: Diff) -> None:
    assert diff("old", "new") == Result(1, TEXT, "")
    assert diff("old", "old") == Result(0, "no differences\n", "")


def test_markdown(diff: Diff) -> None:
    diff.write("new", POINTS.replace("at: 10h", "at: 11h"), version="2.0.0")
    assert diff("old", "new", "--format", "markdown") == Result(1, MARKDOWN, "")


def test_other_lines_of_the_manual_are_told_together(diff: Diff) -> None:
    """A new edition moves nearly every line: what else changed is not lost among them."""
    points = "".join(f"- {{name: p{number}, at: {number}, line: {number}}}\n" for number in range(1, 6))
    diff.write("old", points)
    moved = "".join(f"- {{name: p{number}, at: {number}, line: {number + 9}}}\n" for number in range(1, 6))
    diff.write("new", moved.replace("line: 14", "line: 14, note: It moved."))
    assert "    5 things: other lines of the manual\n    p5: note none" in diff("old", "new").out
    assert "- 5 things: other lines of the manual\n- `p5`: note none" in diff("old", "new", "--format", "markdown").out
    sources = [change["old"]["line"] for change in diff.changes("old", "new") if change["fact"] == "source"]
    assert sources == [1, 2, 3, 4, 5]


@pytest.mark.parametrize(
    ("points", "codes"),
    [
        (POINTS.replace("at: 10h", "at: 11h"), (1, 1, 1)),
        (POINTS.replace("0..4000", "0..5000"), (0, 1, 1)),
        (POINTS + "- {name: more, at: 40h}\n", (0, 0, 1)),
        (POINTS.replace("name: ramp", "name: ramp, title: A ramp"), (0, 0, 1)),
        (POINTS, (0, 0, 0)),
    ],
)
def test_what_ends_with_1(points: str, codes: tuple[int, ...], diff: Diff) -> None:
    diff.write("new", points)
    told = [diff("old", "new", "--fail-on", least).code for least in ("breaking", "behaviour", "any")]
    assert tuple(told) == codes


def test_sides_of_every_kind(diff: Diff) -> None:
    """A folder, its device.yaml, a folder of such folders, and an exported model, in any mixture."""
    Path("all").mkdir()
    Path("old").rename("all/old")
    Path("old.json").write_text(json.dumps(export_model(loaded(Path("all/old/device.yaml")))), "utf-8")
    kinds = ("all", "all/old", "all/old/device.yaml", "old.json")
    facts = {kind: [(each["point"], each["fact"]) for each in diff.changes(kind, "new")] for kind in kinds}
    assert facts == {kind: [("speed", "address"), ("state", "range"), ("state", "entry wait")] for kind in kinds}
    assert all(diff(kind, other) == Result(0, "no differences\n", "") for kind, other in pairwise(kinds))
    change = diff.changes("old.json", "new")[0]
    assert change["places"] == {"old": "old.json", "new": "new/device.yaml:15"}
    assert "MADE_UP_SPEED_ADDRESS" in change["symbols"]["c"]


def test_names_in_code_that_an_exported_model_lacks(diff: Diff) -> None:
    """They are told to be missing where the other side does not have them, and only there."""
    Path("old.json").write_text(json.dumps(export_model(loaded(Path("old/device.yaml")))), "utf-8")
    diff.write("new", EDITED.replace("name: ramp", "name: slope") + "- {name: more, at: 40h}\n")
    missing = {each["point"]: each["symbols_missing"] for each in diff.changes("old.json", "new")}
    assert missing == {"speed": [], "state": [], "more": [], "slope": ["old"], "slope_set_2": ["old"]}
    said = "names in code are missing where old.json is an exported model: compare descriptions, or GIT-REVISION:PATH"
    assert said in diff("old.json", "new").out
    assert "Names in code are missing" in diff("old.json", "new", "--format", "markdown").out
    diff.write("new", EDITED)
    assert "missing" not in diff("old.json", "new").out


def test_what_has_another_name_is_told_by_both(diff: Diff) -> None:
    diff.write("new", POINTS.replace("name: speed", "name: pace").replace("1: run", "1: go"))
    told = diff("old", "new").out
    assert "      rust: Speed -> Pace\n" in told
    assert "      c: MADE_UP_STATE_RUN -> MADE_UP_STATE_GO\n" in told


SHARED = """\
- {name: a, at: 1, special: {FFFFh: broken, FFFEh: silent}}
- {name: b, at: 2, special: {FFFFh: broken, FFFEh: silent}}
- {name: mode, at: 3, enum: modes}
- {name: way, at: 4, enum: {0: off, 1: on}}
"""


@pytest.mark.parametrize(
    ("before", "after", "fact", "symbols"),
    [
        ("1: on}", "1: on}, open: yes", "open", {"python": ["Way", "way"], "rust": ["Way"]}),
        ("modes", "{0: off}", "name of the enum", {"python": ["Modes", "mode", "Mode"], "rust": ["Modes", "Mode"]}),
        ("broken", "burnt", "code broken name", {"python": [], "rust": ["BROKEN", "BURNT"]}),
    ],
)
def test_names_of_what_points_share(
    before: str, after: str, fact: str, symbols: dict[str, list[str]], diff: Diff
) -> None:
    diff.write("old", SHARED, enums="{modes: {0: off, 1: on}}")
    diff.write("new", SHARED.replace(before, after), enums="{modes: {0: off, 1: on}}")
    change = next(each for each in diff.changes("old", "new") if each["fact"] == fact)
    assert {language: change["symbols"][language] for language in symbols} == symbols


def test_lines_that_sentences_name_are_told_with_other_lines(diff: Diff) -> None:
    points = "- {name: first, at: 1, line: 1, note: As line 7 says.}\n- {name: second, at: 2, line: 2}\n"
    diff.write("old", points)
    diff.write("new", points.replace("line 7", "lines 8 and 9").replace("line: 2", "line: 5"))
    assert "    2 things: other lines of the manual\n" in diff("old", "new").out


def test_a_device_by_its_id(diff: Diff) -> None:
    assert diff("jumo_controller", "jumo_controller").code == 0
    assert diff("jumo_control", "jumo_controller").code == 2


def test_devices_come_and_go(diff: Diff) -> None:
    diff.write("all/first", POINTS, device="first")
    diff.write("more/second", POINTS, device="second")
    told = [(each["class"], each["device"], each["fact"], each["new"]) for each in diff.changes("all", "more")]
    assert told == [("compatible", "second", "device", "second"), ("api", "first", "device", None)]
    assert "the device is gone" in diff("all", "more").out


def test_findings_are_told_and_the_rest_is_compared(diff: Diff) -> None:
    """A point that did not resolve is not gone."""
    diff.write("new", EDITED.replace("name: ramp", "name: ramp, type: u99"))
    told = diff("old", "new")
    assert "u99" in told.err
    assert "ramp" not in told.out
    assert told.out.endswith("3 differences\n")
    Path("new/device.yaml").write_text("device: 1\n", "utf-8")
    assert diff("old", "new")[:2] == (1, "")


def test_errors_are_no_success(diff: Diff) -> None:
    diff.write("old", POINTS.replace("name: ramp", "name: ramp, type: u99"))
    diff.write("new", POINTS.replace("name: ramp", "name: ramp, type: u99"))
    assert diff("old", "new").code == 1


def _exported(change: Callable[[dict[str, Any]], object]) -> str:
    model: dict[str, Any] = export_model(loaded(Path("old/device.yaml")))
    change(model)
    return json.dumps(model)


FOREIGN = "model.json does not follow the schema of exported models"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{", "it is not JSON"),
        ("", "it is not JSON"),
        ("\0", "it is not JSON"),
        ("[" * 200_000, "it is not JSON"),
        ('{"format": ' + "9" * 5000 + "}", "it is not JSON"),
        ("NaN", "it is not an exported model"),
        ("[]", "it is not an exported model"),
        ('{"format": 3, "device": "a"}', "its format is not 7"),
        (lambda model: model.pop("points"), "`points` is missing"),
        (lambda model: model.update(points={}), "`points` is missing or no list"),
        (lambda model: model["points"].append({}), FOREIGN),
        (lambda model: model["points"][0].update(type="u99"), FOREIGN),
        (lambda model: model["points"][0].update(addresses=["1", 2]), FOREIGN),
        (lambda model: model["points"][0].update(raw=[]), FOREIGN),
        (lambda model: model["points"][0].update(scale=[{"num": 1}]), FOREIGN),
        (lambda model: model["points"][1]["enum"].update({"9" * 5000: {}}), FOREIGN),
        (lambda model: model.update(title=[]), "`title` is missing or a list"),
        (lambda model: model.update(family="bus"), "there is no family `bus`"),
        (lambda model: model.pop("family"), "there is no family ``"),
    ],
)
def test_a_file_that_is_no_exported_model(
    text: str | Callable[[dict[str, Any]], object], said: str, diff: Diff
) -> None:
    Path("model.json").write_text(text if isinstance(text, str) else _exported(text), "utf-8")
    told = diff("model.json", "new")
    assert (told.code, told.out) == (2, "")
    assert said in told.err


def test_strange_words_of_an_exported_model(diff: Diff) -> None:
    """They follow the contract and reach no terminal raw; ends that cross have no meaning and do no harm."""

    def change(model: dict[str, Any]) -> None:
        model["device"] = "made_up"
        model["points"][0].update(name="a`\x1b[31m*_<b>", bits=[0, 63], title={})
        model["points"][1]["raw"]["ranges"] = [["2 if\u202e", 1]]

    Path("model.json").write_text(_exported(change), "utf-8")
    for form in ("text", "markdown", "json"):
        told = diff("model.json", "new", "--format", form)
        assert told.code == 1
        assert not {"\x1b", "\u202e"} & set(told.out + told.err)


def test_wrong_calls(diff: Diff) -> None:
    assert diff("old").code == 2
    assert diff("old", "new", "--fail-on", "docs").code == 2
    assert diff("old", "nowhere").code == 2
    assert diff("old", "").code == 2


RENAMED = POINTS.replace("name: speed", "name: pace").replace("name: state ", "name: mode ").replace("ramp", "slope")


def test_a_rename_keeps_its_old_name(diff: Diff) -> None:
    diff.write("new", RENAMED)
    assert diff("old", "new", "--fail-on", "breaking").code == 1
    told = diff("old", "new", "--keep-names", "--fail-on", "breaking", "--format", "json")
    assert [(each["class"], each["point"], each["fact"]) for each in json.loads(told.out)["changes"]] == [
        ("compatible", "pace", "name"),
        ("compatible", "mode", "name"),
        ("compatible", "slope", "name"),
        ("compatible", "slope_set_2", "name"),
    ]
    assert "slope_set_2: the old name `ramp_set_2` stays as an alias" in told.err
    assert (
        RENAMED.replace("name: pace", "name: pace, was: [speed]")
        .replace("what it does\n", "what it does\n  was: [state]\n")
        .replace("name: slope", "name: slope, was: [ramp]")
    ) in Path("new/device.yaml").read_text("utf-8")
    assert {each["class"] for each in diff.changes("old", "new", "--keep-names")} == {"compatible"}


@pytest.mark.parametrize(
    ("before", "after", "kept"),
    [
        ("- {name: a, at: 1}\n", "- {name: b, was: [c], at: 1}\n", "- {name: b, was: [a, c], at: 1}\n"),
        ("- {name: a, at: 1}\n", "- {name: b, was: [a], at: 1}\n", "- {name: b, was: [a], at: 1}\n"),
        (
            "- {name: a, at: 1}\n- {name: z, at: 2, access: r}\n",
            *("- {name: b, at: 1}\n- {name: z, at: 2}\n", "- {name: b, was: [a], at: 1}\n- {name: z, at: 2}\n"),
        ),
        ("- name: a\n  at: 1\n", "- name: b\n  was:\n  - c\n  at: 1\n", "- name: b\n  was:\n  - a\n  - c\n  at: 1\n"),
        ("- at: 1\n  name: a\n", '- at: 1\n  name: "b"', '- at: 1\n  name: "b"\n  was: [a]\n'),
        ("- name: a\r\n  at: 1\r\n", "- name: b\r\n  at: 1\r\n", "- name: b\r\n  was: [a]\r\n  at: 1\r\n"),
    ],
)
def test_where_an_old_name_is_written(before: str, after: str, kept: str, diff: Diff) -> None:
    diff.write("old", before)
    file = diff.write("new", after)
    diff("old", "new", "--keep-names")
    assert file.read_bytes().decode().endswith(kept)


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664])
def test_old_names_leave_the_mode_and_the_link(mode: int, diff: Diff) -> None:
    diff.write("old", "- {name: a, at: 1}\n")
    file = diff.write("new", "- {name: b, at: 1}\n")
    real = file.rename(file.with_name("real.yaml"))
    file.symlink_to("real.yaml")
    real.chmod(mode)
    diff("old", "new", "--keep-names")
    assert "was: [a]" in real.read_text("utf-8")
    assert (file.is_symlink(), stat.S_IMODE(real.stat().st_mode)) == (True, mode)


RECORDS = "{trip: {points: [{name: MEMBER, at: base}, {name: hours, at: base + 1}]}}"
USES = "- {name: USE_1, record: trip, at: 50h}\n- {name: USE_2, record: trip, at: 60h}\n"


@pytest.mark.parametrize(
    ("member", "use", "told", "written"),
    [
        (
            "reason",
            "trip",
            "trip_2_reason: the old name `trip_2_cause` stays as an alias",
            "{name: reason, was: [cause],",
        ),
        ("cause", "fault", "fault_2_cause: write `was: [trip_2_cause]` by hand", "{name: cause, at: base}"),
    ],
)
def test_old_names_of_a_record(member: str, use: str, told: str, written: str, diff: Diff) -> None:
    diff.write("old", USES.replace("USE", "trip"), records=RECORDS.replace("MEMBER", "cause"))
    file = diff.write("new", USES.replace("USE", use), records=RECORDS.replace("MEMBER", member))
    assert told in diff("old", "new", "--keep-names").err
    assert written in file.read_text("utf-8")


def test_an_old_name_of_variants(diff: Diff) -> None:
    axes = "{size: {title: Size, values: {small: {title: Small}, large: {title: Large}}}}"
    point = "- {name: NAME, at: 1, variants: {size=small: {range: 0..5}, size=large: {range: 0..9}}}\n"
    diff.write("old", point.replace("NAME", "level"), variants=axes)
    file = diff.write("new", point.replace("NAME", "height"), variants=axes)
    told = diff("old", "new", "--keep-names", "--fail-on", "breaking")
    assert told.code == 0, told
    assert "{name: height, was: [level], at: 1" in file.read_text("utf-8")


def test_an_old_name_that_would_be_a_finding_is_not_written(diff: Diff) -> None:
    """Somebody else is called so by now."""
    file = diff.write("new", "- {name: pace, at: 10h, range: 0..4000}\n- {name: speed, at: 11h}\n")
    diff.write("old", "- {name: speed, at: 10h, range: 0..4000}\n")
    before = file.read_bytes()
    diff("old", "new", "--keep-names")
    assert file.read_bytes() == before


def test_old_names_are_written_to_descriptions_alone(repository: Diff) -> None:
    told = repository("old", "v1:new", "--keep-names")
    assert (told.code, told.out) == (2, "")
    assert "--keep-names" in told.err


@pytest.mark.full(seconds=2)
def test_settings_of_the_line_are_told_once(diff: Diff) -> None:
    """A text is its own code where the manual prints no other."""
    bus = (
        "{framings: [rtu], units: 1..247, functions: {03h: read_holding_registers}, serial: {baud: RATE, data: {1: 8}}}"
    )
    for name, rate in (("before", "9600"), ("after", "19200")):
        diff.write(name, POINTS, bus=bus.replace("RATE", rate))
    assert "serial baud 9600; data 1 8 -> baud 19200; data 1 8" in diff("before", "after").out


def test_several_things_are_called_what_they_are(diff: Diff) -> None:
    errata = "".join(
        f"- {{id: {name}, where: title, line: 1, printed: Nothing., taken: X., why: X., certainty: likely}}\n"
        for name in ("first", "second")
    )
    for name, taken in (("before", "X."), ("after", "Y.")):
        file = diff.write(name, POINTS)
        text = file.read_text("utf-8").replace(
            "---", f"errata:\n{errata}---".replace("taken: X.", f"taken: {taken}"), 1
        )
        file.write_text(text, "utf-8")
    assert "2 errata (erratum:first, erratum:second): taken" in diff("before", "after").out


def test_devices_that_have_nothing_in_common() -> None:
    """Every fact, part and value of every family finds its words."""
    models = [{**export_model(made(name)), "device": "one"} for name in KITCHENS]
    for old, new in permutations(models, 2):
        comparisons = compared({"one": Side(old, None, "old.json")}, {"one": Side(new, None, "new.json")})
        assert list(as_text(comparisons))
        assert list(as_markdown(comparisons))
        assert json.dumps(as_data(comparisons))
