"""What differs between bus families in generated Python: one room for each, and this is the list of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.python.families.can import CAN
from fieldscribe.targets.python.families.modbus import MODBUS
from fieldscribe.targets.python.families.uss import USS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.targets.python.families.family import Family

FAMILIES: Mapping[str, Family] = {"modbus": MODBUS, "can": CAN, "uss": USS}
