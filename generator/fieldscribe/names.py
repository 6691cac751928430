"""Identifiers: casing and reserved words, once for all targets."""

from __future__ import annotations

import re
from functools import lru_cache

SNAKE = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*")
"""What a name in a description looks like."""

C_RESERVED = frozenset(
    """alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t class co_await co_return
    co_yield compl concept const consteval constexpr constinit const_cast continue decltype default delete do double dynamic_cast
    else enum explicit export extern false float for friend goto if inline int long mutable namespace new noexcept not not_eq
    nullptr operator or or_eq private protected public register reinterpret_cast requires restrict return short signed sizeof
    static static_assert static_cast struct switch template this thread_local throw true try typedef typeid typename typeof
    typeof_unqual union unsigned using virtual void volatile wchar_t while xor xor_eq""".split()
)
PYTHON_RESERVED = frozenset(
    """False None True and as assert async await break case class continue def del elif else except finally for from global if
    import in is lambda match nonlocal not or pass print raise return self try type while with yield _""".split()
)
RUST_RESERVED = frozenset(
    """Self abstract as async await become box break const continue crate do dyn else enum extern false final fn for gen if impl in
    let loop macro match mod move mut override priv pub ref return self static struct super trait true try type typeof union
    unsafe unsized use virtual where while yield""".split()
)


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
