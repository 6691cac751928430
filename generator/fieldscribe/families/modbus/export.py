"""What the family adds to exports: its facts in the limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.modbus.facts import ModbusBus, of_bus

if TYPE_CHECKING:
    from fieldscribe.model import Bus

LIMIT_CLASSES = {"pad_coil_bytes": "wire"}
"""How grave a difference in a fact of `limits` is: a class of `differences`."""


def limits(bus: Bus | None) -> dict[str, object]:
    """What the family alone knows of a bus; of a bus of another family what stands for nothing."""
    return {"pad_coil_bytes": (ModbusBus() if bus is None else of_bus(bus)).pad_coil_bytes}
