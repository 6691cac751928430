"""Compilers and their like: a missing tool skips a test and says what to install (where CI is set, it fails)."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import NoReturn

import pytest

from support.places import ROOT

_PACKAGES = {
    "gcc": "gcc",
    "g++": "g++",
    "clang": "clang",
    "clang++": "clang",
    "arm-none-eabi-gcc": "gcc-arm-none-eabi",
    "arm-none-eabi-nm": "binutils-arm-none-eabi",
    "arm-none-eabi-objdump": "binutils-arm-none-eabi",
    "arm-none-eabi-size": "binutils-arm-none-eabi",
    "make": "make",
    "ninja": "ninja-build",
    "cmake": "cmake",
    "meson": "meson",
    "qemu-system-arm": "qemu-system-arm",
    "frama-c": "frama-c-base",
    "avr-gcc": "gcc-avr avr-libc",
    "cargo": "cargo, or rustup from https://rustup.rs",
    "rustdoc": "rustc, or rustup from https://rustup.rs",
    "clippy-driver": "rust-clippy, or rustup from https://rustup.rs",
    "rustfmt": "rustfmt",
    "bash": "bash",
    "zsh": "zsh",
    "fish": "fish",
    "node": "nodejs npm",
    "soffice": "libreoffice-calc-nogui",
    "chromium-headless-shell": "chromium-headless-shell",
}
NODE_MODULES = ROOT / ".cache/node/node_modules"
"""The packages of npm that setup.sh fetches."""
_LIBMODBUS = Path("/usr/include/modbus")

LIMIT = 300
"""Seconds after which a tool is taken to hang."""


def tool(name: str) -> str:
    """Return the path of a tool; without it the test is skipped, or fails where CI is set."""
    path = shutil.which(name)
    if path is None:
        _do_without(name, _PACKAGES.get(name, name))
    return path


def language_server() -> tuple[str, ...]:
    """Return the command that starts yaml-language-server; without it as for `tool`."""
    return *npm_program("yaml-language-server", "bin/yaml-language-server"), "--stdio"


def npm_program(package: str, script: str) -> tuple[str, str]:
    """Return the command that runs a script of a package of npm under node; without it as for `tool`."""
    return tool("node"), str(npm_package(package) / script)


def npm_package(package: str) -> Path:
    """Return the folder of a package of npm; without it as for `tool`."""
    folder = NODE_MODULES / package
    if not folder.is_dir():
        _do_without(package, "npm, and run `sh generator/setup.sh tests`, which fetches it")
    return folder


def gcc_for_32_bits() -> str:
    """Return the path of a gcc that can build 32-bit programs; without it as for `tool`."""
    path = tool("gcc")
    asked = [path, "-m32", "-x", "c", "-o", os.devnull, "-"]
    program = "#include <stdio.h>\nint main(void) { return 0; }"
    done = subprocess.run(asked, input=program, text=True, capture_output=True, check=False)
    if done.returncode != 0:
        _do_without("gcc -m32", "gcc-multilib")
    return path


def libmodbus() -> tuple[str, ...]:
    """Return the flags with which gcc compiles and links libmodbus; without it as for `tool`."""
    if not (_LIBMODBUS / "modbus.h").is_file():
        _do_without("libmodbus", "libmodbus-dev")
    return f"-isystem{_LIBMODBUS}", "-lmodbus"


def crates(project: Path) -> None:
    """Fetch the crates that a cargo project needs, once; without them as for `tool`."""
    fetched = run([tool("cargo"), "fetch", "--offline"], cwd=project)
    if fetched.returncode != 0 and run([tool("cargo"), "fetch"], cwd=project).returncode != 0:
        _do_without("what cargo fetches from crates.io", "it by `cargo fetch` with the network, which keeps it")


def _do_without(name: str, packages: str) -> NoReturn:
    """Skips the test and says what to install; where CI is set, it fails."""
    reason = f"{name} is missing: install {packages}"
    if os.environ.get("CI", "").lower() == "true":
        pytest.fail(reason)
    pytest.skip(reason)


def run(
    command: Sequence[str | Path], *, cwd: Path | None = None, limit: float = LIMIT
) -> subprocess.CompletedProcess[str]:
    """Run a tool or a program to its end, whatever its exit code."""
    words = [str(word) for word in command]
    return subprocess.run(words, cwd=cwd, capture_output=True, text=True, check=False, timeout=limit)


def succeed(command: Sequence[str | Path], *, cwd: Path | None = None) -> str:
    """Return what a tool printed; if the tool fails, the test fails with its messages."""
    done = run(command, cwd=cwd)
    assert done.returncode == 0, f"{' '.join(map(str, command))}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def compiled(compiler: str, flags: Sequence[str], source: Path, program: Path) -> Path:
    """Compile one source file to a program without a warning; return the program."""
    message = succeed([tool(compiler), *flags, "-Werror", "-o", program, source])
    assert not message
    return program
