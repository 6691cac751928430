"""What the checks look at: the resolved parts of one device, with their places in the text."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import NumberError, parse_number

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Report, Span
    from fieldscribe.model import About, Bus, Command, Device, Frame, Message
    from fieldscribe.resolve.addresses import Places
    from fieldscribe.resolve.errata import LocatedErratum
    from fieldscribe.resolve.frames import LocatedFrame
    from fieldscribe.resolve.points import ResolvedPoint
    from fieldscribe.resolve.ranges import Ranges
    from fieldscribe.resolve.scope import Scope
    from fieldscribe.resolve.symbols import SymbolTable


@dataclass(frozen=True, slots=True)
class PrintedFact:
    """A printed fact that disagrees with the description: whom it is about, its key, its place, and the message.

    `taken` is what the description has instead; None if only an erratum can tell the right value. `right` compares
    what an erratum says was taken, where comparing numbers or texts is not enough. `flag` is the flag that it is about.
    """

    about: About
    key: str
    printed: Any
    taken: Any
    span: Span
    message: str
    right: Callable[[Any], bool] | None = None
    flag: str | None = None

    def fits(self, stated: Any) -> bool:
        """Whether an erratum's `taken` is what the description has."""
        return self.right(stated) if self.right is not None else same(stated, self.taken)


@dataclass(slots=True)
class Analysis:
    """One device under check. `frames` collects the checked frames; `cited` finds errata by what they are about."""

    scope: Scope
    index: SymbolTable
    ranges: Ranges
    places: Places
    resolved: list[ResolvedPoint]
    bus: Bus
    messages: tuple[Message, ...]
    commands: tuple[Command, ...]
    open_frames: list[LocatedFrame]
    errata: list[LocatedErratum]
    frames: list[Frame] = field(default_factory=list)
    cited: dict[About, list[LocatedErratum]] = field(default_factory=dict)
    _devices: tuple[Device, Device] | None = None

    def __post_init__(self) -> None:
        for erratum in self.errata:
            for analysis in erratum.subjects:
                self.cited.setdefault(analysis, []).append(erratum)

    @property
    def bus_is_whole(self) -> bool:
        """Whether everything under `bus` could be read; if not, checks that need it are left out."""
        return self.scope.bus is not None and not _lost(self.scope.bus)

    @property
    def devices(self) -> tuple[Device, Device]:
        """The whole device and the same as code may know it, without a digest; only for a device without errors."""
        if self._devices is None:
            from fieldscribe.resolve.device import build_device

            self._devices = build_device(self)
        return self._devices

    @property
    def models(self) -> tuple[Device, Device]:
        """Both devices with their digest, which costs as much as all checks: who writes no files does without."""
        from fieldscribe.plain import with_digest

        return with_digest(*self.devices)

    @property
    def sound(self) -> Device:
        """The device as code sees it, without the points that have findings."""
        from fieldscribe.resolve.device import sound_device

        return sound_device(self) if self.report.has_errors else self.devices[1]

    @property
    def so_far(self) -> Device:
        """The whole device; of one with errors what is sound."""
        from fieldscribe.resolve.device import sound_device

        return sound_device(self) if self.report.has_errors else self.devices[0]

    @property
    def report(self) -> Report:
        """Where findings go."""
        return self.scope.report

    def disagrees(self, fact: PrintedFact) -> None:
        """Report a printed fact that disagrees, unless an erratum gives what is printed and what was taken."""
        for erratum in self.cited.get(fact.about, ()):
            stated = erratum.printed(fact.key)
            if erratum.node.get("flag") != fact.flag:
                continue
            if stated is None or not same(stated, fact.printed):
                continue
            erratum.used.add(fact.key)
            taken = erratum.node["taken"].get(fact.key) if isinstance(erratum.node["taken"], Map) else None
            if taken is None or (fact.taken is not None and not fact.fits(taken)):
                message = f"the erratum takes {_shown(taken)} for `{fact.key}`, the facts say {_shown(fact.taken)}"
                if taken is None:
                    message = f"the erratum does not say what was taken for `{fact.key}`"
                hint = f"write `taken: {{{fact.key}: {_shown(fact.taken)}}}`"
                self.report.error("erratum-differs", message, erratum.node.span("taken"), hint)
            return
        named = f"`flag: {fact.flag}` and " if fact.flag is not None else ""
        hint = (
            f"correct the fact, or explain it: an erratum with {named}`printed: {{{fact.key}: {_shown(fact.printed)}}}`"
        )
        self.report.error("printed-disagrees", fact.message, fact.span, hint)


def _lost(value: Any) -> bool:
    """Whether some key in a mapping, at any depth, could not be read."""
    return isinstance(value, Map) and (bool(value.broken) or any(map(_lost, value.values())))


def same(left: Any, right: Any) -> bool:
    """Whether two facts are equal: as numbers in any notation, as texts without regard to blanks and case."""
    if isinstance(left, Seq | list | tuple) or isinstance(right, Seq | list | tuple):
        lefts, rights = _listed(left), _listed(right)
        return len(lefts) == len(rights) and all(same(left, other) for left, other in zip(lefts, rights, strict=True))
    numbers = [_number(left), _number(right)]
    if None not in numbers:
        return numbers[0] == numbers[1]
    return "".join(str(left).split()).lower() == "".join(str(right).split()).lower()


def _listed(value: Any) -> list[Any]:
    if isinstance(value, Iterable) and not isinstance(value, str):
        return list(value)
    return [part for part in str(value).split(",") if part.strip()]


def _number(value: Any) -> Fraction | None:
    if isinstance(value, str):
        try:
            return parse_number(value)
        except NumberError:
            return None
    return Fraction(value) if value is not None else None


def _shown(value: Any) -> str:
    if isinstance(value, Seq | list | tuple):
        return "[" + ", ".join(map(str, value)) + "]"
    return "…" if value is None else str(value)
