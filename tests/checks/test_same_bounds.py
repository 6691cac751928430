"""The command line and generated Python refuse the same run-time numbers: zero factors, exponents, limits, cases."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import Any

import pytest
from fieldscribe.arithmetic.codec import CodecError, check, decode, encode_checked, setting_of
from fieldscribe.model import Device, Point
from support.described import kitchen_sink, made, shipped
from support.models import named
from support.python_package import imported, write_package

_MAKERS: dict[str, Callable[[], Device]] = {
    "kitchen_sink": kitchen_sink,
    "kitchen_can": lambda: made("kitchen_can"),
    "woodward_mpu2s": lambda: shipped("woodward_mpu2s"),
}
_MOST = 400
"""So many settings of the other points are tried for each."""


@pytest.fixture(scope="module", params=_MAKERS)
def both(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Device, Any]]:
    """A device and its generated package."""
    device = _MAKERS[request.param]()
    for package in imported(write_package(device, tmp_path_factory.mktemp("bounds")), device.id):
        yield device, package


def test_statuses_are_the_same(both: tuple[Device, Any]) -> None:
    """Whatever the points hold that a rule or a limit needs."""
    device, package = both
    made = next(one for one in vars(package).values() if hasattr(one, "POINTS") and one.__name__ != "Points")
    tried = 0
    for point in device.points:
        if point.generated and point.arguments and point.item in made.POINTS:
            attribute = made.POINTS[point.item]
            for raws in _settings(device, point):
                settings = {name: setting_of(_source(device, name), raw) for name, raw in raws.items()}
                for raw in {point.least, 0, 1, point.outer[0], point.outer[1], point.greatest}:
                    tried += 1
                    where = (point.item, raw, raws)
                    if point.readable:
                        assert _status(decode, point, raw, settings) == _named(attribute.decode, raw, raws), where
                    if point.writable:
                        assert _status(check, point, raw, settings) == _named(attribute.check, raw, raws), where
                if point.writable and point.form == "scaled" and point.encodes_values:
                    assert _status(encode_checked, point, 1, settings) == _named(attribute.encode, 1.0, raws), raws
    assert tried > 50


def test_an_exponent_counts_only_in_its_own_range() -> None:
    """PGNEXPO is 0..5: ten to the ninth is no factor, though 10^9 could be computed."""
    device = shipped("woodward_mpu2s")
    power = next(one for one in device.points if one.scale_arguments == ("generator_power_exponent",))
    assert decode(power, 100, {"generator_power_exponent": 5}) == 10_000_000
    for exponent in (-1, 6, 9):
        with pytest.raises(CodecError) as caught:
            decode(power, 100, {"generator_power_exponent": exponent})
        assert caught.value.status == "overflow"


def _settings(device: Device, point: Point) -> Iterator[dict[str, int]]:
    choices = [_choices(_source(device, name), point, name) for name in point.arguments]
    for _, numbers in zip(range(_MOST), product(*choices), strict=False):
        yield dict(zip(point.arguments, numbers, strict=True))


def _choices(source: Point, point: Point, name: str) -> list[int]:
    """Raw numbers of a point that others need: its ends, what is just beyond them, zeros and cases."""
    if source.info.floating:
        return [0, 0x42480000, 0xC2480000, 0x7FC00000, 0x7F800000]
    low, high = source.outer
    cases = [case.raw for case in point.scale or () if case.point == name and case.raw is not None]
    found = [*cases, low, high, 0, 1, low - 1, high + 1, source.least, source.greatest]
    return [raw for raw in dict.fromkeys(found) if source.least <= raw <= source.greatest]


def _source(device: Device, name: str) -> Point:
    return next((one for one in device.points if name in (one.name, one.item)), None) or named(device, name)


def _status(function: Callable[..., object], *arguments: object) -> str:
    try:
        function(*arguments)
    except CodecError as error:
        return error.status
    return "ok"


def _named(function: Callable[..., object], *arguments: object) -> str:
    try:
        value = function(*arguments)
    except Exception as error:
        return str(getattr(error, "status", error))
    return "special" if type(value).__name__ == "Special" else "ok"
