"""Resolves the manual's worked examples: their bytes, what they answer, and what they mean in raw numbers."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from fieldscribe.arithmetic.codec import CodecError, encode, setting_of
from fieldscribe.families import families
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import integer_in
from fieldscribe.model import Bus, Frame, Named, Point
from fieldscribe.resolve.bases import is_stated
from fieldscribe.resolve.bus import reader_of
from fieldscribe.resolve.errata import PrintedFact
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.symbols import SymbolTable
from fieldscribe.resolve.values import FactError, integer, number, whole
from fieldscribe.text import humanised
from fieldscribe.wording.numbers import number_text

RAW = ".raw"
"""The suffix of a point's name that marks a raw number instead of a value."""


@dataclass(frozen=True, slots=True)
class LocatedFrame:
    """A frame with its text, and what it states about given numbers and found blocks."""

    frame: Frame
    node: Map
    given: Mapping[str, int] = field(default_factory=dict)

    @property
    def about(self) -> Named:
        """Return how errata name the frame."""
        return Named("frame", self.frame.name)

    def printed(self, key: str, printed: Any, taken: Any, message: str, *, at: str = "bytes") -> PrintedFact:
        """Return a fact of the frame that is printed differently; `at` is its key."""
        return PrintedFact(self.about, key, printed, taken, self.node.span(at), message)


def frames_of(scope: Scope, bus: Bus, symbols: SymbolTable, points: Mapping[str, Point]) -> list[LocatedFrame]:
    """Return all frames in the order of the text; the checks set `valid` and `corrected` later."""
    result: dict[str, LocatedFrame] = {}
    seen: set[str] = set()
    for node in scope.unique("frames"):
        name, answers = node["name"], node.get("answers")
        seen.add(name)
        if answers is not None and answers not in result:
            if answers == name or answers not in seen:
                hint = "the request stands above its answer"
                scope.unknown("frame", answers, node.span("answers"), list(result), hint)
            continue
        digits = "".join(str(node["bytes"]).split())
        if len(digits) % 2 or not digits:
            message = "the bytes have an odd number of digits" if digits else "the frame has no bytes"
            scope.report.error("bad-number", message, node.span("bytes"), "write two digits for each byte")
            continue
        if not _known_framing(scope, node) or reader_of(scope).refuses(scope, bus, node):
            continue
        before = result[answers].given if answers is not None else {}
        result[name] = LocatedFrame(
            _frame(scope, bus, node, bytes.fromhex(digits), _meaning_of(scope, node, symbols, points)),
            node,
            {**before, **_given(scope, node)},
        )
    return list(result.values())


def _frame(scope: Scope, bus: Bus, node: Map, data: bytes, meaning: Mapping[str, int]) -> Frame:
    answers = node.get("answers")
    framing = str(node.get("framing") or (bus.framings or scope.family.framings)[0])
    _foreign_keys(scope, node)
    return Frame(
        name=node["name"],
        framing=framing,
        direction=node.get("direction") or ("response" if answers else "request"),
        answers=answers,
        printed=data,
        corrected=data,
        valid=True,
        meaning=meaning,
        title=titles(node.get("title"), humanised(node["name"])),
        source=source_of(scope, node),
        errata=(),
        family_facts=reader_of(scope).frame(scope, node, framing),
    )


def _known_framing(scope: Scope, node: Map) -> bool:
    """Return True if the family has the framing; report it otherwise."""
    family, known = scope.family.name, scope.family.framings
    if node.get("framing", known[0]) in known:
        return True
    message = f"`{node['framing']}` is no framing of the family {family}"
    scope.report.error("wrong-choice", message, node.span("framing"), f"write one of {', '.join(known)}")
    return False


def _foreign_keys(scope: Scope, node: Map) -> None:
    """Report keys that only frames of another family have."""
    for other in families():
        for key in other.frame_keys:
            if key in node and key not in scope.family.frame_keys:
                message = f"the family {scope.family.name} has no key `{key}`"
                hint = f"it belongs to {other.name}: leave it out"
                scope.report.error("family-key", message, node.key_span(key), hint)


