"""The neutral model of a device: frozen, typed, with all records and sets expanded. It knows no target and no YAML."""

from fieldscribe.model.device import (
    Block,
    Bus,
    Code,
    Command,
    Device,
    Document,
    Erratum,
    Frame,
    Group,
    Message,
    Own,
    Role,
    Telegram,
)
from fieldscribe.model.interning import Interner
from fieldscribe.model.numbers import TYPES, Digits, Entry, Enum, Fixed, Flag, Special, Text, Titles, TypeInfo
from fieldscribe.model.point import NOWHERE, Place, Point, Source, Unit
from fieldscribe.model.rules import Allowed, Bound, Factor, Interval, Limit, Linear, ScaleCase
from fieldscribe.model.shape import Shape

__all__ = [
    "NOWHERE",
    "TYPES",
    "Allowed",
    "Block",
    "Bound",
    "Bus",
    "Code",
    "Command",
    "Device",
    "Digits",
    "Document",
    "Entry",
    "Enum",
    "Erratum",
    "Factor",
    "Fixed",
    "Flag",
    "Frame",
    "Group",
    "Interner",
    "Interval",
    "Limit",
    "Linear",
    "Message",
    "Own",
    "Place",
    "Point",
    "Role",
    "ScaleCase",
    "Shape",
    "Source",
    "Special",
    "Telegram",
    "Text",
    "Titles",
    "TypeInfo",
    "Unit",
]
