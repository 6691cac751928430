"""The exported model: one JSON object per device for other tools; `schema.json` beside this file describes it.

Its shape changes only with its `format` number. JSON numbers are integers; every other exact number is text.
"""

import json
from typing import Any

from fieldscribe.facts import devices
from fieldscribe.facts.points import DATE_PART, DIGITS, ENTRY, FLAG, FLAG_VALUE, LAYOUT, POINT, SPECIAL
from fieldscribe.facts.schema import DEFINITIONS, record
from fieldscribe.facts.steps import STEP, STEPPED_COMMAND
from fieldscribe.facts.table import Context, FactTable, exported
from fieldscribe.families import FAMILIES, families, family
from fieldscribe.model import Device


class ExportError(ValueError):
    """The device cannot be exported in this form without changing its meaning."""


def export_model(device: Device) -> dict[str, Any]:
    """Return the device as plain dictionaries, lists, texts and integers, ready for `json.dumps`."""
    return exported(devices.device_table(device.family), device, Context(device))


def export_form(form: str, device: Device, unit: int | None) -> bytes:
    """Return the device in a form of export that only some families have. Raises ExportError."""
    own_family = family(device.family)
    if form not in own_family.exports:
        takers = " and ".join(family.name for family in families() if form in family.exports)
        raise ExportError(f"a {form.upper()} is for {takers} devices, {device.id} is a {device.family} device")
    data: bytes = own_family.part(form).export(device, unit)
    return data


def schema_text() -> str:
    """Return the JSON Schema of the exported model."""
    first = next(iter(FAMILIES))
    tables: dict[str, tuple[str, FactTable]] = {
        "document": ("A manual that facts were taken from.", devices.DOCUMENT),
        "limits": ("The limits of the bus.", devices.limits_table(first)),
        "group": ("Points that the manual presents together.", devices.GROUP),
        "point": ("One addressable datum. Records, sets and arrays are expanded.", POINT),
        "special": ("A special code, or a band of them.", SPECIAL),
        "entry": ("A number with a name.", ENTRY),
        "flag": ("A bit, or several, inside a word.", FLAG),
        "flag_value": ("One number of a flag with a name.", FLAG_VALUE),
        "digits": ("The decimal digits of a word.", DIGITS),
        "layout": ("How the characters of a text stand in words.", LAYOUT),
        "date_part": ("A part of a date or time, in some bits of a word.", DATE_PART),
        "identification": ("What a point holds in the device or in one of its variants.", devices.IDENTIFICATION),
        "given": ("A number that a client is given when it opens the device.", devices.GIVEN),
        "found": (
            "A chain of blocks after a marker. A block starts with its id and the number of words after these two.",
            devices.FOUND,
        ),
        "base": ("What addresses count from: a found block, or offset plus multiples of given numbers.", devices.BASE),
        "command": ("A named write of a constant.", devices.COMMAND),
        "stepped_command": ("A named list of requests.", STEPPED_COMMAND),
        "step": ("One request of a command.", STEP),
        "message": ("A layout of eight bytes with an identifier.", devices.MESSAGE),
        "telegram": ("A layout of words that is sent again and again.", devices.TELEGRAM),
        "frame": ("A worked frame of the manual.", devices.frame_table(first)),
        "code": ("A number of the protocol with a name.", devices.CODE),
        "codes": ("Numbers of the protocol.", devices.codes_table(first)),
        "erratum": ("A place where the manual is wrong, unclear or silent.", devices.ERRATUM),
    }
    schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"urn:fieldscribe:export:{devices.FORMAT}",
        "title": "The exported model of a device (fieldscribe export json)",
        "description": "One device with every record, set and array expanded. Tools rely on it: it changes only with "
        "`format`. JSON numbers are integers; every other exact number is text. Numbers are raw unless a key says "
        "otherwise.",
        **_object(devices.device_table(first)),
        "$defs": {
            **DEFINITIONS,
            **{name: {"description": doc, **_object(table)} for name, (doc, table) in tables.items()},
        },
    }
    return json.dumps(schema, indent=2) + "\n"


def _object(table: FactTable) -> dict[str, Any]:
    return dict(record(*((fact.key, fact.doc, fact.schema) for fact in table if fact.published)))
