"""Builds the Modbus requests that read and write a point, for `encode` and as examples for `explain`."""

from collections.abc import Iterator, Mapping

from fieldscribe.arithmetic import words
from fieldscribe.arithmetic.codec import Settings
from fieldscribe.arithmetic.words import exchanged, group_mask
from fieldscribe.diagnostics import RefusedError
from fieldscribe.families.frame_results import BuiltFrames, Options, WriteMethod, refused
from fieldscribe.families.modbus import FAMILY, SPACES, framings_of, profile_of
from fieldscribe.families.modbus.frames import Request, build
from fieldscribe.model import Device, Point, Step
from fieldscribe.text import counted
from fieldscribe.wording import label
from fieldscribe.wording.numbers import hex_text, spaced, units_text


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """Return the request that writes a raw number, or several of a long text. Raises RefusedError."""
    del settings  # a request carries only the point
    requests = write_requests(device, point, raw, options.unit, options.framing)
    return BuiltFrames(tuple(spaced(data) for _, data in requests))


def words_of(point: Point, raw: int, addresses: tuple[int, ...]) -> tuple[int, ...]:
    """Return the unsigned words (or the bit) of a raw number, in ascending order of their addresses."""
    if point.type == "bit":
        return (raw,)
    return tuple(word for _, word in sorted(zip(addresses, words.words_of(point, raw, len(addresses)), strict=True)))


def write_requests(
    device: Device, point: Point, raw: int, unit: int | None, framing: str | None
) -> list[tuple[Request, bytes]]:
    """Return the request that writes a raw number, with its bytes; of a long text several. Raises RefusedError."""
    addresses, profile = point.written.addresses, profile_of(device.bus)
    if point.bits is not None:
        mask, bits = exchanged(
            point, group_mask(point), words.pattern_of(point, raw) << point.bits[1] & group_mask(point)
        )
        raise RefusedError(
            "shared_word",
            f"{label(point)} shares its word with other points, so no single request can write it",
            f"read {hex_text(min(addresses))}, replace the bits of mask {hex_text(mask)} "
            f"by {hex_text(bits)}, and write the word back",
        )
    if point.base is not None:
        message = f"the address of {label(point)} counts from a base, and nobody said where that is"
        names = " ".join(f"--with {name}=NUMBER" for name in _wanted(device, point))
        raise RefusedError("missing", message, f"give {names}")
    values = words_of(point, raw, addresses)
    function = profile.write_function(point.space, len(addresses)) or 0
    most, unit = _most(device, point, function, len(values)), device.bus.usual_unit if unit is None else unit
    requests = []
    for at in range(0, len(values), most):
        part = values[at : at + most]
        request = Request(unit, function, min(addresses) + at, len(part), part)
        status, data = build(profile, framing or profile.framings[0], request)
        if status != "ok":
            raise refused(device.bus, point, status, _hint(device, status))
        requests.append((request, data))
    return requests


def _most(device: Device, point: Point, function: int, count: int) -> int:
    """Return how many items of a point one request carries: all, or for a long text as many as the function allows."""
    return count if point.text is None else min(count, profile_of(device.bus).most.get(function, count))


def _in_parts(device: Device, point: Point, function: int, count: int) -> str:
    most = _most(device, point, function, count)
    return "" if count <= most else f" in {-(-count // most)} requests"


def _hint(device: Device, status: str) -> str:
    if status == "bad_framing":
        return f"it speaks {' and '.join(framings_of(device.bus))}"
    if status == "bad_unit" and device.bus.broadcast is not None:
        return f"{units_text(device.bus)}, or {device.bus.broadcast} for all units at once"
    return ""


def read_text(device: Device, point: Point) -> str:
    """Return how to read the point: function, count, and a request in hexadecimal; empty if it cannot be read."""
    if point.space not in SPACES:
        return ""
    function, count = SPACES[point.space].read, len(point.addresses)
    how = f"function {hex_text(function, 2)}, {counted(count, FAMILY.spaces[point.space])}"
    if point.place.is_scattered:
        return f"{how}, which are not neighbours: in several requests"
    if parts := _in_parts(device, point, function, count):
        return how + parts
    return how if point.base else how + _example(device, function, min(point.addresses), count, ())


def frames_of_step(device: Device, step: Step, arguments: Mapping[str, int]) -> Iterator[str]:
    """Yield the requests of a step to the usual unit; bits that the step keeps are 0. None for an unknown base."""
    words = tuple(word.of(arguments) for word in step.words)
    for function, values in ((step.read, ()), (step.write, words)):
        if function is not None and step.base is None:
            request = Request(device.bus.usual_unit, function, step.address, len(words), values)
            yield spaced(build(profile_of(device.bus), framings_of(device.bus)[0], request)[1])


def way_to_write(device: Device, point: Point) -> WriteMethod | None:
    """Return how to write the point; None if it cannot be written."""
    addresses = point.written.addresses
    known = point.space in SPACES
    function = profile_of(device.bus).write_function(point.space, len(addresses)) if known else None
    if function is None:
        return None
    how = f"function {hex_text(function, 2)}{_in_parts(device, point, function, len(addresses))}"
    if point.bits is not None:
        steps = "read the word first, replace the bits and write it back, for other points share the word"
        return WriteMethod(f"{how}; {steps}")
    if point.base is not None:
        return WriteMethod(how)
    first, count = min(addresses), len(addresses)
    return WriteMethod(how, lambda raw: _example(device, function, first, count, words_of(point, raw, addresses)))


def _wanted(device: Device, point: Point) -> list[str]:
    """Return the names of the numbers that must be given to compute the point's address."""
    base = device.base_of(point)
    return [] if base is None else base.wanted


def _example(device: Device, function: int, address: int, count: int, values: tuple[int, ...]) -> str:
    """Return an example request to unit 1, or to the lowest unit if the device cannot be unit 1."""
    unit, profile = device.bus.usual_unit, profile_of(device.bus)
    status, data = build(profile, profile.framings[0], Request(unit, function, address, count, values))
    if status == "bad_function":
        return " (the device does not allow this function)"
    return f"; request to unit {unit} ({profile.framings[0]}): {spaced(data)}" if data else f" (not possible: {status})"
