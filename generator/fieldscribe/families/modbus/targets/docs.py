"""What the decoder of a page knows of Modbus beside the facts of the device."""

from __future__ import annotations

from fieldscribe.families.modbus import FUNCTIONS
from fieldscribe.families.modbus.remarks import EXCEPTIONS

PROTOCOL: dict[str, object] = {
    "functions": {number: [each.name, each.space, each.most] for number, each in FUNCTIONS.items()},
    "exceptions": dict(EXCEPTIONS),
}
"""The functions with name, space and the most items of a request, and the usual names of exceptions."""
