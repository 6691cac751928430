"""The C target: a header of the points, a header of the frames, and a conformance program."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.device import device_view
from fieldscribe.targets.c.families import frames_of
from fieldscribe.targets.c.fold import folded
from fieldscribe.targets.c.identifiers import device_name_taken, identifiers

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Device
    from fieldscribe.render import Render

FOR_PEOPLE = False
NEEDS_FAMILY = True


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """The generated files: path relative to the output folder, and text."""
    from fieldscribe.targets.c.conformance import conformance_view

    view, scope = device_view(device)
    yield f"c/{device.id}.h", folded(render("c/device.h.j2", {"device": view}))
    frames = frames_of(device)
    bus = frames.bus_view(device, view, scope)
    context = {"device": view, "bus": bus}
    yield f"c/{device.id}_{device.family}.h", folded(render(f"c/{device.family}.h.j2", context))
    suite = conformance_view(device, view, scope, frames.adapters(bus))
    program = render(f"c/{device.family}_conformance.c.j2", {**context, "suite": suite})
    yield f"c/conformance/{device.id}_conformance.c", folded(program)


def runtime(device: Device) -> Iterator[tuple[str, str]]:
    """The real source files beside the output: output path, and path under the templates."""
    for name in ("", f"_{device.family}", "_conformance", f"_conformance_{device.family}"):
        yield f"c/fieldscribe{name}.h", f"c/runtime/fieldscribe{name}.h"


__all__ = ["FOR_PEOPLE", "device_name_taken", "identifiers", "outputs", "runtime"]
