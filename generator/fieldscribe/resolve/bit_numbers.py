"""The numbering of bits in a manual: from 0 or 1, from the lowest or the highest bit. The model counts from 0."""

from typing import NamedTuple

from fieldscribe.diagnostics import Report, Span
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.values import whole_ends

WORD_BITS = 16
"""The bits of a word."""
_NUMBERINGS = {
    "from 0": (0, False),
    "from 1": (1, False),
    "from 0 at the top": (0, True),
    "from 1 at the top": (1, True),
}


class BitNumbers(NamedTuple):
    """The numbering of a number of bits: the number of its first bit, and whether that is the highest one."""

    width: int
    first: int = 0
    from_top: bool = False

    def bit(self, number: int) -> int:
        """Return the bit that the manual numbers so."""
        return self.width - 1 + self.first - number if self.from_top else number - self.first

    def number(self, bit: int) -> int:
        """Return the number that the manual gives a bit."""
        return self.width - 1 + self.first - bit if self.from_top else bit + self.first

    def written(self, high: int, low: int) -> str:
        """Return an interval of bits as text, in the numbers of the manual."""
        return f"{self.number(high)}..{self.number(low)}"

    def range_of(self, text: str, span: Span, report: Report) -> tuple[int, int] | None:
        """Return the highest and the lowest bit that `5..4` or a single number names; None after a finding."""
        ends = whole_ends(text, span, report)
        if ends is None:
            return None
        high, low = map(self.bit, ends)
        if high < low:
            message, hint = f"bits `{text}` run upwards", f"the higher bit comes first: {self.written(low, high)}"
            report.error("range-reversed", message, span, hint)
            return None
        return high, low


def bit_numbers(facts: PointFacts, width: int = WORD_BITS) -> BitNumbers:
    """Return how the manual numbers the bits of a point's word."""
    first, from_top = _NUMBERINGS.get(str(facts.get("bit_numbers")), (0, False))
    return BitNumbers(width, first, from_top)
