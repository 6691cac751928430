"""From drafts to the model's points: addresses, scales, allowed numbers, names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

from fieldscribe.families import FAMILIES
from fieldscribe.language.formula import FormulaError, condition_names, parse_condition
from fieldscribe.language.nodes import Map
from fieldscribe.model import TYPES, Enum, Place, Point, Special, Unit
from fieldscribe.resolve.allowed import Ranges
from fieldscribe.resolve.drafts import Draft
from fieldscribe.resolve.enums import enum_of, flags_of, specials_of
from fieldscribe.resolve.integer_path import decimals_of
from fieldscribe.resolve.names import Index, bits_of, space_of, type_of
from fieldscribe.resolve.rules import Scales
from fieldscribe.resolve.scope import PLAIN, Scope, source_of, titles, unknown_name
from fieldscribe.resolve.values import formula_finding, formula_value, integer, number


@dataclass(frozen=True, slots=True)
class Resolved:
    """A point with the draft that it came from: the model knows no places in the text, the checks do."""

    point: Point
    draft: Draft


@dataclass(frozen=True, slots=True)
class Shape:
    """What is clear about a point before any formula: where it counts, its type, its bits of the word, its special codes."""

    space: str
    type: str
    bits: tuple[int, int] | None
    specials: tuple[Special, ...]

    @property
    def width(self) -> int:
        """How many bits the raw number has."""
        return TYPES[self.type].bits if self.bits is None else self.bits[0] - self.bits[1] + 1

    @property
    def holds(self) -> tuple[int, int]:
        """The least and greatest raw number."""
        signed = TYPES[self.type].signed
        return -(1 << (self.width - 1)) if signed else 0, (1 << (self.width - signed)) - 1


def resolve_points(scope: Scope, drafts: list[Draft], index: Index) -> tuple[list[Resolved], Ranges]:
    """All points of the device, computed; what is wrong with one is a finding and falls back to what is plain."""
    shapes = {id(draft): _shape(scope, draft) for draft in drafts}
    scales = Scales(scope, index)
    widths = {key: shape.holds for key, shape in shapes.items()}
    ranges = Ranges(scales, widths, {key: shape.specials for key, shape in shapes.items()})
    return [Resolved(_point(scope, draft, shapes[id(draft)], scales, ranges), draft) for draft in drafts], ranges


def _shape(scope: Scope, draft: Draft) -> Shape:
    space = space_of(scope, draft)
    bits = bits_of(scope, draft)
    return Shape(space, type_of(scope, draft, space, bits), bits, specials_of(scope, draft))


def _point(scope: Scope, draft: Draft, shape: Shape, scales: Scales, ranges: Ranges) -> Point:
    address = _address(scope, draft)
    closed = draft.layer("range") is None and draft.layer("range_in_units") is None and not draft.get("open", False)
    enum = enum_of(scope, draft, closed)
    floating = TYPES[shape.type].floating
    cases = None if floating else scales.cases(draft)
    access = str(draft.get("access", "rw"))
    reason = _reason(draft, address, access)
    places = () if address is None else (_place(scope, draft, shape, address, access),)
    _existence(scope, draft, scales.index)
    return Point(
        name=draft.name,
        variant=draft.variant,
        code=draft.code,
        group=str(draft.group["group"]),
        space=shape.space,
        places=places,
        references=_references(scope, draft, address),
        type=shape.type,
        bits=shape.bits,
        access=access,
        title=draft.title,
        note=titles(draft.get("note")),
        unit=_unit(scope, draft),
        scale=cases,
        decimals=decimals_of(draft, cases, ranges),
        allowed=ranges.allowed(draft, enum, floating),
        default=_default(scope, draft),
        steps=_steps(scope, draft),
        enum=enum,
        flags=flags_of(scope, draft, shape.width),
        specials=shape.specials,
        record=draft.record,
        set=draft.set,
        changes=draft.get("changes"),
        keeps=draft.get("keeps") if "w" in access else None,
        conditions=tuple(draft.get("conditions", ())) if "w" in access else (),
        when=draft.get("when"),
        since=draft.get("since"),
        until=draft.get("until"),
        was=tuple(draft.get("was", ())),
        reserved=bool(draft.get("reserved", False)),
        source=source_of(scope, *draft.layers, draft.group),
        errata=(),
        generated=reason is None,
        reason=reason,
    )


def _reason(draft: Draft, address: int | None, access: str) -> str | None:
    if address is None:
        return "the manual prints no address"
    if draft.get("reserved", False):
        return "reserved by the maker"
    if draft.layer("scale") is not None and draft.get("scale") is None:
        return "the manual does not settle its scale"
    return "not reachable over the bus" if access == "none" else None


def _address(scope: Scope, draft: Draft) -> int | None:
    raw = draft.get("at")
    span = draft.span("at")
    if draft.layer("at") is None:
        scope.report.error(
            "missing-key",
            f"`{draft.name}` says no address",
            draft.span(),
            "add `at: …`, or `at: ~` if the manual prints none",
        )
        return None
    if raw is None:
        return None
    exact = Fraction(raw) if isinstance(raw, int) else formula_value(str(raw), _base(scope, draft), span, scope.report)
    if exact is None:
        return None
    address = exact.numerator
    if exact.denominator != 1:
        scope.report.error(
            "bad-number", f"the address {exact} is not a whole number", span, "`at` is the number on the wire"
        )
        return None
    last = FAMILIES[scope.family].last_address
    if not 0 <= address <= last:
        scope.report.error(
            "address-outside-space",
            f"the address {address} lies outside 0..{last}",
            span,
            "`at` is the number on the wire",
        )
        return None
    return address


def _base(scope: Scope, draft: Draft) -> Mapping[str, Fraction]:
    """What an address may be computed from: the place where a record is used."""
    use = draft.use
    if use is None or use.get("at") is None:
        return {}
    base = integer(use["at"], use.span("at"), scope.report)
    return {} if base is None else {"base": Fraction(base)}


def _place(scope: Scope, draft: Draft, shape: Shape, address: int, access: str) -> Place:
    count = 1 if shape.bits else max(1, TYPES[shape.type].bits // 16)
    words = tuple(range(address, address + count))
    if words[-1] > FAMILIES[scope.family].last_address:
        message = f"the last word of `{draft.name}` lies outside the space"
        scope.report.error("address-outside-space", message, draft.span("at"), "check the address and the type")
    order = draft.get("words") or _bus_order(scope, shape.type)
    purpose = "write" if access == "w" else "read"
    return Place(purpose, shape.space, words[::-1] if order == "low first" else words, None)


def _bus_order(scope: Scope, type_name: str) -> str:
    said = next((file["bus"].get("words") for file in scope.files if "bus" in file), None)
    if isinstance(said, Map):
        return str(said.get(type_name, "high first"))
    return str(said or "high first")


def _references(scope: Scope, draft: Draft, address: int | None) -> Mapping[str, int | str]:
    if address is None:
        return {}
    numbering: Map | None = draft.group.get("numbering")
    known = {"wire": Fraction(address)}
    for name, text in (numbering or {}).items():
        assert numbering is not None
        found = formula_value(text, known, numbering.span(name), scope.report)
        if found is not None:
            known[name] = found
    return {name: int(found) for name, found in known.items() if name != "wire"}


def _unit(scope: Scope, draft: Draft) -> Unit:
    symbol = draft.get("unit")
    if symbol is None:
        return PLAIN
    found = scope.units.get(symbol)
    if found is None:
        hint = unknown_name(symbol, list(scope.units), "units")
        scope.report.error("unknown-unit", f"there is no unit `{symbol}`", draft.span("unit"), hint)
    return found or PLAIN


def _default(scope: Scope, draft: Draft) -> Fraction | None:
    raw = draft.get("default")
    return None if raw is None else number(raw, draft.span("default"), scope.report)


def _steps(scope: Scope, draft: Draft) -> tuple[tuple[int, int], ...]:
    raw: Map = draft.get("steps", {})
    found = [(integer(key, raw.key_span(key), scope.report), step) for key, step in raw.items()]
    return tuple(sorted((start, step) for start, step in found if start is not None))


def _existence(scope: Scope, draft: Draft, index: Index) -> None:
    text = draft.get("when")
    if text is None:
        return
    try:
        names = condition_names(parse_condition(text))
    except FormulaError as error:
        formula_finding(error, draft.span("when"), scope.report)
        return
    axes = scope.header.get("variants", {})
    for name in names:
        if index.find(name.name) is None and name.name not in axes:
            place = draft.span("when")
            message = f"there is no point and no variant axis `{name.name}`"
            scope.report.error(
                "unknown-point", message, place._replace(column=place.column + name.column), index.hint(name.name)
            )
