"""The points for the HTML page: short rows of numbers and texts, and pools of what many of them share."""

import json
from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from operator import attrgetter
from typing import Any

from fieldscribe import wording
from fieldscribe.facts.points import POINT
from fieldscribe.facts.table import Fact
from fieldscribe.families import family
from fieldscribe.model import Entry, Enum, Flag, Point, Source, Special, Titles
from fieldscribe.model.point import bits_of
from fieldscribe.targets.docs.cells import DocsScope, computed_numberings, reference_heads
from fieldscribe.targets.python.syntax import attribute
from fieldscribe.targets.rust.literals import type_name
from fieldscribe.targets.typescript.syntax import attribute as constant
from fieldscribe.text import line

FIELDS = (
    *("name", "kind", "limits", "code", "title", "group", "addresses", "numbers", "printed", "rows", "source"),
    *("errata", "note", "variant", "index", "written", "default", "was", "identifiers"),
)
"""The fields of a row, in this order; empty ones at the end are left out."""
_DRAWN = frozenset(
    {"name", "code", "group", "variant", "references", "enum", "special", "flags", "title", "note", "errata"}
    | {"source", "raw", "was"}
)
"""Facts that the page shows in special forms."""
_FACTS = [fact for fact in POINT if fact.key not in _DRAWN and (fact.label or fact.rows)]
_SHARED = [(place, fact) for place, fact in enumerate(_FACTS) if fact.holder]
_OF_ADDRESSES = [(place, fact) for place, fact in enumerate(_FACTS) if fact.key in ("address", "addresses")]
_OWN = [placed for placed in enumerate(_FACTS) if not placed[1].holder and placed not in _OF_ADDRESSES]
_OWN_VALUES = attrgetter(*(fact.attribute or (fact.key if fact.value is None else "name") for _, fact in _OWN))

Row = tuple[int, str, str]
"""The position of a fact among all, its label, its text."""


class Pool:
    """Keeps one of each thing and gives its number."""

    def __init__(self) -> None:
        self.things: list[Any] = []
        self._by_key: dict[Hashable, int] = {}
        self._by_content: dict[str, int] = {}

    def number(self, key: Hashable, made: Callable[[], Any]) -> int:
        """Return the number of a thing, which is made once for each key; equal things share a number."""
        number = self._by_key.get(key)
        if number is None:
            thing = made()
            number = self._by_key[key] = self._by_content.setdefault(json.dumps(thing), len(self.things))
            if number == len(self.things):
                self.things.append(thing)
        return number


def titles(texts: Titles, languages: Sequence[str]) -> str | list[str]:
    """Return a title in these languages, English first; the plain text if there is only English."""
    if not texts or len(texts) == 1:
        return line(texts["en"]) if texts else ""
    return [line(texts.get(language, "")) for language in languages]


