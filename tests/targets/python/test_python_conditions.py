"""Points that only some devices have, in the Python of a device: groups are read without them."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.code_view import for_code
from fieldscribe.model import Device
from fieldscribe.pipeline import outputs
from fieldscribe.targets import TARGETS
from support.described import group, head, loaded_in, together
from support.python_package import Slave, error, imported, write_package

BUS = "{framings: [rtu], units: 1..32, functions: {03h: {name: read_registers, max: 16}, 06h: {name: write_register}}}"
MAIN = """\
- {name: actual, at: 9, access: r}
- {name: highest, at: 10, range: 0..400}
- {name: cascade, at: 11, range: 0 .. highest.raw, when: model == pro, special: {50: {name: off, en: "Off"}}}
- {name: output, at: 12, access: r}
- {name: newer, at: 14, access: r, since: firmware 2}
- {name: trend, at: 15, access: r, when: model == pro and highest == 1}
"""
OTHER = """\
- {name: last, at: 13, access: r}
- {name: final, at: 16, access: r}
"""


class Basic(Slave):
    """Refuses all of a request that touches the register that this model does not have."""

    def _answer(self, pdu: bytes) -> bytes:
        address, count = int.from_bytes(pdu[1:3], "big"), int.from_bytes(pdu[3:5], "big")
        self.refuses = (
            {address: 2} if pdu[0] == 3 and any(one in (11, 15) for one in range(address, address + count)) else {}
        )
        return super()._answer(pdu)


@pytest.fixture(scope="module")
def tempco(tmp_path_factory: pytest.TempPathFactory) -> Device:
    said = head(device="tempco", bus=BUS, variants="{model: {title: Model, values: {basic: {}, pro: {}}}}")
    return loaded_in(tmp_path_factory.mktemp("tempco"), together(said, group(MAIN), group(OTHER, group="other")))


@pytest.fixture(scope="module")
def package(tempco: Device, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    folder = tmp_path_factory.mktemp("package")
    yield from imported(write_package(for_code(tempco), folder), "tempco")


def test_a_group_is_read_without_what_the_variant_does_not_have(package: Any) -> None:
    slave = Slave()
    package.Tempco(slave, 1, model="pro").read_many("main")
    assert slave.log == [(3, 10, 1), (3, 9, 2), (3, 11, 1), (3, 12, 1), (3, 14, 1)]
    basic = Basic()
    device = package.Tempco(basic, 1, model="basic")
    assert device.read_many("main") == dict.fromkeys(["actual", "highest", "output", "newer"], 0)
    assert basic.log == [(3, 9, 2), (3, 12, 1), (3, 14, 1)]
    assert "exists only for model pro" in str(error(lambda: device.trend))
    basic.log.clear()
    assert device.read_many("other") == {"last": 0, "final": 0}
    assert basic.log == [(3, 13, 1), (3, 16, 1)]


def test_what_another_point_decides_is_asked_before_a_group_is_read(package: Any) -> None:
    """`trend` is in a device whose `highest` is 1; one that does not tell may have it."""
    slave = Slave()
    slave.words = {10: 1, 15: 7}
    device = package.Tempco(slave, 1, model="pro")
    assert device.read_many("main")["trend"] == 7
    slave.refuses = {10: 2}
    device = package.Tempco(slave, 1, model="pro")
    assert device.read_many("main", errors="return")["trend"] == 7
    slave.refuses, slave.words[10] = {15: 2}, 0
    device = package.Tempco(slave, 1, model="pro")
    assert "trend" not in device.read_many("main", errors="return")
    refused = "the device answered exception 02h (illegal_data_address)"
    expected = f"trend: {refused}; it exists only when model == pro and highest == 1"
    assert str(error(device.trend.read)) == expected
    assert str(device.read_many(["trend"], errors="return")["trend"]) == expected
    device.highest.write(1)
    slave.refuses = {}
    assert device.read_many("main", errors="return")["trend"] == 7


def test_reads_of_listed_points_cross_nothing_that_may_be_missing(package: Any) -> None:
    slave = Basic()
    for model in ("basic", None):
        slave.log.clear()
        package.Tempco(slave, 1, model=model).read_many(["highest", "output", "last", "final"])
        assert slave.log == [(3, 10, 1), (3, 12, 2), (3, 16, 1)], model
    newest = Slave()
    package.Tempco(newest, 1, model="pro").read_many(["last", "final"])
    assert newest.log == [(3, 13, 1), (3, 16, 1)]
    whole = Slave()
    package.Tempco(whole, 1, model="pro").read_many(["highest", "output"])
    assert whole.log == [(3, 10, 3)]


def test_every_language_says_when_a_point_exists(tempco: Device) -> None:
    texts = {path: text for _, path, text in outputs(tempco, ("c", "python", "rust", "docs"))}
    comments = " ".join(texts["c/tempco.h"].split())
    assert "exists only when model == pro;" in comments or "exists only when model == pro */" in comments
    assert "exists only when model == pro and highest == 1" in comments
    assert "Exists only when model == pro." in texts["python/tempco/points.py"]
    rust = texts["rust/tempco/src/points.rs"].replace("\n    ///", "")
    assert "exists only when `model == pro`." in rust
    assert "exists when model == pro" in texts["docs/tempco.md"]


def test_a_condition_may_name_two_axes(tmp_path: Path) -> None:
    """A condition on two axes was an error inside the Python target: the second axis was taken for a number."""
    axes = "{model: {values: {a: {}, b: {}}}, link: {values: {t: {}, u: {}}}}"
    points = "- {name: first, at: 1}\n- {name: both, at: 2, when: model == a and link == t}\n- {name: last, at: 3}\n"
    device = loaded_in(tmp_path, together(head(device="two_axes", bus=BUS, variants=axes), group(points)))
    assert {target for target, _, _ in outputs(device, TARGETS)} == set(TARGETS)
    for package in imported(write_package(for_code(device), tmp_path / "package"), "two_axes"):
        slave = Slave()
        assert package.TwoAxes(slave, 1, model="a", link_="t").both.read() == 0
        other = package.TwoAxes(slave, 1, model="b")
        assert "exists only for model a" in str(error(partial(getattr, other, "both")))
        package.TwoAxes(slave, 1, model="a").read_many("main")
        assert slave.log == [(3, 2, 1), (3, 1, 1), (3, 2, 1), (3, 3, 1)]


class Silent(Slave):
    """Nobody answers; `log` says what was sent all the same."""

    def exchange(self, request: bytes) -> bytes:
        super().exchange(request)
        raise TimeoutError("the port says nothing")


class AsyncSilent(Silent):
    """The same, asynchronously."""

    async def exchange(self, request: bytes) -> bytes:  # type: ignore[override]  # the async twin of the protocol
        return super().exchange(request)


def test_a_device_that_does_not_answer_is_a_no_reply_error(package: Any) -> None:
    """As in the other families: the transport's TimeoutError is its cause."""

    async def ask() -> Any:
        await package.TempcoAsync(AsyncSilent(), 7).actual.read()

    for call in (package.Tempco(Silent(), 7).actual.read, lambda: asyncio.run(ask())):
        raised = error(call)
        assert (type(raised).__name__, raised.status) == ("NoReplyError", "timeout")
        assert str(raised) == "actual: unit 7 did not reply to function 03h: the port says nothing"
        assert isinstance(raised.__cause__, TimeoutError)


def test_what_is_never_written_is_refused_before_any_traffic(package: Any) -> None:
    slave = Slave()
    cascade = package.Tempco(slave, 1).cascade
    raised = error(cascade.write, cascade.special.off)
    assert (raised.status, str(raised)) == ("special", "cascade: raw 50 is the special code off: it is only read")
    assert error(cascade.write_raw, 50).status == "special"
    for call in (cascade.write, cascade.write_raw):
        assert error(call, "off").status == "wrong_type"
    assert error(cascade.write, cascade.special.off.replaced(name="on")).status == "unknown_value"
    assert slave.log == []
