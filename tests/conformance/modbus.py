"""Frames of Modbus."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from support.vector_file import Vector

from conformance.exchanges import name_of_command
from conformance.package import Check, Package, attribute_of, attributes
from conformance.scripts import AsyncScript, Script, now


def _request(package: Package, vector: Vector) -> Any:
    head = vector["unit"], vector["function"], vector["address"]
    return package.modbus.Request(*head, vector["count"], tuple(vector["values"]))


def _frames(vector: Vector) -> Iterator[tuple[bytes, str]]:
    """The frame of a vector with its framing, and the PDU in it unless the checksum or the framing is wrong."""
    yield vector["bytes"], vector["framing"]
    if vector["framing"] == "rtu" and vector["status"] not in ("bad_crc", "bad_framing"):
        yield vector["bytes"][:-2], "pdu"


def build(package: Package, vector: Vector) -> bool:
    """The bytes of a request."""
    request, profile, transaction = _request(package, vector), package.device.PROFILE, vector["transaction"]
    for frame, framing in _frames(vector):
        status, found = package.outcome(package.modbus.build, request, profile, framing, transaction)
        if status != vector["status"] or (status == "ok" and found != frame):
            return False
    return True


def reply(package: Package, vector: Vector) -> bool:
    """What a reply brings."""
    request, profile, transaction = _request(package, vector), package.device.PROFILE, vector["transaction"]
    for frame, framing in _frames(vector):
        status, result = package.outcome(package.modbus.parse, request, frame, profile, framing, transaction)
        if status != vector["status"]:
            return False
        if status in ("ok", "exception"):
            found = (result.code,) if status == "exception" else result
            expected = (vector["exception"],) if status == "exception" else tuple(vector["values_out"])
            if found != expected:
                return False
    return True


def step(package: Package, vector: Vector) -> bool:
    """The words of a step of a command, in place of what the device held, and where they are read and written."""
    name = name_of_command(package, vector["command"], package.runtime.SteppedCommand)
    command = attributes(package.device)[name]
    one = command.requests[vector["index"]]
    numbers = {name: int(number) for name, number in (vector["with"] or {}).items()}
    words, at = one.merged(numbers, tuple(vector["held"])), one.at
    facts = at.address, at.span, at.function, at.base, bool(one.when), one.reads
    where = vector["address"], len(words), vector["write"], vector["base"]
    expected = *where, bool(vector["conditional"]), vector["read"] is not None
    within = None if one.within is None else round(one.within * 1000)
    known = numbers.keys() == command.arguments.keys()
    ends = all(numbers[name] in ends for name, ends in command.arguments.items())
    return known and ends and (list(words), facts, within) == (vector["words"], expected, vector["within"])


def base(package: Package, vector: Vector) -> bool:
    """Where a device that is given numbers, or finds blocks, reads the point."""
    given = {name: int(number) for name, number in (vector.get("given") or {}).items()}
    steps = {**vector, "script": vector["script"] or (), "needs": {}}
    for kind, script in ((package.device, Script), (package.awaited, AsyncScript)):
        transport = script(steps, package.can.Frame)
        devices: list[Any] = []

        def read(kind: Any = kind, transport: Script = transport, devices: list[Any] = devices) -> Any:
            devices.append(kind(transport, vector["unit"], **given))
            return now(getattr(devices[0], attribute_of(kind, vector["point"])).read_raw())

        status, _ = package.outcome(read)
        if status != vector["status"] or not transport.done:
            return False
        found = vector["kind"] == "base" and not given and status == "ok"
        if found and (vector["start"], vector["last"]) not in now(devices[0].find_blocks()).values():
            return False
    return True


CHECKS: Mapping[str, Check] = {
    "build": build,
    "reply": reply,
    "step": step,
    "base": base,
    "base_behind": base,
}
"""The checks of this theme by the kind of vector."""
