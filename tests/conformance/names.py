"""Names of numbers and special codes."""

from __future__ import annotations

import enum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from vector_file import Vector

    from conformance.package import Check, Package


def name(package: Package, vector: Vector) -> bool:
    """The name of a number, and its member: an integer that equals the number."""
    point, number = package.point(vector), vector["raw"]
    if not issubclass(point.names, enum.IntEnum) or point.name_of(number) != vector["name"]:
        return False
    if vector["name"] is None:
        return number not in list(point.names)
    member = point.names[vector["name"].upper()]
    decoded = point.decode(number) if hasattr(point, "decode") else member
    found = decoded[-1] if isinstance(decoded, tuple) else decoded
    return bool(member.name.lower() == vector["name"] and member == number and found in (member, number))


def special(package: Package, vector: Vector) -> bool:
    """A special code and its band."""
    codes = package.point(vector).special
    names = [str(codes(vector[end])) for end in ("low", "high")]
    return vector["special"] in list(codes) and names == [vector["special"]] * 2


def special_name(package: Package, vector: Vector) -> bool:
    """What special code a raw number is."""
    code = package.point(vector).special(vector["raw"])
    found = (None, None) if code is None else (str(code), int(code.no_value))
    return found == (vector["name"], vector["no_value"])


CHECKS: Mapping[str, Check] = {
    "name": name,
    "special": special,
    "special_name": special_name,
}
"""The checks of this theme by the kind of vector."""
