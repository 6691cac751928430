"""What the doc comments of a point say: what it is, where it is, what it means, what is doubtful."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from fieldscribe.model import Device, Erratum, Point, Titles
from fieldscribe.text import rust_doc

_ACCESS = {"r": "read only", "w": "write only", "rw": "read and write", "none": "not reachable"}


def sentence(titles: Titles) -> str:
    """The English title with a full stop."""
    text = rust_doc(titles["en"])
    return text if text.endswith((".", "!", "?")) else f"{text}."


def point_doc(point: Point, errata: Mapping[str, Erratum]) -> tuple[str, ...]:
    """The lines of a point's doc comment, without `///`; an empty line parts paragraphs."""
    lines = [sentence(point.title), "", f"{', '.join(_facts(point))}."]
    if point.note:
        lines += ["", sentence(point.note)]
    for name in point.errata:
        erratum = errata[name]
        lines += ["", rust_doc(f"Erratum {name} ({erratum.certainty}): printed {erratum.printed}; taken {erratum.taken}.")]
    return tuple(lines)


def left_out(device: Device) -> tuple[str, ...]:
    """One line for each point that is only documented."""
    return tuple(
        rust_doc(f"{point.item}{f' ({point.code})' if point.code else ''}: {point.reason}.")
        for point in device.points
        if not point.generated
    )


def _facts(point: Point) -> Iterator[str]:
    if point.code:
        yield rust_doc(point.code)
    words = f"{point.address:04X}h" if point.address is not None else "no address"
    bits = f" bits {point.bits[0]} to {point.bits[1]}" if point.bits else ""
    yield f"{rust_doc(point.space)} {words}{bits}"
    yield f"`{point.type}`"
    if point.unit.symbol:
        yield f"in {rust_doc(point.unit.symbol)}"
    yield _ACCESS.get(point.access, rust_doc(point.access))
    if point.variant:
        yield f"for {rust_doc(point.variant)}"
    if point.when:
        yield f"only when {rust_doc(point.when)}"
