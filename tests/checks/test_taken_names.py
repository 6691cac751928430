"""Names that a language or its library takes: each word of the lists, and that generated code steps aside for it."""

from __future__ import annotations

import ast
import keyword
import re
from pathlib import Path

import pytest
from fieldscribe.pipeline import outputs
from fieldscribe.targets import target
from fieldscribe.targets.python.syntax import HELPERS, Identifiers, attribute, parameter, word_attribute
from fieldscribe.targets.rust.enums import getter_name
from fieldscribe.targets.rust.literals import type_name, value_name, variant_name
from support.described import compile_in, described, loaded_in, made

HEADERS = """
assert complex ctype errno fenv float inttypes iso646 limits locale malloc math memory setjmp signal stdalign stdarg
stdatomic stdbool stddef stdint stdio stdlib stdnoreturn string strings tgmath threads time uchar unistd wchar wctype
"""
"""The headers of ISO C, and those of C libraries that names of devices are as likely to meet."""
RUST = """
as async await break const continue crate dyn else enum extern false fn for gen if impl in let loop match mod move mut
pub ref return self static struct super trait true try type unsafe use where while abstract become box do final macro
override priv typeof unsized virtual yield union
"""
"""The strict, reserved and weak words of the Rust reference."""
RUST_CRATES = "alloc core proc_macro std test"
PRELUDE = """
AsMut AsRef Box Clone Copy Debug Default DoubleEndedIterator Drop Eq Err ExactSizeIterator Extend Fn FnMut FnOnce From
FromIterator Hash Into IntoIterator Iterator None Ok Option Ord PartialEq PartialOrd Result Self Send Sized Some String
Sync ToOwned ToString TryFrom TryInto Unpin Vec
"""
"""What std::prelude brings into each module."""
TRAIT_METHODS = "clone cmp default deref drop eq fmt from hash index into ne neg next not"
PYTHON_MODULES = "abc array asyncio json queue select signal string struct types"


@pytest.mark.parametrize(
    ("language", "names", "why"),
    [
        ("c", HEADERS, r"would make a header `{}\.h`, which hides the one of the C library"),
        (
            "python",
            " ".join(keyword.kwlist),
            "is a word that Python reserves, so that no program could name its package",
        ),
        ("python", PYTHON_MODULES, "is a module of Python's own, which the generated package would hide"),
        ("rust", RUST, "is a word that Rust reserves, so that no program could name its crate"),
        ("rust", RUST_CRATES, "is a crate of Rust's own, which the generated crate would hide"),
    ],
)
def test_no_device_is_called_like(language: str, names: str, why: str) -> None:
    taken = target(language).device_name_taken
    for name in names.split():
        assert re.fullmatch(why.format(name), taken(name)), name
    assert taken("hitachi_l200") == ""


@pytest.mark.parametrize("name", ["fieldscribe", "fieldscribe_runtime", "nul", "aux", "com1", "lpt9"])
def test_no_device_takes_a_name_of_ours_or_of_windows(name: str, tmp_path: Path) -> None:
    device, findings = compile_in(tmp_path, described("- {name: speed, at: 1}\n", device=name))
    assert device is None
    assert [finding.rule for finding in findings] == ["unsafe-name"]


@pytest.mark.parametrize("name", ["fieldscribes", "my_fieldscribe", "nulls", "com10", "lpt"])
def test_a_device_may_come_near_such_a_name(name: str, tmp_path: Path) -> None:
    assert loaded_in(tmp_path, described("- {name: speed, at: 1}\n", device=name)).id == name


def test_rust_steps_aside() -> None:
    for name in RUST.split():
        assert value_name(name) == (f"{name}_" if name in ("crate", "self", "super") else f"r#{name}")
    for name in PRELUDE.split():
        snake = re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()
        assert type_name(snake) == f"{name}_", name
    for name in ("err", "none", "ok", "option", "result", "some", "self"):
        assert variant_name(name) == f"{name.title()}_"
    for name in TRAIT_METHODS.split():
        assert getter_name(name) == f"get_{name}"
    for name in ("from_line", "as_set", "into_air", "to_left"):
        assert getter_name(name) == f"get_{name}"
    assert (getter_name("speed"), getter_name("type"), getter_name("total")) == ("speed", "r#type", "total")
    assert (value_name("speed"), type_name("speed"), variant_name("speed")) == ("speed", "Speed", "Speed")


def test_python_steps_aside() -> None:
    for name in (*filter(str.islower, keyword.kwlist), "match", "print", "self", "try", "type"):
        assert attribute(name) == word_attribute(name) == parameter(name) == f"{name}_", name
    for name in ("link", "transport", "unit", "variants"):
        assert parameter(name) == f"{name}_"
    for name in dir(type("Word", (int,), {})):
        if not name.startswith("_"):
            assert word_attribute(name) == f"{name}_", name
    assert attribute("speed") == word_attribute("speed") == parameter("speed") == "speed"


CLASSES = ("field", "flag", "literal", "named_number", "points", "self", "word")


def test_no_class_is_called_like_what_the_package_imports(tmp_path: Path) -> None:
    points = "".join(f"- {{name: p_{at}, at: {at}, enum: {name}}}\n" for at, name in enumerate(CLASSES))
    enums = "{" + ", ".join(f"{name}: {{0: a, 1: b}}" for name in CLASSES) + "}"
    names = Identifiers(loaded_in(tmp_path, described(points, enums=enums, device="named_numbers")))
    found = [names.enum_class(name) for name in CLASSES]
    assert found == ["FieldEnum", "FlagEnum", "LiteralEnum", "NamedNumberEnum", "PointsEnum", "SelfEnum", "WordEnum"]
    device = Identifiers(loaded_in(tmp_path / "own", described("- {name: a, at: 0}\n", device="points")))
    assert (device.device_class, device.async_class) == ("PointsDevice", "PointsDeviceAsync")


def test_the_helpers_of_python_packages_are_those_that_they_use() -> None:
    used: set[str] = set()
    for device in ("kitchen_sink", "kitchen_can", "kitchen_uss"):
        files = {path: text for _, path, text in outputs(made(device), ("python",))}
        tree = ast.parse(files[f"python/{device}/points.py"])
        for body in (node for node in ast.walk(tree) if isinstance(node, ast.ClassDef)):
            used |= _loaded_in_body(body)
    assert used == HELPERS


def _loaded_in_body(body: ast.ClassDef) -> set[str]:
    """The lower-case names that the statements of a class use, but for its own and those of Python."""
    values = [node.value for node in body.body if isinstance(node, ast.Assign | ast.AnnAssign) and node.value]
    names = {part.id for value in values for part in ast.walk(value) if isinstance(part, ast.Name)}
    own = {
        node.target.id for node in body.body if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)
    }
    own |= {
        part.id
        for node in body.body
        if isinstance(node, ast.Assign)
        for part in node.targets
        if isinstance(part, ast.Name)
    }
    return {name for name in names - own if name.islower() and name not in dir(__builtins__)}
