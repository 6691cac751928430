"""Whole exchanges with a point or a command, blocking and with `await`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from support.vector_file import Vector

from conformance.package import Check, Package, attribute_of, attributes, raw_of, raws_of, same
from conformance.scripts import AsyncScript, Script, now
from conformance.uss import link_of


def _handles(package: Package, vector: Vector) -> list[tuple[Script, Any]]:
    """The point of a device over a script, blocking and with `await`."""
    point = package.point(vector)
    given = dict(one for one in (point.facts.variant, _only(point.facts.only_for)) if one)
    link = (link_of(package, vector),) if "pkw" in vector else ()
    found = []
    for kind, script in ((package.device, Script), (package.awaited, AsyncScript)):
        transport = script(vector, package.can.Frame)
        device = kind(transport, vector["unit"], *link, **given)
        for base, start in vector["starts"].items() if "starts" in vector else ():
            device.set_base(base, int(start), int(vector["lasts"][base]))
        found.append((transport, getattr(device, attribute_of(kind, vector["point"]))))
    return found


def read(package: Package, vector: Vector) -> bool:
    """What reading a point asks, and what it makes of the answer."""
    point, raws = package.point(vector), raws_of(vector)
    raw = raw_of(point, vector)
    value = point.decode(raw, raws) if vector["status"] == "ok" else None
    calls: tuple[tuple[str, Any], ...] = (("read_raw", raw), ("read", value))
    return all(
        same(_ran(package, script, vector, getattr(handle, name)), expected)
        for name, expected in calls
        for script, handle in _handles(package, vector)
    )


def _ran(
    package: Package, script: Script, vector: Vector, function: Callable[..., Any], *arguments: Any, **more: Any
) -> Any:
    """The result of an operation that has the status of the vector, and sent all that it should."""
    status, result = package.outcome(lambda: now(function(*arguments, **more)))
    if status != vector["status"] or not script.done:
        raise AssertionError(f"{status} instead of {vector['status']}: {result}")
    return result if status == "ok" else None


def write(package: Package, vector: Vector, **more: Any) -> bool:
    """What writing a point sends; with `keep` for good."""
    point = package.point(vector)
    raw = raw_of(point, vector)
    for script, handle in _handles(package, vector):
        _ran(package, script, vector, handle.write_raw, raw, **more)
    if hasattr(point, "decode") and getattr(point._form, "encodes", True):
        value = point.decode(raw, raws_of(vector))
        if package.outcome(point.encode, value, raws_of(vector))[0] == "wrong_type":
            return True  # a number of too many bits for a value is written raw alone
        for script, handle in _handles(package, vector):
            _ran(package, script, vector, handle.write, value, **more)
    return True


def store(package: Package, vector: Vector) -> bool:
    """What writing it for good sends."""
    return write(package, vector, keep=True)


def alone(package: Package, vector: Vector) -> bool:
    """What the device takes only with other points: one alone is refused before any request."""
    return write(package, {**vector, "script": [], "needs": {}, "words": []})


def command(package: Package, vector: Vector) -> bool:
    """A named write."""
    for kind, script in ((package.device, Script), (package.awaited, AsyncScript)):
        transport = script({**vector, "needs": {}}, package.can.Frame)
        name = name_of_command(package, vector["command"], package.runtime.Command)
        handle = getattr(kind(transport, vector["unit"]), name)
        _ran(package, transport, vector, handle.send)
    return True


def name_of_command(package: Package, name: str, kind: type) -> str:
    """What a command is called: the plain name may be a point's, a keyword or a method."""
    found = attributes(package.device)
    names = f"{name}_command", name, f"{name}_"
    return next(one for one in names if isinstance(found.get(one), kind))


def _only(only_for: Any) -> tuple[str, Any] | None:
    """One of the values of an axis for which a point exists."""
    return (only_for[0], only_for[1][0]) if only_for else None


def variant(package: Package, vector: Vector) -> bool:
    """A device of each value of an axis, and of no value."""
    axis = vector["axis"]
    link: tuple[Any, ...] = ()
    if "pkw" in vector:
        link = (package.uss.Link(vector["pkw"], package.device.PROFILE.pzd[0]),)
    for kind, script in ((package.device, Script), (package.awaited, AsyncScript)):
        transport = script({**vector, "script": [], "needs": {}}, package.can.Frame)
        others = dict.fromkeys(kind.VARIANTS)
        for value in (None, *vector["choices"]):
            device = kind(transport, vector["unit"], *link, **{_parameter(kind, axis): value})
            if device.variants != {**others, axis: value} or device.unit != vector["unit"]:
                return False
        if kind(transport, vector["unit"], *link).variants != others or not _refuses(kind, transport, vector, link):
            return False
    return bool(list(package.device.VARIANTS[axis]) == vector["choices"])


def _parameter(kind: Any, axis: str) -> str:
    """What the axis is called where a device is made: a name that means something else has an underscore behind it."""
    return axis if axis in kind.__init__.__annotations__ else f"{axis}_"


def _refuses(kind: Any, transport: Script, vector: Vector, link: tuple[Any, ...]) -> bool:
    """Whether a value that is none of the axis is refused with those that are."""
    try:
        kind(transport, vector["unit"], *link, **{_parameter(kind, vector["axis"]): "none of them"})
    except ValueError as error:
        known = f"{vector['axis']} is one of {', '.join(vector['choices'])}, not 'none of them'"
        return str(error) == known
    return False


CHECKS: Mapping[str, Check] = {
    "read": read,
    "write": write,
    "store": store,
    "alone": alone,
    "command": command,
    "variant": variant,
}
"""The checks of this theme by the kind of vector."""
