"""The C target: a header of the points, a header of the frames, and a conformance program."""

from collections.abc import Iterable, Iterator
from io import StringIO
from itertools import chain
from typing import Literal

from fieldscribe.model import Device
from fieldscribe.resources import Render
from fieldscribe.targets.c.frames import frames_of
from fieldscribe.targets.c.header import has_dates, header, header_context
from fieldscribe.targets.c.identifiers import device_name_taken, identifiers
from fieldscribe.targets.c.layout import framed
from fieldscribe.targets.c.point_templates import generated_points
from fieldscribe.targets.c.scope import scope_of

FAMILY_PART = "targets.c"
WEIGHT = 0.9
BEFORE_POINTS = ("", "read", "write", "store")

_HERE = "\0"
"""Placeholder for the functions of points: no text of a description holds it."""

FramesPart = Literal["all", "constants", "calls"]
"""What the header of frames holds."""


def outputs(
    device: Device, render: Render, *, tests: bool = True, frames: FramesPart = "all", rows: bool = False
) -> Iterable[tuple[str, str]]:
    """Yield the headers of points and frames, and the conformance program: path below the output folder, and text.

    With `constants` the header of frames has only constants, or is left out if the family has no facts header; with
    `calls` it leaves out the descriptors of points that calls read and write. With `rows` there is a header of macros
    that are rows of tables.
    """
    scope = scope_of(device)
    scope.calls_only = frames == "calls"
    exchanges = frames != "constants"
    points = generated_points(device, scope)
    own, bus = header_context(device, points, scope), frames_of(device).header(device, points, scope)
    context, sections = {"device": own, "bus": bus.context, "exchanges": exchanges}, bus.sections
    if scope.calls_only:
        scope.left_out = lambda view: set[str]().union(*(section.left_out(view) for section in sections.values()))
    yield f"c/{device.id}.h", header(device, own, points, scope, render)
    if not exchanges and not frames_of(device).has_facts:
        return
    texts = {name: section.text(render, scope if exchanges else None) for name, section in sections.items()}
    frames_text = framed(render, f"c/{device.family}.h.j2", context, texts)
    del texts  # megabytes of a large device, which are in the text above
    yield f"c/{device.id}_{device.family}.h", frames_text
    del frames_text
    if rows and (macros := "".join(section.rows(scope) for section in sections.values())):
        yield f"c/{device.id}_rows.h", framed(render, f"c/{device.family}_rows.h.j2", context, {"rows": macros})
    if tests:
        from fieldscribe.targets.c.conformance import adapters, suite_context

        suite = {**context, "suite": suite_context(device, points, scope)}
        frame = framed(render, f"c/{device.family}_conformance.c.j2", suite, {"adapters": _HERE})
        before, _, after = frame.partition(_HERE)
        program = StringIO()  # the largest file: it is never in memory twice
        program.writelines(chain((before,), adapters(points, scope, sections.values(), render), (after,)))
        yield f"c/conformance/{device.id}_conformance.c", program.getvalue()


def runtime(device: Device, *, tests: bool = True, frames: FramesPart = "all") -> Iterator[tuple[str, str]]:
    """Yield the source files beside them: path below the output folder, and path below the templates."""
    names = ["fieldscribe.h"]
    names += ["fieldscribe_dates.h"] * has_dates(device)
    names += [f"fieldscribe_{device.family}_facts.h"] * frames_of(device).has_facts
    names += [f"fieldscribe_{device.family}_steps.h"] * bool(device.stepped_commands)
    names += [f"fieldscribe_{device.family}.h"] * (frames != "constants")
    identifies = frames != "constants" and frames_of(device).identifies(device)
    names += [f"fieldscribe_{device.family}_identify.h"] * identifies
    names += ["fieldscribe_conformance.h", f"fieldscribe_conformance_{device.family}.h"] * tests
    for name in names:
        yield f"c/{name}", f"c/runtime/{name}"


__all__ = ["device_name_taken", "identifiers", "outputs", "runtime"]
