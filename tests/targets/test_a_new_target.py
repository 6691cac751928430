"""A target is a folder, a folder of templates and a line: a copy of the compiler gets one that way and uses it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from fieldscribe.resources import templates_dir
from support.described import described, write
from support.files import copy_compiler
from support.places import TESTS

TOY = TESTS / "toy_target"
LAST_LINE = '    "vectors",\n'


class Compiler:
    """A copy of the compiler with the target `toy`, and one description."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        package = copy_compiler(folder / "fieldscribe")
        shutil.copytree(templates_dir(), package / "shipped" / "templates")
        ours = shutil.ignore_patterns("__pycache__", "templates")
        shutil.copytree(TOY, package / "targets" / "toy", ignore=ours)
        shutil.copytree(TOY / "templates", package / "shipped" / "templates" / "toy")
        registry = package / "targets" / "__init__.py"
        text = registry.read_text("utf-8")
        assert text.count(LAST_LINE) == 1
        registry.write_text(text.replace(LAST_LINE, f'{LAST_LINE}    "toy",\n'), "utf-8")

    def describe(self, device: str = "made_up", second: str = "torque", third: str = "power") -> None:
        points = [f"- {{name: {name}, at: {at}}}\n" for at, name in enumerate(("speed", second, third), 7)]
        write(self.folder, described("".join(points), device=device))

    def run(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        environment = {**os.environ, "PYTHONPATH": str(self.folder), "XDG_CACHE_HOME": str(self.folder / "cache")}
        command = [sys.executable, "-m", "fieldscribe", *arguments]
        return subprocess.run(
            command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False, timeout=60
        )


@pytest.fixture(scope="module")
def compiler(tmp_path_factory: pytest.TempPathFactory) -> Compiler:
    return Compiler(tmp_path_factory.mktemp("compiler"))


@pytest.mark.full(seconds=2)
def test_it_is_generated_and_checked(compiler: Compiler) -> None:
    compiler.describe()
    done = compiler.run("generate", ".", "--out", "made")
    assert done.returncode == 0, done.stdout + done.stderr
    made = compiler.folder / "made"
    rows = (made / "toy/made_up.csv").read_text("utf-8").splitlines()
    assert rows == ["name,space,address,words", "SPEED,holding,7,1", "TORQUE,holding,8,1", "POWER,holding,9,1"]
    assert (made / "toy/spaces.csv").read_text("utf-8") == (TOY / "templates/runtime/spaces.csv").read_text("utf-8")
    manifest = json.loads((made / "manifest/made_up.json").read_text("utf-8"))
    assert sorted(manifest["targets"]["toy"]) == ["toy/made_up.csv", "toy/spaces.csv"]
    assert list(made.glob("c/*.h"))
    assert compiler.run("generate", ".", "--out", "made", "--check").returncode == 0
    (made / "toy/made_up.csv").write_text("changed by hand\n", "utf-8")
    checked = compiler.run("generate", ".", "--out", "made", "--target", "toy", "--check")
    assert (checked.returncode, checked.stdout.splitlines()[0]) == (1, "stale: made/toy/made_up.csv")


def test_it_is_named(compiler: Compiler) -> None:
    assert "vectors, toy" in " ".join(compiler.run("generate", "--help").stdout.split())
    compiler.describe()
    listed = compiler.run("generate", ".", "--out", "made", "--target", "toy", "--list-outputs").stdout.splitlines()
    assert listed == ["made/manifest/made_up.json", "made/toy/made_up.csv", "made/toy/spaces.csv"]


@pytest.mark.full(seconds=0.6)
def test_its_names_are_checked(compiler: Compiler) -> None:
    compiler.describe(second="acceleration_time", third="acceleration_limit")
    done = compiler.run("check", ".")
    assert done.returncode == 1
    said = " ".join(done.stdout.split())
    assert (
        "the point `acceleration_time` and the point `acceleration_limit` would both be `ACCELERA` in the panel" in said
    )
    assert "device.yaml:17:10" in said
    assert "the point `acceleration_time` stands here" in said
    compiler.describe(second="alarm")
    said = " ".join(compiler.run("check", ".").stdout.split())
    assert "the list of alarms and the point `alarm` would both be `ALARM` in the panel" in said


def test_a_device_may_not_take_its_place(compiler: Compiler) -> None:
    compiler.describe(device="settings")
    assert "`settings` is the table of the panel's settings" in compiler.run("check", ".").stdout
