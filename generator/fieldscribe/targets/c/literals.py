"""C literals and types. Numbers are written so that their type is right on every machine, also with 16-bit int."""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache

from fieldscribe.arithmetic.exact import pattern_of
from fieldscribe.arithmetic.words import INT32, INT64, UINT64
from fieldscribe.model import Point

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
    """Return a number as a signed constant where one can hold it, ready for any expression or `#define`."""
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
    """Return a number from 0 on as an unsigned constant."""
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
