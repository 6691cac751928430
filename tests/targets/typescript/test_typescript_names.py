"""Names and texts of descriptions in generated TypeScript: what is taken, what clashes, and what stays text."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from fieldscribe.language.keys import forms
from fieldscribe.targets.typescript import NODE_MODULES
from fieldscribe.targets.typescript.syntax import DEVICE_MEMBERS, MAKERS, OBJECT_MEMBERS, attribute
from fieldscribe.text import js_comment, js_string
from support.described import compile_in, described, loaded_in
from support.rust_crates import HOSTILE, rare_device
from support.toolchains import succeed, tool
from support.typescript_packages import RUNTIME, compile_types, install, package_name

OF_POINTS_MODULES = {"allCommands", "allPoints", "oldNames"}
BREAKING = (
    *('"', "\\", "\\u0022", "</script><script>", "<!--", "-->", "]]>", "${x}", "`", "'", "*/ x /*", "// x"),
    *("\u2028 \u2029", "\u202e", "\ud800", "\x00 \x1b[0m", "a\nb\r", "@ts-nocheck {@link x}", "\U0001f600"),
)


def in_node(program: str, folder: Path) -> str:
    (folder / "program.mjs").write_text(program, "utf-8")
    return succeed([tool("node"), "program.mjs"], cwd=folder).strip()


def test_literals_are_their_texts_again(tmp_path: Path) -> None:
    """But for control and format characters, which no target writes; and nothing ends the script of a page."""
    literals = [js_string(text) for text in BREAKING]
    cleaned = ['"', "\\", "\\u0022", "</script><script>", "<!--", "-->", "]]>", "${x}", "`", "'", "*/ x /*", "// x"]
    cleaned += ["", "", "", "[0m", "a b", "@ts-nocheck {@link x}", "\U0001f600"]
    assert json.loads(in_node(f"console.log(JSON.stringify([{', '.join(literals)}]))", tmp_path)) == cleaned
    assert not re.search(r"</|<!|-->", "".join(literals))


@pytest.mark.parametrize("text", BREAKING)
def test_comments_end_where_they_end(text: str) -> None:
    comment = js_comment(text)
    assert "*/" not in comment
    assert not re.search(r"[\n\r\u2028\u2029\u202e@]|</", comment)


@pytest.mark.full(seconds=2)
def test_a_hostile_description_is_text(tmp_path: Path) -> None:
    """Its package compiles, and a code is the text that it was."""
    modules = install(tmp_path, [rare_device()])
    options = {"module": "nodenext", "lib": ["ES2020"], "strict": True, "types": [], "noEmit": True}
    (tmp_path / "tsconfig.json").write_text(
        json.dumps({"compilerOptions": options, "files": ["node_modules/rare/index.d.ts"]})
    )
    assert compile_types(tmp_path) == ""
    program = 'import { allPoints } from "rare";\nconsole.log(JSON.stringify(Object.values(allPoints)[0].code));'
    assert json.loads(in_node(program, tmp_path)) == " ".join(HOSTILE.replace("\u202e", "").split())
    assert not any("</script" in path.read_text("utf-8") for path in (modules / "rare").iterdir())


def test_names_of_the_runtime_are_those_that_points_leave() -> None:
    sources = "".join(path.read_text("utf-8") for path in (RUNTIME / "fieldscribe-runtime").glob("*.js"))
    defined = set(re.findall(r"^export (?:async )?(?:function|const|class) (\w+)", sources, re.MULTILINE))
    assert defined >= MAKERS - OF_POINTS_MODULES
    for name in MAKERS | DEVICE_MEMBERS | OBJECT_MEMBERS:
        assert attribute(re.sub(r"([A-Z])", r"_\1", name).lower()) == f"{name}_"


def test_members_of_devices_are_those_of_the_runtime(tmp_path: Path) -> None:
    """What the classes of all families have, and no underscore before it."""
    install(tmp_path)
    program = """
