"""Identifiers: casing and reserved words, once for all targets."""

from __future__ import annotations

from functools import lru_cache

PYTHON_RESERVED = frozenset(
    {
        "False",
        "None",
        "True",
        "and",
        "as",
        "assert",
        "async",
        "await",
        "break",
        "case",
        "class",
        "continue",
        "def",
        "del",
        "elif",
        "else",
        "except",
        "finally",
        "for",
        "from",
        "global",
        "if",
        "import",
        "in",
        "is",
        "lambda",
        "match",
        "nonlocal",
        "not",
        "or",
        "pass",
        "print",
        "raise",
        "return",
        "self",
        "try",
        "type",
        "while",
        "with",
        "yield",
        "_",
    }
)
RUST_RESERVED = frozenset(
    {
        "Self",
        "abstract",
        "as",
        "async",
        "await",
        "become",
        "box",
        "break",
        "const",
        "continue",
        "crate",
        "do",
        "dyn",
        "else",
        "enum",
        "extern",
        "false",
        "final",
        "fn",
        "for",
        "gen",
        "if",
        "impl",
        "in",
        "let",
        "loop",
        "macro",
        "match",
        "mod",
        "move",
        "mut",
        "override",
        "priv",
        "pub",
        "ref",
        "return",
        "self",
        "static",
        "struct",
        "super",
        "trait",
        "true",
        "try",
        "type",
        "typeof",
        "union",
        "unsafe",
        "unsized",
        "use",
        "virtual",
        "where",
        "while",
        "yield",
    }
)

RUST_CONSTANTS = frozenset(
    {"name", "code", "space", "address", "words", "unit", "raw_min", "raw_max", "shift", "mask"}
    | {"decimals", "read_function", "write_function", "write_address", "access", "group", "info"}
    | {"telegram", "index", "addresses", "codes", "numbers", "fixed_bits", "fixed_mask", "floating"}
    | {"is_grouped", "is_closed", "is_contiguous", "is_wide", "raw_reach", "scale"}
)
"""Associated constants of the Rust point traits, which a name of the author would hide."""

RUST_UNKNOWN = ("Unknown", "Other", "Unnamed", "Number")
"""What a Rust enum calls numbers without a name: the first that no entry takes."""


@lru_cache(maxsize=65536)
def pascal(name: str) -> str:
    """`base_frequency` as `BaseFrequency`; digits that would run together keep an underscore (`a_1_2` is `A1_2`)."""
    parts = name.split("_")
    result = parts[0].capitalize()
    for part in parts[1:]:
        joined_digits = part[:1].isdigit() and result[-1:].isdigit()
        result += ("_" if joined_digits else "") + part.capitalize()
    return result


@lru_cache(maxsize=65536)
def upper(name: str) -> str:
    """`base_frequency` as `BASE_FREQUENCY`."""
    return name.upper()
