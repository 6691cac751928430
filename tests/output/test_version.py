"""The version of a description: what it may be, and that it travels into every output."""

from __future__ import annotations

from pathlib import Path

import pytest
from fieldscribe.model import Version
from fieldscribe.pipeline import outputs
from fieldscribe.targets import TARGETS
from support.described import compile_in, described, loaded_in
from support.files import write_files
from support.toolchains import succeed, tool

POINTS = "- {name: speed, at: 0, range: 0..4000, scale: value = raw * 0.1, unit: Hz}\n"


def files(folder: Path, version: str) -> dict[str, str]:
    device = loaded_in(folder / version, described(POINTS, version=version))
    return {path: text for _, path, text in outputs(device, TARGETS)}


@pytest.mark.parametrize(
    ("version", "number"),
    [("0.0.0", 0), ("1.0.0", 1_000_000), ("1.2.3", 1_002_003), ("999.999.999", 999_999_999), ("3999.0.1", 3999000001)],
)
def test_a_version_has_three_numbers_and_one_to_compare(tmp_path: Path, version: str, number: int) -> None:
    device = loaded_in(tmp_path, described(POINTS, version=version))
    assert ".".join(map(str, Version.of(device.version))) == version
    assert Version.of(device.version).number == number < 2**32


@pytest.mark.parametrize(
    "version", ["1.0", "1.0.0.0", "01.0.0", "1.0.1000", "1.1000.0", "4000.0.0", "v1.0.0", "1.0.0-a"]
)
def test_other_versions_are_refused(tmp_path: Path, version: str) -> None:
    device, findings = compile_in(tmp_path, described(POINTS, version=f'"{version}"'))
    assert device is None
    assert [finding.hint for finding in findings] == ["write three numbers, at most 3999.999.999: 1.0.0"]


def test_it_stands_in_every_output(tmp_path: Path) -> None:
    output = {
        "c/made_up.h": [
            '#define MADE_UP_DESCRIPTION_VERSION "2.13.4"',
            "#define MADE_UP_DESCRIPTION_VERSION_MAJOR 2U",
            "#define MADE_UP_DESCRIPTION_VERSION_MINOR 13U",
            "#define MADE_UP_DESCRIPTION_VERSION_PATCH 4U",
            "#define MADE_UP_DESCRIPTION_VERSION_NUMBER 2013004UL ",
        ],
        "python/made_up/__init__.py": ['__version__ = "2.13.4"', '__digest__ = "'],
        "rust/made_up/src/lib.rs": [
            'pub const VERSION: &str = "2.13.4";',
            "pub const VERSION_MAJOR: u32 = 2;",
            "pub const VERSION_MINOR: u32 = 13;",
            "pub const VERSION_PATCH: u32 = 4;",
            "pub const VERSION_NUMBER: u32 = 2_013_004;",
        ],
        "rust/made_up/Cargo.toml": ['version = "2.13.4"'],
        "rust/made_up/conformance/Cargo.toml": ['version = "2.13.4"'],
        "docs/made_up.md": ["| Version of the description | 2.13.4 |"],
        "vectors/made_up.txt": ["\tmade_up\t2.13.4\t"],
    }
    texts = files(tmp_path, "2.13.4")
    assert [(path, line) for path, lines in output.items() for line in lines if line not in texts[path]] == []


def test_one_c_program_may_hold_two_versions(tmp_path: Path) -> None:
    """A gateway may speak to an old and to a new edition, each from a C file of its own."""
    gcc, objects = tool("gcc"), []
    for name, version in {"old": "1.9.0", "new": "2.0.1"}.items():
        folder = write_files(files(tmp_path, version), tmp_path / name)
        source = folder / f"{name}.c"
        source.write_text(
            '#include "made_up_modbus.h"\n'
            f"#if MADE_UP_DESCRIPTION_VERSION_NUMBER {'<' if name == 'old' else '>='} 2000000\n"
            f"unsigned long {name}(void);\n"
            f"unsigned long {name}(void) {{ return MADE_UP_DESCRIPTION_VERSION_NUMBER; }}\n"
            "#endif\n",
            "ascii",
        )
        objects.append(folder / f"{name}.o")
        flags = ("-std=c99", "-Wall", "-Wextra", "-Wconversion", "-Wundef", "-Werror")
        succeed([gcc, *flags, "-I", folder / "c", "-c", source, "-o", objects[-1]])
    program = tmp_path / "main.c"
    program.write_text(
        "unsigned long old(void);\nunsigned long new(void);\n"
        "int main(void) { return old() == 1009000UL && new() == 2000001UL ? 0 : 1; }\n",
        "ascii",
    )
    succeed([gcc, program, *objects, "-o", tmp_path / "main"])
    succeed([tmp_path / "main"])
