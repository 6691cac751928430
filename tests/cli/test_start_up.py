"""A quick command starts quickly."""

from __future__ import annotations

import subprocess
import sys

from fieldscribe.resources import descriptions_dir


def test_check_imports_nothing_that_it_does_not_need() -> None:
    """What takes long to import is left to the commands that use it."""
    code = (
        "import sys\nfrom fieldscribe.cli import main\nmain(['check', sys.argv[1]])\n"
        "print(sorted({'jinja2', 'json', 'hashlib', 'asyncio'} & set(sys.modules)))"
    )
    command = [sys.executable, "-I", "-c", code, str(descriptions_dir() / "jumo_controller")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
