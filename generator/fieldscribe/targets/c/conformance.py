"""The view of the conformance program: which function answers which kind of vector, point by point."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.names import upper
from fieldscribe.records import dataclass
from fieldscribe.targets.c.conformance_cases import AdapterView, StructView, adapter_of, structs_of
from fieldscribe.targets.c.families import frames_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Code, Device
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import DeviceView


@dataclass(frozen=True, slots=True)
class SuiteView:
    """The conformance program of a device."""

    structs: tuple[StructView, ...]
    adapters: tuple[AdapterView, ...]
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


def conformance_view(
    device: Device, view: DeviceView, scope: HeaderScope, cases_of_family: Iterable[tuple[str, str]]
) -> SuiteView:
    """The view of `<device>_conformance.c`; `cases_of_family` has a point's function and a further macro for it."""
    named = frames_of(device).NAMED_CODES
    extra: dict[str, list[str]] = {}
    for function, case in cases_of_family:
        extra.setdefault(function, []).append(case)
    views = {entry.item: entry for group in view.groups for entry, _ in group.entries if entry is not None}
    points = [point for point in device.points if point.generated]
    groups = ((group, f"{scope.prefix}_{group}_blocks") for group, blocks in device.blocks.items() if blocks)
    return SuiteView(
        structs=tuple(struct for point in points for struct in structs_of(point, scope)),
        adapters=tuple(adapter_of(point, views[point.item], scope, extra) for point in points),
        statuses=tuple((f"{scope.upper}_{upper(status)}", status) for status in _STATUSES),
        family=device.family,
        groups=tuple(groups),
        codes=tuple(_codes(device, scope)),
        documented=tuple(
            (point.item, point.space, f"{scope.upper}_{upper(point.item)}", point.index is not None)
            for point in device.points
            if point.raw_only and point.address is not None
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


def _code_kinds(device: Device) -> tuple[tuple[str, tuple[Code, ...]], ...]:
    emitted = (codes for codes in family(device.family).codes if codes.emitted)
    return tuple((codes.kind, device.bus.codes(codes.section)) for codes in emitted)


def _codes(device: Device, scope: HeaderScope) -> Iterator[tuple[str, str, str]]:
    """The kind, name and enumerator of each number of the protocol that has one."""
    for kind, codes in _code_kinds(device):
        for code in codes:
            yield kind, code.name, f"{scope.upper}_{upper(kind)}_{upper(code.name)}"
