"""The C target: a header of the points, a header of the frames, and a conformance program."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from fieldscribe.targets.c.frames import frames_of
from fieldscribe.targets.c.header import device_view, header
from fieldscribe.targets.c.identifiers import device_name_taken, identifiers
from fieldscribe.targets.c.layout import framed
from fieldscribe.targets.c.point_templates import generated_points
from fieldscribe.targets.c.scope import scope_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from fieldscribe.model import Device
    from fieldscribe.render import Render
    from fieldscribe.targets.c.frames import Frames
    from fieldscribe.targets.c.point_templates import GeneratedPoint
    from fieldscribe.targets.c.scope import HeaderScope

SEES_TITLES = False
NEEDS_FAMILY = True
NAMES_CONTAIN_POINT = True


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """Yield the generated files: path relative to the output folder, and text."""
    from fieldscribe.targets.c.conformance import adapters_text, conformance_view

    made = _made(device)
    for name, text in _headers(made, render):
        yield f"c/{name}", text
    suite = conformance_view(device, made.points, made.scope)
    adapters = {"adapters": adapters_text(made.points, made.scope, made.sections.values(), render)}
    context = {**made.context, "suite": suite}
    program = framed(render, f"c/{device.family}_conformance.c.j2", context, adapters)
    yield f"c/conformance/{device.id}_conformance.c", program


def runtime(device: Device) -> Iterator[tuple[str, str]]:
    """Yield the real source files beside the output: output path, and path under the templates."""
    for name in (*_runtime(device), "fieldscribe_conformance.h", f"fieldscribe_conformance_{device.family}.h"):
        yield f"c/{name}", f"c/runtime/{name}"


def vendored(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """Return the headers of the points and of the frames, as they lie in a project: name and text."""
    return _headers(_made(device), render)


def vendored_runtime(device: Device) -> Iterator[tuple[str, str]]:
    """Yield what these headers include: name, and path under the templates."""
    for name in _runtime(device):
        yield name, f"c/runtime/{name}"


class _Made(NamedTuple):
    """A device as the headers show it."""

    device: Device
    scope: HeaderScope
    points: Sequence[GeneratedPoint]
    context: Mapping[str, Any]
    sections: Mapping[str, Frames]


def _made(device: Device) -> _Made:
    scope = scope_of(device)
    points = generated_points(device, scope)
    view = device_view(device, points, scope)
    frames = frames_of(device)
    bus = frames.bus_view(device, points, scope)
    return _Made(device, scope, points, {"device": view, "bus": bus}, frames.sections(bus))


def _headers(made: _Made, render: Render) -> Iterator[tuple[str, str]]:
    device, view = made.device, made.context["device"]
    yield f"{device.id}.h", header(device, view, made.points, made.scope, render)
    texts = {name: section.text(render) for name, section in made.sections.items()}
    yield f"{device.id}_{device.family}.h", framed(render, f"c/{device.family}.h.j2", made.context, texts)


def _runtime(device: Device) -> tuple[str, str]:
    return "fieldscribe.h", f"fieldscribe_{device.family}.h"


__all__ = ["SEES_TITLES", "device_name_taken", "identifiers", "outputs", "runtime", "vendored", "vendored_runtime"]
