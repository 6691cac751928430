"""The view of the conformance program: which function answers which kind of vector, point by point."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.names import upper
from fieldscribe.targets.c.conformance_cases import StructView, cases_of, structs_of
from fieldscribe.targets.c.families import frames_of
from fieldscribe.targets.c.fold import folded
from fieldscribe.targets.c.kinds import Texts

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Iterator, Sequence

    from fieldscribe.model import Code, Device
    from fieldscribe.render import Render
    from fieldscribe.targets.c.frames import Frames
    from fieldscribe.targets.c.kinds import Kind, Placed
    from fieldscribe.targets.c.scope import HeaderScope


@dataclass(frozen=True, slots=True)
class SuiteView:
    """The conformance program of a device."""

    structs: tuple[StructView, ...]
    items: tuple[str, ...]
    """The points, each of which has a function that answers vectors."""
    statuses: tuple[tuple[str, str], ...]
    family: str
    groups: tuple[tuple[str, str], ...]
    codes: tuple[tuple[str, str, str], ...]
    names: tuple[str, ...]
    """The kinds of codes for which a function gives the name."""
    commands: tuple[tuple[str, str, str], ...]
    documented: tuple[tuple[str, str, str, bool], ...]
    """Points that are reached raw only: item, space, the prefix of their macros, and whether they have an index."""
    telegrams: tuple[str, ...]


_STATUSES = ("ok", "out_of_range", "not_a_number", "unknown_value", "zero_factor", "no_case", "overflow", "special")


def conformance_view(device: Device, placed: Sequence[Placed], scope: HeaderScope) -> SuiteView:
    """The view of `<device>_conformance.c`."""
    named = frames_of(device).NAMED_CODES
    groups = ((group, f"{scope.prefix}_{group}_blocks") for group, blocks in device.blocks.items() if blocks)
    dependent = (point for point, kind, _ in placed if kind.view.takes_others)
    return SuiteView(
        structs=tuple(struct for point in dependent for struct in structs_of(point, scope)),
        items=tuple([words[0] for _, _, words in placed]),
        statuses=tuple((f"{scope.upper}_{upper(status)}", status) for status in _STATUSES),
        family=device.family,
        groups=tuple(groups),
        codes=tuple(_codes(device, scope)),
        documented=tuple(
            (point.item, point.space, f"{scope.upper}_{upper(point.item)}", point.index is not None)
            for point in device.points
            if not point.generated and point.raw_only
        ),
        names=tuple(kind for kind, codes in _code_kinds(device) if codes and kind in named),
        commands=tuple(
            (
                command.name,
                f"{scope.prefix}_command_{command.name}",
                f"{scope.upper}_COMMAND_{upper(command.name)}_VALUE",
            )
            for command in device.commands
        ),
        telegrams=tuple(telegram.name for telegram in device.telegrams),
    )


def adapters_text(placed: Iterable[Placed], scope: HeaderScope, sections: Collection[Frames], render: Render) -> str:
    """The functions of points that answer vectors."""
    adapters = Texts(lambda kind: _adapter(kind, scope, sections, render))
    return "".join([adapters.of(kind).filled(words) for _, kind, words in placed])


def _adapter(kind: Kind, scope: HeaderScope, sections: Iterable[Frames], render: Render) -> str:
    of_family = [case for frames in sections for case in frames.cases(kind)]
    cases = cases_of(kind.point, kind.view, scope, of_family)
    return folded(render("c/adapter.c.j2", {"item": kind.view.words.item, "cases": cases}))


def _code_kinds(device: Device) -> tuple[tuple[str, tuple[Code, ...]], ...]:
    emitted = (codes for codes in family(device.family).codes if codes.emitted)
    return tuple((codes.kind, device.bus.codes(codes.section)) for codes in emitted)


def _codes(device: Device, scope: HeaderScope) -> Iterator[tuple[str, str, str]]:
    """The kind, name and enumerator of each number of the protocol that has one."""
    for kind, codes in _code_kinds(device):
        for code in codes:
            yield kind, code.name, f"{scope.upper}_{upper(kind)}_{upper(code.name)}"
