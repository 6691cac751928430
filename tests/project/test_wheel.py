"""The wheel brings templates and descriptions along and works in an empty environment, in a folder of its own."""

from __future__ import annotations

import subprocess
import sys
import venv
from pathlib import Path
from zipfile import ZipFile

import pytest
from support.places import ROOT


def run(*command: object, folder: Path) -> str:
    done = subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.full(seconds=10)
def test_wheel_installs_and_compiles(tmp_path: Path) -> None:
    pip = (sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check")
    run(*pip, "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", "dist", ROOT, folder=tmp_path)
    (wheel,) = (tmp_path / "dist").glob("fieldscribe-*.whl")
    shipped = {path.removeprefix("fieldscribe/shipped/") for path in ZipFile(wheel).namelist()}
    assert {"README.md", "CHANGELOG.md", "descriptions/KEYS.md", "descriptions/using/c.md"} <= shipped
    venv.create(tmp_path / "empty")
    scripts = tmp_path / "empty" / "bin"
    run(*pip, "--python", scripts / "python", "install", wheel, folder=tmp_path)
    project = tmp_path / "project"
    project.mkdir()
    run(scripts / "fieldscribe", "generate", "hitachi_l200", "--out", "bindings", folder=project)
    for path in (
        "c/hitachi_l200.h",
        "rust/hitachi_l200/Cargo.toml",
        "vectors/hitachi_l200.txt",
        "docs/hitachi_l200.md",
    ):
        made = (project / "bindings" / path).read_bytes()
        assert made == (ROOT / "generated" / path).read_bytes(), f"{path} differs from the checkout's"
    words = ("--family", "modbus", "--vendor", "Example", "--model", "HP 12", "--title", "Heat pump")
    run(scripts / "fieldscribe", "init", "heat_pump", *words, folder=project)
    assert "heat_pump: 1 point (1 generated)" in run(scripts / "fieldscribe", "check", "heat_pump", folder=project)
    schema = (ROOT / "descriptions/schema.json").read_text("utf-8")
    assert (project / "heat_pump/schema.json").read_text("utf-8") == schema
    assert run(scripts / "fieldscribe", "schema", folder=project) == schema
    assert "base_frequency" in run(scripts / "fieldscribe", "explain", "hitachi_l200", "A020", folder=project)
