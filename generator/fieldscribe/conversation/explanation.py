"""Explains one point: a heading and rows with all its facts, for the `explain` command."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.arithmetic.exact import float_of, pattern_of
from fieldscribe.arithmetic.words import with_fixed
from fieldscribe.families import family
from fieldscribe.text import line
from fieldscribe.wording.exact import hex_text, rounded

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.families.frame_results import WriteMethod
    from fieldscribe.model import Device, Erratum, Point, Source

Row = tuple[str, str]

_KINDS = {"u": "unsigned", "s": "signed, two's complement", "f": "IEEE 754 floating point"}
_ROWS = {
    "wire": "Wire address",
    "low_wire": "Words",
    "range": "Raw range",
    "range_in_units": "Range",
    "default_in_units": "Default",
}
"""The row that shows a printed fact, where its label differs from its key."""


@dataclass(frozen=True, slots=True)
class Explanation:
    """What is known of one point: a heading and rows of label and text, cleaned of control characters."""

    heading: str
    rows: tuple[Row, ...]

    def as_data(self) -> dict[str, object]:
        """The same for JSON."""
        return {"heading": self.heading, "rows": [{"label": label, "text": text} for label, text in self.rows]}


def explain_point(device: Device, point: Point, *, as_documented: bool = False) -> Explanation:
    """All facts of a point; with `as_documented` as the manual prints them, without its errata."""
    errata = [erratum for erratum in device.errata if erratum.id in point.errata]
    rows = [row for row in _all_rows(device, point, bool(errata) and as_documented) if row[1]]
    if as_documented:
        rows = _with_printed_facts(rows, errata)
    else:
        rows += [("Erratum", _erratum_text(erratum)) for erratum in errata]
    rows += _last_rows(device, point)
    head = f"{point.code} {point.item}" if point.code else point.item
    heading = line(f"{head}: {wording.title_text(point.title)}")
    return Explanation(heading, tuple((line(label), line(text)) for label, text in rows))


def _all_rows(device: Device, point: Point, without_requests: bool) -> Iterator[Row]:
    yield from _identity_rows(device, point)
    if point.generated and not without_requests:
        yield "Read", read_text(device, point)
        yield "Write", write_text(device, point)
    yield from _meaning_rows(device, point)
    yield from _names_rows(point)
    yield from _behaviour_rows(device, point)


def _identity_rows(device: Device, point: Point) -> Iterator[Row]:
    group = next((group for group in device.groups if group.name == point.group), None)
    yield "Group", f"{point.group}: {wording.title_text(group.title)}" if group else point.group
    yield "Variant", str(point.variant or "")
    where = "not printed in the manual" if point.address is None else _address_text(device, point)
    yield "Wire address", f"{where}, space {point.space}" if point.telegram is None else where
    for key, printed in point.references.items():
        as_hex = f" ({hex_text(printed)})" if isinstance(printed, int) and printed <= 0x10000 else ""
        yield key.capitalize(), f"{printed}{as_hex}"
    yield "Words", wording.words_text(point) if len(point.addresses) > 1 else ""
    yield "Written at", wording.write_place_text(point)
    yield "Type", _type_text(point)
    yield "Access", wording.access_text(point.access)


def _address_text(device: Device, point: Point) -> str:
    """The address, with the index or the telegram beside it."""
    address = point.address or 0
    if point.telegram is not None:
        return f"word {address} of the telegram {point.telegram}, counted from 0"
    first = point.addresses[0] if point.text is not None else address
    beside = point.index is not None and point.space in family(device.family).indexed
    index = f", index {point.index}" if beside else ""
    return f"{wording.address_text(first)}{index}"


def _type_text(point: Point) -> str:
    if point.untyped is not None or point.type == "bit" or point.text is not None:
        return wording.type_text(point)
    kind = f"{_KINDS[point.type[0]]}, {point.width} bits"
    if point.digits is not None:
        return f"{wording.type_text(point)} ({kind})"
    if point.bits is None:
        return f"{point.type} ({kind})"
    return f"{wording.type_text(point)} of a shared word ({kind})"


def read_text(device: Device, point: Point) -> str:
    """Return how the point is read, with an example; empty if it cannot be read."""
    part = family(device.family).part("frame_builder")
    return str(part.read_text(device, point)) if part and point.readable and point.addresses else ""


def write_text(device: Device, point: Point) -> str:
    """Return how the point is written, with an example; empty if it cannot be written."""
    part = family(device.family).part("frame_builder")
    way: WriteMethod | None = part.way_to_write(device, point) if part and point.writable and point.addresses else None
    if way is None:
        return ""
    raw = None if way.example is None else sample_raw(point)
    frames = "" if way.example is None or raw is None else way.example(raw)
    return way.how if raw is None or not frames else f"{way.how}{way.joint}{_sample_text(point, raw)}{frames}"


def sample_raw(point: Point) -> int | None:
    """Return a raw number for an example that may be written and moves a machine least; None if there is no sure one.

    It is the default, else the allowed number nearest to zero.
    """
    if point.text is not None:
        return None
    if point.info.floating:
        first = point.allowed.units[0][0] if point.allowed.units else 0
        number = first if point.default is None else point.default
        return pattern_of(number, point.info.bits)
    raw = point.default_raw
    if raw is not None:
        special = point.special(raw)
        if special is None or special.writable:
            return with_fixed(point, raw) if special is None else raw
    ends = [
        end for interval in point.allowed.intervals for end in (interval.low, interval.high) if isinstance(end, int)
    ]
    return with_fixed(point, min(ends, key=abs)) if ends else None


def _sample_text(point: Point, raw: int) -> str:
    """Return the number as an example: its meaning, and the raw number."""
    if point.info.floating:
        number = float_of(raw, point.info.bits)
        text = f"{number:g}" if point.display is None else rounded(*number.as_integer_ratio(), point.display)
        return f"for example {wording.with_unit(text, point)} is the pattern {hex_text(raw, point.width // 4)}"
    meaning = wording.meaning_text(point, raw)
    return f"for example {meaning} is raw {raw}" if meaning else f"for example raw {raw}"


def _meaning_rows(device: Device, point: Point) -> Iterator[Row]:
    by_name = {name: other for other in device.points for name in (other.item, other.name)}
    unit = point.unit
    yield "Unit", f"{unit.symbol} ({unit.name})" if unit.symbol else ""
    yield "Scale", wording.scale_text(point, by_name)
    yield "Resolution", wording.resolution_text(point)
    yield "Shown with", wording.decimals_text(point)
    yield "Widths", "; ".join(wording.width_texts(point))
    yield "Range", "" if point.flags else wording.range_text(point, by_name)
    yield "Raw range", wording.raw_range_text(point)
    yield "Default", wording.default_text(point)
    yield "Steps", wording.steps_text(point)
    yield "Fixed bits", wording.fixed_text(point)
    scale = point.scale_arguments
    limits = [argument for argument in point.limit_arguments if argument not in scale]
    yield "Scale needs", _needs(scale)
    yield "Limits need", _needs(limits)


def _needs(names: tuple[str, ...] | list[str]) -> str:
    return f"{', '.join(names)} (read {'it' if len(names) == 1 else 'them'} first)" if names else ""


def _names_rows(point: Point) -> Iterator[Row]:
    if point.enum is not None:
        yield "Names", "only these may be written" if point.enum.closed else "the range says what may be written"
        for entry in point.enum.entries:
            yield f"Raw {entry.raw}", wording.entry_meaning(entry)
    if point.digits is not None:
        for entry in point.digits.enum.entries:
            yield f"Digit {entry.raw}", wording.entry_meaning(entry)
    for special in point.specials:
        yield f"Raw {wording.special_numbers(special, point.width)}", wording.special_meaning(special)
    for flag in point.flags:
        label = f"Bit{'s' if flag.width > 1 else ''} {wording.flag_bits(flag, point)}"
        yield label, wording.flag_meaning(flag)


def _behaviour_rows(device: Device, point: Point) -> Iterator[Row]:
    yield "Kept", wording.keeps_text(device, point)
    yield "Write only when", ", ".join(point.conditions)
    yield "Exists when", wording.condition_text(point.when, {other.name: other for other in device.points})
    yield "Since", point.since or ""
    yield "Until", point.until or ""
    yield "Changes", point.changes or ""
    yield "Record", point.record or ""
    alone = point.index is None or point.space in family(device.family).indexed
    yield "Index", "" if alone else str(point.index)
    yield "Set", "" if point.set is None else str(point.set)
    yield "Changes with", ", ".join(point.changes_with)
    yield "Old names", ", ".join(point.was)


def _last_rows(device: Device, point: Point) -> Iterator[Row]:
    if point.note:
        yield "Note", wording.title_text(point.note)
    if not point.generated:
        yield "Not generated", point.reason or "no reason given"
    yield "Source", source_text(device, point.source)


def source_text(device: Device, source: Source) -> str:
    """Return where in which document a fact stands."""
    document = next(
        (document.title for document in device.documents if document.id == source.document), source.document
    )
    parts = [document, source.section or "", f"page {source.page}" if source.page else ""]
    parts.append("" if source.line is None else f"line {source.line} of its text")
    return ", ".join(part for part in parts if part)


def _erratum_text(erratum: Erratum) -> str:
    printed, taken, why = (text.rstrip(". ") for text in (erratum.printed, erratum.taken, erratum.why))
    return f"{erratum.id} ({erratum.certainty}): the manual prints: {printed}. Taken: {taken}. {why}."


def _with_printed_facts(rows: list[Row], errata: list[Erratum]) -> list[Row]:
    """The rows with the printed facts of errata in place of the corrected ones; facts without a row follow."""
    shown, further = list(rows), []
    for erratum in errata:
        facts = [(_ROWS.get(key, key.replace("_", " ").capitalize()), said) for key, said in erratum.facts]
        for label, said in facts or [("The manual says", erratum.printed)]:
            remark = f"{said} (as printed; {erratum.id})"
            at = next((place for place, row in enumerate(rows) if row[0].lower() == label.lower()), None)
            if at is None:
                further.append((label, remark))
            else:
                shown[at] = shown[at][0], remark
    return shown + further
