"""The header of a device: its view, the text of its points, and several headers joined in one file."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import islice, product
from typing import NamedTuple

from fieldscribe import wording
from fieldscribe.model import Device, Point, Variant, Version
from fieldscribe.resources import Render
from fieldscribe.targets.c.declarations import defines, place_defines
from fieldscribe.targets.c.point_views import GeneratedPoint, fields_of, functions_of, symbols_of, texts_of
from fieldscribe.targets.c.scope import AliasView, Define, HeaderScope, PointFields, PointView
from fieldscribe.targets.c.syntax import filled, folded, framed, signed
from fieldscribe.targets.identifiers import head_lines
from fieldscribe.text import c_comment, c_string, upper

_INCLUDE = re.compile(r'^#include "([^"\n]+)".*\n', re.MULTILINE)

_FLOATS = "\0"
"""The mark before the functions in floating point of a point: no text of a description holds it."""

_MOST_OLD_NAMES = 64
"""The most old names of a struct: those of its points multiply."""


def header_context(device: Device, points: Sequence[GeneratedPoint], scope: HeaderScope) -> dict[str, object]:
    """Return the context of the header without its points; `double` says that some values are always double."""
    return {
        "head": head_lines(device, "c", c_comment),
        "title": c_comment(f"{device.vendor} {device.model}"),
        "prefix": scope.prefix,
        "upper": scope.upper,
        "version": device.version,
        "numbers": Version.of(device.version),
        "digest": device.digest[:16],
        "line": line_defines(device, scope),
        "identifications": list(identification_defines(device, scope)),
        "telegrams": list(zip(device.telegrams, telegrams_of(device, scope), strict=True)),
        "aliases": tuple(aliases_of(points, scope)),
        "dates": has_dates(device),
        "doubts": [filled(c_comment(text).split(" "), " ", "   ") for text in wording.open_texts(device.doubts)],
        "double": any(view.computes_in_double for view in dict.fromkeys(each.view for each in points)),
    }


def has_dates(device: Device) -> bool:
    """Return True if code has a date or time in parts."""
    return any(point.generated and point.text is not None and point.text.parts for point in device.points)


def line_defines(device: Device, scope: HeaderScope) -> list[tuple[str, str, str]]:
    """Return the times and settings of the line: name, macro and literal."""
    numbers = device.bus.line_numbers
    return [(name, f"{scope.upper}_{upper(name)}", f"{number}U") for name, number in numbers.items()]


class IdentificationDefine(NamedTuple):
    """A macro that identifies the device or a variant: its name in vectors, its point, and its variant."""

    name: str
    macro: str
    literal: str
    point: str
    variant: Variant | None

    @property
    def check(self) -> str:
        """Return the macro of the conformance program that checks the literal: for a text, or for a raw number."""
        kind = "TEXT" if self.literal.startswith('"') else "RAW"
        return f"{kind}({self.macro})"


def identification_defines(device: Device, scope: HeaderScope) -> Iterator[IdentificationDefine]:
    """Yield the macros that identify the device and its variants."""
    for identification in device.identifications:
        variant = (
            "" if identification.variant is None else f"{identification.variant.axis}_{identification.variant.value}_"
        )
        literals = [*map(signed, identification.raws), *map(c_string, identification.texts)]
        for number, literal in enumerate(literals, 1):
            name = f"identify_{variant}{identification.point}" + (f"_{number}" if len(literals) > 1 else "")
            yield IdentificationDefine(
                name, f"{scope.upper}_{upper(name)}", literal, identification.point, identification.variant
            )


def telegrams_of(device: Device, scope: HeaderScope) -> list[str]:
    """Return the enumerators of the telegrams; a macro with the end `_WORDS` says how many words each has."""
    return [f"{scope.upper}_TELEGRAM_{upper(telegram.name)}" for telegram in device.telegrams]


def header(
    device: Device, context: object, points: Iterable[GeneratedPoint], scope: HeaderScope, render: Render
) -> str:
    """Return the text of `<device>.h`; `context` is that of `header_context`."""
    texts: list[str] = []
    floats: list[str] = []
    for name, of_points in _points_by_group(device, points, scope, render).items():
        if of_points:
            texts.append(folded(render("c/group.h.j2", {"title": _title(name, scope)})))
        parts = [text.partition(_FLOATS) for text in of_points]
        of_points.clear()  # kept twice, these texts would take a tenth of the memory of a run
        texts += [whole for whole, _, _ in parts]
        floats += [floating for _, _, floating in parts]
    sections = {"points": "".join(texts), "floats": "".join(floats)}
    texts.clear()
    return framed(render, "c/device.h.j2", {"device": context}, sections)


def _points_by_group(
    device: Device, points: Iterable[GeneratedPoint], scope: HeaderScope, render: Render
) -> dict[str, list[str]]:
    """Return the texts of each group's points, with their functions in floating point after a mark."""
    texts = texts_of(points, lambda view, _: _point_text(view, scope, render))
    by_group: dict[str, list[str]] = {group.name: [] for group in device.groups}
    for point in device.points:
        terms = point.terms
        text = next(texts) if terms.generated else folded(_remark(point, scope, render))
        by_group.setdefault(terms.group, []).append(text)
    return by_group