const found = new Set();
for (const name of ["ModbusDevice modbus", "UssDevice uss", "CanDevice can"].map((one) => one.split(" "))) {
  const made = (await import(`fieldscribe-runtime/${name[1]}`))[name[0]];
  for (let kind = made.prototype; kind !== Object.prototype; kind = Object.getPrototypeOf(kind)) {
    Object.getOwnPropertyNames(kind).forEach((one) => found.add(one));
  }
  const source = String(made) + String(Object.getPrototypeOf(made));
  for (const [, one] of source.matchAll(/this\\.(\\w+) = /g)) found.add(one);
}
console.log([...found].filter((one) => !one.startsWith("_") && one !== "constructor").join(" "));
"""
    assert set(in_node(program, tmp_path).split()) == DEVICE_MEMBERS


def test_modules_of_node_are_no_devices(tmp_path: Path) -> None:
    listed = in_node('import { builtinModules } from "node:module";\nconsole.log(builtinModules.join(" "));', tmp_path)
    plain = {name for name in listed.split() if re.fullmatch("[a-z][a-z0-9_]*", name)}
    assert plain - NODE_MODULES <= {"async_hooks", "diagnostics_channel"}


@pytest.mark.parametrize(
    ("name", "constant"),
    [
        ("base_frequency", "baseFrequency"),
        ("a_1_2", "a1_2"),
        ("trip_1", "trip1"),
        ("class", "class_"),
        ("read_many", "readMany_"),
    ],
)
def test_constants(name: str, constant: str) -> None:
    assert attribute(name) == constant


def test_names_that_differ_by_an_underscore_alone_are_findings(tmp_path: Path) -> None:
    _, found = compile_in(tmp_path, described("- {name: state, at: 1, flags: {0: trip_1, 1: trip1}}\n"))
    messages = [one.message for one in found]
    assert any("TypeScript" in message and "trip1" in message for message in messages), messages


def test_a_name_never_sets_a_prototype(tmp_path: Path) -> None:
    """Keys of objects come from descriptions: names of codes, references, exceptions."""
    device = loaded_in(tmp_path, described("- {name: constructor, at: 1, flags: {0: then, 1: to_string, 2: raw}}\n"))
    install(tmp_path, [device])
    program = 'import { Constructor } from "made-up";\nconsole.log(Object.keys(Constructor.flags).join(" "));'
    assert in_node(program, tmp_path) == "then_ toString_ raw_"
    for form in (forms.NAME, forms.VARIANT_VALUE):  # of all names that become keys
        assert not re.search(form.pattern, "__proto__")


def test_what_all_objects_have_is_nothing_of_a_device(tmp_path: Path) -> None:
    """An axis is not chosen because objects have a member of its name, and such a member is no command."""
    axis = "variants:\n  constructor: {values: {small: {}, large: {}}}\n"
    install(tmp_path, [loaded_in(tmp_path, axis + described("- {name: speed, at: 1}\n"))])
    program = """
import { MadeUp } from "made-up";
const made = new MadeUp({ framing: "rtu", exchange: async () => new Uint8Array() }, { unit: 1 });
try { made.point("toString"); } catch (error) { console.log(error.message); }
"""
    assert in_node(program, tmp_path) == "toString is no point of this device"


NAMES_OF_MODULES = "array bigint boolean bits command date extract f32 f64 handles iterable iterator line map number"
NAMES_OF_MODULES += " object partial place point points promise read_only read_write readonly record runtime s16 s64 s8"
NAMES_OF_MODULES += " special_code stored stored_write_only string symbol u16 u32 u8 uint8_array unknown_number word"
NAMES_OF_MODULES += " word_kind write_only"


@pytest.mark.full(seconds=3)
def test_no_name_is_one_that_modules_need(tmp_path: Path) -> None:
    """Neither of numbers, of flags nor of a device: the packages load, and their types compile."""
    devices = [("named", "enum: {0: off, 1: run}"), ("words", "flags: {0: off, 1: run}")]
    devices += [(name, "unit: Hz") for name in ("line", "point", "handles", "modbus_device", "u16")]
    modules = []
    for device, meaning in devices:
        names = enumerate(NAMES_OF_MODULES.split())
        rows = "".join(f"- {{name: {name}, at: {at}, {meaning}}}\n" for at, name in names)
        (tmp_path / device).mkdir()
        made = loaded_in(tmp_path / device, described(rows).replace("device: made_up", f"device: {device}"))
        install(tmp_path, [made])
        modules.append(f"node_modules/{package_name(made)}/index")
    options = {"module": "nodenext", "lib": ["ES2020"], "strict": True, "types": [], "noEmit": True}
    settings = {"compilerOptions": options, "files": [f"{module}.d.ts" for module in modules]}
    (tmp_path / "tsconfig.json").write_text(json.dumps(settings), "utf-8")
    assert compile_types(tmp_path) == ""
    in_node("".join(f'await import("./{module}.js");\n' for module in modules), tmp_path)
