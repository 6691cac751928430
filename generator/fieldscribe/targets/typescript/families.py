"""What the TypeScript target asks of a bus family."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from fieldscribe.families import family
from fieldscribe.model import Device


class TypeScriptFamily(NamedTuple):
    """What generated modules import for a family.

    `device` is the class of devices, `makers` name the functions whose names differ from those of the calls, and
    `modules` says which module of the runtime has each name beyond the codecs. `options` are further options of a
    device's constructor: name and type.
    """

    device: str
    makers: Mapping[str, str]
    modules: Mapping[str, str]
    options: tuple[tuple[str, str], ...] = ()


_MAKERS = {"Case": "scaleCase", "Type": "wireType"}
"""Names that JavaScript reserves or that say too little there."""


def in_typescript(device: Device) -> TypeScriptFamily:
    """Return the part `targets.typescript` of the device's family."""
    part: TypeScriptFamily = family(device.family).part("targets.typescript").IN_TYPESCRIPT
    return part._replace(makers={**_MAKERS, **part.makers})
