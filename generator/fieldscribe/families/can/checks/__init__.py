"""The checks of the family: what only a CAN device can get wrong, and how its worked frames are read."""

from fieldscribe.families.can.checks import messages_are_told_apart, parameters_are_reachable
from fieldscribe.families.can.checks.worked_frames import read

CHECKS = (messages_are_told_apart.check, parameters_are_reachable.check)

__all__ = ["CHECKS", "read"]
