"""All identifiers in the headers of a device, in the one namespace of C."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.defines import flag_defines
from fieldscribe.targets.c.device import STATUSES, device_view, function_names
from fieldscribe.targets.c.families import frames_of
from fieldscribe.targets.c.frames import old_names_of
from fieldscribe.targets.c.points import named_numbers
from fieldscribe.targets.c.special_codes import FUNCTIONS, special_defines
from fieldscribe.targets.identifiers import Names, Owner

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Device, Point, Special
    from fieldscribe.targets.c.views import DeviceView, PointView
    from fieldscribe.targets.identifiers import Named

_OWN = Owner("target", "what the header needs")

_TYPES = ("status", "real")
_MACROS = ("H", "DESCRIPTION_VERSION", "DESCRIPTION_DIGEST")
_HEADERS = frozenset(
    {"assert", "complex", "ctype", "errno", "fenv", "float", "inttypes", "iso646", "limits", "locale", "malloc", "math"}
    | {"memory", "setjmp", "signal", "stdalign", "stdarg", "stdatomic", "stdbool", "stddef", "stdint", "stdio"}
    | {"stdlib", "stdnoreturn", "string", "strings", "tgmath", "threads", "time", "uchar", "unistd", "wchar", "wctype"}
)
"""Headers of C libraries, which one of the same name in a folder of `-I` hides."""


def device_name_taken(name: str) -> str:
    """Why no header may have that name; empty where it may."""
    return f"would make a header `{name}.h`, which hides the one of the C library" if name in _HEADERS else ""


def identifiers(device: Device) -> Iterator[Names]:
    """All that the headers of a device define."""
    for owner, names in _identifiers(device):
        yield Names("C", owner, names)


def _identifiers(device: Device) -> Iterator[Named]:
    view, scope = device_view(device, names_only=True)
    yield _OWN, [f"{view.prefix}_{name}" for name in _TYPES]
    yield _OWN, [f"{view.upper}_{name}" for name in (*STATUSES, *_MACROS)]
    for telegram, named in zip(device.telegrams, view.telegrams, strict=True):
        yield Owner("telegram", telegram.name), (named.name, named.words_name)
    points = {point.item: point for point in device.points}
    for group in view.groups:
        for made, remark in group.entries:
            if made is None:
                yield Owner("point", remark.item), [name for name, _ in remark.defines]
            else:
                yield from _of_point(made, points[made.item], view)
    yield from old_names_of(view.aliases)
    frames = frames_of(device)
    yield from frames.identifiers(device, frames.bus_view(device, view, scope), scope)


def _of_point(made: PointView, point: Point, device: DeviceView) -> Iterator[Named]:
    owner = Owner("point", point.item)
    names = [*(name for name, _ in made.defines), *function_names(made), *(table.name for table in made.tables)]
    parts = list(_of_parts(made, point, owner)) if point.flags or point.specials else []
    for _, own in parts:
        for name in own:
            names.remove(name)  # once: what the point has beside of the same name is a clash
    yield owner, [*names, f"{made.function}_with"] if made.fields else names
    yield from parts
    if made.special is not None and made.special.codes is not None and point.shared_codes:
        codes, shared = made.special.codes, Owner("special codes", point.shared_codes)
        yield shared, [codes.name + tail for tail in FUNCTIONS]
        for special in point.specials:
            yield (
                Owner("code", special.name, shared),
                _code_names(special, f"{device.upper}_{shared.name.upper()}", point),
            )
    enum = named_numbers(point)
    if made.enum is not None and enum is not None:
        whole = Owner("enum", enum.name)
        yield whole, (made.enum.function, made.enum.table)
        for entry, (name, _, _) in zip(enum.entries, made.enum.entries, strict=True):
            yield Owner("entry", entry.name, whole), (name,)


def _of_parts(made: PointView, point: Point, owner: Owner) -> Iterator[Named]:
    """What a point has for its flags, and for special codes of its own."""
    for flag in point.flags:
        own = [name for name, _ in flag_defines(flag, point, made.macro)]
        yield Owner("flag", flag.name, owner), [*own, f"{made.function}_{flag.name}"] if flag.width > 1 else own
    for special in () if point.shared_codes else point.specials:
        yield Owner("code", special.name, owner), _code_names(special, made.macro, point)


def _code_names(special: Special, macro: str, point: Point) -> list[str]:
    return list(dict.fromkeys(name for name, _ in special_defines(special, macro, point)))
