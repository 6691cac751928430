"""What single cells say in words: access, type, the half of a pair of words, bits, and rows that are reserved."""

from __future__ import annotations

import re

from fieldscribe.audit.editions.tables.cell_text import one_line

_ACCESS_WORDS = {
    "r": "r, ro, r/o, read, read only, readonly, lesen, nur lesen, l, get",
    "w": "w, wo, w/o, write, write only, writeonly, schreiben, nur schreiben, set",
    "rw": "rw, r/w, w/r, wr, r w, read/write, read write, read and write, readwrite, lesen/schreiben, l/s, r&w",
    "none": "-, —, –, none, n/a",
}
_TYPE_WORDS = {
    "u16": "u16, uint16, uint, ushort, word, wort, unsigned, unsigned16, unsigned int, unsigned short, unsigned int16, "
    "unsigned integer, 16bit",
    "s16": "s16, int16, sint16, i16, signed, signed16, short, signed int, signed short, signed integer, signed int16",
    "u32": "u32, uint32, udint, dword, doppelwort, ulong, unsigned long, unsigned32, unsigned int32",
    "s32": "s32, int32, sint32, i32, dint, signed long, signed32, signed int32",
    "u64": "u64, uint64, ulint, unsigned64",
    "s64": "s64, int64, lint, signed64",
    "f32": "f32, float, float32, real, single, ieee754, ieee float, real32",
    "f64": "f64, double, float64, lreal",
    "bit": "bit, bool, boolean, binary",
    "u8": "u8, uint8, byte, usint, uchar",
    "s8": "s8, int8, sint",
}
_ACCESS = {word: access for access, words in _ACCESS_WORDS.items() for word in words.split(", ")}
_TYPES = {word: kind for kind, words in _TYPE_WORDS.items() for word in words.split(", ")}
_DOUBTFUL_TYPES = {"int": "is it signed", "integer": "is it signed", "long": "is it signed"}
LONG = frozenset({"long"})
"""Types of two words that do not tell their sign."""
_HALF = re.compile(
    r"[\s,:(\[-]*\b(?P<half>high|low|hi|lo|msw|lsw|msb|lsb|highword|lowword|highwort|lowwort|upper|lower)"
    r"(?:[ -]?(?:byte|word|wort|part|16 ?bits?))?\)?\]?\s*$",
    re.IGNORECASE,
)
_HIGH = ("hi", "ms", "up")
_BITS = re.compile(r"\b(\d{1,2})\s*(?:\+|\.\.+|-|–|bis|to|:|/)\s*(\d{1,2})\b|\b(\d{1,2})\b")
_RESERVED = re.compile(
    r"\W*(?:reserv(?:ed|iert)|nicht (?:verwendet|belegt|benutzt)|not used|unused|spare|intern(?:al)?|frei)\W*",
    re.IGNORECASE,
)
_PLAIN_BIT = re.compile(r"(?:doppel-?|double[ -]?)?bits?\b", re.IGNORECASE)


def access_of(cell: str) -> str | None:
    """r, w, rw or none; None if the cell says nothing that is known."""
    return _ACCESS.get(" ".join(one_line(cell).casefold().split()))


def type_of(cell: str) -> tuple[str | None, str]:
    """The wire type, and what is open about it."""
    plain = " ".join(re.sub(r"[_\-().,]|\bbits?\b", " ", one_line(cell).casefold()).split())
    joined = plain.replace(" ", "")
    known = _TYPES.get(plain) or _TYPES.get(joined)
    return (known, "") if known else (None, _DOUBTFUL_TYPES.get(plain, ""))


def half_of(text: str) -> tuple[str, str]:
    """The text without the words that make it one half of a pair, and which half it is: `high`, `low` or nothing."""
    found = _HALF.search(text)
    if found is None or not text[: found.start()].strip():
        return text, ""
    return text[: found.start()].rstrip(" ,:-"), "high" if found["half"].casefold().startswith(_HIGH) else "low"


def bits_of(bits: str, kind: str) -> str | None:
    """The bits that a row takes of its word, the high one first, as its column of bits or its type says."""
    told = one_line(bits) or (one_line(kind) if _PLAIN_BIT.match(one_line(kind)) else "")
    found = _BITS.search(told)
    if found is None:
        return None
    if found[3]:
        return found[3] if int(found[3]) < 16 else None
    high, low = sorted((int(found[1]), int(found[2])), reverse=True)
    return f"{high}..{low}" if high < 16 and high > low else None


def is_reserved(title: str) -> bool:
    """Whether a title says that the maker keeps the address to itself."""
    return _RESERVED.fullmatch(title) is not None
