"""Moves points whose addresses count from a base to where they are, by the numbers that people give."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from fieldscribe.language.numbers import NumberError, parse_integer
from fieldscribe.model import Base, Device, Place, Point, SteppedCommand, Terms
from fieldscribe.text import shortened
from fieldscribe.user_errors import UnclearError

_LAST = 65535


def at_bases(device: Device, pairs: Sequence[str]) -> tuple[Device, list[str]]:
    """Return the device with the points whose base is known at their addresses, and the pairs about other things.

    A pair is `slot=3`, a given number, or `models_103=40070`, the address of a block. Raises UnclearError.
    """
    ranges = {each.name: (each.low, each.high) for each in device.given}
    ranges |= {base.name: (0, _LAST) for base in device.bases if base.block is not None}
    numbers: dict[str, int] = {}
    others = []
    for pair in pairs:
        name, equals, text = (part.strip() for part in pair.partition("="))
        if name not in ranges or not equals:
            others.append(pair)
            continue
        try:
            numbers[name] = parse_integer(text)
        except NumberError as error:
            raise UnclearError(f"{name}: {error.message}", error.hint) from error
        low, high = ranges[name]
        if not low <= numbers[name] <= high:
            raise UnclearError(f"{name} is {low}..{high}, not {shortened(text)}", "")
    starts = {base.name: base.at(numbers) for base in device.bases if numbers.keys() >= set(base.wanted)}
    return moved(device, starts, {}) if starts else device, others


def moved(device: Device, starts: Mapping[str, int], lasts: Mapping[str, int]) -> Device:
    """Return the device with the points of these bases at their addresses; without those behind the last of a block."""
    terms: dict[int, Terms] = {}
    points = []
    for point in device.points:
        base = point.base or ""
        here = _moved(point, starts[base], terms) if base in starts else point
        if base not in lasts or max(here.addresses, default=0) <= lasts[base]:
            points.append(here)
    stepped = tuple([_of_steps(command, starts) for command in device.stepped_commands])
    left = tuple(base for base in device.bases if base.name not in starts)
    return replace(device, points=tuple(points), stepped_commands=stepped, bases=left)


def advice(bases: Iterable[Base]) -> str:
    """Return the options that say where these bases are."""
    names = dict.fromkeys(name for base in bases for name in base.wanted)
    return " ".join(f"--with {name}=NUMBER" for name in names)


def _of_steps(command: SteppedCommand, starts: Mapping[str, int]) -> SteppedCommand:
    """Return the command with the steps whose base is known at their addresses."""
    moved = [
        replace(step, address=starts[step.base] + step.address, base=None)
        if step.base and step.base in starts
        else step
        for step in command.steps
    ]
    return replace(command, steps=tuple(moved))


def _moved(point: Point, start: int, known: dict[int, Terms]) -> Point:
    terms = known.get(id(point.terms)) or known.setdefault(id(point.terms), replace(point.terms, base=None))
    place = Place(tuple([start + address for address in point.addresses]), point.place.references)
    written = point.write_place
    if written is not None:
        written = Place(tuple([start + address for address in written.addresses]), written.references)
    return replace(point, place=place, write_place=written, terms=terms)
