"""The C target: a header of the points, a header of the frames, a conformance program, and their identifiers.

All identifiers in the headers of a device share one namespace.
"""

from collections.abc import Iterable, Iterator
from io import StringIO
from itertools import chain
from typing import Literal

from fieldscribe.model import Device, Point
from fieldscribe.resources import Render
from fieldscribe.targets.c.declarations import FUNCTIONS, flag_defines, special_defines
from fieldscribe.targets.c.frames import frames_of, old_names_of
from fieldscribe.targets.c.header import (
    aliases_of,
    has_dates,
    header,
    header_context,
    identification_defines,
    line_defines,
    remark_defines,
    telegrams_of,
)
from fieldscribe.targets.c.limits import ranges_table
from fieldscribe.targets.c.point_views import GeneratedPoint, fields_of, generated_points, names_of, symbols_of
from fieldscribe.targets.c.scope import HeaderScope, PointView, scope_of
from fieldscribe.targets.c.syntax import framed
from fieldscribe.targets.identifiers import Named, Names, Owner
from fieldscribe.text import upper

FAMILY_PART = "targets.c"
WEIGHT = 0.9
BEFORE_POINTS = ("", "read", "write", "store")
_HERE = "\0"
"""Placeholder for the functions of points: no text of a description holds it."""
FramesPart = Literal["all", "constants", "calls"]
"""What the header of frames holds."""
_OWN = Owner("target", "what the header needs")
SIGNIFICANT = 63
"""The characters of a name that every C compiler compares (C99 5.2.4.1, MISRA C 5.1 and 5.4)."""
_VERSION = tuple(f"DESCRIPTION_VERSION{tail}" for tail in ("", "_MAJOR", "_MINOR", "_PATCH", "_NUMBER"))
_MACROS = ("H", *_VERSION, "DESCRIPTION_DIGEST", "DESCRIPTION")
_HEADERS = frozenset(
    {"assert", "complex", "ctype", "errno", "fenv", "float", "inttypes", "iso646", "limits", "locale", "malloc", "math"}
    | {"memory", "setjmp", "signal", "stdalign", "stdarg", "stdatomic", "stdbool", "stddef", "stdint", "stdio"}
    | {"stdlib", "stdnoreturn", "string", "strings", "tgmath", "threads", "time", "uchar", "unistd", "wchar", "wctype"}
)
"""Headers of C libraries: with `-I` to our folder, a header of ours would hide the one of the same name."""


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
    device_context, bus = header_context(device, points, scope), frames_of(device).header(device, points, scope)
    context, sections = {"device": device_context, "bus": bus.context, "exchanges": exchanges}, bus.sections
    if scope.calls_only:
        scope.left_out = lambda view: set[str]().union(*(section.left_out(view) for section in sections.values()))
    yield f"c/{device.id}.h", header(device, device_context, points, scope, render)
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


def device_name_taken(name: str) -> str:
    """Return why no header may have that name; empty if it may."""
    return f"would make a header `{name}.h`, which hides the one of the C library" if name in _HEADERS else ""


def identifiers(device: Device) -> Iterator[Names]:
    """Yield all identifiers that the headers of a device define."""
    for owner, names in _identifiers(device):
        yield Names("C", owner, names, SIGNIFICANT)


def _identifiers(device: Device) -> Iterator[Named]:
    scope = scope_of(device)
    points = generated_points(device, scope, names_only=True)
    yield _OWN, [f"{scope.upper}_{name}" for name in _MACROS]
    yield Owner("target", "times and settings of the line"), [macro for _, macro, _ in line_defines(device, scope)]
    yield Owner("target", "what identifies the device"), [each.macro for each in identification_defines(device, scope)]
    for telegram, name in zip(device.telegrams, telegrams_of(device, scope), strict=True):
        yield Owner("telegram", telegram.name), (name, f"{name}_WORDS")
    yield from _of_points(device, points, scope)
    yield from old_names_of(aliases_of(points, scope))
    yield from frames_of(device).header(device, points, scope).identifiers


def _of_points(device: Device, points: Iterable[GeneratedPoint], scope: HeaderScope) -> Iterator[Named]:
    generated = iter(points)
    for point in device.points:
        if point.generated:
            yield from _of_point(next(generated).view, scope)
        else:
            defines = remark_defines(point, fields_of(point, scope), scope)
            yield Owner("point", point.item), [name for name, _ in defines]


def _of_point(view: PointView, scope: HeaderScope) -> Iterator[Named]:
    point, owner = view.point, Owner("point", view.fields.item)
    names = [*(name for name, _ in view.defines), *(name for name, _ in symbols_of(view))]
    parts = list(_of_parts(view, owner)) if point.flags or point.specials else []
    for _, names_of_part in parts:
        for name in names_of_part:
            names.remove(name)  # only once: another use of the name in the same point is a clash
    yield owner, names
    yield from parts
    for flag, values in view.shared_values:
        for entry, (name, _) in zip(flag.values, values, strict=True):
            yield Owner("entry", entry.name, Owner("enum", flag.enum)), (name,)
    yield from _of_shared(view, scope)
    if view.codes is not None and point.shared_codes:
        shared = Owner("special codes", point.shared_codes)
        yield shared, [view.special + tail for tail in FUNCTIONS]
        yield from _of_codes(point, f"{scope.upper}_{upper(shared.name)}", shared)
    enum = point.named_numbers
    if view.enum is not None and enum is not None:
        whole = Owner("enum", names_of(enum, point, view.fields)[0])
        yield whole, (view.enum.lookup.name, view.enum.table)
        for entry, (name, _, _) in zip(enum.entries, view.enum.entries, strict=True):
            yield Owner("entry", entry.name, whole), (name,)


def _of_shared(view: PointView, scope: HeaderScope) -> Iterator[Named]:
    """Yield the struct, rule and ranges of a point, which others may share; the first of them has its name in them."""
    point = view.point
    if view.struct:
        yield Owner("struct", ", ".join(sorted(point.arguments))), (view.struct,)
    shared = {view.rule.name if view.rule is not None else "", ranges_table(point, scope)}
    yield Owner("point", view.fields.item), sorted(shared & {f"{view.function}_rule", f"{view.function}_ranges"})


def _of_parts(view: PointView, owner: Owner) -> Iterator[Named]:
    """Yield the identifiers for the point's flags, and for special codes of its own."""
    point = view.point
    for flag in point.flags:
        names = [name for name, _ in flag_defines(flag, point, view.macro)]
        names += [f"{view.function}_{flag.name}"] * (flag.width > 1)
        yield Owner("flag", flag.name, owner), names
    if not point.shared_codes:
        yield from _of_codes(point, view.macro, owner)


def _of_codes(point: Point, macro: str, owner: Owner) -> Iterator[Named]:
    for special in point.specials:
        names = dict.fromkeys(name for name, _ in special_defines(special, macro, point))
        yield Owner("code", special.name, owner), tuple(names)
