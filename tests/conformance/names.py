"""Names of numbers and special codes."""

from __future__ import annotations

import enum
from collections.abc import Mapping

from support.vector_file import Vector

from conformance.package import Check, Package


def name(package: Package, vector: Vector) -> bool:
    """The name of a number, and its member: an integer of the enum that equals the number, named or not."""
    point, number = package.point(vector), vector["raw"]
    named = vector["name"] is not None
    if not issubclass(point.names, enum.IntEnum) or point.name_of(number) != vector["name"]:
        return False
    member = point.names[vector["name"].upper()] if named else point.names(number)
    if (member.is_named, str(member)) != (named, vector["name"] if named else str(number)):
        return False
    decoded = point.decode(number) if hasattr(point, "decode") else member
    found = decoded[-1] if isinstance(decoded, tuple) else decoded
    same = isinstance(found, package.runtime.Special) or (type(found) is point.names and found == number)
    return bool(member == number and hash(member) == hash(number) and same and (number in list(point.names)) == named)


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


CHECKS: Mapping[str, Check] = {"name": name, "special": special, "special_name": special_name}
"""The checks of this theme by the kind of vector."""
