"""What tells a point from others of its kind, as finished words of Python."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.patterns import blanks, widths
from fieldscribe.targets.python.forms import addresses_of, number
from fieldscribe.targets.python.identifiers import attribute
from fieldscribe.targets.python.layout import docstring, wrapped
from fieldscribe.text import python_doc, python_string

if TYPE_CHECKING:
    from fieldscribe.model import Point
    from fieldscribe.targets.python.kinds import Kind, Limits
    from fieldscribe.targets.python.scope import PackageScope


class Words(NamedTuple):
    """The words of a point, or blanks for them; what it has not is empty. `named` is the class of its numbers."""

    name: str
    docstring: str
    group: str
    code: str
    default: str
    named: str
    array_index: str
    addresses: tuple[str, ...]
    references: tuple[str, ...]
    ends: tuple[str, ...]


_ALONE = Words._fields.index("named")
"""The words before this one have a line of their own: their width decides about no line break."""
_CODE, _DEFAULT, _LISTS = map(Words._fields.index, ("code", "default", "addresses"))
_MOST = 48
"""A point with more words is laid out alone."""


def words_of(point: Point, kind: Kind, limits: Limits, scope: PackageScope) -> tuple[str, ...]:
    """The words of a point, one behind the other."""
    place, code, index = point.place, point.code, point.index
    return (
        attribute(point.name if point.variant is None else point.item),
        _docstring(point, kind, limits, scope),
        python_string(point.terms.group),
        python_string(code) if code else "",
        "" if point.default is None else number(point.default),
        scope.names.word_class(point) if kind.has_flags else kind.named,
        "" if index is None else str(index),
        *addresses_of(place.addresses, numbered=kind.numbered),
        *[
            python_string(printed) if isinstance(printed, str) else str(printed)
            for printed in place.references.values()
        ],
        *limits.ends,
    )


def likeness(point: Point, kind: Kind, limits: Limits, words: tuple[str, ...]) -> tuple[object, ...]:
    """What decides about the text of a point and is no word: equal for all points that one pattern fits."""
    place, written, variant = point.place, point.write_place, point.variant
    return (
        *kind.alike,
        limits.form,
        len(place.addresses),
        tuple(place.references),
        written and written.addresses,
        variant and (point.name, variant),
        point.was,
        words[_CODE] == "",
        words[_DEFAULT] == "",
        widths(words[_ALONE:]) if len(words) <= _MOST else words,
    )


def blanked(words: tuple[str, ...], point: Point) -> Words:
    """Blanks for the words."""
    shown = blanks(words) if len(words) <= _MOST else words
    addresses, references = len(point.place.addresses), len(point.place.references)
    second, third = _LISTS + addresses, _LISTS + addresses + references
    return Words._make((*shown[:_LISTS], shown[_LISTS:second], shown[second:third], shown[third:]))


def _docstring(point: Point, kind: Kind, limits: Limits, scope: PackageScope) -> str:
    """The lines of the docstring: title, limits, remarks, and the errata that change facts."""
    title = point.title["en"]
    told = f"{title}: {limits.told}" if limits.told else title
    lines = wrapped(python_doc(f"{told}{'' if told.endswith('.') else '.'}{kind.remarks}"))
    if point.errata and (changing := [erratum for erratum in point.errata if erratum in scope.errata]):
        lines += ["", *wrapped(f"Errata: {', '.join(changing)}.")]
    return "\n".join(docstring(lines))
