"""Reduces a device to chosen points and their dependencies."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from fnmatch import fnmatchcase

from fieldscribe.code_view import for_code
from fieldscribe.conversation.lookup import find, near
from fieldscribe.diagnostics import UnclearError, did_you_mean
from fieldscribe.facts.digest import with_digest
from fieldscribe.families import family
from fieldscribe.grouping import grouped
from fieldscribe.model import Block, Command, Device, Enum, Erratum, Interval, Point, SteppedCommand
from fieldscribe.text import shortened

_GLOB = frozenset("*?[")
_MOST_NAMED = 20
"""The most wrong words in a message."""


def select(device: Device, words: Sequence[str]) -> Device:
    """Return the device reduced to these points and commands and their dependencies, with its own digest.

    A word is a code, a name, `group:NAME` or the name of a group, or a pattern such as `d0*`. Raises UnclearError.
    """
    items: set[str] = set()
    commands: set[str] = set()
    unclear: dict[str, UnclearError] = {}
    for word in words:
        try:
            points, commands_of_word = _matches(device, word)
        except UnclearError as error:
            unclear[word] = error
            continue
        items.update(point.item for point in points)
        commands.update(command.name for command in commands_of_word)
    if unclear:
        raise _all_of(unclear)
    kept = tuple(command for command in device.commands if command.name in commands)
    stepped = tuple(command for command in device.stepped_commands if command.name in commands)
    needed = [command.busy for command in kept if command.busy is not None]
    needed += [name for command in stepped for step in command.steps if step.when for name in step.when.names]
    needed += [identification.point for identification in device.identifications]
    return _reduced(device, tuple(_with_dependencies(device, items, needed)), kept, stepped)


def address_only_messages(device: Device, words: Iterable[str]) -> Iterator[str]:
    """Yield a message for each word that names a point whose code is only the address."""
    for word in words:
        reason = next((point.reason for point in _named(device, word) if point.raw_only), None)
        if reason is not None:
            yield f"`{shortened(word)}` comes with its address alone, and no conversion: {reason}"


def _all_of(unclear: Mapping[str, UnclearError]) -> UnclearError:
    """Return one error for all of these words."""
    if len(unclear) == 1:
        return next(iter(unclear.values()))
    quoted = list(unclear.items())[:_MOST_NAMED]
    more = [f"and {len(unclear) - _MOST_NAMED} more"] if len(unclear) > _MOST_NAMED else []
    hints = [f"for `{shortened(word)}`, {error.hint}" for word, error in quoted if error.hint]
    return UnclearError("; ".join([*(error.message for _, error in quoted), *more]), "; ".join(hints))


def _matches(device: Device, word: str) -> tuple[list[Point], list[Command | SteppedCommand]]:
    """Return the points and commands that a word selects. Raises UnclearError."""
    groups = {group.name for group in device.groups}
    if word.startswith("group:") and word.removeprefix("group:") in groups:
        return _of_group(device, word.removeprefix("group:")), []
    if _GLOB.intersection(word) and not _named(device, word):
        points = [point for point in device.points if _is_like(point, word.lower()) and _is_in_code(point)]
        commands = [command for command in device.all_commands if fnmatchcase(command.name, word.lower())]
    else:
        points = _named(device, word)
        commands = [command for command in device.all_commands if command.name == word]
        if points and word in groups:
            raise UnclearError(
                f"`{shortened(word)}` is a point of {device.id} and a group", f"write `name:{word}` or `group:{word}`"
            )
        points = points or _of_group(device, word)
    if not points and not commands:
        raise UnclearError(f"{device.id} has no point, group or command `{shortened(word)}`", _hint(device, word))
    missing = [point for point in points if not _is_in_code(point)]
    if missing:
        reason = missing[0].reason or "it is documented only"
        raise UnclearError(f"`{shortened(word)}` cannot be used in code: {reason}", "leave it out")
    return points, commands


def _named(device: Device, word: str) -> list[Point]:
    """Return the points with this code or name, or this element of an array; a number is not a name."""
    points = [point for point in device.points if point.code is not None and point.code.lower() == word.lower()]
    for query in () if points else (word,) if word.startswith(("code:", "name:")) else (f"code:{word}", f"name:{word}"):
        points += [match.point for match in find(device, query)]
    return list({point.item: point for point in points}.values())


def _of_group(device: Device, group: str) -> list[Point]:
    return [point for point in device.points if point.group == group and _is_in_code(point)]


def _is_in_code(point: Point) -> bool:
    """Return True if code has the point, or at least its address."""
    return point.generated or point.raw_only


def _is_like(point: Point, glob: str) -> bool:
    return any(fnmatchcase(name.lower(), glob) for name in (point.item, point.name, point.code or ""))


def _hint(device: Device, word: str) -> str:
    """Return a hint with similar names of points, groups and commands."""
    others = [*(group.name for group in device.groups), *(command.name for command in device.all_commands)]
    names = [*get_close_matches(word.lower()[:64], others, 2), *near(device, word)[:3]]
    return did_you_mean(list(dict.fromkeys(names))) or f"`fieldscribe list {device.id}` shows them all"


def _with_dependencies(device: Device, items: set[str], named: Iterable[str]) -> list[Point]:
    """Return these points and all their dependencies, which can only be read."""
    by_name = grouped((name, point) for point in device.points for name in {point.item, point.name})
    read: dict[str, Point] = {}
    pending = [name for point in device.points if point.item in items for name in _dependencies(point)]
    pending += named
    while pending:
        for point in by_name.get(pending.pop(), ()):
            if point.item not in items and point.item not in read:
                read[point.item] = _only_read(point)
                pending += _dependencies(read[point.item])
    return [read.get(point.item, point) for point in device.points if point.item in items or point.item in read]


def _dependencies(point: Point) -> Iterator[str]:
    """Yield the names of the points on which scale, limits and existence of this one depend."""
    yield from point.arguments
    if point.when is not None:
        yield from point.when.names
    if point.writable:
        yield from (*point.changes_with, *point.write_with)


def _only_read(point: Point) -> Point:
    """Return the point without writing, whose limits may depend on further points."""
    if not point.readable:
        return point
    outermost = tuple(Interval(*interval.outer) for interval in point.allowed.intervals)
    allowed = replace(point.allowed, intervals=outermost) if point.allowed.moves else point.allowed
    return replace(point, shape=replace(point.shape, access="r"), allowed=allowed, write_place=None)


def _reduced(
    device: Device, points: tuple[Point, ...], commands: tuple[Command, ...], stepped: tuple[SteppedCommand, ...]
) -> Device:
    names = {point.name for point in points}
    groups = {point.group for point in points}
    kept = {each.name for each in commands} | {each.name for each in stepped}
    counted = {point.base for point in points} | {step.base for command in stepped for step in command.steps}
    bases = tuple(base for base in device.bases if base.name in counted)
    command_places = {f"command:{command.name}" for command in device.all_commands if command.name not in kept}
    reduced = replace(
        device,
        points=points,
        groups=tuple(group for group in device.groups if group.name in groups),
        enums=_enums_of(device, points),
        blocks=_blocks(device, points),
        commands=commands,
        given=tuple(each for each in device.given if any(each.name in base.wanted for base in bases)),
        found=device.found if any(base.block is not None for base in bases) else None,
        bases=bases,
        stepped_commands=stepped,
        frames=tuple(frame for frame in device.frames if names.issuperset(frame.meaning)),
        errata=tuple(
            erratum
            for erratum in device.errata
            if names.intersection(erratum.points)
            or not (erratum.points or str(erratum.where) in command_places or _is_about_others(erratum))
        ),
    )
    return with_digest(reduced, for_code(reduced))[0]


def _is_about_others(erratum: Erratum) -> bool:
    """Return True if the erratum only leaves open which further points the device has."""
    return {fact for fact, _ in erratum.leaves_open} == {"points"}


def _enums_of(device: Device, points: Iterable[Point]) -> tuple[Enum, ...]:
    used = {enum.name for point in points if (enum := point.named_numbers)}
    return tuple(enum for enum in device.enums if enum.name in used)


def _blocks(device: Device, points: Sequence[Point]) -> Mapping[str, tuple[Block, ...]]:
    """Return the reads of each group, planned for the remaining points."""
    reading = family(device.family).part("reading")
    if reading is None:
        return {}
    members = {group: [point for point in points if point.group == group] for group in device.blocks}
    planned = {
        group: reading.READING.blocks(device.bus, of_group, device.variants) for group, of_group in members.items()
    }
    return {group: blocks for group, blocks in planned.items() if blocks is not None}
