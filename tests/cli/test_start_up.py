"""A quick command starts quickly, and so does pytest."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from fieldscribe.resources import descriptions_dir


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


def test_the_plugin_of_pytest_imports_no_simulation() -> None:
    code = "import sys, fieldscribe.simulation.pytest_plugin\nprint('fieldscribe.model' in sys.modules)"
    done = subprocess.run([sys.executable, "-I", "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
