"""The generated package of a device, as users import it, and what calls into it give."""

from __future__ import annotations

import importlib
import math
import struct
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from support.vector_file import Vector


class Package:
    """The package of one device, with the runtime beside it."""

    def __init__(self, folder: Path, device: str) -> None:
        sys.path.insert(0, str(folder))
        self.widest: dict[tuple[str, str], tuple[int, Any]] = {}
        self.module = importlib.import_module(device)
        self.points = importlib.import_module(f"{device}.points")
        self.runtime = importlib.import_module("fieldscribe_runtime")
        self.modbus, self.can, self.uss = (
            importlib.import_module(f"fieldscribe_runtime.{family}") for family in ("modbus", "can", "uss")
        )
        self.device = self._class(self.runtime.AnyDevice)
        self.awaited = self._class(self.runtime.AnyAsyncDevice)
        self.family = next(one for one in ("modbus", "can", "uss") if self._is_of(getattr(self, one)))

    def _class(self, base: type) -> Any:
        kinds = (one for one in vars(self.module).values() if isinstance(one, type))
        return next(one for one in kinds if issubclass(one, base))

    def _is_of(self, family: Any) -> bool:
        session = next(one for name, one in vars(family).items() if name.endswith("Session"))
        return issubclass(self.device, session)

    def point(self, vector: Vector) -> Any:
        """The point of a vector, as a pure codec."""
        return self.device.POINTS[vector["point"]]

    def outcome(self, function: Callable[..., Any], *arguments: Any) -> tuple[str, Any]:
        """The status and result of a call, or the error; a special code as a value is the status `special`."""
        try:
            result = function(*arguments)
        except self.runtime.FieldscribeError as error:
            return getattr(error, "status", ""), error
        return ("special" if isinstance(result, self.runtime.Special) else "ok"), result


def raws_of(vector: Vector) -> dict[str, int]:
    """The raw numbers of other points that a vector needs."""
    return {name: int(raw) for name, raw in vector.get("with", {}).items()}


def raw_of(point: Any, vector: Vector) -> Any:
    """The raw number of a vector, also of one that gives its words."""
    return point.from_words(vector["words"]) if vector["words"] else vector["raw"]


def pattern(value: float) -> str:
    """The bits of a number; all that are no number count as one."""
    return struct.pack(">d", value).hex() if not math.isnan(value) else "nan"


def same(one: Any, other: Any) -> bool:
    """Whether two values are the same, also where both are no number."""
    return bool(one == other or (isinstance(one, float) and math.isnan(one) and math.isnan(other)))


def attributes(kind: type) -> dict[str, Any]:
    """What a class has, with what it is made of, as it stands there."""
    return {name: one for base in reversed(kind.__mro__) for name, one in vars(base).items()}


def attribute_of(kind: type, name: str) -> str:
    """What a point is called as an attribute: a name that is a keyword or a method has an underscore behind it."""
    return f"{name}_" if f"{name}_" in attributes(kind) else name


Check = Callable[[Package, Vector], bool]
"""Whether the generated code does what a vector says."""
