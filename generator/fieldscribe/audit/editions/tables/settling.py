"""What concerns several points: pairs of words, labels that go on in the row below, titles, places that come twice."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables.cell_text import one_line
from fieldscribe.audit.editions.tables.drafts import DraftErratum
from fieldscribe.audit.editions.tables.numbers import codes_in
from fieldscribe.audit.editions.tables.words_of_rows import half_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fieldscribe.audit.editions.tables.drafts import DraftGroup, DraftPoint
    from fieldscribe.audit.editions.tables.rows import Read

_SHORT = 80
_CITED = {"labels": "enum", "range": "range", "range_in_units": "range"}
"""How a description cites facts that have numbers."""


def titled(points: Sequence[DraftPoint], read: Sequence[Read]) -> list[DraftPoint]:
    """Give rows without a title of their own the one above with what tells them apart."""
    above = ""
    for point, entry in zip(points, read, strict=True):
        told = one_line(entry.cells.get("description", ""))
        if point.title:
            above = point.title
            continue
        own, half = half_of(told)
        point.half = point.half or half
        usable = own and len(own) <= _SHORT and not point.labels
        same_pair = point.half == "low" and not half
        point.title = above if same_pair or not usable else f"{above}: {own}" if above and above not in own else own
    return list(points)


def share_labels(points: Sequence[DraftPoint]) -> None:
    """Where a cell says that there are more choices than it names, the rest stands in the row below, for both rows."""
    for point, below in pairwise(points):
        wanted = int(point.printed["choices"][0]) if "choices" in point.printed else 0
        if wanted <= len(point.labels) or not below.rest or "choices" in below.printed:
            continue
        if point.labels.keys() & below.rest.keys() or wanted != len(point.labels) + len(below.rest):
            continue
        point.labels = below.labels = {**point.labels, **below.rest}
        below.printed["choices"] = point.printed["choices"]
        point.lines["enum"] = below.lines["enum"] = [point.line, below.line]
        below.lines["choices"] = [point.line]
    for point in points:
        wanted = int(point.printed["choices"][0]) if "choices" in point.printed else len(point.labels)
        if point.labels and wanted != len(point.labels):
            point.questions.append(f"{wanted} choices are printed, {len(point.labels)} of them were read")
            del point.printed["choices"]
        elif not point.labels:
            point.printed.pop("choices", None)
        _hold_together(point, wanted)


def _hold_together(point: DraftPoint, wanted: int) -> None:
    """Labels beside a scale or a limit of another point are special codes; those outside the range contradict it."""
    outside = [number for number in point.labels if point.range and not _allows(point.range, number)]
    if len(point.labels) == 1 and wanted != 1:
        point.labels = {}
    elif point.labels and (point.scale or point.unit or point.range_in_units or "*" in (point.range or "")):
        said = ", ".join(f"{number} {label}" for number, label in point.labels.items())
        point.questions.append(f"are these special codes: {said}?")
        point.labels = {}
        point.printed.pop("choices", None)
    elif outside:
        point.questions.append(
            f"the range is printed as {point.range}; what is named is {', '.join(map(str, point.labels))}"
        )
        point.range = None


def _allows(text: str, number: int) -> bool:
    """Whether a range of whole numbers, as we wrote it, has a number in it; True where other points limit it."""
    if "*" in text:
        return True
    ends = [part.partition("..") for part in text.replace("|", ",").split(",")]
    return any(int(low) <= number <= int(high or low) for low, _, high in ends)


def paired(points: Iterable[DraftPoint]) -> list[DraftPoint]:
    """Join the rows of both words of a value."""
    joined: list[DraftPoint] = []
    for point in points:
        above = joined[-1] if joined else None
        if above is not None and _is_pair(above, point):
            _join(above, point)
        else:
            joined.append(point)
    for point in joined:
        if point.half:
            point.questions.append(f"this is the {point.half} word of a value whose other word was not found")
    return joined


def _is_pair(above: DraftPoint, below: DraftPoint) -> bool:
    if not above.half or not below.half or above.half == below.half or above.space != below.space:
        return False
    if (above.code, above.title) != (below.code, below.title) and (not above.code or above.code != below.code):
        return False
    return above.at is None or below.at is None or abs(above.at - below.at) == 1


def _join(above: DraftPoint, below: DraftPoint) -> None:
    high, low = (above, below) if above.half == "high" else (below, above)
    above.type = "s32" if above.type == "s16" else "u32" if above.type in (None, "u16", "~") else above.type
    above.length = None
    above.words = "low first" if high is below else None
    if high.at is None or low.at is None:
        known = high if low.at is None else low
        above.at, above.shown = None, "~"
        above.questions.append(f"only one word of the value has an address, {known.shown}")
        above.printed = {key: value for key, value in above.printed.items() if key in ("resolution", "range_in_units")}
    else:
        first = min(high, low, key=lambda half: half.at or 0)
        addresses = [key for key in low.printed if key not in ("resolution", "range_in_units", "choices")]
        above.printed |= {f"low_{key}": low.printed[key] for key in addresses}
        above.at, above.shown = first.at, first.shown
        above.errata = [erratum for erratum in first.errata if erratum not in above.errata] + above.errata
        above.errata += [_of_low(erratum) for erratum in low.errata if erratum.fact in addresses]
    above.half = ""


def _of_low(erratum: DraftErratum) -> DraftErratum:
    return DraftErratum(f"low_{erratum.fact}", erratum.printed, erratum.taken, erratum.why)


def limits_known(groups: Sequence[DraftGroup]) -> None:
    """Leave out limits by other points that are not in the draft."""
    codes = {point.code for group in groups for point in group.points}
    for point in (point for group in groups for point in group.points):
        missing = codes_in([point.range or ""]) - codes
        if missing:
            point.questions.append(f"the range is {point.range}; {', '.join(sorted(missing))} is not in this draft")
            point.range = None


def each_once(groups: Sequence[DraftGroup]) -> None:
    """Leave out what comes a second time: the same place, or a code without a place."""
    seen: dict[tuple[str, int, str | None], DraftPoint] = {}
    codes = {point.code: point for group in groups for point in group.points if point.code and point.at is not None}
    for group in groups:
        kept: list[DraftPoint] = []
        for point in group.points:
            first = None
            if point.at is not None:
                first = seen.setdefault((point.space, point.at, point.bits), point)
            elif point.code in codes:
                first = codes[point.code]
            if first is None or first is point:
                kept.append(point)
            else:
                _mention(first, point)
        group.points = kept


def _mention(first: DraftPoint, again: DraftPoint) -> None:
    """Say that a point comes twice; facts that it lacks are taken from there."""
    differing = [
        key
        for key in ("range", "scale", "unit", "access")
        if getattr(again, key) and getattr(first, key) and getattr(again, key) != getattr(first, key)
    ]
    is_same = first.title == again.title or (first.code and first.code == again.code)
    for key in ("range", "range_in_units", "scale", "unit", "access", "type", "labels") if is_same else ():
        if not getattr(first, key) and getattr(again, key):
            setattr(first, key, getattr(again, key))
            if key in _CITED:
                first.lines[_CITED[key]] = [again.line]
    other = f" as `{again.title[:60]}`" if again.title != first.title else ""
    also = f", with another {', '.join(differing)}" if differing else ""
    first.questions.append(f"line {again.line} has this place too{other}{also}: it was left out")
