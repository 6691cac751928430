"""Turns the rows of a table into draft points: YAML facts for clear cells, questions for the rest."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from fieldscribe.importing import cells as read
from fieldscribe.importing.cells import Address, one_line, phrase
from fieldscribe.importing.draft_text import DraftPoint, label_map, scalar
from fieldscribe.importing.headings import Columns
from fieldscribe.importing.readers import Row
from fieldscribe.wording.numbers import hex_text, number_text

_MODICON_SPACES = {"0": "coil", "1": "discrete", "3": "input", "4": "holding"}
"""The spaces by the first digit of a Modicon reference."""
_WORDS_OF_TYPES = {"u16": 1, "s16": 1, "u32": 2, "s32": 2, "f32": 2, "u64": 4, "s64": 4, "f64": 4}
_LONGEST_TITLE, _LONGEST_CODE = 120, 40


@dataclass(frozen=True, slots=True)
class Options:
    """The options of the user.

    `columns` has the headings or numbers of columns by role, `tables` and `lines` choose tables by number and place.
    `base` is the number printed for wire address 0; None stands for Modicon references. `is_hex` says that addresses
    without a mark are hexadecimal, `address_part` which number counts if a cell prints several. `ranges` says
    whether ranges are `raw` or in `units`.
    """

    columns: Mapping[str, Sequence[str]] = field(default_factory=dict)
    space: str | None = None
    family: str | None = None
    language: str = "en"
    tables: Sequence[int] = ()
    lines: tuple[int, int] | None = None
    base: int | None = 0
    is_hex: bool = False
    address_part: int | None = None
    ranges: str | None = None


def points_of(columns: Columns, space: str, options: Options) -> tuple[list[DraftPoint], list[str]]:
    """Return the points of a table, and comments for rows above the first point that are not points.

    A later row without address, code and name is a bit of the point above, or a question there.
    """
    points: list[DraftPoint] = []
    comments: list[str] = []
    reader = _RowReader(columns, space, options)
    rows = columns.table.rows
    repeated = {row.cells for row in rows[: columns.first]}
    for row in rows[columns.first :]:
        cells = _by_role(row, columns)
        if row.cells in repeated:
            continue
        has_place = "address" in cells or "code" in cells
        if points and not has_place and (bits := _bits(cells)) and cells.get("name"):
            _add_flag(points[-1], bits, one_line(cells["name"]))
        elif has_place or ("name" in cells and len(row.filled) > 1):
            points.append(reader.point(row, cells))
        else:
            lost = f"line {row.line} is no point: {' | '.join(map(one_line, row.filled))}"
            (points[-1].questions if points else comments).append(lost)
    for point in points:
        if point.flags:
            point.facts["flags"] = label_map(point.flags, "title", options.language)
    return points, comments


def _by_role(row: Row, columns: Columns) -> dict[str, str]:
    """Return the non-empty cells by role; several descriptions are joined."""
    cells: dict[str, str] = {}
    for role, places in columns.places.items():
        filled = [row.cells[place] for place in places if place < len(row.cells) and phrase(row.cells[place])]
        if filled:
            cells[role] = "\n".join(filled) if role == "description" else filled[0]
    return cells


def _bits(cells: Mapping[str, str]) -> str | None:
    kind = cells.get("type", "")
    return read.bits_in(cells.get("bits") or (kind if "bit" in kind.casefold() else ""))


def _add_flag(point: DraftPoint, bits: str, name: str) -> None:
    if point.flags.setdefault(bits, name) != name:
        point.questions.append(f"bit {bits} is printed twice: {point.flags[bits]}, {name}")


def _has_unmarked_hex(columns: Columns, place: int) -> bool:
    """Return True if a number of an address column has hexadecimal digits but no mark, so that all may be so."""
    cells = [row.cells[place] for row in columns.table.rows[columns.first :] if place < len(row.cells)]
    return not columns.is_hex(place) and any(map(read.looks_hex, cells))


class _RowReader:
    """Reads the rows of one table."""

    def __init__(self, columns: Columns, space: str, options: Options) -> None:
        self._space, self._options, self._columns = space, options, columns
        self._places = columns.places.get("address", ())
        unclear = (place for place in self._places if _has_unmarked_hex(columns, place))
        self._unclear_hex = frozenset(() if options.is_hex else unclear)

    def point(self, row: Row, cells: Mapping[str, str]) -> DraftPoint:
        """Return the point of a row."""
        point = DraftPoint(row.line, self._space, phrase(cells.get("name", ""))[:_LONGEST_TITLE])
        point.code = phrase(cells.get("code", ""))[:_LONGEST_CODE]
        if "space" in cells:
            named = read.space_in(cells["space"])
            point.space = named or point.space
            if named is None:
                _ask_about(point, "space", cells)
        self._read_address(point, row)
        _set(point, "access", read.access_in(cells.get("access", "")), cells)
        if read.is_reserved(point.title):
            point.facts["reserved"] = "yes"
            return point
        _read_type(point, cells)
        _read_scale(point, cells)
        _read_range(point, cells, self._options.ranges)
        _read_labels(point, cells, self._options.language)
        _read_default(point, cells)
        return point

    def _read_address(self, point: DraftPoint, row: Row) -> None:
        cells = {place: phrase(row.cells[place]) for place in self._places if place < len(row.cells)}
        texts = {place: text for place, text in cells.items() if text}
        found = [wire for place, text in texts.items() for wire in self._on_wire(text, place)]
        if len({wire and wire[1:] for wire in found}) != 1 or found[0] is None:
            printed = f"which is the address: {' | '.join(texts.values())}?" if texts else "no address is printed"
            printed += f" By `--base` none lies below {self._options.base}" if texts and self._options.base else ""
            point.questions += [printed] if self._places else []
            return
        address, space, wire = found[0]
        point.space, point.wire = space or point.space, wire
        point.facts["at"] = hex_text(wire) if address.is_hex else str(wire)
        if address.value != wire:
            printed = hex_text(address.value) if address.is_hex else str(address.value)
            point.reference = address.value - wire, printed

    def _on_wire(self, text: str, place: int) -> list[tuple[Address, str | None, int] | None]:
        """Return the addresses of a cell, each with its space and wire address; None for unclear ones.

        A Modicon reference gives both, any other number no space.
        """
        found = read.addresses_in(text, is_hex=self._options.is_hex or self._columns.is_hex(place)) or []
        if self._options.address_part is not None:
            found = found[self._options.address_part - 1 :][:1]
        if not found or (place in self._unclear_hex and not all(address.is_hex for address in found)):
            return [None]
        if self._options.base is None:
            return [_of_reference(address) for address in found]
        wires = [(address, None, address.value - self._options.base) for address in found]
        return [wire if wire[2] >= 0 else None for wire in wires]


def _of_reference(address: Address) -> tuple[Address, str, int] | None:
    """Return the space and the wire address of a Modicon reference of five or six digits."""
    match = re.fullmatch(r"([0134])(\d{4,5})", address.printed)
    if match is None or not int(match[2]):
        return None
    return address, _MODICON_SPACES[match[1]], int(match[2]) - 1


def _set(point: DraftPoint, role: str, value: str | None, cells: Mapping[str, str]) -> None:
    """Set a fact from its cell; ask if the cell is unclear."""
    if value:
        point.facts[role] = value
    elif role in cells:
        _ask_about(point, role, cells)


def _ask_about(point: DraftPoint, role: str, cells: Mapping[str, str]) -> None:
    point.questions.append(f"which {role} is `{one_line(cells[role])}`?")


def _read_type(point: DraftPoint, cells: Mapping[str, str]) -> None:
    kind, bits = read.type_in(cells.get("type", "")), _bits(cells)
    holds_bits = point.space in ("coil", "discrete")
    if bits and not holds_bits:
        point.facts["bits"] = bits
    elif kind and not (holds_bits and kind == "bit"):
        point.facts["type"] = kind
    elif "type" in cells and not kind:
        point.facts["type"] = "~"
        _ask_about(point, "type", cells)
    length, text = read.quantity_in(cells.get("length", "")) or (None, "")
    if kind is None and length in (2, 4) and not text:
        point.facts |= {"type": "~", "length": str(length)}
        point.questions.append(f"the value has {length} words: of which type, and which word comes first?")
    elif "length" in cells and (text or length != _WORDS_OF_TYPES.get(kind or "", 1)):
        _ask_about(point, "length", cells)


def _read_scale(point: DraftPoint, cells: Mapping[str, str]) -> None:
    """Read step, unit and formula; a step may have the unit, and the column of units the step."""
    for role in ("step", "unit"):
        quantity = read.quantity_in(cells.get(role, ""))
        text = quantity[1] if quantity else one_line(cells.get(role, ""))
        if text:
            unit = read.unit_in(text)
            if unit:
                point.facts.setdefault("unit", scalar(unit))
            else:
                _ask_about(point, role, cells)
        if quantity and not point.facts.keys() & {"scale", "printed"}:
            _read_step(point, quantity[0], role, cells)
    formula = one_line(cells.get("formula", ""))
    if formula:
        is_ours = formula.startswith(("raw =", "value ="))
        if "scale" in point.facts or not is_ours:
            _ask_about(point, "formula", cells)
        point.facts.setdefault("scale", scalar(formula) if is_ours else "~")


def _read_step(point: DraftPoint, step: Fraction, role: str, cells: Mapping[str, str]) -> None:
    is_float = point.facts.get("type") in ("f32", "f64")
    if 0 < step < 1 and not is_float:
        point.facts["scale"] = f"value = raw * {number_text(step)}"
    elif step != 1:
        point.facts |= {} if is_float else {"scale": "~"}
        point.questions.append(f"what is one raw step worth? Printed is `{one_line(cells[role])}`")


def _read_range(point: DraftPoint, cells: Mapping[str, str], ranges: str | None) -> None:
    text = cells.get("range", "")
    if not text and cells.keys() & {"least", "greatest"}:
        text = f"{cells.get('least', '')} .. {cells.get('greatest', '')}"
    found = read.range_in(text)
    if found is None:
        point.questions += [f"which range is `{one_line(text)}`?"] if text and not read.labels_in(text) else []
        return
    if found.unit:
        point.facts.setdefault("unit", scalar(found.unit))
    scale = point.facts.get("scale")
    ranges = ranges or ("units" if found.in_units else "raw" if scale is None else None)
    if ranges is None or (ranges == "raw" and found.in_units):
        point.questions.append(f"is the range {one_line(text)} raw, or in the unit?")
        return
    point.facts["range" if ranges == "raw" else "range_in_units"] = found.text
    if ranges == "units" and scale is None and ".." in found.text:
        point.facts["scale"] = "~"
        point.questions.append("what is one raw step worth? The range is in the unit, and no step is printed")


def _read_labels(point: DraftPoint, cells: Mapping[str, str], language: str) -> None:
    labels = read.labels_in(cells.get("description", "")) or read.labels_in(cells.get("range", ""))
    if labels and point.facts.keys() & {"scale", "unit", "range_in_units"}:
        names = ", ".join(f"{number} {label}" for number, label in labels.items())
        point.questions.append(f"are these special codes: {names}?")
    elif labels:
        point.facts["enum"] = label_map(labels, "", language)


def _read_default(point: DraftPoint, cells: Mapping[str, str]) -> None:
    text = one_line(cells.get("default", ""))
    quantity, scale = read.quantity_in(text), point.facts.get("scale")
    if quantity and scale is None and quantity[0].denominator == 1 and not quantity[1]:
        point.facts["default"] = number_text(quantity[0])
    elif quantity and scale not in (None, "~") and (quantity[1] or "." in text or "," in text):
        point.facts["default_in_units"] = number_text(quantity[0])
    elif text:
        point.questions.append(f"is the default {text} raw, or in the unit?")
