"""Commands as rows beside the points: constant writes that make the device do something."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families import family
from fieldscribe.targets.docs.bus import part_of
from fieldscribe.targets.docs.tables import original, source_cells
from fieldscribe.wording import title_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Command, Device
    from fieldscribe.targets.docs.tables import Encode


def command_cells(command: Command, device: Device, encode: Encode) -> Mapping[str, str]:
    """The cells of a command's row, by column."""
    numbers = part_of(device).numbers(command.space, command.address)
    value = "" if command.value is None else str(command.value)
    is_bit = family(device.family).spaces[command.space] == "bit"
    return {
        "name": encode(command.name),
        "kind": "command",
        "title": encode(command.title["en"]),
        "title_original": encode(original(command.title)),
        "space": encode(command.space),
        "address": str(command.address),
        "address_hex": hex_text(command.address),
        "words": "1",
        **{name: str(number) for name, number in numbers.items()},
        "computed": " ".join(numbers),
        "type": "bit" if is_bit else "u16",
        "encoding": "bit" if is_bit else "integer",
        "access": "w",
        "raw_min": value,
        "raw_max": value,
        "remarks": encode("; ".join(_remarks(command))),
        "note": encode(title_text(command.note)) if command.note else "",
        **dict(zip(("document", "section", "page", "line"), source_cells(command.source, encode), strict=True)),
        "generated": "yes",
    }


def _remarks(command: Command) -> Iterator[str]:
    yield f"{wanted_text(command)} with function {hex_text(command.function, 2)}"
    if command.wears is not None:
        yield f"the memory stands {command.wears} writes"
    if command.busy:
        yield f"busy while {command.busy}"


def wanted_text(command: Command) -> str:
    """Which number is written: `write 1150`."""
    return f"write {'any number' if command.value is None else command.value}"
