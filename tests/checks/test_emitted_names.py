"""Names in generated code: the lists hold what is defined, and nasty names define nothing twice or are refused."""

from __future__ import annotations

import ast
import random
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest
from fieldscribe.code_view import for_code
from fieldscribe.model import Device
from fieldscribe.pipeline import outputs
from fieldscribe.resources import render, templates_dir
from fieldscribe.targets import c, target
from fieldscribe.targets.rust import CONSTANTS
from support.described import DEVICES, compile_in, described, group, head, loaded, loaded_in, together

LANGUAGES = ("c", "python", "rust", "typescript")
"""Targets in which names of the description become identifiers."""

SEEDS = 60

BUS = """
  framings: [rtu]
  units: 1..247
  exceptions: {{01h: {first}}}
  functions: {{03h: read, 06h: write, 10h: write_many}}"""
AXIS = "{{{axis}: {{title: Axis, values: {{{first}: {{}}, {second}: {{}}}}}}}}"
COMMANDS = '[{{name: {command}, space: holding, at: 9000, function: 06h, value: 1, section: "2"}}]'

WORDS = (
    *("a", "b", "ready", "active_low", "low", "mask", "shift", "raw", "min", "max", "raw_min", "count", "blocks"),
    *("words", "address", "code", "space", "name", "class", "self", "type", "fn", "none", "true", "value", "of"),
    *("read", "write", "request", "command", "encode", "decode", "check", "first", "last", "with", "get", "all_false"),
    *(
        *("group_count", "exception", "status", "ok", "points", "enums", "factors", "flags", "old", "unit", "link"),
        *("1", "12"),
    ),
)


def name(chance: random.Random) -> str:
    """One to three of the words that targets themselves put into names."""
    words = [chance.choice(WORDS) for _ in range(chance.choice((1, 1, 2, 2, 3)))]
    text = "_".join(words)
    return text if text[0].isalpha() else f"a{text}"


def nasty(seed: int) -> str:
    """A device of few names that come near each other."""
    chance = random.Random(seed)
    pool = [name(chance) for _ in range(7)]
    pool += [f"{chance.choice(pool)}_{chance.choice(WORDS)}".strip("_") for _ in range(7)]

    def one() -> str:
        return chance.choice(pool)

    names = {key: one() for key in ("device", "axis", "first", "second", "command", "group")}
    bus, variants, commands = (text.format(**names) for text in (BUS, AXIS, COMMANDS))
    lines = []
    for at, point in enumerate(dict.fromkeys(one() for _ in range(9))):
        first, second = one(), one()
        facts = chance.choice(
            (
                f"flags: {{0: {{name: {first}, active: 0}}, 1: {second}}}",
                f"flags: {{1..0: {{name: {first}, values: {{0: {second}, 1: {one()}}}}}, 3: {one()}}}",
                f"enum: {{0: {first}, 1: {second}}}",
                f"range: 0..100, scale: value = raw * 0.1, special: {{0FFFFh: {first}, 0FFFEh: {second}}}",
                f"range: 0..9, was: [{first}]",
                "type: ~",
                "bits: 3..0, range: 0..9",
            )
        )
        lines.append(f"- {{name: {point}, at: {at}, {facts}}}\n")
    described = head(device=names["device"], bus=bus, variants=variants, commands=commands)
    return together(described, group("".join(lines), group=names["group"]))


