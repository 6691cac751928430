"""Programs that were written before a rename compile and work after `diff --keep-names`, in every language."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.targets import c, python, rust
from support.described import described, loaded, write
from support.files import generate
from support.python_package import typed_findings
from support.rust_workspace import rust_program, rustc
from support.toolchains import succeed, tool

SAID = {
    "records": "{trip: {points: [{name: CAUSE, at: base, enum: {0: none, 7: hot}}]}}",
    "variants": "{size: {title: Size, values: {small: {title: Small}, large: {title: Large}}}}",
}
POINTS = """\
- {name: MODE, at: 1, enum: {0: stop, 1: run}, sets: {2: {at: 2}, 3: {at: 3, enum: {5: wait}}}}
- {name: STATE, at: 4, flags: {0: ready, 3..2: {name: phase, values: {0: idle, 1: busy}}}}
- {name: first_trip, record: trip, at: 10}
- {name: second_trip, record: trip, at: 20}
- {name: PAIR, at: 30, digits: {count: 2, enum: {0: single, 1: both}}}
- {name: LEVEL, at: 31, variants: {size=small: {enum: {1: low}}, size=large: {range: 2, enum: {2: high}}}}
- {name: ratio, at: 40, range: 1..9}
- {name: LIMIT, at: 41, range: 0..ratio, scale: value = raw * ratio, unit: V}
"""
OLD = {"MODE": "mode", "STATE": "state", "CAUSE": "cause", "PAIR": "pair", "LEVEL": "level", "LIMIT": "limit"}
NEW = {"MODE": "way", "STATE": "status", "CAUSE": "reason", "PAIR": "couple", "LEVEL": "height", "LIMIT": "bound"}

C = """\
#define FIELDSCRIBE_IMPLEMENTATION
#include "made_up.h"
int main(void) {
    uint16_t raw;
    return !(MADE_UP_MODE_RUN == 1 && MADE_UP_MODE_SET_3_WAIT == 5 && MADE_UP_TRIP_CAUSE_HOT == 7
        && MADE_UP_PAIR_BOTH == 1 && MADE_UP_LEVEL_SMALL_LOW == 1 && MADE_UP_STATE_READY_MASK == 1
        && made_up_mode_name(1)[0] == 'r' && made_up_trip_cause_name(7)[0] == 'h'
        && made_up_mode_encode(1, &raw) == FIELDSCRIBE_OK && raw == 1);
}
"""
PYTHON = """\
from made_up import LevelSmall, MadeUp, Mode, ModeSet3, Pair, State, StatePhase, TripCause
from made_up.enums import Mode as Same

assert int(Mode.RUN) == 1 and int(ModeSet3.WAIT) == 5 and int(TripCause.HOT) == 7 and int(Pair.BOTH) == 1
assert int(LevelSmall.LOW) == 1 and int(StatePhase.BUSY) == 1 and int(State.READY) == 1 and Same is Mode
mode: Mode = MadeUp.mode.decode(1)
assert mode is Mode.RUN, mode
"""
RUST = """\
#![allow(deprecated, reason = "old names are what is tested")]
use made_up::{enums, flags, points, with};

fn main() {
    assert_eq!(u16::from(enums::Mode::Run), 1);
    assert_eq!(u16::from(enums::ModeSet3::Wait), 5);
    assert_eq!(u16::from(enums::TripCause::Hot), 7);
    assert_eq!(u16::from(enums::LevelSmall::Low), 1);
    assert_eq!(enums::Pair::from(1), enums::Pair::Both);
    assert!(flags::State::from(1).ready());
    let _: with::Limit = with::Limit { ratio: 2 };
    let _ = |point: points::LevelLarge, other: points::ModeSet2| (point, other);
}
"""


def spelt(text: str, names: dict[str, str]) -> str:
    """The text with these names."""
    for blank, name in names.items():
        text = text.replace(blank, name)
    return text


@pytest.fixture(scope="module", params=["before", "after"])
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What is generated before and after the rename."""
    out: Path = tmp_path_factory.mktemp("old_names")
    said = {key: spelt(text, OLD) for key, text in SAID.items()}
    file = write(out / "old", described(spelt(POINTS, OLD), **said))
    if request.param == "after":
        said = {key: spelt(text, NEW) for key, text in SAID.items()}
        new = write(out / "new", described(spelt(POINTS, NEW), **said))
        assert main(["diff", str(file), str(new), "--keep-names", "--fail-on", "breaking"]) == 0
        file = new
    return generate(loaded(file), out / "made", c, python, rust)


def ran(*command: str, cwd: Path, **environment: str) -> str:
    """What a program says that ends well."""
    told = {**os.environ, **environment}
    done = subprocess.run(command, cwd=cwd, env=told, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.mark.full(seconds=2)
def test_in_c(folder: Path, tmp_path: Path) -> None:
    (tmp_path / "old.c").write_text(C, "utf-8")
    options = ("-std=c99", "-Wall", "-Wextra", "-Werror", "-I", str(folder / "c"))
    ran(tool("gcc"), *options, "old.c", "-o", "old", cwd=tmp_path)
    ran(str(tmp_path / "old"), cwd=tmp_path)


@pytest.mark.full(seconds=2)
def test_in_python(folder: Path, tmp_path: Path) -> None:
    said = ran(sys.executable, "-W", "always", "-c", PYTHON, cwd=tmp_path, PYTHONPATH=str(folder / "python"))
    is_after = (folder.parent / "new").exists()
    assert ("DeprecationWarning: Mode is now called Way" in said) == is_after, said
    ran(sys.executable, "-m", "ruff", "check", "--isolated", "--no-cache", str(folder / "python/made_up"), cwd=tmp_path)
    assert "program.py" not in typed_findings(PYTHON, folder / "python", "made_up", tmp_path)


@pytest.mark.full(seconds=3)
def test_in_rust(folder: Path, rust_libraries: Path, tmp_path: Path) -> None:
    done = rustc(folder / "rust/made_up/src/lib.rs", rust_libraries, "--crate-name=made_up", out=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    (tmp_path / "old.rs").write_text(RUST, "utf-8")
    crates = (rust_libraries / "libfieldscribe_runtime.rlib", tmp_path / "libmade_up.rlib")
    succeed([rust_program(tmp_path / "old.rs", tmp_path / "old", *crates)])
