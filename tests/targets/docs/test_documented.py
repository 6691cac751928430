"""Points that are documented only: why, in which words, and how their words are reached raw."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from typing import Any

import pytest
from fieldscribe.export import export_model
from fieldscribe.model import Device
from fieldscribe.pipeline import outputs
from fieldscribe.targets import TARGETS
from support.described import described, loaded_in
from support.python_package import imported, write_package

BUS = "{framings: [rtu], units: 1..247, functions: {03h: {name: read, max: 125}, 06h: write_one, 10h: write_many}}"
POINTS = """\
- {name: energy, at: 10, untyped: "48-bit counter, the high word first", length: 3}
- {name: open_size, at: 20, type: ~, unit: W}
- {name: open_scale, at: 21, scale: ~, type: u32}
- {name: nowhere, at: ~}
- {name: speed, at: 30, range: 0..10}
"""


@pytest.fixture(scope="module")
def device(tmp_path_factory: pytest.TempPathFactory) -> Device:
    """A device whose manual leaves some things open."""
    return loaded_in(tmp_path_factory.mktemp("documented"), described(POINTS, bus=BUS))


@pytest.fixture(scope="module")
def texts(device: Device) -> dict[str, str]:
    """Everything generated for it."""
    return {path: text for _, path, text in outputs(device, TARGETS)}


@pytest.fixture(scope="module")
def package(device: Device, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """Its Python package."""
    yield from imported(write_package(device, tmp_path_factory.mktemp("made_up")), "made_up")


def test_nothing_is_made_up(device: Device, texts: dict[str, str]) -> None:
    """Neither a type nor a range stands where nobody says them; two reasons are told apart."""
    rows = {row["name"]: row for row in csv.DictReader(io.StringIO(texts["docs/made_up.csv"]))}
    assert (rows["energy"]["words"], rows["energy"]["word_order"], rows["open_size"]["words"]) == ("3", "", "1")
    assert rows["energy"]["remarks"] == "type: 48-bit counter, the high word first"
    for name in ("energy", "open_size"):
        assert not any(rows[name][key] for key in ("type", "factor", "offset", "raw_min", "raw_max", "min", "max"))
    assert (rows["open_scale"]["type"], rows["open_scale"]["factor"], rows["open_scale"]["max"]) == ("u32", "", "")
    reasons = {one.name: one.reason for one in device.points}
    assert reasons["energy"] == "no type says its encoding"
    assert reasons["open_size"] == "the manual does not settle its type"
    exported: Any = export_model(device)
    types = {one["name"]: (one["type"], one["words"]) for one in exported["points"]}
    assert (types["energy"], types["open_size"], types["open_scale"]) == ((None, 3), (None, 1), ("u32", 2))


def test_the_words_are_reached_raw(texts: dict[str, str]) -> None:
    """Addresses are constants in C and Rust; what has none is only told of."""
    header, points = texts["c/made_up.h"], texts["rust/made_up/src/points.rs"]
    for name, address, words in (("ENERGY", "0x000A", 3), ("OPEN_SIZE", "0x0014", 1), ("OPEN_SCALE", "0x0015", 2)):
        assert f"#define MADE_UP_{name}_ADDRESS {address}U\n" in header
        assert f"#define MADE_UP_{name}_WORDS {words}U\n" in header
        _, _, rest = points.partition(f"pub const {name}: ")
        assert f"Documented::new(runtime::Space::Holding, {address}, {words}, None)" in rest.partition(";")[0]
    assert "NOWHERE_ADDRESS" not in header
    assert "NOWHERE" not in points


@pytest.mark.parametrize(
    ("name", "message"),
    [
        (
            "energy",
            "energy is documented only: no type says its encoding; `read_at` and `write_at` reach its words at {}",
        ),
        ("nowhere", "nowhere is documented only: the manual prints no address"),
        ("speeed", "'MadeUp' object has no attribute 'speeed'; did you mean speed?"),
    ],
)
def test_python_says_why(package: Any, name: str, message: str) -> None:
    """A point that is no attribute answers with its reason, and a misspelt name with those that are near."""

    class Nowhere:
        framing = "rtu"

        def exchange(self, request: bytes) -> bytes:
            raise AssertionError(request)

    drive = package.MadeUp(Nowhere(), 1)
    with pytest.raises(AttributeError) as caught:
        getattr(drive, name)
    assert str(caught.value) == message.format("holding 10, 11, 12")
    assert not hasattr(drive, name)
    assert drive.DOCUMENTED["energy"].at.addresses == (10, 11, 12)
