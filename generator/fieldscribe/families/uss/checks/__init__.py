"""The checks of the family: what only a USS device can get wrong, and how its worked frames are read."""

from fieldscribe.families.uss.checks import codes_agree, parameters_are_reachable
from fieldscribe.families.uss.checks.worked_frames import read

CHECKS = (codes_agree.check, parameters_are_reachable.check)

__all__ = ["CHECKS", "read"]
