"""Compilers and their like: a missing tool skips a test and says what to install (where CI is set, it fails)."""

from __future__ import annotations

import os
import shutil
import subprocess
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

_PACKAGES = {
    "gcc": "gcc",
    "g++": "g++",
    "clang": "clang",
    "clang++": "clang",
    "arm-none-eabi-gcc": "gcc-arm-none-eabi",
    "arm-none-eabi-nm": "binutils-arm-none-eabi",
    "arm-none-eabi-objdump": "binutils-arm-none-eabi",
    "arm-none-eabi-size": "binutils-arm-none-eabi",
    "frama-c": "frama-c-base",
    "cargo": "cargo, or rustup from https://rustup.rs",
    "rustfmt": "rustfmt",
}

LIMIT = 300
"""Seconds after which a tool is taken to hang."""


def tool(name: str) -> str:
    """The path of a tool; without it the test is skipped, or fails where CI is set."""
    path = shutil.which(name)
    if path is None:
        reason = f"{name} is missing: install {_PACKAGES.get(name, name)}"
        if os.environ.get("CI", "").lower() == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    return path


def run(command: Sequence[str | Path], *, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Runs a tool or a program to its end, whatever its exit code."""
    words = [str(word) for word in command]
    return subprocess.run(words, cwd=cwd, capture_output=True, text=True, check=False, timeout=LIMIT)


def succeed(command: Sequence[str | Path], *, cwd: Path | None = None) -> str:
    """What a tool printed; a test fails with its messages when it does."""
    done = run(command, cwd=cwd)
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def compiled(compiler: str, flags: Sequence[str], source: Path, program: Path) -> Path:
    """Compiles one source file to a program without a single warning."""
    message = succeed([tool(compiler), *flags, "-Werror", "-o", program, source])
    assert not message
    return program
