"""What differs between two models of a device: each difference classified, and the step that the version must take.

Models are compared as they are exported, so one side may be a description and the other a file of another version.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.differences.classes import is_taken, next_version, step_for
from fieldscribe.differences.comparison import Difference, differences
from fieldscribe.model import Device

if TYPE_CHECKING:
    from fieldscribe.differences.table import Exported

__all__ = ["Difference", "differences", "is_taken", "next_version", "step_between"]


def step_between(old: Device | Exported, new: Device | Exported) -> str | None:
    """The step that the version must take: `major`, `minor` or `patch`; None where nothing differs.

    A model is a device, or what `export_model` made of one and JSON kept.
    """
    return step_for(difference.weight for difference in differences(_exported(old), _exported(new)))


def _exported(model: Device | Exported) -> Exported:
    if not isinstance(model, Device):
        return model
    from fieldscribe.export import export_model

    return export_model(model)
