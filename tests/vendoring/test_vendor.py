"""`fieldscribe vendor`: exactly the files that a project needs, for all of a device or some points."""

from __future__ import annotations

import json
import re
import shutil
from hashlib import sha256
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import Report, UnclearError
from fieldscribe.model import Device
from fieldscribe.output.files import VENDORED, made_of
from fieldscribe.pipeline import load_device
from fieldscribe.vendoring.requests import LANGUAGES, LICENCE, CodeRequest, files_of
from fieldscribe.vendoring.selection import select
from support.c_device import PROGRAMS, WARNINGS
from support.described import SHIPPED, described, group, head, loaded_in, made, shipped, together, write
from support.places import ROOT
from support.toolchains import succeed, tool

pytestmark = pytest.mark.usefixtures("loads_once")

RUNTIME = {"fieldscribe.h", "fieldscribe_modbus.h", "fieldscribe_modbus_facts.h"}
TEN = "A001,A002,A003,A020,D001,D002,F002,F003,run_command,inverter_status"
TWELVE = "A020,A001,A002,A004,F002,F003,D001,D002,D003,D004,D081,B012"
LANGUAGES_OF_C = (
    ("gcc", "-std=c99", "-DFIELDSCRIBE_NO_FLOAT"),
    ("clang", "-std=c99"),
    ("clang", "-std=c99", "-DFIELDSCRIBE_NO_FLOAT"),
    ("gcc", "-xc++", "-std=c++17"),
    ("clang", "-xc++", "-std=c++17", "-DFIELDSCRIBE_NO_FLOAT"),
)
HARD = TEN.replace("A003,A020", "A061,A062")
"""Two whose limits depend on other points."""


def vendor(*words: str | Path) -> int:
    return main(["vendor", *map(str, words)])


def names(device: Device, *words: str) -> list[str]:
    """The points that are left of a device."""
    return [point.item for point in select(device, words).points]


@pytest.mark.parametrize(
    ("device", "words", "points"),
    [
        ("hitachi_l200", ("A020",), ["base_frequency"]),
        ("hitachi_l200", ("a020", "base_frequency"), ["base_frequency"]),
        ("hitachi_l200", ("name:base_frequency",), ["base_frequency"]),
        (
            "hitachi_l200",
            ("*_command", "d00[12]"),
            ["run_command", "direction_command", "output_frequency", "motor_current"],
        ),
        # a limit needs the points that it is made of, and not their limits
        ("hitachi_l200", ("A061",), ["maximum_frequency", "upper_frequency_limit", "lower_frequency_limit"]),
        ("hitachi_l200", ("A062",), ["upper_frequency_limit", "lower_frequency_limit", "start_frequency"]),
        ("hitachi_l200", ("group:monitor_d",), None),
        ("hitachi_l200", ("monitor_d",), None),
        ("woodward_mpu2s", ("generator_active_power",), ["generator_active_power", "generator_power_exponent"]),
        ("nord_sk5xxe", ("P050[2]",), ["setpoint_1"]),
        # clients identify the device by any choice of points
        ("fronius_datamanager", ("SN",), ["manufacturer", "serial_number"]),
    ],
)
def test_points_are_chosen_with_what_they_need(device: str, words: tuple[str, ...], points: list[str] | None) -> None:
    whole = shipped(device)
    group = words[0].removeprefix("group:")
    assert names(whole, *words) == (points or [point.item for point in whole.points if point.group == group])


def test_a_code_comes_before_a_name(tmp_path: Path) -> None:
    device = loaded_in(tmp_path, described("- {name: first, code: second, at: 1}\n- {name: second, at: 2}\n"))
    assert names(device, "second") == ["first"]
    assert names(device, "name:second") == ["second"]


def test_a_command_is_chosen_by_its_name() -> None:
    device = shipped("hitachi_l200")
    with_command = select(device, ["A020", "enter"])
    assert [command.name for command in with_command.commands] == ["enter"]
    assert {"base_frequency", "data_write"} == {point.name for point in with_command.points}  # it says when it is done
    assert not select(device, ["A020"]).commands


