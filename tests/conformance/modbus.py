"""Frames of Modbus."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from support.vector_file import Vector

from conformance.package import Check, Package


def _request(package: Package, vector: Vector) -> Any:
    head = vector["unit"], vector["function"], vector["address"]
    return package.modbus.Request(*head, vector["count"], tuple(vector["values"]))


def build(package: Package, vector: Vector) -> bool:
    """The bytes of a request."""
    arguments = package.device.PROFILE, vector["framing"], vector["transaction"]
    status, frame = package.outcome(package.modbus.build, _request(package, vector), *arguments)
    return status == vector["status"] and (status != "ok" or frame == vector["bytes"])


def reply(package: Package, vector: Vector) -> bool:
    """What a reply brings."""
    arguments = package.device.PROFILE, vector["framing"], vector["transaction"]
    status, result = package.outcome(package.modbus.parse, _request(package, vector), vector["bytes"], *arguments)
    if status != vector["status"]:
        return False
    if status == "exception":
        return bool(result.code == vector["exception"])
    return status != "ok" or result == tuple(vector["values_out"])


CHECKS: Mapping[str, Check] = {"build": build, "reply": reply, "printed_build": build, "printed_reply": reply}
"""The checks of this theme by the kind of vector."""
