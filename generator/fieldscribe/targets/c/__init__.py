"""The C target: a header of the points, a header of the frames, and a conformance program."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.device import device_view, header
from fieldscribe.targets.c.families import frames_of
from fieldscribe.targets.c.fold import framed
from fieldscribe.targets.c.identifiers import device_name_taken, identifiers
from fieldscribe.targets.c.kinds import placed_points
from fieldscribe.targets.c.scope import scope_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Device
    from fieldscribe.render import Render

FOR_PEOPLE = False
NEEDS_FAMILY = True
KEEPS_NAMES = True


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """The generated files: path relative to the output folder, and text."""
    from fieldscribe.targets.c.conformance import adapters_text, conformance_view

    scope = scope_of(device)
    placed = placed_points(device, scope)
    view = device_view(device, placed, scope)
    yield f"c/{device.id}.h", header(device, view, placed, scope, render)
    frames = frames_of(device)
    bus = frames.bus_view(device, placed, scope)
    sections = frames.sections(bus)
    context = {"device": view, "bus": bus}
    texts = {name: section.text(render) for name, section in sections.items()}
    yield f"c/{device.id}_{device.family}.h", framed(render, f"c/{device.family}.h.j2", context, texts)
    suite = conformance_view(device, placed, scope)
    adapters = {"adapters": adapters_text(placed, scope, sections.values(), render)}
    program = framed(render, f"c/{device.family}_conformance.c.j2", {**context, "suite": suite}, adapters)
    yield f"c/conformance/{device.id}_conformance.c", program


def runtime(device: Device) -> Iterator[tuple[str, str]]:
    """The real source files beside the output: output path, and path under the templates."""
    for name in ("", f"_{device.family}", "_conformance", f"_conformance_{device.family}"):
        yield f"c/fieldscribe{name}.h", f"c/runtime/fieldscribe{name}.h"


__all__ = ["FOR_PEOPLE", "device_name_taken", "identifiers", "outputs", "runtime"]