@pytest.mark.parametrize(
    ("device", "word", "message", "hint"),
    [
        ("hitachi_l200", "A0020", "no point, group or command `A0020`", "did you mean"),
        ("hitachi_l200", "A02O", "no point, group or command `A02O`", "did you mean `A020`"),
        ("hitachi_l200", "enterr", "`enterr`", "`enter`"),
        ("hitachi_l200", "zzz*", "`zzz*`", "fieldscribe list hitachi_l200"),
        ("hitachi_l200", "4137", "`4137`", ""),
        ("hitachi_l200", "reserved_coil_0004", "cannot be used in code: reserved by the maker", "leave it out"),
    ],
)
def test_words_that_mean_nothing(device: str, word: str, message: str, hint: str) -> None:
    with pytest.raises(UnclearError) as refused:
        select(shipped(device), [word])
    assert message in refused.value.message
    assert hint in refused.value.hint


def test_all_wrong_words_are_told_at_once(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", "A02O,D001,Q1") == 2
    shown_text = capsys.readouterr().err
    assert "`A02O`; hitachi_l200 has no point, group or command `Q1`" in shown_text
    assert "for `A02O`, did you mean `A020`" in shown_text
    with pytest.raises(UnclearError, match="and 10 more"):
        select(shipped("hitachi_l200"), [f"none{number}" for number in range(30)])


def test_a_point_that_is_documented_only_is_told(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert vendor("c", "siemens_mm4", "--out", tmp_path, "--points", "r0021") == 0
    assert "`r0021` comes with its address alone, and no conversion: the manual" in capsys.readouterr().err


@pytest.mark.parametrize(("points", "most"), [(TEN, 28), (HARD, 34)])
def test_ten_points_are_small_and_compile(points: str, most: int, tmp_path: Path) -> None:
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", points) == 0
    left = {path.name: path.stat().st_size for path in tmp_path.iterdir()}
    assert left.keys() == {*RUNTIME, "hitachi_l200.h", "hitachi_l200_modbus.h", "hitachi_l200.manifest.json", LICENCE}
    assert left["hitachi_l200.h"] <= 20 * 1024
    assert left["hitachi_l200.h"] + left["hitachi_l200_modbus.h"] <= most * 1024
    compiles(tmp_path, "hitachi_l200_modbus.h")


def compiles(folder: Path, *headers: str) -> None:
    """One C file that includes these headers is compiled and linked, without a warning."""
    text = "".join(f'#include "{header}"\n' for header in headers)
    (folder / "all.c").write_text(f"#define FIELDSCRIBE_IMPLEMENTATION\n{text}int main(void) {{ return 0; }}\n")
    succeed([tool("gcc"), *WARNINGS, "-std=c99", f"-I{folder}", folder / "all.c", "-o", folder / "all"])
    (folder / "all").unlink()
    (folder / "all.c").unlink()


@pytest.mark.parametrize("device", SHIPPED)
def test_all_of_a_device_is_what_generate_makes(device: str, tmp_path: Path) -> None:
    assert vendor("c", device, "--out", tmp_path) == 0
    made_headers = {path.name: path.read_text("utf-8") for path in tmp_path.glob("*.h")}
    head = re.compile("Regenerate with: .*")
    for name, text in made_headers.items():
        assert head.sub("", text) == head.sub("", (ROOT / "generated/c" / name).read_text("utf-8")), name


@pytest.mark.parametrize("device", SHIPPED)
def test_lines_of_a_choice_are_lines_of_the_whole(device: str) -> None:
    """Nothing of a point changes its name or its bytes because others are left out."""
    whole = shipped(device)
    known = {line for _, text in files_of(whole, CodeRequest("c")) for line in text.split("\n")}
    alone = [point.item for point in whole.points if point.generated and not (point.arguments or point.changes_with)]
    every_third = tuple(alone[::3])
    new = [
        line
        for name, text in files_of(whole, CodeRequest("c", every_third))
        if name.startswith(device)
        for line in text.split("\n")
        if line not in known
    ]
    allowed = re.compile(
        r" \* Generated by| \* Regenerate with|#if \w+_DESCRIPTION != |#define \w+_DESCRIPTION(_DIGEST)? |"
        r"    case \d+U:|        .*\bwords\[\d+\]|"
        r"    0x\w+U, /\*|#define \w+_(BLOCK_MOST|GROUP_COUNT) |    \{\d+U, 0x\w+, \d+U\}, /\*|/\* ---- "
    )
    assert [line for line in new if not allowed.match(line)] == []


@pytest.mark.full(seconds=6)
@pytest.mark.parametrize("device", [*SHIPPED, "kitchen_sink", "kitchen_can", "kitchen_uss", "kitchen_codes"])
def test_each_point_alone_compiles(device: str, tmp_path: Path) -> None:
    """With what it needs of the runtime; points that need the same lie in one program, under names of their own.

    Made devices have all mechanisms; of shipped ones every fifth point will do. Every seventh program is linked, too:
    what several cuts of a runtime lack is missing in one of them.
    """
    whole = shipped(device) if device in SHIPPED else made(device)
    folders: dict[tuple[str, ...], Path] = {}
    for number, point in enumerate(whole.points[:: 5 if device in SHIPPED else 1]):
        if point.generated or point.raw_only:
            texts = dict(files_of(whole, CodeRequest("c", (f"name:{point.item}",), f"alone_{number}")))
            runtime = tuple(text for name, text in texts.items() if name.startswith("fieldscribe"))
            folder = folders.setdefault(runtime, tmp_path / str(len(folders)))
            folder.mkdir(exist_ok=True)
            for path, text in texts.items():
                (folder / path).write_text(text, "utf-8")
    for number, folder in enumerate(folders.values()):
        compiler, *standard = LANGUAGES_OF_C[number % len(LANGUAGES_OF_C)]
        source = "".join(f'#include "{path.name}"\n' for path in folder.glob("*.h"))
        source = f"#define FIELDSCRIBE_IMPLEMENTATION\n{source}int main(void) {{ return 0; }}\n"
        (folder / "each.c").write_text(source, "utf-8")
        result = ("-fsyntax-only",) if number % 7 else ("-o", folder / "each")
        succeed([tool(compiler), *WARNINGS, *standard, f"-I{folder}", folder / "each.c", *result])


@pytest.mark.full(seconds=1)
def test_all_in_one_file_beside_another_version(tmp_path: Path) -> None:
    """Two devices, and two versions of one, live in one program."""
    older = ROOT / "descriptions/hitachi_l200"
    shutil.copytree(older, tmp_path / "older")
    text = (tmp_path / "older/device.yaml").read_text("utf-8").replace("version: 1.0.0", "version: 0.9.0")
    (tmp_path / "older/device.yaml").write_text(text, "utf-8")
    out = tmp_path / "out"
    assert vendor("c", "hitachi_l200", "--out", out, "--points", TEN, "--single-file") == 0
    assert vendor("c", tmp_path / "older", "--out", out, "--points", TEN, "--single-file", "--as", "older_l200") == 0
    assert vendor("c", "siemens_mm4", "--out", out, "--points", "P1082", "--single-file") == 0
    assert sorted(path.name for path in out.glob("*.h")) == ["hitachi_l200.h", "older_l200.h", "siemens_mm4.h"]
    compiles(out, "hitachi_l200.h", "older_l200.h", "siemens_mm4.h")
    assert "OLDER_L200_DESCRIPTION_VERSION_NUMBER 9000UL" in (out / "older_l200.h").read_text("utf-8")


@pytest.mark.parametrize("how", [(), ("--single-file",), ("--no-frames",)])
def test_a_command_with_steps_comes_with_what_it_needs(how: tuple[str, ...], tmp_path: Path) -> None:
    """The points of its conditions, which are read, and the function that fills in the words of a step."""
    assert vendor("c", ROOT / "tests/devices/kitchen_sink", "--out", tmp_path, "--points", "ask", *how) == 0
    headers = {path.name: path.read_text("utf-8") for path in tmp_path.glob("*.h")}
    text = "".join(headers.values())
    assert "bool fieldscribe_modbus_steps_fill(" in text
    assert "#define KITCHEN_SINK_COMMAND_ASK_STEPS 5U" in text
    assert "KITCHEN_SINK_COMMAND_CLOSE_BREAKER" not in text
    assert "KITCHEN_SINK_CONTROL_MODE_ADDRESS" in text
    compiles(tmp_path, "kitchen_sink.h" if "--single-file" in how else "kitchen_sink_modbus.h")


def test_points_alone_need_no_frames(tmp_path: Path) -> None:
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", "A020", "--no-frames") == 0
    constants = ["fieldscribe.h", "fieldscribe_modbus_facts.h", "hitachi_l200.h", "hitachi_l200_modbus.h"]
    assert sorted(path.name for path in tmp_path.glob("*.h")) == constants
    compiles(tmp_path, "hitachi_l200_modbus.h")
    assert vendor("c", "siemens_mm4", "--out", tmp_path / "uss", "--points", "P1082", "--no-frames") == 0
    assert sorted(path.name for path in tmp_path.glob("uss/*.h")) == ["fieldscribe.h", "siemens_mm4.h"]


@pytest.mark.parametrize(
    ("code", "in_head"),
    [
        ("A020", dict.fromkeys(("c", "python", "rust", "typescript"), "A020")),
        ("$(touch /x)", dict.fromkeys(("c", "python", "rust", "typescript"), "'$(touch /x)'")),
        ("a;b`c`", dict.fromkeys(("c", "python", "rust", "typescript"), "'a;b`c`'")),
        ("x*/y", {"c": "...", "python": "'x*/y'", "rust": "'x*/y'"}),
        ("it's #1", {"c": """'it'"'"'s #1'""", "python": "...", "rust": """'it'"'"'s #1'"""}),
        ("A,B", dict.fromkeys(("c", "python", "rust", "typescript"), "...")),
        ("a  b", dict.fromkeys(("c", "python", "rust", "typescript"), "...")),
    ],
)
def test_the_command_in_a_head_can_be_pasted(code: str, in_head: dict[str, str], tmp_path: Path) -> None:
    """Whatever a code holds: a shell gets the same words, or three dots."""
    place = write(tmp_path, described(f"- {{name: odd_one, code: {json.dumps(code)}, at: 1}}\n"))
    device = load_device(place, Report())
    assert device is not None
    for language, points in in_head.items():
        wanted = f"fieldscribe vendor {language} made_up --points {points}\n"
        texts = [text for path, text in files_of(device, CodeRequest(language, (code,))) if "made_up" in path]
        heads = [text for text in texts if "egenerate" in text]
        assert heads
        assert all(wanted in text for text in heads)


def test_points_from_a_file(tmp_path: Path) -> None:
    (tmp_path / "points.txt").write_text("A001, D001  # what the panel shows\n\n# and what it sets\nF002\n", "utf-8")
    assert vendor("c", "hitachi_l200", "--out", tmp_path / "out", "--points", f"@{tmp_path / 'points.txt'}") == 0
    requested = json.loads((tmp_path / "out/hitachi_l200.manifest.json").read_text("utf-8"))["asked"]
    assert requested == {"c": {"device": "hitachi_l200", "points": ["A001", "D001", "F002"]}}


def test_check_tells_what_is_missing_stale_edited_and_foreign(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    order = ("c", "hitachi_l200", "--out", out, "--points", TEN)

    def check() -> dict[str, list[str]]:
        capsys.readouterr()
        code = vendor(*order, "--check", "--format", "json")
        [delivery] = json.loads(capsys.readouterr().out)["deliveries"]
        wrong = {key: delivery[key] for key in ("missing", "edited", "stale", "refused") if delivery[key]}
        assert code == (1 if wrong else 0)
        return wrong

    assert len(check()["missing"]) == 7
    assert vendor(*order) == 0
    assert check() == {}
    (out / "fieldscribe.h").unlink()
    header = (out / "hitachi_l200.h").read_text("utf-8")
    (out / "hitachi_l200.h").write_text(header.replace("4000, raw", "5000, raw"), "utf-8")
    assert check() == {"missing": ["fieldscribe.h"], "edited": ["hitachi_l200.h"]}
    assert vendor(*order) == 0
    assert (out / "hitachi_l200.h").read_text("utf-8") == header
    order = (*order[:-1], "A001")
    assert check() == {"stale": sorted({path.name for path in out.iterdir()} - {LICENCE})}
    shutil.rmtree(out)
    out.mkdir()
    (out / "fieldscribe.h").write_text("by hand", "utf-8")
    assert list(check()["refused"]) == ["fieldscribe.h"]
    assert vendor(*order) == 1
    assert [path.name for path in out.iterdir()] == ["fieldscribe.h"]
    assert vendor(*order, "--force") == 0


def test_what_nobody_took_changes_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Only the chosen points decide whether vendored files are current."""
    shutil.copytree(ROOT / "descriptions/hitachi_l200", tmp_path / "hitachi_l200")
    order = ("c", tmp_path / "hitachi_l200", "--out", tmp_path / "out", "--points", "D001,F002")
    assert vendor(*order) == 0
    coils = tmp_path / "hitachi_l200/coils.yaml"
    text = coils.read_text("utf-8")
    coils.write_text(text.replace("name: trip_reset", "name: trip_acknowledge", 1), "utf-8")
    assert coils.read_text("utf-8") != text
    assert vendor(*order, "--check") == 0, capsys.readouterr()


def test_a_code_may_have_a_sharp_in_a_file(tmp_path: Path) -> None:
    place = write(tmp_path / "made_up", described('- {name: odd_one, code: "P#1", at: 1}\n'))
    (tmp_path / "points.txt").write_text("P#1 # this\n#and that\n", "utf-8")
    assert vendor("c", place, "--out", tmp_path / "out", "--points", f"@{tmp_path / 'points.txt'}") == 0
    requested = json.loads((tmp_path / "out/made_up.manifest.json").read_text("utf-8"))["asked"]
    assert requested["c"]["points"] == ["P#1"]


def test_an_edited_manifest_removes_no_foreign_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A manifest may name what it likes: files go by our head or by a name that only ours have."""
    order = ("c", "hitachi_l200", "--out", tmp_path, "--points", "A020")
    assert vendor(*order) == 0
    (tmp_path / "main.c").write_text("int main(void) { return 0; }\n", "utf-8")
    shutil.copy(tmp_path / "fieldscribe.h", tmp_path / "fieldscribe_older.h")
    head = (tmp_path / "hitachi_l200.h").read_text("utf-8").partition("*/")[0]
    (tmp_path / "hitachi_l200_older.h").write_text(f"{head}*/\n", "utf-8")
    manifest = tmp_path / "hitachi_l200.manifest.json"
    document = json.loads(manifest.read_text("utf-8"))
    for name in ("main.c", "fieldscribe_older.h", "hitachi_l200_older.h"):
        document["targets"]["c"][name] = sha256((tmp_path / name).read_bytes()).hexdigest()
    manifest.write_text(json.dumps(document), "utf-8")
    capsys.readouterr()
    assert vendor(*order) == 0
    printed = capsys.readouterr().out
    assert (tmp_path / "main.c").is_file()
    assert not list(tmp_path.glob("*_older.h"))
    assert [line.split(": ")[0] for line in printed.splitlines()[:3]] == [
        "removed",
        "removed",
        "left in place, as it was edited by hand or is not ours",
    ]
    assert "main.c" not in manifest.read_text("utf-8")


def test_files_without_our_head_go_with_their_wish(tmp_path: Path) -> None:
    """All that is left of one request goes when another takes its place."""
    for language in ("c", "python", "rust", "typescript", "csv", "markdown"):
        if language in LANGUAGES:
            assert vendor(language, "hitachi_l200", "--out", tmp_path / language, "--points", "A020") == 0
        else:
            assert main(["docs", "hitachi_l200", "--format", language, "--out", str(tmp_path / language)]) == 0
        known = {path for path in (tmp_path / language).rglob("*") if path.is_file()}
        for path in known:
            name = path.relative_to(tmp_path / language).as_posix()
            assert VENDORED.names(name, "hitachi_l200") or made_of(path.read_bytes()) == "hitachi_l200", name


def test_what_is_in_the_way_gets_advice_that_helps(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a link out of the folder, a name that is too long and a folder, --force makes no file."""
    out, order = tmp_path / "out", ("python", "hitachi_l200", "--points", "A020", "--out", tmp_path / "out")
    (tmp_path / "elsewhere").mkdir()
    out.mkdir()
    (out / "hitachi_l200").symlink_to(tmp_path / "elsewhere")
    for words in ((), ("--force",), ("--as", "a" * 250)):
        assert vendor(*order, *words) in (1, 2)
        printed = capsys.readouterr().err
        assert "--force" not in printed
        assert "hint: " in printed
    (out / "hitachi_l200").unlink()
    (out / ".fieldscribe-new").mkdir()
    assert vendor(*order) == 2
    assert "hint: move it away" in capsys.readouterr().err
    assert not list((tmp_path / "elsewhere").iterdir())


@pytest.mark.parametrize(("words", "most"), [((TWELVE,), 1860), (("A020",), 1200), (("A020", "--no-frames"), 500)])
def test_runtime_that_nobody_calls_is_left_out(words: tuple[str, ...], most: int, tmp_path: Path) -> None:
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", *words) == 0
    assert sum(len(path.read_text("utf-8").splitlines()) for path in tmp_path.iterdir()) <= most


@pytest.mark.parametrize(
    ("words", "kept"),
    [
        ("A020", set()),
        ("A020,fieldscribe_modbus_build_pdu", {"fieldscribe_modbus_build_pdu"}),
        ("A020,fieldscribe_take_*", {"fieldscribe_take_s64", "fieldscribe_take_text"}),
    ],
)
def test_words_keep_parts_of_the_runtime(words: str, kept: set[str], tmp_path: Path) -> None:
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", words) == 0
    texts = "".join((tmp_path / name).read_text("utf-8") for name in RUNTIME)
    names = ("fieldscribe_modbus_build_pdu", "fieldscribe_take_s64", "fieldscribe_take_text", "fieldscribe_rule_times")
    assert {name for name in names if name in texts} == kept
    assert "#define FIELDSCRIBE_COUNT(" in texts  # which programs of users need
    assert ("base_frequency_frame" in (tmp_path / "hitachi_l200_modbus.h").read_text("utf-8")) == bool(kept)
    compiles(tmp_path, "hitachi_l200_modbus.h")


def test_twelve_points_with_their_runtime_can_be_reviewed(tmp_path: Path) -> None:
    points = "A020,A001,A002,A004,F002,F003,D001,D002,D003,D004,D081,B012"
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", points) == 0
    assert sum(len(file.read_text("utf-8").splitlines()) for file in tmp_path.iterdir()) <= 1500
    compiles(tmp_path, "hitachi_l200_modbus.h")


@pytest.mark.parametrize(("words", "comes"), [("F002,A020", False), ("F002,A020,fieldscribe_modbus_await_rtu", True)])
def test_calls_leave_out_the_functions_that_they_do_without(words: str, comes: bool, tmp_path: Path) -> None:
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", words) == 0
    text = "".join((tmp_path / f"hitachi_l200{tail}.h").read_text("utf-8") for tail in ("", "_modbus"))
    for name in ("base_frequency_check(", "acceleration_time_to_words(", "standard_a_blocks[", "basic_f_blocks["):
        assert (name in text) == comes, name
    compiles(tmp_path, "hitachi_l200_modbus.h")


@pytest.mark.parametrize(
    ("device", "words", "parts"),
    [
        ("hitachi_l200", "D001", set()),
        ("hitachi_l200", "A020", {"writes"}),
        ("hitachi_l200", "run_command", {"coils", "writes"}),
        ("hitachi_l200", "running,fieldscribe_modbus_build_tcp", {"coils", "tcp"}),
        ("hitachi_l200", "D001,fieldscribe_modbus_*", {"coils", "writes", "tcp"}),
        ("fronius_datamanager", "group:common", {"tcp"}),
    ],
)
def test_parts_of_the_runtime_that_no_point_needs_are_left_out(
    device: str, words: str, parts: set[str], tmp_path: Path
) -> None:
    assert vendor("c", device, "--out", tmp_path, "--points", words) == 0
    text = "".join((tmp_path / name).read_text("utf-8") for name in sorted(RUNTIME))
    lines = {"coils": "% 8U)) & 1U", "writes": "_writer *writer;", "tcp": "    uint16_t transaction;"}
    assert {part for part, line in lines.items() if line in text} == parts
    assert ("#if defined(FIELDSCRIBE_MODBUS_" in text) == (len(parts) == 3)
    compiles(tmp_path, f"{device}_modbus.h")


@pytest.mark.parametrize(("words", "has_pages"), [("delay", True), ("page", False)])
def test_a_point_behind_a_page_brings_the_count_of_requests(words: str, has_pages: bool, tmp_path: Path) -> None:
    page = group("- {name: page, at: 1, range: 0..1}\n")
    behind = group("- {name: delay, at: 2}\n", group="behind", select="{page: 1}")
    file = write(tmp_path, together(head(device="drive"), page, behind))
    assert vendor("c", file, "--out", tmp_path, "--points", words) == 0
    assert ("_select(" in (tmp_path / "fieldscribe_modbus.h").read_text("utf-8")) == has_pages
    compiles(tmp_path, "drive_modbus.h")


def test_reads_do_the_same_without_the_other_parts_of_the_runtime(tmp_path: Path) -> None:
    parts = ",".join(f"fieldscribe_modbus_{name}_rtu" for name in ("build", "parse", "ask"))
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", f"D001,D002,D003,{parts}") == 0
    printed = []
    for folder in (tmp_path, ROOT / "generated/c"):
        words = tool("gcc"), *WARNINGS, "-std=c99", f"-I{folder}", PROGRAMS / "spoiled_reads.c", "-o", tmp_path / "run"
        succeed([*words])
        printed.append(succeed([tmp_path / "run"]).splitlines())
    assert [lines for lines in zip(*printed, strict=True) if lines[0] != lines[1]][:3] == []
    assert len(set(printed[0])) > 30


@pytest.mark.full(seconds=1)
def test_devices_in_one_folder_have_what_each_of_them_uses(tmp_path: Path) -> None:
    """In whatever order they come; a foreign edit, a choice that changed and a device that went are noticed."""
    l200 = ("c", "hitachi_l200", "--out", tmp_path, "--points", "A020")
    mm4 = ("c", "siemens_mm4", "--out", tmp_path, "--points", "P1082,fieldscribe_take_s64")
    whole = ("c", "jumo_controller", "--out", tmp_path)
    order: tuple[str | Path, ...]
    for order in (l200, mm4):
        assert vendor(*order) == 0
    for order in (l200, mm4):
        assert vendor(*order, "--check") == 0
    compiles(tmp_path, "hitachi_l200_modbus.h", "siemens_mm4_uss.h")
    small = (tmp_path / "fieldscribe.h").read_text("utf-8")
    assert vendor(*whole) == 0
    for order in (l200, mm4, whole):
        assert vendor(*order, "--check") == 0
    compiles(tmp_path, "hitachi_l200_modbus.h", "siemens_mm4_uss.h", "jumo_controller_modbus.h")
    for path in tmp_path.glob("jumo_controller*"):
        path.unlink()
    assert vendor(*l200, "--check") == 1
    assert vendor(*l200) == 0
    assert vendor(*mm4, "--check") == 0
    assert (tmp_path / "fieldscribe.h").read_text("utf-8") == small


def test_two_devices_share_the_runtime(tmp_path: Path) -> None:
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", "D001") == 0
    assert vendor("c", "jumo_controller", "--out", tmp_path) == 0
    assert vendor("c", "hitachi_l200", "--out", tmp_path, "--points", "D001", "--no-frames") == 0
    assert (tmp_path / "fieldscribe_modbus.h").is_file()  # the other device has it
    compiles(tmp_path, "hitachi_l200_modbus.h", "jumo_controller_modbus.h")


@pytest.mark.parametrize(
    ("words", "shown_text"),
    [
        (("c", "hitachi_l200"), "--out DIR is missing"),
        (("c",), "DEVICE is missing"),
        (("d", "hitachi_l200", "--out", "x"), "`d` is not a language"),
        (("--points", "A001"), "LANGUAGE and DEVICE are missing"),
        (("--points", ""), "LANGUAGE and DEVICE are missing"),
        (("--as", ""), "LANGUAGE and DEVICE are missing"),
        (("--wheel",), "LANGUAGE and DEVICE are missing"),
        ((), "there is no project file fieldscribe.toml"),
        (("python", "hitachi_l200", "--out", "x", "--single-file"), "--single-file is for c"),
        (("rust", "hitachi_l200", "--out", "x", "--no-frames"), "--no-frames is for c"),
        (("c", "hitachi_l200", "--out", "x", "--points", " , "), "--points names no point"),
        (("c", "hitachi_l200", "--out", "x", "--points", "@nothing"), "cannot read nothing: No such file"),
        (("c", "hitachi_l200", "--out", "x", "--points", "A0Z1"), "no point, group or command `A0Z1`"),
        (("c", "hitachi_l200", "--out", "x", "--as", "../x"), "`../x` is no name"),
        (("c", "hitachi_l200", "--out", "x", "--as", "stdint"), "hides the one of the C library"),
        (("c", "hitachi_l200", "--out", "x", "--as", "serial"), "`serial` is a library that the runtime"),
        (("c", "hitachi_l200", "--out", "x", "--points", "A020,fieldscribe_reed"), "has no `fieldscribe_reed`"),
        (
            ("c", "hitachi_l200", "--out", "x", "--points", "fieldscribe_*"),
            "no point, group or command `fieldscribe_*`",
        ),
        (("python", "hitachi_l200", "jumo_controller", "--out", "x"), "call it once for each, or name them in"),
        (
            ("c", "hitachi_l200", "--out", "x", "--points", "A001", "A002"),
            "commas between points, as in --points A001,",
        ),
        (("c", "hitachi_l2000", "--out", "x"), "did you mean `hitachi_l200`"),
    ],
)
def test_wrong_calls(
    words: tuple[str, ...],
    shown_text: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert vendor(*words) == 2
    assert shown_text in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_outputs_are_listed_before_they_are_made_and_a_rule_names_them(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What a build system asks before it builds, and after."""
    device, out = ROOT / "tests/devices/kitchen_can", tmp_path / "drivers"
    (tmp_path / "points.txt").write_text("*\n", "utf-8")
    words = ("c", device, "--out", out, "--points", f"@{tmp_path / 'points.txt'}")
    assert vendor(*words, "--list-outputs") == 0
    listed = capsys.readouterr().out.split()
    assert not out.exists()
    assert vendor(*words, "--depfile", tmp_path / "drivers.d") == 0
    assert sorted(listed) == sorted(map(str, out.iterdir()))
    rule, *empty = (tmp_path / "drivers.d").read_text("utf-8").replace("\\\n", "").splitlines()
    outputs, inputs = (part.split() for part in rule.split(":"))
    assert outputs == listed
    assert {str(device / "device.yaml"), str(device / "words.yaml"), str(tmp_path / "points.txt")} < set(inputs)
    assert str(ROOT / "templates/c/device.h.j2") in inputs
    assert empty == [f"{path}:" for path in inputs]