def _point_text(view: PointView, scope: HeaderScope, render: Render) -> str:
    """Return the part of the header that is one point, and after a mark its functions in floating point."""
    left_out = scope.left_out(view)
    functions = [function for function in functions_of(view, scope) if function.name not in left_out]
    whole = [function.text for function in functions if not function.floating]
    floats = "".join([f"{function.text}\n" for function in functions if function.floating])
    return folded(render("c/point.h.j2", {"p": view, "functions": whole})) + _FLOATS + folded(floats)


def _title(group: str, scope: HeaderScope) -> str:
    """Return the title of a group: its name, and the space of its points if all have the same."""
    space = scope.spaces.get(group)
    return group.replace("_", " ") + (f" ({space})" if space else "")


def aliases_of(points: Sequence[GeneratedPoint], scope: HeaderScope) -> Iterator[AliasView]:
    """Yield the old names of everything in the header that belongs to renamed points."""
    for point, view, _ in points:
        for old, item in zip(point.was, point.old_items, strict=True) if point.was else ():
            yield from _aliases(view, AliasView(old, item, point.item), scope)
    yield from _aliases_of_structs(points, scope)


def _aliases(view: PointView, old: AliasView, scope: HeaderScope) -> Iterator[AliasView]:
    """Yield the old names of everything that a renamed point has in the header."""
    point = view.point
    fields = view.fields._replace(item=old.old_item, macro=upper(old.old_item))
    function = f"{scope.prefix}_{fields.item}"
    for (name, _), (new, _) in zip(defines(point, fields, scope), view.defines, strict=True):
        yield old._replace(old=name, new=new, sort="NUMBER")
    for name, sort in symbols_of(view):
        yield old._replace(old=function + name.removeprefix(view.function), new=name, sort=sort)
    enum = point.named_numbers
    if view.enum is not None and enum is not None and enum.was:
        before = enum.was[point.was.index(old.was)]
        yield old._replace(old=f"{scope.prefix}_{before}_name", new=view.enum.lookup.name, sort="FUNCTION")
        for entry, (new, _, _) in zip(enum.entries, view.enum.entries, strict=True):
            yield old._replace(old=f"{scope.upper}_{upper(before)}_{upper(entry.name)}", new=new, sort="NUMBER")


def _aliases_of_structs(points: Iterable[GeneratedPoint], scope: HeaderScope) -> Iterator[AliasView]:
    """Yield the old names of structs, whose points may have been renamed alone or together.

    Fields are ordered by name: a struct has no old name under which the order would be different.
    """
    structs = {view.struct: sorted(point.arguments) for point, view, _ in points if view.struct}
    for struct, names in structs.items():
        for chosen in islice(product(*[_names_of(name, scope) for name in names]), 1, _MOST_OLD_NAMES):
            renamed, old = next(name for name in chosen if name.was), [name.old_item for name in chosen]
            if old == sorted(old):
                yield renamed._replace(old=scope.struct(old), new=struct, sort="STRUCT")


def _names_of(name: str, scope: HeaderScope) -> Iterator[AliasView]:
    """Yield the name of a point as a member of a struct, then its old names."""
    point = scope.points[name]
    yield AliasView("", name, point.item)
    for old, item in zip(point.was, point.old_items, strict=True):
        yield AliasView(old, old if name == point.name else item, point.item)


def _remark(point: Point, scope: HeaderScope, render: Render) -> str:
    """Return the comment on a point without code: the reason, and its address if it can be reached raw."""
    fields = fields_of(point, scope, f"not generated: {point.reason or 'documented only'}")
    return render("c/remark.h.j2", {"comment": fields.comment, "defines": remark_defines(point, fields, scope)})


def remark_defines(point: Point, fields: PointFields, scope: HeaderScope) -> tuple[Define, ...]:
    """Return the macros of a point that is not generated."""
    if not point.raw_only:
        return ()
    return *place_defines(point, fields, scope), (f"{scope.upper}_{fields.macro}_WORDS", f"{point.words}U")


def joined(files: Mapping[str, str], device: Device) -> str:
    """Return the headers of a device joined in one text: each follows those that it includes, below its own head."""
    order: dict[str, None] = {}

    def place(name: str) -> None:
        for included in _INCLUDE.findall(files[name]):
            if included in files and included not in order:
                place(included)
        order[name] = None

    for name in files:
        if name not in order:
            place(name)
    lines = (*head_lines(device, "c", c_comment), "", f"All in one file: {', '.join(order)}.")
    head = "".join(f" * {line}\n" for line in lines)
    texts = "".join(f"\n{_without_includes(files[name], files)}" for name in order)
    return f"/*\n{head} */\n".replace(" * \n", " *\n") + texts


def _without_includes(text: str, files: Mapping[str, str]) -> str:
    """Return a header without the `#include` lines of headers above it."""
    return _INCLUDE.sub(lambda match: "" if match[1] in files else match[0], text)
