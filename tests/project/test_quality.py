"""The sources are typed, linted and free of what belongs to one machine; `generated/` is current and deterministic."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
import tokenize
from pathlib import Path

import pytest
from support.places import ROOT

RUNTIME = ROOT / "templates/python/runtime"


def run(*command: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, check=False, env={**os.environ, **environment}
    )


def assert_clean(done: subprocess.CompletedProcess[str]) -> None:
    assert done.returncode == 0, done.stdout + done.stderr


def test_ruff() -> None:
    assert_clean(run(sys.executable, "-m", "ruff", "check", "generator", "tests", "templates"))


@pytest.mark.full(seconds=40)
def test_mypy_of_the_compiler_and_the_tests() -> None:
    assert_clean(run(sys.executable, "-m", "mypy", "--no-error-summary"))


@pytest.mark.full(seconds=6)
def test_mypy_and_ruff_of_the_generated_python() -> None:
    places = [str(path.parent) for path in sorted((ROOT / "generated/python").glob("*/__init__.py"))]
    assert places
    assert_clean(
        run(
            *(sys.executable, "-m", "mypy", "--config-file", os.devnull, "--strict", "--no-error-summary"),
            *places,
            MYPYPATH="generated/python",
        )
    )
    assert_clean(run(sys.executable, "-m", "ruff", "check", "--isolated", *places))
    assert_clean(run(sys.executable, "-m", "ruff", "format", "--isolated", "--line-length", "120", "--check", *places))


@pytest.mark.full(seconds=8)
def test_generated_is_current_whatever_the_order_of_hashes() -> None:
    """A run that compiles everything makes the bytes that are kept, which runs with other hashes made."""
    assert_clean(run(sys.executable, "-m", "fieldscribe", "generate", "descriptions", "--check", PYTHONHASHSEED="1"))


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize(
    "pattern",
    [r"(?<![\w.])/(?:root|home|work|usr/local)/\w", r"pypi\.org|crates\.io/|registry\.npmjs|deb\.debian\.org"],
)
def test_no_machine_paths_and_no_registry_hosts(pattern: str) -> None:
    found = []
    for folder in ("descriptions", "generator", "templates", "generated", "tests"):
        for path in (ROOT / folder).rglob("*"):
            if (
                path.suffix in {".py", ".yaml", ".j2", ".h", ".c", ".rs", ".toml", ".md", ".json", ".csv", ".sh"}
                and path.name != Path(__file__).name
            ):
                found += [
                    f"{path}: {line}"
                    for line in path.read_text("utf-8", "replace").splitlines()
                    if re.search(pattern, line)
                ]
    assert found == []


_SUPPRESSIONS = {
    ".py": r"(?:noqa|type: ignore)\b(?!(?:: [A-Z0-9, ]+|\[[a-z, -]+\])? +(?:#|-) ?\w).*",
    ".rs": r"#!?\[(?:allow|expect)\((?![^)]*\breason = ).*",
    ".c": r"NOLINT(?!\w*\([^)]*\):? \w).*",
}
"""By suffix, what is a suppression without a reason behind it."""


def _bare_suppressions(path: Path) -> list[str]:
    pattern = _SUPPRESSIONS[{".h": ".c"}.get(path.suffix, path.suffix)]
    text = path.read_text("utf-8")
    if path.suffix == ".py" and re.search(pattern, text):
        tokens = tokenize.generate_tokens(io.StringIO(text).readline)
        text = "\n".join(token.string for token in tokens if token.type == tokenize.COMMENT)
    return re.findall(pattern, text)


def test_every_suppression_has_its_reason() -> None:
    places = [path for folder in ("generator", "templates", "tests") for path in (ROOT / folder).rglob("*")]
    sources = [path for path in places if path.suffix in {".py", ".rs", ".c", ".h"}]
    assert len(sources) > 500
    assert {path: found for path in sources if (found := _bare_suppressions(path))} == {}


@pytest.mark.parametrize(
    ("name", "text", "bare"),
    [
        ("a.py", "x = 1  # noqa", True),
        ("a.py", "x = 1  # noqa: S603", True),
        ("a.py", "x = 1  # noqa: S603, S311  # both are ours", False),
        ("a.py", "x = 1  # noqa: S603 - all ours", False),
        ("a.py", "x = 1  # type: ignore[arg-type]", True),
        ("a.py", "x = 1  # type: ignore[arg-type, misc]  # of one type", False),
        ("a.py", "x = '# noqa'", False),
        ("a.rs", "#[allow(dead_code)]", True),
        ("a.rs", '#![allow(\n    dead_code,\n    reason = "it compiles"\n)]', False),
        ("a.h", "int x; /* NOLINT(misc-x) */", True),
        ("a.c", "int x; /* NOLINTNEXTLINE(misc-x): it is the table */", False),
    ],
)
def test_a_suppression_without_a_reason_is_found(name: str, text: str, bare: bool, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text, "utf-8")
    assert bool(_bare_suppressions(tmp_path / name)) is bare


@pytest.mark.parametrize("target", ["c", "rust"])
def test_no_generated_line_is_wide(target: str) -> None:
    sources = [path for path in (ROOT / "generated" / target).rglob("*") if path.suffix in {".h", ".c", ".rs"}]
    assert len(sources) > 20
    lines = [(path, line) for path in sources for line in path.read_text("utf-8").splitlines()]
    assert [(path, line) for path, line in lines if len(line) > 120] == []


def test_runtime_sources_carry_their_licence() -> None:
    sources = [p for p in (ROOT / "templates").rglob("runtime/**/*") if p.suffix in {".h", ".py", ".rs", ".toml"}]
    assert len(sources) > 100
    assert [path for path in sources if "0BSD" not in path.read_text("utf-8")[:600]] == []
