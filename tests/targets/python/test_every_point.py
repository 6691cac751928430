"""Every point of the devices on Modbus and CAN: pymodbus, or python-can, looks at the words at the other end."""

from __future__ import annotations

import random
import struct
from collections.abc import Callable
from contextlib import contextmanager
from typing import Any

import can
import pytest
from pymodbus import FramerType
from pymodbus.client import ModbusTcpClient
from support.modbus_server import server
from support.places import PACKAGES, ROOT
from support.python_package import imported
from support.python_transports import parameters_on, transport
from support.vector_file import Vector, vectors_of

DEVICES: dict[str, Callable[[Any, Any], list[Any]]] = {
    "eastron_sdm630": lambda package, line: [package.EastronSdm630(line, 1)],
    "hitachi_l200": lambda package, line: [package.HitachiL200(line, 1, voltage_class=one) for one in ("200V", "400V")],
    "jumo_controller": lambda package, line: [package.JumoController(line, 1)],
    "nord_sk5xxe": lambda package, line: [package.NordSk5xxe(line, 1)],
}


@pytest.mark.full(seconds=3)
@pytest.mark.parametrize("name", DEVICES)
def test_every_point_is_read_and_written_where_it_stands(name: str) -> None:
    """With a raw number that its limits allow, and the numbers of other points that they need."""
    found = vectors_of((ROOT / "generated/vectors" / f"{name}.txt").read_text("utf-8"))
    places = {one["point"]: one for one in found if one["kind"] == "address"}
    words = {(one["point"], one["raw"]): one["words"] for one in found if one["kind"] == "words"}
    allowed = _allowed(name)
    with contextmanager(imported)(PACKAGES, name) as package, server(FramerType.RTU, addresses=0x10000) as port:
        peer = Peer(port)
        with transport("tcp").TcpLine("127.0.0.1", port, framing="rtu") as line:
            devices = DEVICES[name](package, line)
            for item, place in places.items():
                [point] = [device.point(item) for device in devices if device._has(device.POINTS[item])][:1]
                if hasattr(point, "write_raw"):
                    one = allowed[item]
                    for other, raw in one.get("with", {}).items():
                        peer.put(places[other], int(raw))
                    point.write_raw(one["raw"])
                    if point.facts.bits is None:
                        assert peer.words(place) == words.get((item, one["raw"]), _high_first(place, one["raw"])), item
                    assert not hasattr(point, "read_raw") or point.read_raw() == one["raw"], item
                elif place["space"] == "input":
                    assert point.read_raw() == int("0007" * place["words"], 16), item  # what the server has everywhere
                else:
                    raw, numbers = next(
                        ((raw, words[key]) for key in words if key[0] == item and (raw := key[1])), (1, [1])
                    )
                    peer.put(place, *numbers)
                    assert point.read_raw() == raw, item


def _high_first(place: Vector, raw: int) -> list[int]:
    """Return the words of a raw number that has no vector of its words."""
    return [raw >> 16 * word & 0xFFFF for word in reversed(range(place["words"]))]


def _allowed(name: str) -> dict[str, Vector]:
    """A raw number for each point that can be written, if possible not 0, with the numbers that its limits need."""
    found = vectors_of((ROOT / "generated/vectors" / f"{name}.txt").read_text("utf-8"))
    fine = [one for one in reversed(found) if one["kind"] == "check" and one["status"] == "ok"]
    return {one["point"]: one for one in sorted(fine, key=lambda one: one["raw"] != 0)}


