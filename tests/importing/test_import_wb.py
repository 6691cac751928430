"""`import wb`: templates to the description of a device, what is not carried, and templates that break out or loop."""

from __future__ import annotations

import json
import os
import re
from itertools import count
from pathlib import Path
from typing import Any

import corpus.__main__ as corpus
import pytest
from fieldscribe.cli import main
from fieldscribe.importing.wb import rendering
from fieldscribe.importing.wb.conditions import Condition, Parameters, condition_of
from fieldscribe.importing.wb.templates import Texts
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

FOLDER = Path(__file__).parent / "wb"


@pytest.mark.parametrize("template", ["heater.json", "relays.json.jinja", "fields.json", "conditions.json"])
def test_a_template_becomes_a_device(template: str, capsys: pytest.CaptureFixture[str]) -> None:
    """FIELDSCRIBE_ACCEPT=1 writes the drafts; look at the difference."""
    assert main(["import", "wb", str(FOLDER / template), "--device", "heater"]) == 0
    draft, report = capsys.readouterr()
    path = FOLDER / f"{template.partition('.')[0]}.draft"
    if os.environ.get("FIELDSCRIBE_ACCEPT"):
        path.write_text(f"{draft}# {report}", "utf-8")
    assert f"{draft}# {report}" == path.read_text("utf-8")


def test_a_collection_has_a_line_of_marks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, path in (("config-a.json", "heater.json"), ("config-b.json.jinja", "relays.json.jinja")):
        (tmp_path / name).write_bytes((FOLDER / path).read_bytes())
    (tmp_path / "config-c.json").write_text('{"device": {"protocol": "milur"}}', "utf-8")
    (tmp_path / "config-d.json").write_text("[]", "utf-8")
    assert corpus.main(tmp_path) == 0
    printed = capsys.readouterr().out
    assert re.search(r"^\| wb \| 3 \| 1 \| 0 \| 24 \| 83.33% \| \d+ \|$", printed, re.MULTILINE)
    assert "  config-b.json.jinja: the template does not render: relays_inputs.json.jinja\n" in printed
    assert "  config-d.json: this is no template: there is no `device`\n" in printed
    assert "  not carried: condition: 2 in 1 files, alone in 0\n" in printed


def imported(template: Any, folder: Path, capsys: pytest.CaptureFixture[str], name: str = "config-a.json") -> str:
    """Return the draft of a template, or the message."""
    path = folder / name
    path.write_text(template if isinstance(template, str) else json.dumps(template), "utf-8")
    main(["import", "wb", str(path)])
    draft, message = capsys.readouterr()
    return draft or message


class Known(Parameters):
    """Parameters of which `gone` is none, and `far` exists under a condition."""

    def __init__(self) -> None:
        super().__init__([], Texts(None))

    def compared(self, name: str, sign: str, number: int) -> Condition:
        return sign == "!=" if name == "gone" else f"{name} {sign} {number}"

    def defined(self, name: str) -> Condition:
        known: dict[str, Condition] = {"gone": False, "far": "exists(far)"}
        return known.get(name, True)


@pytest.mark.parametrize(
    ("template", "description"),
    [
        ("a==1", "a == 1"),
        ("(((a==1)))&&!(b>-2)", "a == 1 and not (b > -2)"),
        ("a==1||a==2||b==3||a==2", "a in (1, 2) or b == 3"),
        ("a!=1&&(b==1||c<=2)", "a != 1 and (b == 1 or c <= 2)"),
        ("3<=a", "a >= 3"),
        ("isDefined(far)==0||far==1", "not exists(far) or far == 1"),
        ("isDefined(far)&&b==1", "exists(far) and b == 1"),
        ("isDefined(a)==0||a==1", "a == 1"),
        ("gone==1", False),
        ("a==1&&gone==1", False),
        ("(a==1||b==2)||a==3", "a in (1, 3) or b == 2"),
        ("a==1&&b==2||a==3", "a == 1 and b == 2 or a == 3"),
        ("gone!=1||a==1", True),
        ("a==1&&(2==2)", "a == 1"),
        ("b==0&&(!(b==0)||a==1)", "b == 0 and a == 1"),
        *(
            (text, None)
            for text in ("", "a", "a=1", "a==b", "a==1.5", "f(a)", "a<b<c", "a==1)", "(" * 900, "a+1==2", "a" * 5000)
        ),
        *((text, None) for text in ("isDefined(a,b)", "isDefined('a')", "__import__('os')", "[a for a in b]", "a:=1")),
    ],
)
def test_conditions(template: str, description: Condition | None) -> None:
    """None stands for what cannot be read."""
    if description is None:
        with pytest.raises(ValueError, match=r"understood|number|characters"):
            condition_of(template, Known())
    else:
        assert condition_of(template, Known()) == description


