"""The memory of earlier runs: it saves work, it never executes anything, and no state of it is an error."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterable
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.output.memory import cache_dir
from fieldscribe.pipeline import load_models
from fieldscribe.safe_files import State, state_of
from support.places import TESTS

DEVICES = TESTS / "devices"
COMMAND = ["generate", "device", "--out", "made", "--target", "c"]


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a device whose output was just made."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    shutil.copytree(DEVICES / "kitchen_can", tmp_path / "device")
    monkeypatch.chdir(tmp_path)
    assert main(COMMAND) == 0
    return tmp_path


def memory(place: Path) -> Path:
    (found,) = (place / "cache/fieldscribe/runs").iterdir()
    return found


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The devices that are compiled."""
    from fieldscribe.output import generation

    load, seen = load_models, []

    def counted(*arguments: object) -> object:
        seen.append(str(arguments[0]))
        return load(*arguments)  # type: ignore[arg-type]  # whatever it was called with

    monkeypatch.setattr(generation, "load_models", counted)
    return seen


def test_unchanged_input_is_not_compiled(place: Path, compiled: list[str]) -> None:
    assert main(COMMAND) == 0
    assert compiled == []
    (place / "device/device.yaml").write_text((place / "device/device.yaml").read_text("utf-8") + "# \n", "utf-8")
    assert main(COMMAND) == 0
    assert compiled == ["device/device.yaml"]


def test_the_state_of_the_compiler_has_its_files_and_not_what_python_keeps_of_them() -> None:
    """Else a first start would make the second one compile anew."""
    from fieldscribe.output.memory import _compiler

    parts = _compiler()
    assert any("/pipeline.py' (" in part for part in parts)
    assert any("/fieldscribe.h' (" in part for part in parts)
    assert not any("__pycache__" in part or ".pyc" in part for part in parts)


@pytest.mark.parametrize("path", ["device/device.yaml", "made/c/kitchen_can.h"])
def test_what_was_only_touched_is_not_compiled(place: Path, path: str, compiled: list[str]) -> None:
    os.utime(place / path)
    assert main(COMMAND) == 0
    assert compiled == []


