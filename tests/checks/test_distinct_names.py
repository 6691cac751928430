"""The proof that identifiers differ: points of one kind have the same identifiers but for their names."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from pathlib import Path

import pytest
from fieldscribe.checks.names_do_not_clash import PointKinds
from fieldscribe.lowered import lower
from fieldscribe.model import Device
from fieldscribe.targets import knows, target
from support.described import SHIPPED, compile_in, group, head, made, shipped, together

LANGUAGES = ("c", "python", "rust", "typescript")
MADE = ("kitchen_can", "kitchen_codes", "kitchen_sink", "kitchen_uss")


def keys_of(device: Device) -> Mapping[int, Hashable]:
    return lower(device).template_keys


def too_coarse(device: Device) -> Mapping[int, Hashable]:
    """All points of a type are taken for one kind, as a counterexample."""
    return {id(point): point.shape.type for point in device.points}


def strangers(device: Device, keys: Mapping[int, Hashable], language: str) -> Iterator[str]:
    """Yield the identifiers of points that the first point of their kind lacks, with its own name put in."""
    identifiers, kinds = target(language).identifiers, PointKinds(device, keys)
    sample = {(space, name) for space, _, names, _ in identifiers(kinds.sample) for name in map(plain, names)}
    known = kinds.names
    first: dict[object, str] = {}
    stands_for = {point.item: first.setdefault(keys[id(point)], point.item) for point in device.points}
    for space, owner, names, _ in identifiers(device):
        whole = owner
        while whole.of is not None:
            whole = whole.of
        item = whole.name
        if plain(item) not in known or whole.kind not in ("point", "enum"):
            continue
        other = stands_for[item]
        for name in map(plain, names):
            if (space.replace(f"`{item}`", f"`{other}`"), name.replace(plain(item), plain(other), 1)) not in sample:
                yield name


def plain(name: str) -> str:
    return name.replace("_", "").lower()


def devices() -> list[Device]:
    return [*map(shipped, SHIPPED), *map(made, MADE)]


@pytest.mark.parametrize("language", LANGUAGES)
def test_points_of_a_kind_have_the_same_names(language: str) -> None:
    for device in devices():
        if knows(language, device):
            assert list(strangers(device, keys_of(device), language)) == []


def test_a_kind_that_is_too_coarse_is_noticed() -> None:
    assert any(list(strangers(device, too_coarse(device), "c")) for device in devices())


def test_large_devices_are_proven() -> None:
    """But for the names in C that are longer than all compilers compare."""
    for name, proven in (("hitachi_l200", [1, 1, 1, 1]), ("woodward_mpu2s", [0, 1, 1, 1])):
        kinds = PointKinds(shipped(name), keys_of(shipped(name)))
        assert [
            kinds.are_distinct(target(language).identifiers, target(language).BEFORE_POINTS) for language in LANGUAGES
        ] == proven


@pytest.mark.parametrize(("second", "clash"), [("x_y", True), ("x_w", False), ("xy", False)])
def test_a_name_and_its_ending_may_be_another_name_and_its_ending(second: str, clash: bool, tmp_path: Path) -> None:
    """`x` with `y_z` is what `x_y` is with `z`; the other points make the kinds large, so that the proof is tried."""
    first = [*(f"first_{number}" for number in range(9)), "x"]
    others = [*(f"second_{number}" for number in range(9)), second]
    rows = "".join(f"- {{name: {name}, at: {at}, enum: {{0: y_z, 1: q}}}}\n" for at, name in enumerate(first))
    rows += "".join(f"- {{name: {name}, at: {at}, enum: {{0: z, 1: p}}}}\n" for at, name in enumerate(others, 50))
    _, findings = compile_in(tmp_path, together(head(device="pair"), group(rows)))
    assert [finding.rule for finding in findings] == ["name-clash"] * clash


@pytest.mark.parametrize(("last", "clash"), [("read_x", True), ("x_read", False)])
def test_a_name_may_begin_with_a_word_before_names(last: str, clash: bool, tmp_path: Path) -> None:
    """The call that reads `x_frame` is what `read_x` is with `frame`."""
    names = [*(f"point_{number}" for number in range(9)), "x_frame", last]
    rows = "".join(f"- {{name: {name}, at: {at}}}\n" for at, name in enumerate(names))
    _, findings = compile_in(tmp_path, together(head(device="pair"), group(rows)))
    assert [finding.rule for finding in findings] == ["name-clash"] * clash
