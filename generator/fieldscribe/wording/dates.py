"""The parts of dates and times as texts, in the words of the description."""

from fieldscribe.model import DatePart, Text

_MONDAY = 6
"""Of weekdays that count from Monday, Sunday is 6 or 7."""


def parts_text(layout: Text) -> str:
    """Return the places of the parts: `year from 2000 in bits 15..8 of word 1, month in bits 7..0 of word 1`."""
    return ", ".join(f"{name_text(part)} in {place_text(part)}" for part in layout.parts)


def name_text(part: DatePart) -> str:
    """Return a part with its base."""
    if part.name == "weekday":
        first, number = ("monday", part.base - _MONDAY) if part.base >= _MONDAY else ("sunday", part.base)
        return f"weekday from {first} {number}"
    return f"{part.name} from {part.base}" if part.base else part.name


def place_text(part: DatePart) -> str:
    """Return the place of a part: `word 2`, or `bits 6..0 of word 1`."""
    high, low = part.bits
    bits = "" if part.width == 16 else f"bits {high}..{low} of " if high > low else f"bit {low} of "
    return f"{bits}word {part.word + 1}"
