"""The analysis of one device: what was resolved, with its places in the text, and the model that follows from it.

`pipeline` makes it; checks and the audit read it, because the model itself knows no places in the text.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from fieldscribe.code_view import for_code
from fieldscribe.diagnostics import Report
from fieldscribe.grouping import grouped
from fieldscribe.language.nodes import Map
from fieldscribe.model import About, Block, Bus, Command, Device, Enum, Frame, Group, Identification, Message, Point
from fieldscribe.model.device import SteppedCommand
from fieldscribe.resolve.addresses import Places
from fieldscribe.resolve.bus import reader_of
from fieldscribe.resolve.errata import LocatedErratum, PrintedFact, fact_text, same
from fieldscribe.resolve.frames import LocatedFrame
from fieldscribe.resolve.points import ResolvedPoint
from fieldscribe.resolve.ranges import Ranges
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.symbols import SymbolTable
from fieldscribe.text import humanised

_NO_VERSION = "0.0.0"
"""Stands in for a version that has a finding, so that names can still be compared."""


@dataclass
class Analysis:
    """One resolved device. The checks fill `frames`; `cited` finds errata by their subject."""

    scope: Scope
    symbols: SymbolTable
    ranges: Ranges
    places: Places
    resolved: list[ResolvedPoint]
    bus: Bus
    messages: tuple[Message, ...]
    commands: tuple[Command, ...]
    located_frames: list[LocatedFrame]
    errata: list[LocatedErratum]
    identifications: tuple[Identification, ...]
    stepped_commands: tuple[SteppedCommand, ...]
    frames: list[Frame] = field(default_factory=list)
    cited: dict[About, list[LocatedErratum]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.cited |= grouped((subject, erratum) for erratum in self.errata for subject in erratum.subjects)

    @property
    def report(self) -> Report:
        """Return where findings go."""
        return self.scope.report

    @property
    def bus_is_whole(self) -> bool:
        """Return True if everything under `bus` could be read; checks that need all of it run only then."""
        return self.scope.bus is not None and not _is_broken(self.scope.bus)

    @cached_property
    def device(self) -> Device:
        """Return the model, without a digest.

        If there are errors, it has only points without a finding that need no point with a finding.
        """
        resolved = {entry.point.item: entry for entry in self.resolved}
        if self.report.has_errors:
            resolved = {item: entry for item, entry in resolved.items() if not entry.facts.failed}
            known = {entry.point.name for entry in resolved.values()} | resolved.keys()
            while lost := [item for item, entry in resolved.items() if not known.issuperset(entry.point.arguments)]:
                known -= {name for item in lost for name in (item, resolved.pop(item).point.name)}
        return self._device_of([entry.point for entry in resolved.values()])

    @cached_property
    def code_device(self) -> Device:
        """Return the model as generated code may know it, without a digest."""
        return for_code(self.device)

    @property
    def digested(self) -> tuple[Device, Device]:
        """Return `device` and `code_device` with their digest, which takes as long as all checks."""
        from fieldscribe.facts.digest import with_digest  # `check` does not need the table of facts

        return with_digest(self.device, self.code_device)

    def report_printed(self, fact: PrintedFact) -> None:
        """Report a printed fact that differs, unless an erratum says what is printed and what was taken instead."""
        for erratum in self.cited.get(fact.about, ()):
            stated = erratum.printed(fact.key)
            if erratum.node.get("flag") == fact.flag and stated is not None and same(stated, fact.printed):
                erratum.used.add(fact.key)
                self._check_taken(erratum.node, fact)
                return
        named = f"`flag: {fact.flag}` and " if fact.flag is not None else ""
        printed = f"`printed: {{{fact.key}: {fact_text(fact.printed)}}}`"
        hint = fact.hint or f"correct the fact, or explain it: an erratum with {named}{printed}"
        self.report.error("printed-disagrees", fact.message, fact.span, hint)

    def _check_taken(self, erratum: Map, fact: PrintedFact) -> None:
        """Report an erratum whose `taken` is missing or differs from the description."""
        taken = erratum["taken"].get(fact.key) if isinstance(erratum["taken"], Map) else None
        if taken is not None and (fact.taken is None or fact.fits(taken)):
            return
        message = f"the erratum takes {fact_text(taken)} for `{fact.key}`, the facts say {fact_text(fact.taken)}"
        if taken is None:
            message = f"the erratum does not say what was taken for `{fact.key}`"
        hint = f"write `taken: {{{fact.key}: {fact_text(fact.taken)}}}`"
        self.report.error("erratum-differs", message, erratum.span("taken"), hint)

    def _device_of(self, resolved: list[Point]) -> Device:
        scope, header = self.scope, self.scope.header
        variants = {axis: tuple(entry["values"]) for axis, entry in scope.axes.items()}
        ids = {about: tuple(dict.fromkeys(each.erratum.id for each in errata)) for about, errata in self.cited.items()}
        named = (replace(point, errata=ids[point.name]) if point.name in ids else point for point in resolved)
        points = _written_both_ways(tuple(named))
        return Device(
            id=str(header["device"]),
            version=str(header.get("version", _NO_VERSION)),
            vendor=str(header.get("vendor", "")),
            model=str(header.get("model", "")),
            title=titles(header.get("title")),
            note=titles(header.get("note")),
            family=str(header["family"]),
            documents=tuple(scope.documents.values()),
            variants=variants,
            bus=self.bus,
            groups=tuple(_groups(scope)),
            points=points,
            enums=_enums(points),
            blocks=self._blocks(points, variants),
            commands=self.commands,
            frames=tuple(self.frames),
            errata=tuple(located.erratum for located in self.errata),
            digest="",
            messages=self.messages,
            identifications=self.identifications,
            given=tuple(scope.given.values()),
            found=scope.found,
            bases=tuple({base.name: base for base in scope.bases.values()}.values()),
            stepped_commands=self.stepped_commands,
            telegrams=tuple(telegram for telegram, _ in self.places.telegrams.values()),
        )

    def _blocks(self, points: Iterable[Point], variants: dict[str, tuple[str, ...]]) -> dict[str, tuple[Block, ...]]:
        """Return the reads that the family plans for each group."""
        by_group = grouped((point.group, point) for point in points)
        reader = reader_of(self.scope)
        planned = {group: reader.blocks(self.bus, members, variants) for group, members in by_group.items()}
        return {group: blocks for group, blocks in planned.items() if blocks is not None}


def _written_both_ways(points: tuple[Point, ...]) -> tuple[Point, ...]:
    """Return the points, of which those that another one is written with name that one, too."""
    by_partner: dict[str, dict[str, None]] = {}
    for point in points:
        for name in point.write_with:
            by_partner.setdefault(name, {})[point.name] = None
    return tuple([_written_with(point, by_partner.get(point.name, {})) for point in points]) if by_partner else points


def _written_with(point: Point, others: Iterable[str]) -> Point:
    together = tuple(dict.fromkeys((*point.write_with, *others)))
    return point if together == point.write_with else replace(point, terms=replace(point.terms, write_with=together))


def _groups(scope: Scope) -> Iterator[Group]:
    for node in scope.groups:
        name = str(node["group"])
        yield Group(name, titles(node.get("title"), humanised(name)), titles(node.get("note")), source_of(scope, node))


def _enums(points: Iterable[Point]) -> tuple[Enum, ...]:
    """Return the enums that generated points use, each name once."""
    by_name: dict[str, Enum] = {}
    for point in points:
        if point.generated and (enum := point.named_numbers) is not None:
            by_name.setdefault(enum.name, enum)
    return tuple(by_name.values())


def _is_broken(value: Any) -> bool:
    """Return True if a key in a mapping, at any depth, could not be read."""
    return isinstance(value, Map) and (bool(value.broken) or any(map(_is_broken, value.values())))
