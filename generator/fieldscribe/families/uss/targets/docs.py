"""What the decoder of a page knows of USS beside the facts of the device."""

from __future__ import annotations

from fieldscribe.families.uss.parts import EEPROM_TASKS, RESPONSE_WIDTHS, TASK_WIDTHS

PROTOCOL: dict[str, object] = {
    "tasks": dict(sorted(TASK_WIDTHS.items())),
    "eeprom": sorted(EEPROM_TASKS),
    "responses": RESPONSE_WIDTHS,
}
"""The words of value that tasks and responses carry, and the tasks that write to the EEPROM, too."""