def c_names(text: str) -> Iterator[str]:
    """What a header defines, but for its guard and what stands in branches of the preprocessor twice."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    defines = dict(re.findall(r"^#define (\w+)(?:\(.*?\))? ?(.*)$", text, re.MULTILINE))
    both = re.findall(r"^#define (\w+)(?:\(.*?\))? ?(.*)$", text, re.MULTILINE)
    yield from (one for one, value in both if defines[one] != value)  # only other definitions of one name are errors
    yield from defines
    yield from re.findall(r"^    ([A-Z]\w+) = ", text, re.MULTILINE)
    yield from re.findall(r"^static const .*?\b(\w+)(?:\[\w*\])? = ", text, re.MULTILINE)
    yield from re.findall(r"^static [^;=]*?\b(\w+)\([^;]*?\)\n\{", text, re.MULTILINE)


def python_names(text: str) -> Iterator[tuple[str, str]]:
    """What a module and its classes define, by scope."""
    tree = ast.parse(text)
    holders: list[ast.Module | ast.ClassDef] = [tree, *(one for one in ast.walk(tree) if isinstance(one, ast.ClassDef))]
    for holder in holders:
        scope = getattr(holder, "name", "")
        for one in holder.body:
            if isinstance(one, ast.Assign | ast.AnnAssign):
                targets = one.targets if isinstance(one, ast.Assign) else [one.target]
                yield from ((scope, each.id) for each in targets if isinstance(each, ast.Name))
            elif isinstance(one, ast.ClassDef | ast.FunctionDef):
                yield scope, one.name
            elif isinstance(one, ast.Import | ast.ImportFrom):
                yield from ((scope, each.asname or each.name) for each in one.names)
        for inside in ast.walk(holder):
            if isinstance(inside, ast.FunctionDef):
                given = (*inside.args.posonlyargs, *inside.args.args, *inside.args.kwonlyargs)
                arguments = [each.arg for each in given]
                assert len(arguments) == len(set(arguments)), arguments


def rust_names(text: str) -> Iterator[tuple[str, str]]:
    """What a module and its inherent blocks define, by scope: types and values apart."""
    scope = ""
    for line in text.splitlines():
        if found := re.match(r"(?:pub )?(?:mod|impl|pub enum|enum) ([\w: ]+?) \{", line):
            scope = found[0]
        elif line.startswith("}"):
            scope = ""
        kinds = r"\s*pub (?:const fn|fn|const|struct|enum|mod|type) (\w+)"
        if found := re.match(kinds, line):
            yield scope if line.startswith(" ") else "", found[1]


def typescript_names(text: str) -> Iterator[tuple[str, str]]:
    """What a module imports and defines, and the properties of each object in it."""
    scope = ""
    for line in text.splitlines():
        if found := re.match(r"(?:export )?(?:const|class) (\w+)|import \{", line):
            scope = found[1] or ""
            yield from [("", found[1])] if found[1] else []
        elif found := re.match(r"  (\w+)(?:: |,$)", line):
            yield scope, found[1]


def doubles(device: Device) -> list[object]:
    """Names that generated code defines twice in one place."""
    found: list[object] = []
    for _, path, text in outputs(device, LANGUAGES):
        copied = any(one in path.removeprefix("c/") for one in ("fieldscribe_", "conformance", "/runner/"))
        if copied or device.id not in path:
            continue
        if path.endswith(".h"):
            names: list[object] = list(c_names(text))
        elif path.endswith(".py"):
            names = list(python_names(text))
        elif path.endswith(".rs"):
            names = list(rust_names(text))
        elif path.endswith(".js") and not path.endswith("index.js"):
            names = list(typescript_names(text))
        else:
            continue
        found += [(path, one) for one, count in Counter(names).items() if count > 1]
    return found


@pytest.mark.parametrize("part", range(6))
def test_nasty_names(part: int, tmp_path: Path) -> None:
    """A device that passes `check` defines nothing twice in any target."""
    for seed in range(part, SEEDS, 6):
        device, _ = compile_in(tmp_path, nasty(seed))
        assert device is None or doubles(device) == [], seed


@pytest.mark.parametrize("folder", sorted(DEVICES.iterdir()), ids=lambda one: one.name)
def test_the_lists_hold_what_is_defined(folder: Path) -> None:
    """Every name that the headers define is one that the target lists, and no other is."""
    device = loaded(folder / "device.yaml")
    listed = {name for one in target("c").identifiers(device) for name in one.names}
    headers = [text for _, text in c.outputs(for_code(device), render, tests=False, rows=True)]
    assert len(headers) == 2 + (device.family == "modbus")
    assert {name for header in headers for name in c_names(header)} - listed == set()
    code = re.sub(r"/\*.*?\*/", "", "\n".join(headers), flags=re.DOTALL)
    assert listed - set(re.findall(r"\w+", code)) == set(), "a name that no header has would be refused for nothing"
    for name in LANGUAGES:
        assert len(list(target(name).identifiers(device))) > len(device.points)


FLAGS = (
    "0: {name: on, values: {0: stopped, 1: running}}, 2..1: {name: mode, values: {0: a, 1: b}}, "
    "3: {name: low, active: 0}"
)
NAMES_OF_FLAGS = {
    "c": {
        "on": ("MADE_UP_STATE_ON_MASK",),
        "mode": (
            *("MADE_UP_STATE_MODE_MASK", "MADE_UP_STATE_MODE_SHIFT", "MADE_UP_STATE_MODE_A", "MADE_UP_STATE_MODE_B"),
            "made_up_state_mode",
        ),
        "low": ("MADE_UP_STATE_LOW_MASK",),
    },
    "python": {"on": ("ON", "on"), "mode": ("MODE", "mode", "StateMode"), "low": ("LOW", "low")},
    "rust": {
        "on": ("ON", "on", "with_on"),
        "mode": ("MODE", "mode", "with_mode", "MODE_A", "MODE_B"),
        "low": ("LOW_ACTIVE_LOW", "low", "with_low"),
    },
    "typescript": {"on": ("on",), "mode": ("mode", "StateMode"), "low": ("low",)},
}


@pytest.mark.parametrize("language", LANGUAGES)
def test_each_flag_has_its_names_and_is_named_as_their_owner(language: str, tmp_path: Path) -> None:
    """A single bit has no names for its numbers; a finding about a name leads to the flag, which is of its point."""
    device = loaded_in(tmp_path, described(f"- {{name: state, at: 1, flags: {{{FLAGS}}}}}\n"))
    found: dict[str, tuple[str, ...]] = {}
    of_point: set[str] = set()
    for _, owner, names, _ in target(language).identifiers(device):
        of_point.update(names if (owner.kind, owner.name) == ("point", "state") else ())
        flag = owner.of if owner.kind == "value" and owner.of is not None else owner
        if flag.kind == "flag":
            assert flag.of is not None
            assert (flag.of.kind, flag.of.name) == ("point", "state")
            found[flag.name] = (*found.get(flag.name, ()), *names)
    assert found == NAMES_OF_FLAGS[language]
    assert language == "c" or "State" in of_point, "the class of the word belongs to its point"
    text = "".join(text for _, path, text in outputs(device, [language]) if "made_up" in path)
    assert set(re.findall(r"\w+", text)) >= {name for names in found.values() for name in names}


@pytest.mark.parametrize(
    ("language", "first", "second"),
    [
        ("c", ("MADE_UP_MODE_OFF",), ("MADE_UP_MODE_SLOW_ONE",)),
        ("python", ("OFF",), ("SLOW_ONE",)),
        ("rust", ("Off",), ("SlowOne",)),
        ("typescript", ("OFF",), ("SLOW_ONE",)),
    ],
)
def test_each_entry_of_an_enum_is_named_as_the_owner_of_its_names(
    language: str, first: tuple[str, ...], second: tuple[str, ...], tmp_path: Path
) -> None:
    device = loaded_in(
        tmp_path, described("- {name: state, at: 1, enum: mode}\n", enums="{mode: {0: 'off', 1: slow_one}}")
    )
    owned = {owner: names for _, owner, names, _ in target(language).identifiers(device) if owner.kind == "entry"}
    assert {(owner.name, owner.of and owner.of.kind, owner.of and owner.of.name) for owner in owned} == {
        ("off", "enum", "mode"),
        ("slow_one", "enum", "mode"),
    }
    assert {owner.name: tuple(names) for owner, names in owned.items()} == {"off": first, "slow_one": second}


@pytest.mark.parametrize(
    ("entries", "variant"),
    [
        ("0: 'off'", "Unknown"),
        ("0: unknown", "Other"),
        ("0: unknown, 1: other", "Unnamed"),
        ("0: unknown, 1: other, 2: unnamed", "Number"),
    ],
)
def test_the_variant_for_unnamed_numbers_steps_aside_in_rust(entries: str, variant: str, tmp_path: Path) -> None:
    device = loaded_in(tmp_path, described(f"- {{name: state, at: 1, open: yes, enum: {{{entries}}}}}\n"))
    texts = "".join(text for _, path, text in outputs(device, ["rust"]) if "made_up" in path)
    assert f", else {variant};" in texts


def test_every_old_name_of_a_function_leads_to_one(tmp_path: Path) -> None:
    """Of points of each form, among them some whose counts are too fine for an integer, or that need none."""
    forms = (
        *("scale: raw = value / 3", "scale: value = raw * 0.1", "enum: {0: off, 1: on}", "type: f32", "range: 0..9"),
        *("type: text, characters: 4", "scale: value = raw / new_1", "flags: {0: a, 2..1: b}", "access: r"),
    )
    lines = [f"- {{name: new_{at}, at: {10 * at}, was: [old_{at}], {form}}}\n" for at, form in enumerate(forms)]
    texts = {path: text for _, path, text in outputs(loaded_in(tmp_path, described("".join(lines))), ["c"])}
    code = re.sub(r"/\*.*?\*/", "", texts["c/made_up.h"], flags=re.DOTALL)
    functions = set(re.findall(r"^[A-Za-z].*?\b(\w+)\([^;]*?\)(?=\n\{| \{)", code, re.MULTILINE))
    renamed = dict(re.findall(r"^#define (made_up_old_\d\w*) (\w+)$", code, re.MULTILINE))
    arrays = {"made_up_new_5_addresses"}
    assert {new.replace("_new_", "_old_") for new in renamed.values()} == set(renamed)
    assert {name for name in functions | arrays if "_new_" in name} == {*renamed.values(), "made_up_new_6_rule"}


def test_the_constants_of_rust_are_those_of_its_traits() -> None:
    """The traits have no constant that a special code could hide without a finding."""
    runtime = templates_dir() / "rust" / "runtime" / "fieldscribe_runtime" / "src" / "point.rs"
    constants = re.findall(r"^    const ([A-Z_]+):", runtime.read_text("utf-8"), re.MULTILINE)
    assert constants
    assert {name.lower() for name in constants} <= CONSTANTS
