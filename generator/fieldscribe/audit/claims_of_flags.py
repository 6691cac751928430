"""What the flags of a word take from the manual: bits, titles, and what each value means."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from fieldscribe.audit.citing import Citing, numbers_in
from fieldscribe.audit.wordings import joined
from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.wordings import Wordings
    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Flag, Point
    from fieldscribe.resolve.point_facts import PointFacts

LIST_OF_BITS = "list of bits"
"""The fact that a row lists all bits of a word that are flags."""
_LISTED = 3
"""So many bits in a row are no chance."""


def claims_of_flags(citing: Citing, point: Point, draft: PointFacts, wordings: Wordings) -> Iterator[Claim]:
    """Each flag at its bits, with the values that have names."""
    above = point.bits[1] if point.bits else 0
    always = point.fixed.bits if point.fixed is not None else 0
    alike = "values" in citing.lines_of_fact  # printed once for all flags
    kind = "values" if alike else "flags"
    for position, flag in enumerate(point.flags):
        place, node = _node_of_flag(draft, flag, above)
        label = wordings.label(node.get("title")) if isinstance(node, Map) else ()
        values = [_label_of_value(node, entry.raw, wordings) for entry in flag.values]
        by_value = any(values)  # the labels of the values stand beside numbers, the title is one of them or none
        printed = node.get("printed", {}) if isinstance(node, Map) else {}
        named = wordings.bits(flag.low + flag.width - 1, flag.low)
        beside: list[Fraction] = []
        for bit in dict.fromkeys((flag.low + flag.width - 1, flag.low)):
            numbers = (
                Fraction(bit + above),
                Fraction(1 << bit),
                Fraction(1 << bit + above),
                Fraction(1 << bit | always),
            )
            beside += numbers_in(printed["bit"]) if "bit" in printed else numbers
            run = _ends_of_run(point, bit)
            between = frozenset(Fraction(end + above) for end in run) if bit not in run else frozenset()
            words = (*named, *joined("bit", bit + above))
            if not label or named or (by_value and not alike):
                in_list = (position, -1) if by_value and not named and bit == flag.low else None
                yield from citing.numbers(
                    "flag values" if in_list else "flags",
                    f"bit {bit + above}",
                    numbers,
                    "flags",
                    between=between,
                    words=() if in_list else words,
                    entry=in_list,
                    place=place,
                )
        at_bit = () if named or (by_value and not alike) else beside
        if not any(set(label) <= set(words) or (label and words and label[0] in words[0]) for words in values):
            ends = numbers_in(printed.get("bit")) or (flag.low + above, flag.low + flag.width - 1 + above)
            own = map(Fraction, ends) if at_bit else ()
            yield from citing.label("flags", label, beside=at_bit, bit=own, entry=(position, 0), place=place)
        if label and flag.width > 1 and not named:
            yield from _ends_of(citing, flag, above, place)
        for key in ("mask", "active"):
            for number in numbers_in(printed.get(key)):
                in_list = (position, 1) if at_bit and key == "mask" else None
                yield from citing.numbers(
                    "flags" if in_list else f"printed {key}",
                    f"{key} {number}",
                    (number,),
                    "flags",
                    entry=in_list,
                    place=place,
                )
        for part, (entry, words) in enumerate(zip(flag.values, values, strict=True)):
            at = (0 if alike else position, part)
            bits = () if alike else beside
            number = Fraction(entry.raw)
            yield from citing.label("flag values", words, kind, beside=(number,), or_beside=bits, entry=at, place=place)
        bare = {entry.raw for entry, words in zip(flag.values, values, strict=True) if not words}
        yield from _rows_of(citing, flag, flag.low + above, bare, place)
        yield from _lines_of_values(citing, flag, flag.low + above, label, values, place)
        yield from _behind_their_name(citing, flag, above, wordings, place)
    yield from _list_of(citing, point, above, draft.span("flags"))


def _behind_their_name(citing: Citing, flag: Flag, above: int, wordings: Wordings, place: Span) -> Iterator[Claim]:
    """The highest bit behind the word `Bit`, where the manual prints most flags so."""
    number = Fraction(flag.low + flag.width - 1 + above)
    yield from citing.numbers(
        "flags",
        f"bit {number}",
        (number,),
        "flags",
        optional=True,
        words=joined("bit", number),
        names=("Bit", *wordings.code("bits")),
        alike="bits behind their name",
        place=place,
    )


def _list_of(citing: Citing, point: Point, above: int, place: Span) -> Iterator[Claim]:
    """The bits of all flags one after the other, where a row lists them: `11 + 10 + 9 + 8`."""
    bits = sorted(Fraction(bit + above) for flag in point.flags for bit in range(flag.low, flag.low + flag.width))
    if len(bits) >= _LISTED:
        shown = ", ".join(map(str, reversed(bits)))
        yield from citing.in_order(
            LIST_OF_BITS, shown, [bits[::-1], bits], "flags", optional=True, tight=True, place=place
        )


def _ends_of(citing: Citing, flag: Flag, above: int, place: Span) -> Iterator[Claim]:
    """The bits at both ends of a flag, beside each other where the manual prints nearly all flags so."""
    high, low = Fraction(flag.low + flag.width - 1 + above), Fraction(flag.low + above)
    shown, run = f"bits {high} and {low}", [(high, low)]
    yield from citing.in_order("flags", shown, run, apart=True, place=place)
    yield from citing.in_order("flags", shown, run, optional=True, alike="parts", place=place)


def _rows_of(citing: Citing, flag: Flag, bit: int, bare: set[int], place: Span) -> Iterator[Claim]:
    """How a table may print a single bit: in the first cell of its row, with both values in it, or as `Bit 8 = 0`."""
    if flag.width > 1 or not flag.values:
        return
    number = Fraction(bit)
    row = frozenset((number,))
    shown = f"row of bit {bit}"
    yield from citing.numbers("flags", shown, row, optional=True, opens=True, alike="rows of bits", place=place)
    for raw in (0, 1):
        value = Fraction(raw)
        optional = raw not in bare
        yield from citing.numbers(
            "flag values",
            f"{flag.name} {raw}",
            (value,),
            "flags",
            optional=optional,
            row=row,
            alike="values in rows",
            place=place,
        )
        run, alike = [[number, value]], f"bits = {raw}"
        yield from citing.in_order(
            "flag values", f"bit {bit} = {raw}", run, "flags", optional=True, alike=alike, tight=True, place=place
        )


def _lines_of_values(  # noqa: PLR0913, PLR0917 - what a line prints of a value
    citing: Citing, flag: Flag, bit: int, titles: tuple[str, ...], values: list[tuple[str, ...]], place: Span
) -> Iterator[Claim]:
    """How a table may print a value of a bit: in a line of its own, as `Bit 8 = 0: input 4 not delayed`."""
    for entry, words in zip(flag.values, values, strict=True) if flag.width == 1 else ():
        lines = tuple(f"{title} {label}" for title in titles for label in words)
        if lines:
            shown, run = f"bit {bit} = {entry.raw}: {lines[0]}", [(Fraction(bit), Fraction(entry.raw))]
            yield from citing.in_order(
                "flag values",
                shown,
                run,
                "flags",
                optional=True,
                tight=True,
                alike="lines of values",
                words=lines,
                place=place,
            )


def _label_of_value(node: Any, raw: int, wordings: Wordings) -> tuple[str, ...]:
    if not isinstance(node, Map):
        return ()
    values = {int(number): entry for key, entry in node.get("values", {}).items() for number in numbers_in(key)}
    values |= {number: node[key] for number, key in enumerate(("zero", "one")) if key in node}
    entry = values.get(raw)
    titles = entry.get("title", entry) if isinstance(entry, Map) else None
    return wordings.label(titles) if isinstance(titles, Map) else ()


def _node_of_flag(draft: PointFacts, flag: Flag, above: int) -> tuple[Span, Any]:
    """Where the description names the bits of a flag, and what it says of them."""
    flags = draft.get("flags")
    if isinstance(flags, Map):
        ends = {flag.low + above, flag.low + above + flag.width - 1}
        key = next((bits for bits in flags if ends == set(numbers_in(bits))), None)
        return (flags.span(), None) if key is None else (flags.key_span(key), flags[key])
    return draft.span("flags"), None


def _ends_of_run(point: Point, bit: int) -> tuple[int, int]:
    """The ends of the run of named bits around a bit."""
    named = {place for flag in point.flags for place in range(flag.low, flag.low + flag.width)}
    low = high = bit
    while low - 1 in named:
        low -= 1
    while high + 1 in named:
        high += 1
    return low, high
