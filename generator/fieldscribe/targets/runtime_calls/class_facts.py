"""The class of points without its points: profile, blocks, variants, identifications, commands."""

from collections.abc import Iterator, Mapping
from fractions import Fraction

from fieldscribe.model import Command, Device, Point, SteppedCommand, Variant
from fieldscribe.targets.runtime_calls.point_call import places
from fieldscribe.targets.runtime_calls.point_expressions import addresses_of, number, place_of_command, step_of
from fieldscribe.targets.runtime_calls.scope import Call, Node, PointName, Scope, call, family_calls


def members(device: Device) -> dict[str, list[Point | dict[Variant, Point]]]:
    """Return the points that have attributes, group by group; after them those that have one name in variants."""
    groups: dict[str, list[Point | dict[Variant, Point]]] = {group.name: [] for group in device.groups}
    by_name: dict[str, dict[Variant, Point]] = {}
    for point in device.points:
        group = groups.setdefault(point.terms.group, [])
        if not point.terms.generated:
            continue
        group.append(point)
        if point.variant is not None:
            by_name.setdefault(point.name, {})[point.variant] = point
    for same in by_name.values():
        groups[next(iter(same.values())).group].append(same)
    return groups


def class_facts(scope: Scope) -> Mapping[str, Node]:
    """Return the class variables by name, in order."""
    device, family = scope.device, family_calls(scope.device)
    facts: dict[str, Node] = {"PROFILE": family.profile(device, scope), **family.facts(device, scope)}
    if device.variants:
        facts["VARIANTS"] = device.variants
    if device.identifications:
        facts["IDENTIFICATIONS"] = _identifications(scope)
    documented = [point for point in device.points if not point.terms.generated]
    if documented:
        facts["DOCUMENTED"] = {scope.attribute(point.item): _documented(point, scope) for point in documented}
    return facts


def readable_groups(device: Device) -> tuple[str, ...]:
    """Return the groups with points to read."""
    return tuple(dict.fromkeys([point.group for point in device.points if point.generated and point.readable]))


def commands_of(scope: Scope) -> Iterator[tuple[Command | SteppedCommand, Call]]:
    """Yield the commands, each with the call that creates it."""
    for command in scope.device.commands:
        facts: dict[str, Node] = {"at": place_of_command(command, scope)}
        if command.value is not None:
            facts["value"] = command.value
        yield command, call(scope.runtime("Command"), **facts)
    for stepped in scope.device.stepped_commands:
        yield stepped, _stepped(stepped, scope)


def _stepped(command: SteppedCommand, scope: Scope) -> Call:
    facts: dict[str, Node] = {}
    if command.arguments:
        facts["arguments"] = command.arguments
    if command.run in ("first", "before write"):
        facts["run"] = command.run
    if command.every is not None:
        facts["every"] = number(Fraction(command.every, 1000), binary=True)
    return call(scope.runtime("SteppedCommand"), *(step_of(step, scope) for step in command.steps), **facts)


def _documented(point: Point, scope: Scope) -> Call:
    """Return why the point has no attribute, and the addresses of its words, if they can be reached."""
    facts: dict[str, Node] = {}
    if point.raw_only:
        facts.update(places(point, addresses_of(point.addresses, point.space), scope))
    if point.code:
        facts["code"] = point.code
    return call(scope.runtime("Documented"), point.reason or "no reason given", **facts)


def _identifications(scope: Scope) -> Node:
    """Return what identifies the device and its variants."""
    made = scope.runtime("Identification")
    return tuple(
        call(
            made,
            PointName(each.point),
            (*each.raws, *each.texts),
            *(() if each.variant is None else ((each.variant.axis, each.variant.value),)),
        )
        for each in scope.device.identifications
    )
