"""Clashes in C, where everything has one flat namespace: <DEVICE>_<POINT>_<TAIL>, and points may be called alike.

The point `speed` with a flag `limit` has `SPEED_LIMIT_MASK`; so has a point `speed_limit` that takes bits of its word.
Only names that the author gave can meet, so only those are followed, each at its underscores: that stays quick.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.checks.identifiers import Claim, enums_of
from fieldscribe.resolve.drafts import groups

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from fieldscribe.checks.subject import Subject
    from fieldscribe.model import Point
    from fieldscribe.resolve.points import Resolved

HEADER = frozenset(
    {"ok", "out_of_range", "not_a_number", "unknown_value", "zero_factor", "no_case", "overflow", "special"}
    | {"status", "real", "h", "description_version", "description_digest"}
    | {"modbus_h", "modbus_functions", "modbus_profile"}
    | {"can_h", "can_bitrate", "can_profile", "can_dialogue"}
    | {"uss_h", "uss_tasks", "uss_pkw", "uss_profile"}
)
"""What headers define behind the device's name, whatever the description says."""

_ALWAYS = frozenset({"space", "address", "words", "code", "raw_min", "raw_max", "decimals"})
_FUNCTIONS = frozenset(
    {"encode", "encode_count", "decode", "decode_count", "check", "rule", "to_words", "from_words", "extract", "insert"}
    | {"frame"}
)
_BITS = frozenset({"shift", "mask"})

_OF_CODES = ("is_special", "special_name", "is_no_value")

_SOMETIMES: Mapping[str, Callable[[Point], bool]] = {
    **dict.fromkeys(_OF_CODES, lambda point: bool(point.specials)),
    "index": lambda point: point.index is not None,
    "characters": lambda point: point.text is not None,
    "digits": lambda point: point.digits is not None,
    **dict.fromkeys(("fixed_mask", "fixed_bits"), lambda point: point.fixed is not None),
    "active_low_mask": lambda point: any(flag.active == 0 for flag in point.flags),
    "telegram": lambda point: point.telegram is not None,
    "display_decimals": lambda point: point.display is not None,
    "eeprom_frame": lambda point: point.space == "parameter",
}
"""What only points of some forms, spaces and families have."""

LAYOUT = re.compile(
    r"layout_(bit|[us](8|16|32|64))(_order_[0-9a-f]+)?(_bits_\d+_\d+|_word)?(_fixed_[0-9a-f]+_[0-9a-f]+)?"
)
"""What the header of frames calls the ways in which numbers lie in words, whatever the points."""


class Header(frozenset[str]):
    """The names that headers define whatever authors named, with all that layouts may be called."""

    def __contains__(self, name: object) -> bool:
        return super().__contains__(name) or (isinstance(name, str) and LAYOUT.fullmatch(name) is not None)


C_TAILS = _ALWAYS | _FUNCTIONS | _BITS | _SOMETIMES.keys()
"""What every point may have behind its name."""

Tails = dict[str, Claim]


def prefix_clashes(subject: Subject) -> Iterator[tuple[Claim, Claim]]:
    """Pairs of things that would get one C identifier."""
    fixed = {one.point.item: one for one in subject.resolved if one.point.generated}
    given = _given(subject, fixed)
    header = Header(HEADER | set(_of_device(subject)))
    for prefix, tails in given.items():
        for tail, claim in tails.items():
            whole = f"{prefix}_{tail}"
            if whole in header:
                yield Claim("C", whole.upper(), "what the header needs", None), claim
            yield from _meets(whole, len(prefix), claim, fixed, given)


def _meets(
    whole: str, own: int, claim: Claim, fixed: dict[str, Resolved], given: dict[str, Tails]
) -> Iterator[tuple[Claim, Claim]]:
    """Other things whose identifier, split at any underscore, is this one."""
    at = whole.find("_")
    while at >= 0:
        prefix, tail = whole[:at], whole[at + 1 :]
        one = fixed.get(prefix)
        if one is not None and _has(one.point, tail):
            yield Claim("C", whole.upper(), f"the point `{one.point.name}`", one.draft), claim
        if at != own and tail in given.get(prefix, ()):
            yield given[prefix][tail], claim
        at = whole.find("_", at + 1)


def _has(point: Point, tail: str) -> bool:
    if tail in _BITS:
        return point.bits is not None
    if tail in _SOMETIMES:
        return _SOMETIMES[tail](point)
    return tail in _ALWAYS or tail in _FUNCTIONS or tail in point.references


def _given(subject: Subject, fixed: dict[str, Resolved]) -> dict[str, Tails]:
    """What authors named, by what stands before it: flags and codes of points, entries of enums, commands."""
    given: dict[str, Tails] = {}
    for item, one in fixed.items():
        for prefix, tail, what, key in _named(item, one.point):
            claim = Claim("C", f"{prefix}_{tail}".upper(), what, one.draft, key)
            given.setdefault(prefix, {}).setdefault(tail, claim)
    for raw in subject.scope.listed("commands"):
        for tail in ("address", "value"):
            claim = Claim("C", f"COMMAND_{raw['name']}_{tail}".upper(), f"the command `{raw['name']}`", raw, "name")
            given.setdefault(f"command_{raw['name']}", {}).setdefault(tail, claim)
    return given


def _of_device(subject: Subject) -> Iterator[str]:
    """What the header defines for the spaces, codes, groups, messages and telegrams of the device."""
    yield from (f"space_{space}" for space in subject.scope.family.spaces)
    yield from (f"exception_{code.name}" for code in subject.bus.exceptions)
    yield from (f"command_{raw['name']}" for raw in subject.scope.listed("commands"))
    for group in groups(subject.scope):
        yield from (f"{group['group']}_{tail}" for tail in ("blocks", "blocks_count", "group_count"))
    yield from (f"message_{raw['name']}" for raw in subject.scope.listed("messages"))
    for raw in subject.scope.listed("telegrams"):
        yield from (f"telegram_{raw['name']}{tail}" for tail in ("", "_words", "_slots"))
    if subject.scope.header["family"] == "uss":
        kinds = (
            ("task", subject.bus.functions),
            ("response", subject.bus.codes("responses")),
            ("error", subject.bus.exceptions),
        )
        for kind, codes in kinds:
            yield from (f"{kind}_name", *(f"{kind}_{code.name}" for code in codes))


def _named(item: str, point: Point) -> Iterator[tuple[str, str, str, str]]:
    """Prefix, tail, what it is, and the key under which it stands."""
    holder = point.shared_codes or item
    for special in point.specials:
        ends = ("",) if special.low == special.high else ("_first", "_last")
        for end in ends:
            yield holder, special.name + end, f"the code `{special.name}` of `{holder}`", "special"
    for tail in _OF_CODES if point.shared_codes else ():
        yield holder, tail, f"the special codes of `{holder}`", "special"
    for flag in point.flags:
        more = ("_shift", *(f"_{value.name}" for value in flag.values)) if flag.width > 1 else ()
        for end in ("", "_mask", *more):
            yield item, flag.name + end, f"the flag `{flag.name}` of `{item}`", "flags"
    for key, enum in enums_of(point):
        for tail in ("name", *(entry.name for entry in enum.entries)):
            yield enum.name, tail, f"`{tail}` of the enum `{enum.name}`", key
