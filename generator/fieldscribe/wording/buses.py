"""Sentences that every family needs: about units, places, and words as manuals print them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.model import Bus, Code

ALL_ELEMENTS = 255


def units_text(bus: Bus) -> str:
    """Which units the device may have: `units are 1 to 32`."""
    low, high = bus.units
    return f"units are {low} to {high}"


def strange_unit(bus: Bus, unit: int) -> str:
    """That no device has a unit number; empty if one may have it."""
    low, high = bus.units
    return "" if low <= unit <= high else f"the device cannot have unit {unit}: {units_text(bus)}"


def words_text(words: Sequence[int]) -> str:
    """Words as manuals print them: `0001h FFFFh`."""
    return " ".join(f"{word:04X}h" for word in words)


def counted(number: int, what: str) -> str:
    """`1 word`, `2 words`."""
    return f"{number} {what}{'' if number == 1 else 's'}"


def here_are(number: int, what: str = "") -> str:
    """How many there are, against how many there should be: `here is 1`, `here are 3 bytes`."""
    return f"here {'is' if number == 1 else 'are'} {counted(number, what) if what else number}"


def span_text(low: int, high: int) -> str:
    """Addresses in both notations: `1028h (4136)`, `1013h to 1014h (4115 to 4116)`."""
    return f"{hex_text(low)} ({low})" if low == high else f"{hex_text(low)} to {hex_text(high)} ({low} to {high})"


def element_text(parameter: int, index: int, *, alone: bool) -> str:
    """`parameter 1082`, `parameter 2010, index 1`; `alone`: no point there is one of several elements."""
    beside = f", all elements (index {index})" if index == ALL_ELEMENTS else f", index {index}"
    return f"parameter {parameter}" + ("" if index == 0 and alone else beside)


def numbered(codes: Sequence[Code], number: int) -> Code | None:
    """The code of that number."""
    return next((code for code in codes if code.number == number), None)


def word_text(addresses: tuple[int, ...], address: int, *, text: bool = False) -> str:
    """Which word of a point an address is: `low word (2 of 2)`; empty for a point of one word."""
    count = len(addresses)
    if count < 2 or address not in addresses:
        return ""
    place = addresses.index(address)
    if text:
        return f"word {place + 1} of {count}, the first characters first"
    name = {0: "high word", count - 1: "low word"}.get(place, "word")
    return f"{name} ({place + 1} of {count}, the high part first)"
