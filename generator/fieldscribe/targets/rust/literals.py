"""Rust types and literals, with digits grouped as clippy requires."""

from functools import lru_cache

from fieldscribe.arithmetic.exact import float_of, pattern_of
from fieldscribe.arithmetic.words import ends_of
from fieldscribe.model import Shape
from fieldscribe.text import pascal

RESERVED = frozenset(
    {"Self", "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do"}
    | {"dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop"}
    | {"macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static"}
    | {"struct", "super", "trait", "true", "try", "type", "typeof", "union", "unsafe", "unsized", "use"}
    | {"virtual", "where", "while", "yield"}
)
"""The reserved words of the language."""

RAW_TYPES = {
    "bit": "u8",
    **{f"u{bits}": f"u{bits}" for bits in (8, 16, 32, 64)},
    **{f"s{bits}": f"i{bits}" for bits in (8, 16, 32, 64)},
    "f32": "u32",
    "f64": "u64",
}
"""The Rust type of a raw number by wire type; a plain bit is a `bool`."""

FLOAT_GREATEST = {32: 3.4028234663852886e38, 64: 1.7976931348623157e308}
"""The greatest finite number of a binary floating-point type by its bits."""

_HIDDEN = frozenset({"Err", "None", "Ok", "Option", "Result", "Some", "Self"})
"""Names that generated code uses everywhere in their meaning of the prelude."""

_PRELUDE = (
    _HIDDEN
    | {"AsMut", "AsRef", "Box", "Clone", "Copy", "Debug", "Default", "DoubleEndedIterator", "Drop", "Eq", "Extend"}
    | {"ExactSizeIterator", "Fn", "FnMut", "FnOnce", "From", "FromIterator", "Hash", "Into", "IntoIterator", "Iterator"}
    | {"Ord", "PartialEq", "PartialOrd", "Send", "Sized", "String", "Sync", "ToOwned", "ToString", "TryFrom", "TryInto"}
    | {"Unpin", "Vec"}
)
"""Names that a type of ours must not hide."""

_OF_CRATE = frozenset(
    {"Access", "AsyncClient", "AsyncTransport", "BitGroup", "Block", "Client", "ClientError", "Coded", "Command"}
    | {"CountReadable", "CountWritable", "Dialogue", "Encodable", "Error", "FixedBits", "Frame", "Framing"}
    | {"Function", "Link", "Listener", "LocalClient", "LocalTransport", "Message", "Point", "PointInfo", "Profile"}
    | {"Readable", "Reading", "Receiver", "ReplyError", "Scaled", "Space", "Special", "Task", "Transport", "Whole"}
    | {"Writable"}
)
"""Names at the root of every crate, or of those of a family."""

_NOT_RAW = frozenset({"crate", "self", "super", "Self"})
_UNGROUPED = 10_000


def raw_type(shape: Shape) -> str:
    """Return the Rust type of the raw number of points of that shape."""
    if shape.text is not None:
        return f"[u16; {shape.words}]"
    return "bool" if shape.form == "bit" else RAW_TYPES[shape.type]


@lru_cache(maxsize=32)
def type_range(rust_type: str) -> tuple[int, int]:
    """Return the least and the greatest number of a Rust integer type or `bool`."""
    if rust_type == "bool":
        return 0, 1
    return ends_of(int(rust_type[1:]), signed=rust_type[0] == "i")


@lru_cache(maxsize=65536)
def type_name(name: str) -> str:
    """Return the name of a type: `BaseFrequency`; changed if the prelude has that name."""
    result = pascal(name)
    return f"{result}_" if result in _PRELUDE else result


def device_type(name: str) -> str:
    """Return the name of a device's type: `HitachiL200`; changed if its crate has an item of that name already."""
    result = type_name(name)
    return f"{result}Device" if result in _OF_CRATE else result


@lru_cache(maxsize=65536)
def variant_name(name: str) -> str:
    """Return the name of an enum's variant: `ForwardAndReverse`; only a few names would hide others there."""
    result = pascal(name)
    return f"{result}_" if result in _HIDDEN else result


@lru_cache(maxsize=65536)
def value_name(name: str) -> str:
    """Return the name of a function, a field or a local; a raw identifier if Rust reserves the word."""
    if name not in RESERVED:
        return name
    return f"{name}_" if name in _NOT_RAW else f"r#{name}"


def integer(number: int) -> str:
    """Return a decimal literal: `4000`, `-70_000`."""
    return str(number) if -_UNGROUPED < number < _UNGROUPED else f"{number:_}"


def raw_literal(number: int, rust_type: str) -> str:
    """Return a raw number as a literal of its type."""
    return ("true" if number else "false") if rust_type == "bool" else integer(number)


@lru_cache(maxsize=4096)
def mask(number: int, rust_type: str) -> str:
    """Return a mask in hexadecimal, as wide as its type: `0x0030`, `0x0000_0001`."""
    digits = int(rust_type[1:]) // 4
    text = f"{number:0{digits}X}"
    return "0x" + "_".join(text[at : at + 4] for at in range(0, digits, 4))


def nearest_float(number: float, bits: int) -> float:
    """Return the binary32 or binary64 nearest to a number; the largest one instead of infinity."""
    if bits == 64:
        return number
    try:
        return float_of(pattern_of(number, 32), 32)
    except OverflowError:
        return FLOAT_GREATEST[32] if number > 0 else -FLOAT_GREATEST[32]


@lru_cache(maxsize=4096)
def float_literal(number: float) -> str:
    """Return a binary64 literal that reads back as the same number: `10.0`, `0.1`, `1e20`."""
    mantissa, _, exponent = repr(float(number)).partition("e")
    whole, point, fraction = mantissa.partition(".")
    text = integer(int(whole)) if whole.strip("-") != "0" else whole
    if point and not (exponent and fraction == "0"):
        text += "." + "_".join(fraction[at : at + 3] for at in range(0, len(fraction), 3))
    return f"{text}e{int(exponent)}" if exponent else text
