"""Every point of the devices on Modbus against a server of pymodbus; a client of pymodbus looks at the words."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import contextmanager
from typing import Any

import pytest
from pymodbus import FramerType
from pymodbus.client import ModbusTcpClient
from support.modbus_server import server
from support.places import PACKAGES, ROOT
from support.python_package import imported
from support.python_transports import transport
from support.vector_file import Vector, vectors_of

DEVICES: dict[str, Callable[[Any, Any], list[Any]]] = {
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
    checks = (one for one in reversed(found) if one["kind"] == "check" and one["status"] == "ok" and one["raw"])
    allowed = {one["point"]: one for one in checks}
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
                        assert peer.words(place) == words.get((item, one["raw"]), [one["raw"] & 0xFFFF]), item
                    assert not hasattr(point, "read_raw") or point.read_raw() == one["raw"], item
                else:
                    raw, numbers = next(
                        ((raw, words[key]) for key in words if key[0] == item and (raw := key[1])), (1, [1])
                    )
                    peer.put(place, *numbers)
                    assert point.read_raw() == raw, item


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
