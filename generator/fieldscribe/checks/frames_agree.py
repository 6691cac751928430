"""The manual's worked examples are frames of this device and mean what the description says, or errata explain them."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from fieldscribe import wording
from fieldscribe.arithmetic.words import raw_of
from fieldscribe.language.nodes import Map
from fieldscribe.model import Frame, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.errata import PrintedFact
from fieldscribe.resolve.frames import LocatedFrame
from fieldscribe.wording.numbers import units_text

Words = Mapping[tuple[str, int, int], tuple[int, ...]]
"""The words of a frame, by space or telegram, address, and the index beside it (0 without one)."""


@dataclass(slots=True)
class Seen:
    """A worked example as the family read it.

    `request` is the family's own form of the frame, for parsing its answers. `words` is None if the device has no such
    frame; if `written`, they have the addresses at which points are written.
    """

    frame: Frame
    request: Any = None
    words: Words | None = None
    written: bool = False
    starts: Mapping[str, int] = field(default_factory=dict)
    """The bases that the frame gives, by name."""

    def raw(self, point: Point, indexed: Collection[str]) -> int | None:
        """Return the raw number that the frame carries of a point; None if it carries none."""
        where, index = point.telegram or point.space, (point.index or 0) if point.space in indexed else 0
        addresses, known = (point.written if self.written else point.place).addresses, self.words or {}
        if point.base is not None and point.base not in self.starts:
            return None
        start = self.starts.get(point.base or "", 0)
        words = [word for address in addresses for word in known.get((where, start + address, index), ())]
        return raw_of(point, words) if len(words) == point.words else None


Reader = Callable[[Analysis, "LocatedFrame", dict[str, Seen]], Seen]
"""Reads a frame, given the frames before it by name, and reports what disagrees."""


def check(analysis: Analysis) -> None:
    """Report frames with a wrong checksum, count or length, wrong answers, and meanings that the bytes do not have."""
    if not (analysis.bus_is_whole and analysis.located_frames):
        return
    family_part = analysis.scope.family.part("checks")
    read: Reader = _unread if family_part is None else family_part.read
    seen: dict[str, Seen] = {}
    bases = {base.name: base for base in analysis.scope.bases.values()}
    failed = {name for name, base in bases.items() if not base.formula}
    points = {one.point.item: one.point for one in analysis.resolved if one.point.base not in failed}
    fixed = [point for point in points.values() if point.fixed is not None and point.generated]
    for located in analysis.located_frames:
        read_frame = read(analysis, located, seen)
        known = {name: base for name, base in bases.items() if located.given.keys() >= set(base.wanted)}
        read_frame.starts = {name: base.at(located.given) for name, base in known.items()}
        if read_frame.words is not None:
            _compare_meaning(analysis, located, read_frame, points)
            if located.frame.direction == "request":
                _compare_fixed_bits(analysis, located, read_frame, fixed)
        ids = tuple(erratum.erratum.id for erratum in analysis.cited.get(located.about, ()))
        seen[located.frame.name] = read_frame
        analysis.frames.append(replace(read_frame.frame, errata=ids))


def _unread(analysis: Analysis, located: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    """Return the frame unread, for families that do not read frames."""
    del analysis, seen
    return Seen(located.frame)


def _compare_meaning(analysis: Analysis, located: LocatedFrame, seen: Seen, points: dict[str, Point]) -> None:
    says, indexed = located.node.get("says"), analysis.scope.family.indexed
    if not isinstance(says, Map):
        return
    for word in says:
        facts = analysis.symbols.find(word.removesuffix(".raw"))
        point = points.get(facts.item) if facts is not None else None
        if facts is None or point is None or point.item not in located.frame.meaning or "at" in facts.failed:
            continue
        wanted, carried = located.frame.meaning[point.item], seen.raw(point, indexed)
        if carried != wanted:
            text = "does not carry it" if carried is None else f"carries raw {carried}"
            message = f"`says` gives raw {wanted} for `{word}`, the frame {text}"
            analysis.report_printed(PrintedFact(located.about, "says", says[word], None, says.span(word), message))


def _compare_fixed_bits(analysis: Analysis, located: LocatedFrame, seen: Seen, points: list[Point]) -> None:
    """Report requests that write a word without its constant bits."""
    for point in points:
        word = seen.raw(_whole_word(point), analysis.scope.family.indexed)
        if word is None or point.fixed is None or word & point.fixed.mask == point.fixed.bits:
            continue
        printed = f"{word & 0xFFFF:04X}h"
        message = f"the word of `{point.name}` is {printed}, {wording.fixed_text(point)}"
        analysis.report_printed(located.printed("fixed", printed, None, message))


def _whole_word(point: Point) -> Point:
    """Return the point, or the whole word of a bit group as a point."""
    if point.bits is None:
        return point
    return replace(point, terms=replace(point.terms, bits=None), shape=replace(point.shape, type="u16", width=16))


def report_no_frame(analysis: Analysis, located: LocatedFrame, message: str) -> Seen:
    """Report bytes that are not a frame of the device; an erratum may give the right ones."""
    printed = hex_of(located.frame.printed)
    analysis.report_printed(located.printed("form", printed, None, message))
    return Seen(replace(located.frame, valid=False))


def report_refused(analysis: Analysis, located: LocatedFrame, status: str, unit: int = 0) -> Seen:
    """Report a request that the device does not accept, or a response that does not answer its request."""
    frame = located.frame
    if status == "bad_unit" and analysis.scope.bus is not None:
        return _report_unit(analysis, located, unit, analysis.scope.bus)
    asks = frame.direction == "request"
    what = "this device does not accept such a request" if asks else f"this does not answer `{frame.answers}`"
    return report_no_frame(analysis, located, f"{what}: {status.replace('_', ' ')}")


def _report_unit(analysis: Analysis, located: LocatedFrame, unit: int, bus: Map) -> Seen:
    """Report a unit number that the device cannot have: once for all frames, at `units` of the bus."""
    fact = located.printed("form", hex_of(located.frame.printed), None, "")
    fact = fact._replace(
        span=bus.span("units"),
        message=f"{units_text(analysis.bus)}, and printed frames have unit {unit}",
        hint="correct `units`, or explain each of these frames: an erratum with `printed: {form: …}`",
    )
    analysis.report_printed(fact)
    return Seen(replace(located.frame, valid=False))


def report_no_request(analysis: Analysis, located: LocatedFrame) -> None:
    """Report a response that names no request."""
    if located.frame.answers is None:
        message = f"the response `{located.frame.name}` answers nothing"
        span = located.node.span("name")
        analysis.report.error("unknown-frame", message, span, "name the request under `answers`")


def report_wrong_error(analysis: Analysis, located: LocatedFrame, carried: int | None) -> None:
    """Report a frame whose error differs from the one in the description."""
    stated = located.node.get("error")
    if stated is not None and stated != carried:
        text = "refuses nothing" if carried is None else f"carries {carried}"
        message = f"`error` gives {stated}, the frame {text}"
        analysis.report_printed(located.printed("error", stated, carried, message, at="error"))


def report_wrong_sum(analysis: Analysis, located: LocatedFrame, key: str, here: bytes, right: bytes) -> None:
    """Report a checksum or a length that does not follow from the bytes."""
    printed, taken = hex_of(here), hex_of(right)
    if printed != taken:
        what = "checksum" if key == "xor" else key.upper()
        message = f"the {what} {printed} is printed, the bytes give {taken}"
        analysis.report_printed(located.printed(key, printed, taken, message))


def hex_of(data: bytes) -> str:
    """Return bytes as manuals print them."""
    return data.hex(" ").upper()