class Points:
    """The points of a device for the page; `data` has them, and what they share by number."""

    def __init__(self, scope: DocsScope, languages: Sequence[str]) -> None:
        self._scope, self._languages, device = scope, languages, scope.device
        self.numberings = tuple(dict.fromkeys((*reference_heads(device.points), *computed_numberings(device))))
        self._numbers_at = family(device.family).numbers
        self._kinds, self._limits, self._enums, self._words, self._codes = (Pool() for _ in range(5))
        self._documents = {document.id: place for place, document in enumerate(device.documents)}
        self._groups = {group.name: place for place, group in enumerate(device.groups)}
        self._errata = {erratum.id: place for place, erratum in enumerate(device.errata)}

    def data(self) -> dict[str, object]:
        """Return the rows of the points, and the pools that they refer to."""
        rows = list(map(self._row, self._scope.device.points))
        self._rank_facts(rows)
        pools = {"kinds": self._kinds, "limits": self._limits, "enums": self._enums}
        pools |= {"words": self._words, "codes": self._codes}
        return {
            "fields": FIELDS,
            "points": rows,
            "numberings": self.numberings,
            **{name: pool.things for name, pool in pools.items()},
        }

    def source(self, source: Source) -> list[object]:
        """Return a place in a manual: number of the document, section, page, line."""
        place = [line(source.section or ""), line(source.page or ""), source.line or 0]
        return _trimmed([self._documents.get(source.document, -1), *place])

    def titles(self, texts: Titles) -> str | list[str]:
        """Return a title for the page."""
        return titles(texts, self._languages)

    def _row(self, point: Point) -> list[object]:
        addresses, place = point.addresses, point.place
        counts = bool(addresses) and point.base is None
        numbers = {**(self._numbers_at(point.space, min(addresses)) if counts else {}), **place.references}
        known = [numbers.get(key, 0) for key in self.numberings]
        key = id(point.shape), id(point.terms)
        identifiers: list[object] = _identifiers(point) if point.generated else []
        return _trimmed(
            [
                line(point.item),
                self._kinds.number(key, lambda: self._kind(point)),
                self._limits.number((*key, id(point.allowed)), lambda: self._limits_of(point)),
                line(point.code or ""),
                self.titles(point.title),
                self._groups.get(point.group, 0),
                addresses,
                _trimmed(known),
                sum([1 << at for at, key in enumerate(self.numberings) if key in place.references]),
                self._own_rows(point),
                self.source(point.source),
                [self._errata[each] for each in point.errata if each in self._errata],
                self.titles(point.note),
                "" if point.variant is None else line(str(point.variant)),
                "" if point.index is None else point.index,
                [] if point.write_place is None else point.write_place.addresses,
                line(wording.default_text(point)),
                [line(old) for old in point.was],
                identifiers,
            ]
        )

    def _rank_facts(self, rows: list[list[Any]]) -> None:
        """Number the facts among those that the device states: an unused new fact changes no page."""
        own = FIELDS.index("rows")
        holders: list[tuple[Any, Any]] = [(kind, "rows") for kind in self._kinds.things if "rows" in kind]
        holders += [(row, own) for row in rows if len(row) > own]
        used = sorted({place for holder, key in holders for place, _, _ in holder[key]})
        ranks = {place: rank for rank, place in enumerate(used)}
        for holder, key in holders:
            holder[key] = [(ranks[place], label, text) for place, label, text in holder[key]]

    def _own_rows(self, point: Point) -> list[Row]:
        values = zip(_OWN, _OWN_VALUES(point), strict=True)
        present = [placed for placed, value in values if value or value == 0]
        present += _OF_ADDRESSES if len(point.addresses) != 1 else []  # the row has one address already
        return list(self._rows(present, point))

    def _rows(self, facts: Iterable[tuple[int, Fact]], point: Point) -> Iterator[Row]:
        for place, fact in facts:
            for label, text in fact.rows_of(point, self._scope.context):
                if text:
                    yield place, label, line(text)

    def _kind(self, point: Point) -> dict[str, object]:
        """Return the facts of a point's shape and terms."""
        shape, enum, bits = point.shape, point.named_numbers, point.bits
        fixed = shape.fixed
        kind = {
            "rows": list(self._rows(_SHARED, point)),
            "space": line(point.space),
            "telegram": line(point.telegram or ""),
            "type": line(wording.type_text(point)),
            "form": shape.form,
            "access": point.access,
            "unit": line(point.unit.symbol),
            "unitName": line(point.unit.name),
            "width": shape.width,
            "low": 0 if bits is None else bits[1],
            "isGroup": bits is not None,
            "signal": [] if point.place.bit is None else bits_of(point),
            "generated": point.generated,
            "counts": shape.decimals if shape.has_counts else -1,
            "needs": list(shape.scale_arguments),
            "links": [line(name) for name in (*point.changes_with, *point.write_with, point.view_of) if name],
            "base": line(point.base or ""),
            "fixed": [] if fixed is None else [fixed.mask, fixed.bits],
        }
        if enum is not None:
            kind["enum"] = self._enums.number(id(enum.entries), lambda: self._enum(enum, patterns=shape.patterns))
            kind["digits"] = 0 if shape.digits is None else shape.digits.count
        if shape.flags:
            kind["word"] = self._words.number(id(shape.flags), lambda: list(map(self._flag, shape.flags)))
        if shape.specials:
            codes = shape.specials
            kind["codes"] = self._codes.number(id(codes), lambda: [self._code(each, shape.width) for each in codes])
        return {key: value for key, value in kind.items() if value or key in ("enum", "word", "codes", "counts")}

    def _limits_of(self, point: Point) -> dict[str, object]:
        points = self._scope.by_name
        own = {
            "range": "" if point.flags else wording.range_text(point, points, unit=False),
            "raw": wording.raw_range_text(point),
            "needs": ", ".join(point.limit_arguments),
        }
        return {key: line(text) for key, text in own.items() if text}

    def _enum(self, enum: Enum, *, patterns: bool) -> dict[str, object]:
        entries = [[wording.entry_number(each, patterns=patterns), *self._entry(each)] for each in enum.entries]
        return {"name": line(enum.name), "closed": enum.closed, "entries": entries}

    def _entry(self, entry: Entry) -> list[object]:
        return _trimmed([line(entry.name), self.titles(entry.title), line(entry.quantity or "")])

    def _flag(self, flag: Flag) -> list[object]:
        values = [[each.raw, *self._entry(each)] for each in flag.values]
        return [flag.low, flag.width, line(flag.name), self.titles(flag.title), flag.active, values]

    def _code(self, special: Special, width: int) -> list[object]:
        numbers, remarks = wording.special_numbers(special, width), wording.special_remarks(special)
        return [numbers, line(special.name), self.titles(special.title), remarks]


def _identifiers(point: Point) -> list[object]:
    """Return the names of a point in C, Python, Rust and TypeScript; empty if a name equals that of the point."""
    names = "", attribute(point.name), type_name(point.item), constant(point.item)
    return ["" if name == point.item else name for name in names]


def _trimmed(values: list[Any]) -> list[Any]:
    """Return a row without empty fields at its end."""
    while (values and not values[-1] and values[-1] != 0) or (values and values[-1] in ([], 0, "")):
        values.pop()
    return values