@pytest.mark.full(seconds=2)
def test_models_are_found_and_read_where_they_stand() -> None:
    """An inverter has the models in the order and with the lengths of the map of its maker."""
    models = {1: 65, 103: 50, 120: 26, 121: 30, 122: 44, 123: 24, 160: 48, 124: 24, 0xFFFF: 0}
    name, start = "fronius_datamanager", 40002
    with contextmanager(imported)(PACKAGES, name) as package, server(FramerType.RTU, addresses=0x10000) as port:
        peer = Peer(port)

        def put(address: int, *words: int) -> None:
            peer.put({"space": "holding", "address": address}, *words)

        put(40000, 0x5375, 0x6E53)
        for model, length in models.items():
            put(start, model, length)
            start += 2 + length
        put(40004, *(int.from_bytes(b"Fronius".ljust(32, b"\0")[at : at + 2], "big") for at in range(0, 32, 2)))
        put(40079, 2301, 2302, 2303, 0xFFFF)
        put(40232, 5000)
        put(40250, 0xFFFE)
        put(40255, 0xFFFF)
        put(40292, 431)
        with transport("tcp").TcpLine("127.0.0.1", port, framing="rtu") as line:
            inverter = package.FroniusDatamanager(line, 1)
            assert inverter.identify() == {}
            assert inverter.manufacturer.read() == "Fronius"
            assert [float(inverter.phase_b_voltage.read()), float(inverter.power_limit.read())] == [230.2, 50.0]
            assert float(inverter.module_current_index_2.read()) == 43.1
            inverter.power_limit.write(70)
            assert peer.words({"space": "holding", "address": 40232, "words": 1}) == [7000]
            inverter.use_integers.send()
            assert peer.words({"space": "holding", "address": 215, "words": 1}) == [6]


@pytest.mark.full(seconds=5)
def test_every_point_on_a_can_bus() -> None:
    """Telegrams as python-can sends them, and parameters of a unit that lives on python-can."""
    allowed, words = _allowed("woodward_mpu2s"), [random.Random(1).randrange(0x10000) for _ in range(69)]
    with (
        contextmanager(imported)(PACKAGES, "woodward_mpu2s") as package,
        parameters_on("every", chatters=False) as held,
        transport("can").CanLine(can.Bus("every", interface="virtual")) as line,
        can.Bus("every", interface="virtual") as other,
    ):
        device = package.WoodwardMpu2s(line, 1)
        device.fresh_for = 60.0
        for slot in (*range(23), *range(23)):
            data = bytes((0xDD, slot)) + struct.pack(">3H", *words[3 * slot : 3 * slot + 3])
            other.send(can.Message(arbitration_id=0x321, data=data, is_extended_id=False))
        for item in device.POINTS:
            point = device.point(item)
            at = point.facts.at.addresses
            if point.facts.at.telegram:
                number = int.from_bytes(struct.pack(f">{len(at)}H", *[words[one] for one in at]), "big")
                high, low = point.facts.bits or (16 * len(at) - 1, 0)
                number = number >> low & (1 << high - low + 1) - 1
                assert point.read_raw() & (1 << high - low + 1) - 1 == number, item
            elif item in allowed and hasattr(point, "write_raw"):
                for other_item, raw in allowed[item].get("with", {}).items():
                    held[1, device.point(other_item).facts.at.address] = int(raw) & 0xFFFF
                raw = allowed[item]["raw"]
                point.write_raw(raw)
                if len(at) == 1 and point.facts.bits is None:
                    assert held[1, at[0]] == raw & 0xFFFF, item
                assert not hasattr(point, "read_raw") or point.read_raw() == raw, item
            else:
                held.update({(1, one): 1 for one in at})
                assert point.read_raw() is not None


class Peer:
    """A client of pymodbus at the same server."""

    def __init__(self, port: int) -> None:
        self._client = ModbusTcpClient("127.0.0.1", port=port, framer=FramerType.RTU)
        assert self._client.connect()  # type: ignore[no-untyped-call]  # pymodbus says no types here

    def put(self, place: Vector, *words: int) -> None:
        """Write words or a bit."""
        if place["space"] == "coil":
            assert not self._client.write_coil(place["address"], bool(words[0]), device_id=1).isError()
        else:
            assert not self._client.write_registers(place["address"], list(words), device_id=1).isError()

    def words(self, place: Vector) -> list[int]:
        """Return the words of a point, or its bit."""
        if place["space"] == "coil":
            return [int(self._client.read_coils(place["address"], count=1, device_id=1).bits[0])]
        count = place["words"]
        return list(self._client.read_holding_registers(place["address"], count=count, device_id=1).registers)