@pytest.mark.parametrize(
    ("template", "message"),
    [
        ("{{ ''.__class__ }}", "access to attribute '__class__' of 'str' object is unsafe"),
        ("{{ [].extend([1]) }}", "access to attribute 'extend' of 'list' object is unsafe"),
        ("{{ cycler.__init__.__globals__ }}", "is unsafe"),
        ("{% include '../secret.json' %}", "../secret.json"),
        ("{% include 'link.json' %}", "link.json"),
        ("{{ missing }}", "'missing' is undefined"),
        ("{% for %}", "does not render"),
        ("{{ 1 / 0 }}", "division by zero"),
        ("{% macro a() %}{{ a() }}{% endmacro %}{{ a() }}", "recursion"),
        ("{% for a in range(1000000) %}{% endfor %}", "Range too big"),
        ("{{ 'a' * 900000000 }}", "it needs more than"),
        ("{% for a in range(99999) %}{{ 'a' * 1000 }}{% endfor %}", "more than 16777216 characters"),
        ("\ufeff{", "this is no JSON"),
    ],
)
def test_a_template_that_breaks_out_or_fails(
    template: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "secret.json").write_text('{"device": {"channels": [{"name": "Secret", "address": 1}]}}', "utf-8")
    folder = tmp_path / "templates"
    folder.mkdir()
    (folder / "link.json").symlink_to(tmp_path / "secret.json")
    assert message in imported(template, folder, capsys, "a.json.jinja")


LOOPS = (
    "{% for a in range(90000) %}" * 6 + "{% endfor %}" * 6,
    "{% set l = [0] %}{% for a in l %}{% set _ = l.append(0) %}{% endfor %}",
)


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("template", LOOPS)
def test_a_template_that_loops_is_stopped(
    template: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a limit of one second."""
    program = tmp_path / "rendering.py"
    text = Path(rendering.__file__).read_text("utf-8")
    program.write_text(text.replace("MOST_CHARACTERS = 20,", "MOST_CHARACTERS = 1,"), "utf-8")
    monkeypatch.setattr(rendering, "__file__", str(program))
    assert "the template is not rendered after" in imported(template, tmp_path, capsys, "a.json.jinja")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "config-a.json:1: this is no JSON: Expecting value\n  hint: templates are those of wb-mqtt-serial"),
        ("[" * 100_000, "\n  hint: templates are those of wb-mqtt-serial"),
        ('{"device": 9' + "9" * 5_000 + "}", "this is no JSON"),
        ('{"device": {"scale": 1e999999999}}', "is no number"),
        ("[]", "there is no `device`"),
        ('{"device": []}', "there is no `device`"),
        ('{"device": {"protocol": "milur"}}', "the protocol is milur"),
        ('{"device": {}}', "the template has 0 channels and parameters"),
        ('// a\n/* b\n*/ {"device": {\n"a" 1}}', "config-a.json:4: this is no JSON: Expecting ':' delimiter"),
    ],
)
def test_what_is_no_template(content: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert message in imported(content, tmp_path, capsys)


_KEYS = (
    *(
        "name",
        "id",
        "title",
        "address",
        "write_address",
        "reg_type",
        "format",
        "type",
        "units",
        "scale",
        "offset",
        "enum",
        "min",
        "max",
    ),
    *(
        "enum_titles",
        "on_value",
        "off_value",
        "error_value",
        "round_to",
        "condition",
        "fw",
        "default",
        "readonly",
        "consists_of",
    ),
    *("string_data_size", "word_order", "byte_order", "description", "group"),
)
_VALUES: st.SearchStrategy[Any] = st.one_of(
    st.sampled_from(
        [
            "u8",
            "s16",
            "u32",
            "float",
            "string",
            "bcd16",
            "holding",
            "coil",
            "switch",
            "a==1",
            "1:2:3",
            "0x1F",
            "little_endian",
        ]
    ),
    st.integers(-70000, 70000),
    st.floats(allow_nan=False, allow_infinity=False),
    st.text(max_size=8),
    st.booleans(),
    st.none(),
    st.lists(st.integers(-3, 3), max_size=3),
    st.just({"address": 1}),
)
_ITEMS = st.dictionaries(st.sampled_from(_KEYS), _VALUES, max_size=9)
_DRAWN = count()


@pytest.mark.full(seconds=2)
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    device=st.fixed_dictionaries(
        {"channels": st.lists(_ITEMS, min_size=1, max_size=4)},
        optional={
            "parameters": st.one_of(
                st.lists(_ITEMS, max_size=3), st.dictionaries(st.sampled_from("abc"), _ITEMS), _VALUES
            ),
            "setup": st.lists(_ITEMS, max_size=2),
            "groups": st.one_of(st.lists(_ITEMS, max_size=2), _VALUES),
            "translations": st.one_of(
                st.dictionaries(st.sampled_from(["en", "de", "x"]), st.dictionaries(st.text(max_size=3), _VALUES)),
                _VALUES,
            ),
            **dict.fromkeys(("stride", "shift", "max_read_registers", "guard_interval_us", "other"), _VALUES),
        },
    ),
    hardware=st.one_of(st.lists(st.dictionaries(st.sampled_from(["signature", "fw"]), _VALUES), max_size=2), _VALUES),
)
@example(device={"channels": [{}], "max_read_registers": 0.5}, hardware=None)
@example(device={"channels": [{}], "guard_interval_us": 1e-308, "stride": 0.5, "shift": 0.5}, hardware=None)
def test_whatever_a_template_holds_compiles(
    device: dict[str, Any], hardware: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"{next(_DRAWN)}.json"
    path.write_text(json.dumps({"device": device, "hw": hardware}), "utf-8")
    assert main(["import", "wb", str(path)]) == 0, capsys.readouterr().err
    capsys.readouterr()
