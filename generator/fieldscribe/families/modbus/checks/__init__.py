"""The checks of the family: what only a Modbus device can get wrong, and how its worked frames are read."""

from fieldscribe.families.modbus.checks import functions_agree
from fieldscribe.families.modbus.checks.worked_frames import read

CHECKS = (functions_agree.check,)

__all__ = ["CHECKS", "read"]
