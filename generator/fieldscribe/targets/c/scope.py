"""The state of a header while it is built: prefixes, points, shared items already emitted; and literals of C."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import Any

from fieldscribe.arithmetic.exact import pattern_of
from fieldscribe.arithmetic.words import INT32, INT64, UINT64
from fieldscribe.lowered import Lowered, lower
from fieldscribe.model import Device, Point
from fieldscribe.text import upper

VALUE_BOUNDS = {"int32_t": INT32, "int64_t": INT64, "uint64_t": UINT64}
"""The bounds of the types in which values and counts are passed."""

_PATTERNS = {"f32": "u32", "f64": "u64", "text": "u16"}
"""The types that hold floating-point patterns, and one word of a text."""


def wire_kind(point: Point) -> str:
    """Return the type of a point's raw number (of a text: of one word), as the runtime names layouts: `u16`, `bit`."""
    return _PATTERNS.get(point.type, point.type)


def raw_kind(point: Point) -> str:
    """Return the type of a point's raw number, as in the names of the runtime's cores: `u16`, `bool`."""
    return "bool" if point.type == "bit" else wire_kind(point)


def raw_type(point: Point) -> str:
    """Return the C type of a point's raw number (of a text: of one word)."""
    kind = raw_kind(point)
    return kind if kind == "bool" else f"{'int' if kind[0] == 's' else 'uint'}{kind[1:]}_t"


def cast(kind: str, number: str) -> str:
    """Return a number as another type."""
    return f"({kind}){number}" if number.isidentifier() else f"({kind})({number})"


def sign_and_size(point: Point) -> tuple[str, str]:
    """Return two expressions: whether `raw` is negative, and its magnitude."""
    if not point.info.signed:
        return "false", "raw"
    return "raw < 0", "fieldscribe_magnitude(raw)"


@lru_cache(maxsize=65536)
def signed(number: int) -> str:
    """Return a number as a constant for any expression or `#define`, signed if a signed type can hold it."""
    if number > INT64[1]:
        return f"UINT64_C({number})"
    if number >= 0:
        return str(number)
    return f"({number})" if number > INT64[0] else f"({number + 1} - 1)"


@lru_cache(maxsize=65536)
def bare(number: int) -> str:
    """Return a number as a signed constant without brackets, for comparisons and arguments."""
    return str(number) if INT64[0] < number <= INT64[1] else signed(number)


@lru_cache(maxsize=65536)
def unsigned(number: int) -> str:
    """Return a number of 0 or more as an unsigned constant."""
    return f"{number}U" if number < 1 << 32 else f"UINT64_C({number})"


@lru_cache(maxsize=65536)
def hexadecimal(number: int, digits: int = 4) -> str:
    """Return an address or mask as an unsigned constant: `0x1028U`."""
    return f"0x{number:0{digits}X}U" if number < 1 << 32 else f"UINT64_C(0x{number:0{digits}X})"


def float_order(value: float, bits: int) -> int:
    """Return the rank of the nearest binary32 or binary64 among all numbers of its type; 0 and -0 have rank 0."""
    infinity = 0x7F80_0000 if bits == 32 else 0x7FF0 << 48
    try:
        size = min(pattern_of(abs(value), bits), infinity - 1)
    except OverflowError:
        size = infinity - 1
    return -size if value < 0 else size


def real(number: Fraction) -> str:
    """Return the nearest binary64 number as a constant that converts back to the same bits."""
    return repr(number.numerator / number.denominator)


@dataclass(slots=True)
class HeaderScope:
    """The state while the header of a device is built.

    `enums` are the names of enums of points, `digits` of those of decimal digits, `spaces` the space of each group
    whose points all have the same. `shared` are what several points share, each with the first of them. `spelling` has
    the expressions for raw numbers of other points in the function being written. `calls_only` leaves out the
    descriptor of a point that calls read and write; `left_out` returns the names of the functions
    of a view that nobody needs.
    """

    prefix: str
    upper: str
    lowered: Lowered
    digits: frozenset[str]
    enums: frozenset[str]
    spaces: Mapping[str, str | None]
    spelling: str = "{}_raw"
    shared: dict[str, str] = field(default_factory=dict)
    calls_only: bool = False
    left_out: Callable[[Any], set[str]] = lambda _: set()

    @property
    def points(self) -> Mapping[str, Point]:
        """The points by item and by name."""
        return self.lowered.points

    def named_after_first(self, point: str, sort: str, content: str) -> str:
        """Return the name of something shared: the name of the first point that needs this content, then `sort`."""
        return f"{self.prefix}_{self.shared.setdefault(content, point)}_{sort}"

    def is_first(self, point: str, name: str) -> bool:
        """Return True if the point is the first that needs something shared: its text defines it."""
        return self.shared.setdefault(name, point) == point

    def brings(self, point: Point) -> tuple[bool, bool, tuple[str, ...]]:
        """Return the shared items that this point defines: names of numbers, shared codes, shared enums of flags."""
        item, enum, codes = point.item, point.named_numbers, point.shape.shared_codes
        names = enum is not None and self.is_first(item, f"names of {enum.name}")
        wide = dict.fromkeys(flag.enum for flag in point.flags if flag.enum and flag.width > 1)
        flags = [name for name in wide if name not in self.enums and self.is_first(item, f"flags of {name}")]
        return names, bool(codes) and self.is_first(item, f"codes of {codes}"), tuple(flags)

    def struct(self, names: Iterable[str]) -> str:
        """Return the struct for the raw numbers of several points, named after them in alphabetical order."""
        return f"{self.prefix}_with_{'_and_'.join(sorted(names))}"

    def takes(self, names: tuple[str, ...]) -> None:
        """Begin a function that takes the raw numbers of these points, in a struct if there are several."""
        self.spelling = "with->{}_raw" if len(names) > 1 else "{}_raw"

    def parameters(self, point: Point, names: tuple[str, ...]) -> list[str]:
        """Return the parameter for the raw numbers of other points: a number, or a struct if there are several."""
        self.takes(names)
        if len(names) > 1:
            return [f"const {self.struct(point.arguments)} *with"]
        return [f"{raw_type(self.points[name])} {name}_raw" for name in names]

    def raw(self, name: str) -> str:
        """Return the expression for the raw number of another point, in the function being written."""
        return self.spelling.format(name)

    def passed(self, names: tuple[str, ...]) -> tuple[str, ...]:
        """Return the arguments that pass on these raw numbers: `lower_limit_raw`, or `with` for several."""
        return ("with",) if len(names) > 1 else tuple(map(self.raw, names))


def scope_of(device: Device) -> HeaderScope:
    """Return a fresh scope for a device."""
    digits = frozenset(enum.name for point in device.points if point.digits and (enum := point.named_numbers))
    enums = frozenset(enum.name for enum in device.enums)
    return HeaderScope(device.id, upper(device.id), lower(device), digits, enums, _spaces(device))


def _spaces(device: Device) -> dict[str, str | None]:
    """Return the space of each group; None if its points have different ones."""
    spaces: dict[str, str | None] = {}
    for terms in {id(point.terms): point.terms for point in device.points}.values():
        if spaces.setdefault(terms.group, terms.space) != terms.space:
            spaces[terms.group] = None
    return spaces