def _meaning_of(scope: Scope, node: Map, symbols: SymbolTable, points: Mapping[str, Point]) -> dict[str, int]:
    """Return the raw numbers that a frame carries according to `says`, by item."""
    held: dict[str, int | Fraction] = {}
    settings: Map | None = node.get("with")
    if settings is not None:
        settings = settings.copied()
        for name in _bases(scope) & settings.keys():
            del settings[name]
        if scope.found is None and is_stated(scope, "found"):  # it has a finding
            for name in [word for word in settings if symbols.find(word.removesuffix(RAW)) is None]:
                del settings[name]
    for point, raw_number in StatedValues(scope, settings).numbers(symbols, points) if settings is not None else ():
        held[point.item] = held[point.name] = setting_of(point, raw_number)
    says: Map | None = node.get("says")
    if says is None:
        return {}
    return {point.item: raw_number for point, raw_number in StatedValues(scope, says, held).numbers(symbols, points)}


def _bases(scope: Scope) -> set[str]:
    """Return the names of given numbers and of found blocks."""
    return {*scope.given, *(base.name for base in scope.bases.values() if base.block is not None)}


def _given(scope: Scope, node: Map) -> Mapping[str, int]:
    """Return what the frame states about given numbers, and about the places of found blocks."""
    settings = node.get("with", {})
    numbers = {name: integer(settings[name], settings.span(name), scope.report) for name in _bases(scope) & {*settings}}
    return {name: number for name, number in numbers.items() if number is not None}


@dataclass(frozen=True, slots=True)
class StatedValues:
    """Values by point as an author wrote them; `held` is what other points hold at that time."""

    scope: Scope
    values: Map
    held: Mapping[str, int | Fraction] = field(default_factory=dict)

    def numbers(self, symbols: SymbolTable, points: Mapping[str, Point]) -> Iterator[tuple[Point, int]]:
        """Yield each named point with its raw number; report and leave out those without a clear number."""
        for word, value in self.values.items():
            name = word.removesuffix(RAW)
            facts = symbols.find(name)
            if facts is None:
                symbols.unknown(name, self.values.key_span(word))
                continue
            point = points.get(facts.item)
            if point is None or facts.failed & {"scale", "type", "enum"}:
                continue
            try:
                yield point, self.raw(point, word, value) if word == name else whole(value, self.values.span(word))
            except FactError as error:
                error.report(self.scope.report)

    def raw(self, point: Point, word: str, value: Any) -> int:
        """Return the raw number of a name, or of a value in the unit. Raises FactError."""
        if isinstance(value, bool):
            return int(value)
        known = _names(point) if isinstance(value, str) and not value[:1].isdigit() else {}
        if value in known:
            return known[value]
        span = self.values.span(word)
        if known and integer_in(value) is None:
            self.scope.unknown("entry", value, span, known)
            raise FactError
        if point.text is not None:
            raise FactError(
                "bad-formula",
                f"`{word}` is {point.text.kind}",
                span,
                "`says` takes only points that hold a number: leave it out",
            )
        exact = number(value, span, self.scope.report)
        if exact is None:
            raise FactError
        try:
            raw = encode(point, exact, self.held)
        except CodecError as error:
            raise self._no_number(point, word, error) from error
        if point.fixed_scale is not None and point.fixed_scale.at(exact) != raw:
            exact = point.fixed_scale.at(exact)
        elif point.scale is not None or point.info.floating or exact == raw:
            return raw
        message = f"`{word}` cannot be {value}: that is raw {number_text(exact)}"
        raise FactError(
            "bad-number", message, span, f"give a value of the point, in its unit, or the raw number: `{word}{RAW}: …`"
        )

    def _no_number(self, point: Point, word: str, error: CodecError) -> FactError:
        """Return the error for a value that has no raw number."""
        span = self.values.span(word)
        if error.status == "missing":
            message = f"`{word}` needs what {', '.join(error.missing)} holds to be scaled (say it under `with`)"
            return FactError("bad-formula", message, span, f"give its raw number: `{word}{RAW}: …`")
        if point.info.floating:
            message = f"`{word}` cannot be {self.values[word]}: the type is too small"
            return FactError("bad-number", message, span, "correct it")
        message = f"`{word}` has no scale for the values under `with`"
        return FactError("bad-formula", message, span, "check the values under `with`")


def _names(point: Point) -> dict[str, int]:
    """Return the names of the point's numbers."""
    if point.enum is None:
        return {"off": 0, "on": 1} if point.type == "bit" else {}
    return {entry.name: entry.raw for entry in point.enum.entries}
