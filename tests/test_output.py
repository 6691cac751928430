"""Files on disk: changed ones only, whole or not at all, and never outside the output folder."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from fieldscribe.output import Changes, UnsafePathError, apply, compare, read_manifest, settle_manifest
from fieldscribe.output.two_processes import both, halved

if TYPE_CHECKING:
    from pathlib import Path

FILES = {"c": {"c/drive.h": b"one\n", "c/runtime.h": b"shared\n"}, "docs": {"docs/drive.md": b"# drive\n"}}


def written(out: Path) -> dict[str, bytes]:
    return {path.relative_to(out).as_posix(): path.read_bytes() for path in out.rglob("*") if path.is_file()}


def changed(out: Path, device: str, files: dict[str, dict[str, bytes]]) -> Changes:
    """What all targets of a device would change, the manifest last."""
    found = [compare(out, device, target, made) for target, made in files.items()]
    found.append(settle_manifest(out, device, {target: sorted(made) for target, made in files.items()}))
    write = {path: data for one in found for path, data in one.write.items()}
    return Changes(write, [path for one in found for path in one.remove], [])


def generate(out: Path, device: str, files: dict[str, dict[str, bytes]]) -> None:
    apply(out, changed(out, device, files))


def test_writes_files_and_a_manifest(tmp_path: Path) -> None:
    generate(tmp_path, "drive", FILES)
    manifest = json.loads((tmp_path / "manifest/drive.json").read_text())
    assert manifest["targets"] == {"c": ["c/drive.h", "c/runtime.h"], "docs": ["docs/drive.md"]}
    assert written(tmp_path)["c/drive.h"] == b"one\n"


def test_an_unchanged_file_is_not_touched(tmp_path: Path) -> None:
    generate(tmp_path, "drive", FILES)
    before = (tmp_path / "c/drive.h").stat().st_mtime_ns
    changes = changed(tmp_path, "drive", FILES)
    assert changes.stale == []
    apply(tmp_path, changes)
    assert (tmp_path / "c/drive.h").stat().st_mtime_ns == before


@pytest.mark.parametrize("spoil", ["edit", "delete"])
def test_an_edited_or_deleted_output_is_stale(tmp_path: Path, spoil: str) -> None:
    generate(tmp_path, "drive", FILES)
    place = tmp_path / "c/drive.h"
    place.unlink() if spoil == "delete" else place.write_bytes(b"two\n")
    assert changed(tmp_path, "drive", FILES).stale == ["c/drive.h"]


def test_removes_only_what_the_manifest_says_of_that_device_and_target(tmp_path: Path) -> None:
    generate(tmp_path, "drive", FILES)
    (tmp_path / "c/mine.h").write_text("by hand")
    smaller = {"c": {"c/drive2.h": b"renamed\n"}}
    assert compare(tmp_path, "drive", "c", smaller["c"]).remove == ["c/drive.h", "c/runtime.h"]
    generate(tmp_path, "drive", smaller)
    assert {"c/mine.h", "c/drive2.h", "docs/drive.md"} <= written(tmp_path).keys()
    assert "c/drive.h" not in written(tmp_path)
    assert read_manifest(tmp_path, "drive")["docs"] == ["docs/drive.md"]


def test_keeps_what_another_device_shares(tmp_path: Path) -> None:
    generate(tmp_path, "drive", FILES)
    generate(tmp_path, "pump", {"c": {"c/pump.h": b"", "c/runtime.h": b"shared\n"}})
    generate(tmp_path, "drive", {"c": {"c/drive.h": b"one\n"}})
    assert "c/runtime.h" in written(tmp_path)


@pytest.mark.parametrize("path", ["../escape.h", "/tmp/escape.h", "c/../../escape.h"])
def test_nothing_is_written_outside(tmp_path: Path, path: str) -> None:
    with pytest.raises(UnsafePathError):
        compare(tmp_path / "out", "drive", "c", {path: b"x"})


def test_a_link_out_of_the_folder_is_not_followed(tmp_path: Path) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    out = tmp_path / "out"
    out.mkdir()
    (out / "c").symlink_to(outside)
    with pytest.raises(UnsafePathError):
        changed(out, "drive", FILES)
    assert list(outside.iterdir()) == []


def test_a_hostile_manifest_removes_nothing_outside(tmp_path: Path) -> None:
    out = tmp_path / "out"
    victim = tmp_path / "victim"
    victim.write_text("precious")
    (out / "manifest").mkdir(parents=True)
    (out / "manifest/drive.json").write_text(json.dumps({"targets": {"c": ["../victim", "/etc/passwd", 7]}}))
    generate(out, "drive", FILES)
    assert victim.read_text() == "precious"


@pytest.mark.parametrize("text", ["", "[]", "{", '{"targets": 3}', '{"targets": {"c": 1}}'])
def test_a_broken_manifest_is_no_manifest(tmp_path: Path, text: str) -> None:
    (tmp_path / "manifest").mkdir()
    (tmp_path / "manifest/drive.json").write_text(text)
    generate(tmp_path, "drive", FILES)
    assert (tmp_path / "c/drive.h").is_file()


def test_work_is_parted_by_weight_and_keeps_its_order() -> None:
    assert halved([3, 9, 1, 4, 2], float) == ([9, 1], [3, 4, 2])
    assert halved([], float) == ([], [])


def test_both_halves_are_done_and_their_failures_told() -> None:
    assert both(lambda: "here", lambda: "there") == ("here", "there")

    def fail() -> str:
        raise UnsafePathError("no")

    for here, there in ((fail, str), (str, fail)):
        with pytest.raises(UnsafePathError, match="no"):
            both(here, there)
