"""Completion as the shells do it: their own completion code runs the scripts that we print."""

from __future__ import annotations

import json
import os
import pty
import select
import subprocess
import sys
import time
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.cli.completion import completions
from support.described import described, write
from support.places import ROOT
from support.toolchains import tool

ENVIRONMENT = {**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}", "TERM": "dumb"}
LINES = [
    ("fieldscribe dec", ["decode"]),
    ("fieldscribe explain hit", ["hitachi_l200"]),
    ("fieldscribe explain hitachi_l200 base_f", ["base_frequency", "base_frequency_set_2"]),
    ("fieldscribe decode woodward_mpu2s --for", ["--format"]),
    ("fieldscribe decode woodward_mpu2s --format jsonl --can", ["--can-id"]),
]


@pytest.mark.parametrize(
    ("typed", "known"),
    [
        (["l"], ["listen", "list"]),
        (["--v"], ["--version"]),
        (["nothing", ""], []),
        (["explain", "woodward"], ["woodward_mpu2s"]),
        (["explain", "hitachi_l200", "a002"], ["A002"]),
        (["explain", "--descriptions", "descriptions", "hitachi_l200", "A002"], ["A002"]),
        (["explain", "--descriptions", "tests", "hitachi_l200", "A002"], []),
        (["explain", "no_device", ""], []),
        (["encode", "hitachi_l200", "A002", ""], []),
        (["encode", "hitachi_l200", "A020", "--with", "A00"], ["A001=", "A002=", "A003=", "A004=", "A005="]),
        (["decode", "siemens_mm4", "--framing", "pk"], ["pkw"]),
        (["decode", "siemens_mm4", "--framing", "=", "pk"], ["pkw"]),
        (["decode", "siemens_mm4", "--framing", "="], ["rtu", "tcp", "uss", "pkw", "pzd", "broadcast"]),
        (["decode", "siemens_mm4", "--framing=pk"], ["--framing=pkw"]),
        (["completion", "z"], ["zsh"]),
        (["export", ""], ["json", "dbc"]),
    ],
)
def test_completions(typed: list[str], known: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    assert completions(typed) == known


def told(*command: str, folder: Path = ROOT) -> list[str]:
    done = subprocess.run(command, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, check=True, timeout=120)
    assert done.stderr == ""
    return done.stdout.splitlines()


HOSTILE = ["Z$(touch pwned)", "$(touch pwned2);x", "a'b\"c `touch pwned`"]
"""Codes that a description may have: they pass `check`."""


@pytest.fixture
def hostile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a description of these codes, and folders of devices that no shell should be given."""
    points = "".join(f"- {{name: p{at}, code: {json.dumps(code)}, at: {at}}}\n" for at, code in enumerate(HOSTILE))
    write(tmp_path / "odd", described(points, device="odd"))
    for folder in ("$(touch pwned)", "a\nb; touch pwned", "-x", "Odd One"):
        write(tmp_path / folder, described(points, device="odd"))
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_codes_are_words_and_folders_are_ids(hostile: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "odd"]) == 0
    capsys.readouterr()
    assert completions(["explain", "--descriptions", str(hostile), ""]) == ["odd"]
    assert completions(["explain", "odd", "$"]) == HOSTILE[1:2]


@pytest.mark.full(seconds=2)
def test_bash_types_hostile_codes_quoted(hostile: Path) -> None:
    """Bash puts the words on the line as they are, and Enter runs that."""
    ask = (
        "COMP_WORDS=(fieldscribe explain odd ''); COMP_CWORD=3; _fieldscribe fieldscribe\n"
        'for word in "${COMPREPLY[@]}"; do eval "printf \'%s\\n\' $word"; done\n'
    )
    said = told(tool("bash"), "--norc", "-c", f"source <(fieldscribe completion bash)\n{ask}", folder=hostile)
    assert said == ["p0", HOSTILE[0], "p1", HOSTILE[1], "p2", HOSTILE[2]]
    assert not list(hostile.glob("pwned*"))


@pytest.mark.full(seconds=2)
def test_fish_types_hostile_codes_quoted(hostile: Path) -> None:
    ask = "fieldscribe completion fish | source; complete --escape -C 'fieldscribe explain odd Z'"
    assert told(tool("fish"), "--no-config", "-c", ask, folder=hostile) == [r"Z\$\(touch\ pwned\)"]


@pytest.mark.full(seconds=2)
def test_bash() -> None:
    ask = "".join(
        f"COMP_WORDS=({line}); COMP_CWORD={line.count(' ')}; _fieldscribe fieldscribe; echo ${{COMPREPLY[*]}}\n"
        for line, _ in LINES
    )
    script = f"source <(fieldscribe completion bash)\ncomplete -p fieldscribe\n{ask}"
    first, *said = told(tool("bash"), "--norc", "-c", script)
    assert first == "complete -o default -F _fieldscribe fieldscribe"
    assert said == [" ".join(known) for _, known in LINES]


@pytest.mark.full(seconds=3)
def test_fish() -> None:
    ask = "".join(f"; string join -- ' ' (complete -C '{line}')" for line, _ in LINES)
    said = told(tool("fish"), "--no-config", "-c", f"fieldscribe completion fish | source{ask}; true")
    assert said == [" ".join(known) for _, known in LINES]
    files = told(
        "fish", "--no-config", "-c", "fieldscribe completion fish | source; complete -C 'fieldscribe check gen'"
    )
    assert "generator/" in files


@pytest.mark.full(seconds=3)
def test_zsh(tmp_path: Path) -> None:
    in_zsh(
        tmp_path, ROOT, [(line, f"{known[0]} " if len(known) == 1 else min(known, key=len)) for line, known in LINES]
    )


@pytest.mark.full(seconds=3)
def test_zsh_types_hostile_codes_quoted(hostile: Path) -> None:
    in_zsh(hostile, hostile, [("fieldscribe explain odd Z", r"\$\(touch\ pwned\) ")])
    assert not list(hostile.glob("pwned*"))


def in_zsh(home: Path, folder: Path, lines: list[tuple[str, str]]) -> None:
    """Zsh completes at its prompt only: it gets a terminal, and each line with a tab behind it."""
    shell = tool("zsh")
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.execve(shell, [shell, "-f", "-i"], {**ENVIRONMENT, "HOME": str(home), "ZDOTDIR": str(home)})
    try:
        _type(terminal, "PS1=; unsetopt zle_bracketed_paste; autoload -Uz compinit; compinit -u -D\n")
        _type(terminal, "source <(fieldscribe completion zsh); echo rea''dy\n")
        _await(terminal, "ready")
        for line, shown in lines:
            _type(terminal, f"{line}\t")
            _await(terminal, shown)
            _type(terminal, "\x15")
    finally:
        os.close(terminal)
        os.waitpid(child, 0)


def _type(terminal: int, text: str) -> None:
    os.write(terminal, text.encode())


def _await(terminal: int, expected: str) -> None:
    shown, until = "", time.monotonic() + 60
    while expected not in shown:
        left = until - time.monotonic()
        assert left > 0, shown
        assert select.select([terminal], [], [], left)[0], shown
        shown += os.read(terminal, 4096).decode("utf-8", "replace")


def test_completion_loads_little() -> None:
    """It answers a key that was pressed: no template engine, no tables, nothing that only compiling needs."""
    asked = "from fieldscribe.cli import main; import sys; main(sys.argv[1:]); print(*sys.modules, file=sys.stderr)"
    words = ["completion", "words", "--", "explain", "hitachi_l200", "A0"]
    done = subprocess.run([sys.executable, "-c", asked, *words], cwd=ROOT, capture_output=True, text=True, check=True)
    assert "A001" in done.stdout
    loaded = set(done.stderr.split())
    heavy = {"jinja2", "asyncio", "fieldscribe.targets.c", "fieldscribe.checks"}
    assert not heavy & loaded
