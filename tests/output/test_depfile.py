"""Builds with real make, ninja and cmake: after a change of any input they build once, and then nothing."""

from __future__ import annotations

import os
import shutil
import sys
import time
from pathlib import Path

import pytest
from support.files import copy_compiler
from support.places import ROOT
from support.toolchains import run, succeed, tool

pytestmark = pytest.mark.full(seconds=4)

INPUTS = (
    *("device/device.yaml", "device/words.yaml", "fieldscribe.toml", "points.txt"),
    *("generator/fieldscribe/text.py", "templates/c/device.h.j2", "templates/c/runtime/fieldscribe.h"),
)
"""One of each kind: the head of a description, a part, both lists of points, a module, a template, a runtime."""

MAKE = """
all: {outputs}
{outputs} &:
	{command}
-include made.d
"""
NINJA = """
rule fieldscribe
  command = {command}
  depfile = made.d
build {outputs}: fieldscribe
"""
CMAKE = """
cmake_minimum_required(VERSION 3.20)
project(drive NONE)
add_custom_command(OUTPUT {absolute} COMMAND {command} DEPFILE made.d WORKING_DIRECTORY ${{CMAKE_SOURCE_DIR}} VERBATIM)
add_custom_target(drivers ALL DEPENDS {absolute})
"""


class Project:
    """A folder with a description, lists of points, and the compiler itself, which a build system keeps up to date."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        copy_compiler(folder / "generator/fieldscribe")
        shutil.copytree(ROOT / "templates", folder / "templates")
        (folder / "points.txt").write_text("*\n", "utf-8")
        text = 'targets = ["c"]\n[[devices]]\ndevice = "device"\nout = "drivers"\n'
        (folder / "fieldscribe.toml").write_text(text, "utf-8")

    def begin(self) -> None:
        """As if nothing was ever built."""
        for name in ("device", "made", "drivers"):
            shutil.rmtree(self.folder / name, ignore_errors=True)
        shutil.copytree(ROOT / "tests/devices/kitchen_can", self.folder / "device")

    def say(self, command: str) -> str:
        """The command line of the compiler that lies here."""
        return f"env PYTHONPATH=generator PYTHONDONTWRITEBYTECODE= {sys.executable} -m fieldscribe {command}"

    def listed(self, command: str) -> list[str]:
        """The outputs of a command."""
        return succeed(["sh", "-c", self.say(f"{command} --list-outputs")], cwd=self.folder).split()

    def touch(self, path: str) -> None:
        """As an editor does that saves the same text, a while from now, for clocks whose ticks are long."""
        later = time.time() + 2
        os.utime(self.folder / path, (later, later))


COMMANDS = {
    "generate": "generate device --target c --out made",
    "vendor": "vendor c device --out drivers --points @points.txt",
    "project": "vendor",
}
LISTS = {"generate": "", "vendor": "points.txt", "project": "fieldscribe.toml"}
"""What each command reads beside descriptions and the compiler."""


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """One for all builders: the modules of its compiler become bytecode once."""
    return Project(tmp_path_factory.mktemp("project"))


def write_build(project: Project, builder: str, command: str) -> list[str]:
    """Writes the build file; the words that build. CMake takes absolute paths for what a command makes."""
    folder = project.folder
    if builder in ("make", "ninja"):
        words = {"outputs": " ".join(project.listed(command)), "command": project.say(f"{command} --depfile made.d")}
        name, form = ("Makefile", MAKE) if builder == "make" else ("build.ninja", NINJA)
        (folder / name).write_text(form.format(**words), "utf-8")
        return [tool(builder)]
    command = command.replace("--out ", f"--out {folder}/")
    command = command if "--out" in command else f"{command} --project {folder}/fieldscribe.toml"
    output = project.say(f"{command} --depfile ${{CMAKE_BINARY_DIR}}/made.d").replace(
        "env ", "${CMAKE_COMMAND} -E env "
    )
    text = CMAKE.format(absolute=" ".join(project.listed(command)), command=output)
    (folder / "CMakeLists.txt").write_text(text, "utf-8")
    succeed([tool("cmake"), "-G", builder, "-B", folder / "build", "-S", folder])
    return [tool("cmake"), "--build", str(folder / "build")]


def builds(project: Project, words: list[str]) -> bool:
    """Whether a build ran the compiler."""
    done = run(words, cwd=project.folder)
    assert done.returncode == 0, done.stdout + done.stderr
    return " unchanged " in done.stdout or " written, " in done.stdout


@pytest.mark.parametrize(
    ("command", "builder"),
    [*(("generate", builder) for builder in ("ninja", "Ninja")), *(("vendor", "ninja"), ("project", "make"))],
)
def test_a_change_is_built_once(command: str, builder: str, project: Project) -> None:
    for name in ("make", "ninja", "cmake"):
        tool(name)
    project.begin()
    words = write_build(project, builder, COMMANDS[command])
    assert builds(project, words)
    assert not builds(project, words)
    path = LISTS[command] or "device/words.yaml"
    project.touch(path)
    assert builds(project, words), path
    assert not builds(project, words), path


def test_every_input_is_listed(project: Project) -> None:
    """A change of any of them makes the outputs old, as make says without building them."""
    project.begin()
    words = [*write_build(project, "make", COMMANDS["generate"]), "--question"]
    assert builds(project, words[:1])
    assert run(words, cwd=project.folder).returncode == 0
    for path in INPUTS:
        if path not in LISTS.values():
            before = (project.folder / path).stat().st_mtime
            project.touch(path)
            assert run(words, cwd=project.folder).returncode == 1, path
            os.utime(project.folder / path, (before, before))


def test_a_part_that_is_gone_stops_nobody(project: Project) -> None:
    """The rule of the last build still names it."""
    tool("make")
    project.begin()
    words = write_build(project, "make", COMMANDS["generate"])
    assert builds(project, words)
    device = project.folder / "device"
    text = (device / "words.yaml").read_text("utf-8")
    (device / "words.yaml").unlink()
    (device / "more_words.yaml").write_text(text, "utf-8")
    head = (device / "device.yaml").read_text("utf-8")
    (device / "device.yaml").write_text(head.replace("words.yaml", "more_words.yaml"), "utf-8")
    assert builds(project, words)
    assert not builds(project, words)
