"""Points that only some devices have, in the Python of a device: groups are read without them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from fieldscribe.diagnostics import Report
from fieldscribe.pipeline import load_device
from python_package import Slave, error, imported, write_package

if TYPE_CHECKING:
    from collections.abc import Iterator

TEMPCO = """\
fieldscribe: 1
device: tempco
version: 1.0.0
vendor: Maker
model: T1
title: Temperature controller
family: modbus
documents: {manual: {title: Manual, language: en}}
variants: {model: {title: Model, values: {basic: {}, pro: {}}}}
bus: {framings: [rtu], units: 1..32, functions: {03h: {name: read_registers, max: 16}, 06h: {name: write_register}}}
groups:
- group: main
  space: holding
  source: {document: manual, section: "1"}
  points:
  - {name: actual, at: 9, access: r}
  - {name: highest, at: 10, range: 0..400}
  - {name: cascade, at: 11, range: 0 .. highest.raw, when: model == pro, special: {50: {name: off, en: "Off"}}}
  - {name: output, at: 12, access: r}
  - {name: newer, at: 14, access: r, since: firmware 2}
  - {name: trend, at: 15, access: r, when: model == pro and highest == 1}
- group: other
  space: holding
  source: {document: manual, section: "2"}
  points:
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
def package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    folder = tmp_path_factory.mktemp("tempco")
    (folder / "device.yaml").write_text(TEMPCO, "utf-8")
    report = Report()
    device = load_device(folder / "device.yaml", report)
    assert device is not None, report.findings
    yield from imported(write_package(device, folder), "tempco")


def test_a_group_is_read_without_what_the_variant_does_not_have(package: Any) -> None:
    slave = Slave()
    package.Tempco(slave, 1, model="pro").read_many("main")
    assert slave.log == [(3, 9, 2), (3, 11, 1), (3, 12, 1), (3, 14, 1), (3, 15, 1)]
    basic = Basic()
    device = package.Tempco(basic, 1, model="basic")
    assert device.read_many("main") == dict.fromkeys(["actual", "highest", "output", "newer"], 0)
    assert basic.log == [(3, 9, 2), (3, 12, 1), (3, 14, 1)]
    assert "exists only for model pro" in str(error(lambda: device.trend))
    basic.log.clear()
    assert device.read_many("other") == {"last": 0, "final": 0}
    assert basic.log == [(3, 13, 1), (3, 16, 1)]


def test_reads_of_listed_points_cross_nothing_that_may_be_missing(package: Any) -> None:
    slave = Basic()
    for model in ("basic", None):
        slave.log.clear()
        package.Tempco(slave, 1, model=model).read_many(["highest", "output", "last", "final"])
        assert slave.log == [(3, 10, 1), (3, 12, 2), (3, 16, 1)], model
    whole = Slave()
    package.Tempco(whole, 1, model="pro").read_many(["highest", "output"])
    assert whole.log == [(3, 10, 3)]
