"""The neutral model of a device: frozen, typed, with all records and sets expanded. It knows no target and no YAML."""

from fieldscribe.model.device import (
    About,
    Base,
    Block,
    Bus,
    Code,
    Command,
    Device,
    Document,
    Erratum,
    FamilyFacts,
    Field,
    Found,
    Frame,
    Given,
    Group,
    Identification,
    Message,
    Named,
    Role,
    Step,
    SteppedCommand,
    Telegram,
    Version,
    Word,
)
from fieldscribe.model.numbers import (
    NOTATIONS,
    TYPE_PATTERN,
    TYPES,
    DatePart,
    Digits,
    Entry,
    Enum,
    Fixed,
    Flag,
    Special,
    Text,
    Titles,
    TypeInfo,
    carrier_of,
    type_info,
)
from fieldscribe.model.point import NOWHERE, Place, Point, Source, Terms, Unit, Variant, bits_of, item_of
from fieldscribe.model.rules import Allowed, Bound, Factor, Interval, Limit, Linear, ScaleCase
from fieldscribe.model.shape import Interner, Shape
