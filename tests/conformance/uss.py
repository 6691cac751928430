"""Telegrams of USS."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from support.vector_file import Vector

from conformance.package import Check, Package


def link_of(package: Package, vector: Vector) -> Any:
    """How the link of a vector is set."""
    return package.uss.Link(vector["pkw"], vector["pzd"], bool(vector["single_first"]))


def _request(package: Package, vector: Vector, **rest: Any) -> Any:
    return package.uss.Request(vector["unit"], vector["task"], vector["parameter"], vector["index"], **rest)


def uss_build(package: Package, vector: Vector) -> bool:
    """The bytes of a request."""
    rest = {"width": vector["width"], "value": vector["value"], "words": tuple(vector["words"])}
    arguments = _request(package, vector, **rest), package.device.PROFILE, link_of(package, vector)
    status, data = package.outcome(package.uss.build, *arguments)
    return status == vector["status"] and (status != "ok" or data == vector["bytes"])


def uss_broadcast(package: Package, vector: Vector) -> bool:
    """A telegram to all units."""
    arguments = tuple(vector["mask"]), tuple(vector["words"]), package.device.PROFILE, link_of(package, vector)
    status, data = package.outcome(package.uss.broadcast, *arguments)
    return status == vector["status"] and (status != "ok" or data == vector["bytes"])


def uss_reply(package: Package, vector: Vector) -> bool:
    """What a reply brings."""
    arguments = vector["bytes"], package.device.PROFILE, link_of(package, vector)
    status, found = package.outcome(package.uss.parse, _request(package, vector), *arguments)
    if status == "refused":
        return bool(vector["status"] == status and vector["response"] == 7 and found.code == vector["error"])
    good = (found.response, found.width, found.value, 0, list(found.words)) if status == "ok" else ()
    expected = tuple(vector[key] for key in ("response", "width", "value", "error", "words")) if good else ()
    return bool(status == vector["status"] and good == expected)


CHECKS: Mapping[str, Check] = {
    "uss_build": uss_build,
    "uss_broadcast": uss_broadcast,
    "uss_reply": uss_reply,
}
"""The checks of this theme by the kind of vector."""
