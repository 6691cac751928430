"""What a receiver in C lives through: recipes of the headers, noise, answers of a wrong length, words that are gone."""

from __future__ import annotations

import platform
import re
from dataclasses import replace
from pathlib import Path

import pytest
from fieldscribe.resources import templates_dir
from support.c_device import SANITIZING, WARNINGS, program, run_program, write_headers
from support.described import made, shipped
from support.places import ROOT
from support.toolchains import compiled, run, succeed, tool

KITCHENS = {"modbus": "kitchen_sink", "can": "kitchen_can", "uss": "kitchen_uss"}
DEVICES = {"modbus": "hitachi_l200", "can": "woodward_mpu2s", "uss": "siemens_mm4"}
"""The devices that the recipes name."""


def recipe(family: str) -> str:
    """The statements in the comments of a family's runtime; remarks stand in brackets behind them, or alone."""
    text = (templates_dir() / "c" / "runtime" / f"fieldscribe_{family}.h").read_text("utf-8")
    lines = re.findall(r"^ \*     (.*)$", text, re.MULTILINE)
    return "\n".join(re.sub(r"(^|\s{2,})\(.*\)$", "", line) for line in lines)


# a line on which a byte of noise has come before each request, and another comes before the answer
SERIAL_LINE = program("serial_line")

RECIPES = {"modbus": program("recipes_modbus"), "uss": program("recipes_uss"), "can": program("recipes_can")}


@pytest.mark.parametrize("way", SANITIZING)
@pytest.mark.parametrize("family", sorted(RECIPES))
def test_the_recipe_of_a_runtime_works(family: str, way: str, tmp_path: Path) -> None:
    """As it stands there, also with noise before the request and the answer; its names are each of one thing."""
    name = DEVICES[family]
    device = shipped(name)
    write_headers(device, tmp_path)
    program = ("" if family == "can" else SERIAL_LINE) + RECIPES[family].replace("@RECIPE@", recipe(family))
    head = f'#include <stdlib.h>\n#define FIELDSCRIBE_IMPLEMENTATION\n#include "{name}_{family}.h"\n'
    # statuses on the way are given, and not all of them looked at
    allowed = ("-Wno-unused-but-set-variable", "-Wno-float-equal")
    run_program(head + program, way, tmp_path / "c", tmp_path, *allowed)


TOLD = {"modbus": program("told_modbus"), "uss": program("told_uss")}

WHOLE = {
    "modbus": """
/* How many bytes a receiver takes that gets them one by one. */
static size_t whole(
    fieldscribe_modbus_framing framing, const fieldscribe_modbus_request *request, const uint8_t *bytes, size_t size)
{
    size_t got = 0U;
    while (fieldscribe_modbus_left(&kitchen_sink_modbus_profile, framing, request, bytes, size, got) > 0U) {
        ++got;
    }
    return got;
}
""",
    "uss": """
static size_t whole(const fieldscribe_uss_link *link, const uint8_t *bytes)
{
    size_t got = 0U;
    while (fieldscribe_uss_left(link, bytes, 99U, got) > 0U) {
        ++got;
    }
    return got;
}
""",
}


@pytest.mark.parametrize("way", SANITIZING)
@pytest.mark.parametrize("family", sorted(TOLD))
def test_an_answer_of_another_length_is_received_whole(family: str, way: str, folder: Path, tmp_path: Path) -> None:
    """What it says of its length counts: it is refused for that, without waiting for bytes that never come."""
    head = f'#define FIELDSCRIBE_IMPLEMENTATION\n#include "{KITCHENS[family]}_{family}.h"\n'
    run_program(f"{head}{WHOLE[family]}int main(void)\n{{{TOLD[family]}", way, folder, tmp_path)


GONE = program("unneeded_words")


@pytest.mark.parametrize("way", SANITIZING)
def test_an_answer_does_not_need_the_words_that_were_written(way: str, folder: Path, tmp_path: Path) -> None:
    run_program(GONE, way, folder, tmp_path)


NOTHING = {"modbus": program("nothing_modbus"), "uss": program("nothing_uss"), "can": program("nothing_can")}


@pytest.mark.parametrize("way", SANITIZING)
@pytest.mark.parametrize("family", sorted(NOTHING))
def test_where_there_is_nothing_nothing_is_read_or_stored(family: str, way: str, folder: Path, tmp_path: Path) -> None:
    """NULL with a count beside it is refused like too few."""
    head = f'#define FIELDSCRIBE_IMPLEMENTATION\n#include "{KITCHENS[family]}_{family}.h"\n'
    run_program(f"{head}int main(void)\n{{{NOTHING[family]}}}\n", way, folder, tmp_path)


@pytest.mark.parametrize("family", sorted(KITCHENS))
def test_headers_of_two_descriptions_do_not_compile_together(family: str, tmp_path: Path) -> None:
    """One that was left behind when the other was generated anew is named."""
    name = KITCHENS[family]
    device = made(name)
    write_headers(device, tmp_path)
    frames = tmp_path / "c" / f"{name}_{family}.h"
    check: list[str | Path] = [tool("gcc"), "-std=c99", *WARNINGS, "-fsyntax-only", "-x", "c", frames]
    succeed(check)
    write_headers(replace(device, digest="0123456789abcdef" * 4), tmp_path / "next")
    (tmp_path / "c" / f"{name}.h").write_bytes((tmp_path / "next" / "c" / f"{name}.h").read_bytes())
    done = run(check)
    assert done.returncode != 0
    assert f"{name}.h is of another description" in done.stderr


@pytest.mark.skipif(platform.machine() != "x86_64", reason="steps through instructions of x86")
@pytest.mark.full(seconds=2)
@pytest.mark.parametrize("level", ["-O0", "-O2"])
def test_words_of_a_telegram_are_of_one_moment_in_interrupts(level: str, tmp_path: Path) -> None:
    source = ROOT / "tests/targets/c/programs/can_interrupts.c"
    flags = ("-std=gnu99", level, *WARNINGS, f"-I{templates_dir() / 'c' / 'runtime'}")
    succeed([compiled("gcc", flags, source, tmp_path / "interrupts")])


@pytest.mark.full(seconds=4)
@pytest.mark.parametrize("name", ["ask", "late"])
def test_a_line_is_asked(name: str, folder: Path, tmp_path: Path) -> None:
    """An answer to an earlier request is dropped; nobody is waited for who does not answer."""
    run_program(program(name), "gcc", folder, tmp_path)


BABBLE = program("babble")


@pytest.mark.full(seconds=2)
def test_a_line_that_babbles_comes_to_an_end(folder: Path, tmp_path: Path) -> None:
    """And bytes that are no answer are told from silence."""
    run_program(BABBLE, "gcc", folder, tmp_path)
