"""Explains one point: a heading and rows with all its facts, for the `explain` command."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from fieldscribe import wording
from fieldscribe.arithmetic.exact import float_of, pattern_of
from fieldscribe.arithmetic.words import ends_of, number_of, with_fixed
from fieldscribe.conversation.decode_state import Directory
from fieldscribe.conversation.meanings import Doubts, Meanings, raw_form
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Context, Row
from fieldscribe.families import family
from fieldscribe.families.frame_results import WriteMethod
from fieldscribe.model import Device, Erratum, Point
from fieldscribe.text import line
from fieldscribe.wording.exact import hex_text, rounded

_ROWS = {
    "wire": "Wire address",
    "low_wire": "Addresses",
    "range": "Raw range",
    "range_in_units": "Range",
    "default_in_units": "Default",
}
"""The row of a printed fact, if its label differs from its key."""


@dataclass(frozen=True, slots=True)
class Explanation:
    """The explanation of a point: a heading and rows of label and text, without control characters."""

    heading: str
    rows: tuple[Row, ...]

    def as_data(self) -> dict[str, object]:
        """Return the same for JSON."""
        return {"heading": self.heading, "rows": [{"label": label, "text": text} for label, text in self.rows]}


def explain_point(device: Device, point: Point, *, as_documented: bool = False, raw: int | None = None) -> Explanation:
    """Return all facts of a point; with `as_documented`, as the manual prints them, without errata.

    Rows about the raw number, if there is one, come first.
    """
    errata = [erratum for erratum in device.errata if erratum.id in point.errata]
    printed = errata if as_documented else []
    rows = [*_rows_of_number(device, point, raw), *(row for row in _rows(device, point, errata, printed) if row[1])]
    head = f"{point.code} {point.item}" if point.code else point.item
    heading = line(f"{head}: {wording.title_text(point.title)}")
    return Explanation(heading, tuple((line(label), line(text)) for label, text in rows))


def _rows_of_number(device: Device, point: Point, raw: int | None) -> Iterator[Row]:
    """Return the meaning of a raw number, and if it is out of range, other readings of it."""
    if raw is None or point.text is not None:
        return
    signed = raw < 0
    if not ends_of(point.width, signed=signed)[0] <= raw <= ends_of(point.width, signed=signed)[1]:
        yield f"Raw {raw}", f"it does not fit into the {point.width} bits of the point"
        return
    raw = number_of(raw, point.width, signed=point.info.signed) if raw > 0 else raw
    meaning = Meanings(device, point).text(raw, {})
    yield f"R{raw_form(point)(raw)[1:]}", meaning
    doubts = Doubts(device, point, partial(Directory(device).neighbours, point))
    yield from (("Doubt", text) for text in doubts.of(raw, {}, meaning))


def _rows(device: Device, point: Point, errata: list[Erratum], printed: list[Erratum]) -> Iterator[Row]:
    """Return the rows of the facts in the table, those of `printed` errata as printed; texts may be empty."""
    context = Context(device)
    rows: list[Row] = []
    for fact in POINT:
        if fact.key == "errata":
            yield from _with_printed_facts([row for row in rows if row[1]], printed)
            yield from (("Erratum", _erratum_text(erratum)) for erratum in errata if not printed)
            rows.clear()
        rows += fact.rows_of(point, context)
        if fact.key == "access" and point.generated and not printed:
            rows += [("Read", read_text(device, point)), ("Write", write_text(device, point))]
    yield from rows


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
    """Return a raw number for an example that certainly may be written, and moves a machine least; None without one.

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
    """Return the example: its meaning, and the raw number."""
    if point.info.floating:
        number = float_of(raw, point.info.bits)
        text = f"{number:g}" if point.display is None else rounded(*number.as_integer_ratio(), point.display)
        return f"for example {wording.with_unit(text, point)} is the pattern {hex_text(raw, point.width // 4)}"
    meaning = wording.meaning_text(point, raw)
    return f"for example {meaning} is raw {raw}" if meaning else f"for example raw {raw}"


def _erratum_text(erratum: Erratum) -> str:
    printed, taken, why = (text.rstrip(". ") for text in (erratum.printed, erratum.taken, erratum.why))
    doubts = ", ".join(text for _, text in erratum.leaves_open)
    tail = f" The manual leaves open {doubts}." if doubts else ""
    return f"{erratum.id} ({erratum.certainty}): the manual prints: {printed}. Taken: {taken}. {why}.{tail}"


def _with_printed_facts(rows: list[Row], errata: list[Erratum]) -> list[Row]:
    """Return the rows with the printed facts of errata in place of the corrected ones; facts without a row follow."""
    replaced, further = list(rows), []
    for erratum in errata:
        facts = [(_ROWS.get(key, key.replace("_", " ").capitalize()), text) for key, text in erratum.facts]
        for label, text in facts or [("The manual says", erratum.printed)]:
            remark = f"{text} (as printed; {erratum.id})"
            at = next((place for place, row in enumerate(rows) if row[0].lower() == label.lower()), None)
            if at is None:
                further.append((label, remark))
            else:
                replaced[at] = replaced[at][0], remark
    return replaced + further
