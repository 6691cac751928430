"""generator/setup.sh finds what is missing, also where a command is there and its library is not."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest
from support.places import ROOT

pytestmark = pytest.mark.full(seconds=0.3)

ALWAYS_THERE = ("gcc", "g++", "arm-none-eabi-gcc", "cargo", "rustfmt", "cargo-clippy", "zsh", "fish", "npm")


def _program(folder: Path, name: str, text: str) -> None:
    file = folder / name
    file.write_text(f"#!/bin/sh\n{text}\n", "utf-8")
    file.chmod(0o755)


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    """A copy of the script in a checkout that is set up, on a machine without root where every compiler works."""
    (tmp_path / "generator").mkdir()
    shutil.copy(ROOT / "generator/setup.sh", tmp_path / "generator")
    (tmp_path / "pyproject.toml").write_text("x\n", "utf-8")
    for folder in ("bin", ".venv/bin"):
        (tmp_path / folder).mkdir(parents=True)
    for name in ALWAYS_THERE:
        _program(tmp_path / "bin", name, "exit 0")
    _program(tmp_path / "bin", "id", "echo 1000")
    _program(tmp_path / "bin", "clang", 'test "$1" = -dumpversion && echo 15.0.7; exit 0')
    _program(tmp_path / ".venv/bin", "python", "exit 0")
    return tmp_path


def _missing(machine: Path) -> str:
    environment = {**os.environ, "PATH": f"{machine / 'bin'}:{os.environ['PATH']}"}
    words = ["sh", str(machine / "generator/setup.sh"), "tests"]
    done = subprocess.run(words, capture_output=True, text=True, check=True, env=environment, timeout=60)
    said = [line for line in done.stderr.splitlines() if line.startswith("missing here:")]
    return said[0] if said else ""


def test_a_machine_with_everything_misses_nothing(machine: Path) -> None:
    assert "clang" not in _missing(machine)
    assert "gcc " not in _missing(machine)


def test_a_clang_without_its_sanitizers_is_not_complete(machine: Path) -> None:
    """The library of the version that is installed is what is missing."""
    _program(
        machine / "bin",
        "clang",
        'test "$1" = -dumpversion && { echo 15.0.7; exit 0; }\ncase "$*" in *-fsanitize=*) exit 1 ;; esac\nexit 0',
    )
    assert "clang libclang-rt-15-dev" in _missing(machine)


def test_a_gcc_that_cannot_link_is_not_complete(machine: Path) -> None:
    _program(machine / "bin", "gcc", "exit 1")
    assert "gcc libc6-dev" in _missing(machine)


def test_an_environment_whose_setting_up_was_interrupted_is_made_whole(machine: Path) -> None:
    """It has a python, but no pip yet."""
    _program(machine / ".venv/bin", "python", "exit 1")
    _program(
        machine / "bin",
        "python3",
        f'[ "$1 $2" = "-m venv" ] && printf "#!/bin/sh\\nexit 0\\n" >{machine}/.venv/bin/python; exit 0',
    )
    _missing(machine)
    assert (machine / ".venv/installed").is_file()
