"""The comment above a point: what users of the code must know. It has names and numbers, no titles and notes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.fold import folded
from fieldscribe.targets.c.layout import WIDTH, filled
from fieldscribe.text import c_comment
from fieldscribe.wording import (
    codes_text,
    condition_text,
    display_text,
    range_text,
    raw_range_text,
    resolution_text,
    width_texts,
    with_unit,
)
from fieldscribe.wording.exact import exact

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.words import Words


def comment_text(point: Point, words: Words, scope: HeaderScope, remark: str = "") -> str:
    """Code, name, range, unit, step, access, space and default; rare facts; errata that changed one of these."""
    head = f"{words.code_said} {words.said}" if words.code_said else words.said
    return f"{head}: {'; '.join((*_facts(point, words, scope), *([c_comment(remark)] if remark else [])))}"


def laid_out(text: str) -> str:
    """The comment of that text: on one line if it fits."""
    single_line = f"/* {text} */"
    if len(single_line) <= WIDTH:
        return single_line
    return folded("\n".join(("/*", *filled(text.split(" "), " ", " * "), " */")))


def _facts(point: Point, words: Words, scope: HeaderScope) -> Iterator[str]:
    if point.untyped is None:
        yield from filter(None, (words.range, *map(c_comment, _steps(point))))
    spaces = (point.space,) if scope.spaces.get(point.group) is None else ()
    references = zip(point.references, words.references[::2], strict=True)
    yield ", ".join((point.access, *spaces, *(f"{key} {number}" for key, number in references)))
    if point.display is not None:
        yield display_text(point)
    if words.default:
        yield f"default {words.default}"
    yield from map(c_comment, _rare_facts(point, scope))


def _rare_facts(point: Point, scope: HeaderScope) -> Iterator[str]:
    if point.when is not None:
        yield f"exists only when {condition_text(point.when, scope.points)}"
    yield from width_texts(point)
    if point.specials:
        yield codes_text(point)
    if any(flag.width == 1 and flag.active == 0 for flag in point.flags):
        yield "exclusive or with ACTIVE_LOW_MASK makes every bit 1 whose name is true, and back"
    errata = [erratum for erratum in point.errata if erratum in scope.errata]
    if errata:
        yield f"errat{'a' if len(errata) > 1 else 'um'} {', '.join(errata)}"


def range_words(point: Point) -> str:
    """The range in the unit, or in raw numbers where values cannot be given."""
    if point.text is not None:
        return f"{point.text.characters} characters, {point.text.encoding}"
    if point.digits is not None:
        return f"{point.digits.count} digits, the highest first"
    units = range_text(point)
    raws = "" if units else raw_range_text(point)
    return units or (f"raw {raws}" if raws else "")


def _steps(point: Point) -> Iterator[str]:
    """The unit of one count, and the steps of the device where they are coarser."""
    if point.form != "scaled":
        return
    count = "" if point.decimals is None else with_unit(exact(1, 10**point.decimals), point)
    step = resolution_text(point)
    if step and step != count:
        yield f"in steps of {step}"
    if count:
        yield f"{count} a count"
