"""A quick command starts quickly, and so does pytest; Ctrl-C ends a command at any time."""

from __future__ import annotations

import os
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import pytest
from fieldscribe.resources import descriptions_dir
from support.places import ROOT


@pytest.mark.full(seconds=1)
def test_check_imports_nothing_that_it_does_not_need() -> None:
    """What takes long to import is left to the commands that use it."""
    code = (
        "import sys\nfrom fieldscribe.cli import main\nmain(['check', sys.argv[1]])\n"
        "print(sorted({'jinja2', 'json', 'hashlib', 'asyncio'} & set(sys.modules)))"
    )
    command = [sys.executable, "-I", "-c", code, str(descriptions_dir() / "jumo_controller")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"


@pytest.mark.full(seconds=5)
def test_a_generate_with_nothing_changed_imports_as_little(tmp_path: Path) -> None:
    code = (
        "import sys\nfrom fieldscribe.cli import main\nmain(sys.argv[1:])\n"
        "print(sorted({'dataclasses', 'hashlib', 'yaml', 'fieldscribe.families'} & set(sys.modules)))"
    )
    words = ["generate", str(descriptions_dir() / "jumo_controller"), "--target", "docs", "--out", str(tmp_path)]
    command = [sys.executable, "-I", "-c", code, *words]
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path / "cache")}
    for _ in range(3):  # files are trusted two seconds after they were written
        done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
        if done.stdout.splitlines()[-1] == "[]":
            return
        time.sleep(2.1)
    raise AssertionError(done.stdout)


INTERRUPTING = """
import os, signal, sys

_, awaited, entry = sys.argv

class Interrupting:
    @staticmethod
    def find_spec(name, path=None, target=None):
        if name == awaited:
            os.kill(os.getpid(), signal.SIGINT)

sys.meta_path.insert(0, Interrupting)
module, _, function = entry.partition(":")
sys.argv[1:] = ["check"]
if function:
    sys.exit(getattr(__import__(module, fromlist=[function]), function)())
import runpy
runpy.run_module(module, run_name="__main__", alter_sys=True)
"""
"""Runs an entry point; Ctrl-C comes when a module is imported."""

SCRIPT: str = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["scripts"]["fieldscribe"]


@pytest.mark.parametrize("entry", [SCRIPT, "fieldscribe"])
@pytest.mark.parametrize("module", ["fieldscribe.cli", "argparse", "fieldscribe.cli.terminal", "fieldscribe.cli.check"])
def test_ctrl_c_while_modules_are_imported_ends_as_later(module: str, entry: str) -> None:
    command = [sys.executable, "-I", "-c", INTERRUPTING, module, entry]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "")


def test_the_plugin_of_pytest_imports_no_simulation() -> None:
    code = "import sys, fieldscribe.simulation.pytest_plugin\nprint('fieldscribe.model' in sys.modules)"
    done = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