def test_an_input_with_its_size_and_time_put_back_is_compiled(place: Path, compiled: list[str]) -> None:
    source = place / "device/device.yaml"
    text, before = source.read_text("utf-8"), source.stat()
    assert "version: 1.0.0" in text
    source.write_text(text.replace("version: 1.0.0", "version: 1.0.1"), "utf-8")
    os.utime(source, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert main(COMMAND) == 0
    assert compiled == ["device/device.yaml"]


@pytest.mark.parametrize("path", ["c/kitchen_can.h", "manifest/kitchen_can.json"])
def test_an_output_with_its_size_and_time_put_back_is_not_unchanged(
    place: Path, path: str, compiled: list[str]
) -> None:
    target = place / "made" / path
    data, before = target.read_bytes(), target.stat()
    target.write_bytes(data.replace(b"0", b"9", 1))
    os.utime(target, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert main([*COMMAND, "--force"]) == 0
    assert compiled
    assert target.read_bytes() == data


def test_an_output_within_the_tick_of_the_clock_is_read(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A change that leaves size, inode and times as they were, as one within a tick of the file system's clock does."""
    from fieldscribe.output import memory as room

    target = place / "made/c/kitchen_can.h"
    data, before = target.read_bytes(), target.stat()
    monkeypatch.setattr(room, "state_of", lambda status: state_of(before if status.st_ino == before.st_ino else status))
    target.write_bytes(data.replace(b"0", b"9", 1))
    assert main(COMMAND) == 0
    assert target.read_bytes() == data


BROKEN = {
    "empty": b"",
    "binary": b"\x80\x04\x95pickle",
    "cut": b'{"run": "',
    "list": b"[]",
    "deep": b"[" * 200_000,
    "other shape": b'{"run": 1, "inputs": [], "outputs": {"x": 1}}',
    "huge number": b'{"run": ' + b"9" * 5000 + b"}",
}


QUICK = ("cut", "other shape", "link")


@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(kind, marks=() if kind in QUICK else pytest.mark.full)
        for kind in (*BROKEN, "folder", "pipe", "link", "huge", "unwritable names")
    ],
)
def test_a_broken_memory_is_made_anew_or_ignored(place: Path, kind: str, compiled: list[str]) -> None:
    found = memory(place)
    text = found.read_bytes()
    found.unlink()
    if kind in BROKEN:
        found.write_bytes(BROKEN[kind])
    elif kind == "folder":
        (found / "x").mkdir(parents=True)
    elif kind == "pipe":
        os.mkfifo(found)
    elif kind == "link":
        found.symlink_to(found.name)
    elif kind == "huge":
        found.touch()
        os.truncate(found, 3 << 30)
    else:
        document = json.loads(text)
        document["outputs"]["c/\0\ud800"] = {"state": [0, 0, 0, 0], "sha256": ""}
        found.write_text(json.dumps(document))
    assert main(COMMAND) == 0
    assert len(compiled) == 1
    assert main(COMMAND) == 0
    assert len(compiled) == (2 if kind == "folder" else 1)


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize("kind", ["file", "shared", "link to nowhere"])
def test_without_a_private_cache_everything_works(place: Path, kind: str) -> None:
    shutil.rmtree(place / "cache")
    if kind == "file":
        (place / "cache").write_text("")
    elif kind == "shared":
        (place / "cache/fieldscribe/runs").mkdir(parents=True)
        (place / "cache/fieldscribe/runs").chmod(0o777)
    else:
        (place / "cache").symlink_to("nowhere/at/all")
    assert main(COMMAND) == 0
    assert main([*COMMAND, "--check"]) == 0


@pytest.mark.parametrize(
    ("found", "fits"),
    [
        ((0o700, 0, True), True),
        ((0o755, 0, True), True),
        ((0o720, 0, True), False),
        ((0o702, 0, True), False),
        ((0o777, 0, True), False),
        ((0o700, 1, True), False),
        ((0o700, 0, False), False),
    ],
)
def test_a_cache_belongs_to_its_user_alone(
    found: tuple[int, int, bool], fits: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who could write into it could make stale outputs pass for unchanged."""
    mode, owner, writable = found
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    place = tmp_path / "fieldscribe/runs"
    place.mkdir(parents=True)
    place.chmod(mode)
    user = os.getuid() + owner
    monkeypatch.setattr(os, "getuid", lambda: user)
    monkeypatch.setattr(os, "access", lambda *_: writable)
    assert cache_dir() == (place if fits else None)


def test_a_relative_place_of_caches_is_none(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As the XDG specification asks: what is remembered does not lie about in the folders where the command runs."""
    monkeypatch.setenv("XDG_CACHE_HOME", "relative/place")
    monkeypatch.setenv("HOME", str(place / "home"))
    assert main(COMMAND) == 0
    assert not (place / "relative").exists()
    assert (place / "home/.cache/fieldscribe").exists()


def test_a_full_disk_of_the_cache_is_ignored(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from fieldscribe.output import writing

    replace = writing.replace

    def full(path: Path, data: Iterable[bytes], *temporary: str) -> State:
        if path.is_relative_to(place / "cache"):
            raise OSError(28, "No space left on device")
        return replace(path, data, *temporary)

    memory(place).unlink()
    monkeypatch.setattr(writing, "replace", full)
    assert main(COMMAND) == 0
    assert list((place / "cache/fieldscribe/runs").iterdir()) == []


def test_nothing_executable_is_kept_or_loaded(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """All that a run leaves in the cache is JSON, and a run never turns bytes of a file into code by itself."""
    import marshal
    import pickle

    def loaded(*_: object) -> None:
        raise AssertionError("something executable was loaded")

    for module in (marshal, pickle):
        monkeypatch.setattr(module, "load", loaded)
        monkeypatch.setattr(module, "loads", loaded)
    from fieldscribe import resources

    resources._environment.cache_clear()
    shutil.rmtree(place / "made")
    assert main(COMMAND) == 0
    kept = [path for path in (place / "cache").rglob("*") if path.is_file()]
    assert [json.loads(path.read_bytes()).keys() for path in kept] == [{"run", "inputs", "outputs"}]


@pytest.mark.parametrize(
    ("variable", "found"), [("caches", "home/.cache"), ("", "home/.cache"), ("/ABSOLUTE", "absolute")]
)
def test_the_place_of_caches_is_that_of_the_specification(
    variable: str, found: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A relative XDG_CACHE_HOME is to be ignored."""
    from fieldscribe.output.memory import cache_dir

    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.setenv("XDG_CACHE_HOME", variable.replace("/ABSOLUTE", str(tmp_path / "absolute")))
    place = cache_dir()
    assert place == tmp_path / found / "fieldscribe/runs"
    assert place.stat().st_mode & 0o777 == 0o700


def test_without_a_home_nothing_is_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And no folder that is called `~` is made."""
    from fieldscribe.output.memory import cache_dir

    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(os.path, "expanduser", lambda path: path)
    assert cache_dir() is None
    assert list(tmp_path.iterdir()) == []
