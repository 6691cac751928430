"""What the checks look at: the resolved parts of one device, still with their places in the text."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import NumberError, parse_number

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Report, Span
    from fieldscribe.model import Bus, Command, Device, Frame, Message
    from fieldscribe.resolve.addresses import Places
    from fieldscribe.resolve.allowed import Ranges
    from fieldscribe.resolve.errata import OpenErratum
    from fieldscribe.resolve.frames import OpenFrame
    from fieldscribe.resolve.names import Index
    from fieldscribe.resolve.points import Resolved
    from fieldscribe.resolve.scope import Scope


@dataclass(frozen=True, slots=True)
class Printed:
    """A printed fact that disagrees: about whom, under which key of `printed`, where, and what to say of it.

    `taken` None means that the right value follows from nothing here and the erratum's word counts; `right` tells
    whether what an erratum takes is what was taken, where comparing the two as texts would not do. `flag` is the flag
    of the point that it is about.
    """

    about: str
    key: str
    printed: Any
    taken: Any
    span: Span
    message: str
    right: Callable[[Any], bool] | None = None
    flag: str | None = None

    def fits(self, said: Any) -> bool:
        """Whether what an erratum says was taken is what was taken."""
        return self.right(said) if self.right is not None else same(said, self.taken)


@dataclass(slots=True)
class Subject:
    """One device under check. `frames` are replaced as they are checked; `cited` maps whom errata are about to them."""

    scope: Scope
    index: Index
    ranges: Ranges
    places: Places
    resolved: list[Resolved]
    bus: Bus
    messages: tuple[Message, ...]
    commands: tuple[Command, ...]
    open_frames: list[OpenFrame]
    errata: list[OpenErratum]
    frames: list[Frame] = field(default_factory=list)
    cited: dict[str, list[OpenErratum]] = field(default_factory=dict)
    _models: tuple[Device, Device] | None = None

    def __post_init__(self) -> None:
        for erratum in self.errata:
            for subject in erratum.subjects:
                self.cited.setdefault(subject, []).append(erratum)

    @property
    def bus_is_whole(self) -> bool:
        """Whether all that was written under `bus` could be read: else what rests on it cannot be judged."""
        return self.scope.bus is not None and not _lost(self.scope.bus)

    @property
    def models(self) -> tuple[Device, Device]:
        """The model and what code may know of it, made when first asked for: only of a device without errors."""
        if self._models is None:
            from fieldscribe.resolve.device import build_device

            self._models = build_device(self)
        return self._models

    @property
    def sound(self) -> Device:
        """The device as code may know it, without the points that something is wrong with."""
        from fieldscribe.resolve.device import sound_device

        return sound_device(self) if self.report.has_errors else self.models[1]

    @property
    def report(self) -> Report:
        """Where findings go."""
        return self.scope.report

    def disagrees(self, one: Printed) -> None:
        """A printed fact that disagrees with what was taken: an error, unless an erratum about it says both."""
        for erratum in self.cited.get(one.about, ()):
            stated = erratum.printed(one.key)
            if erratum.raw.get("flag") != one.flag:
                continue
            if stated is None or not same(stated, one.printed):
                continue
            erratum.used.add(one.key)
            said = erratum.raw["taken"].get(one.key) if isinstance(erratum.raw["taken"], Map) else None
            if said is None or (one.taken is not None and not one.fits(said)):
                wrong = f"the erratum takes {_shown(said)} for `{one.key}`, the facts say {_shown(one.taken)}"
                if said is None:
                    wrong = f"the erratum does not say what was taken for `{one.key}`"
                hint = f"write `taken: {{{one.key}: {_shown(one.taken)}}}`"
                self.report.error("erratum-differs", wrong, erratum.raw.span("taken"), hint)
            return
        named = f"`flag: {one.flag}` and " if one.flag is not None else ""
        hint = (
            f"correct the fact, or explain it: an erratum with {named}`printed: {{{one.key}: {_shown(one.printed)}}}`"
        )
        self.report.error("printed-disagrees", one.message, one.span, hint)


def _lost(value: Any) -> bool:
    return isinstance(value, Map) and (bool(value.broken) or any(map(_lost, value.values())))


def same(left: Any, right: Any) -> bool:
    """Whether two printed things are the same: as numbers in any notation, or as text but for blanks and case."""
    if isinstance(left, Seq | list | tuple) or isinstance(right, Seq | list | tuple):
        lefts, rights = _listed(left), _listed(right)
        return len(lefts) == len(rights) and all(same(one, other) for one, other in zip(lefts, rights, strict=True))
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
