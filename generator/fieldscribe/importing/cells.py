"""Reads single cells: their plain text, and the address, type, access, range, step, unit or labels that they print.

A function returns None (or an empty result) for a cell that it does not understand completely: nothing is guessed.
"""

import html
import re
from collections.abc import Mapping
from fractions import Fraction
from functools import cache
from typing import NamedTuple

from fieldscribe.language.units import shipped, shipped_unit
from fieldscribe.wording.numbers import number_text

_BREAKS = re.compile(r"\s*<\s*(?:br|/?li|/?ul|/?p)\b[^<>]{0,40}>\s*", re.IGNORECASE)
_TAGS = re.compile(r"<\s*/?\s*[a-zA-Z][^<>]{0,80}>")
_EMPHASIS = re.compile(r"\*\*|__|(?<!\S)\*(?=\S)(?!\d)|(?<=\S)(?<!\d)\*(?!\S)")
_FOOTNOTE = re.compile(r"(?:(?<=\s)|^|(?<=[\w)%]))\*\d\b")
_SPACES = re.compile(r"[ \t\u00a0\u2007\u202f]+")
_HYPHEN = re.compile(r"(?<=[a-zäöüß])-\s*\n\s*(?=[a-zäöüß])|(?<=[a-zäöüß])- (?=[a-zäöüß]{3})(?!und |oder )")
_DASH = re.compile(r"[-—–]{1,3}")

_HEX_MARKED = re.compile(r"0[xX]([0-9A-Fa-f]{1,8})|[Hh]'([0-9A-Fa-f]{1,8})|([0-9A-Fa-f]{1,8})[hH]")
_ADDRESS_PARTS = re.compile(r"[\s/,;()=\[\]]+")
_NUMBER = r"[-+\u2212]?\d{1,15}(?:[.,]\d{1,9})?"
_TO = r"(?:-|–|—|−|\.{2,}|…|~|÷|\bto\b|\bbis(?: zu)?\b|\bthrough\b|\bund\b|\band\b)"
_RANGE = re.compile(
    rf"(?:zwischen |between )?({_NUMBER})\s*(1/[a-z]{{1,4}}|[A-Za-z%‰°µμΩ(][^\s\d;:~…–—-]{{0,15}})??\s*"
    rf"{_TO}\s*({_NUMBER})\s*([^\d\s].*|1/[a-z]+)?"
)
_MAYBE_THOUSANDS = re.compile(r"[-+\u2212]?[1-9]\d{0,2}[.,]\d{3}")
_LIST = re.compile(r"[-+]?\d+(?:\s*(?:,\s|;|/|\||,(?=\d+(?:,|$)))\s*[-+]?\d+)+")
_STEP = re.compile(rf"(?:[x*×·]\s*)?(?:1\s*/\s*(?P<divisor>10{{0,6}})|(?P<number>{_NUMBER}))\s*(?P<unit>.*)")
_UNIT_WORDS = {
    "std": "h", "stunde": "h", "stunden": "h", "hours": "h", "hour": "h", "hrs": "h",
    "sek": "s", "sekunde": "s", "sekunden": "s", "seconds": "s", "second": "s", "sec": "s",
    "minuten": "min", "minute": "min", "minutes": "min", "msec": "ms", "millisekunden": "ms",
    "tage": "d", "days": "d", "grad": "°", "prozent": "%", "percent": "%", "hz": "Hz", "khz": "kHz",
    "volt": "V", "ampere": "A", "amps": "A", "watt": "W", "u/min": "rpm", "1/min": "1/min",
}  # fmt: skip
"""Other spellings of units, in both languages."""

_ACCESS_WORDS = {
    "r": "r, ro, r/o, read, read only, read-only, readonly, lesen, nur lesen, l, get",
    "w": "w, wo, w/o, write, write only, write-only, writeonly, schreiben, nur schreiben, set",
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
_SPACE_WORDS = {
    "coil": r"\bcoils?\b|\b0x{1,4}\b|^fc ?0?1$",
    "discrete": r"discrete|diskret|\b1x{1,4}\b|status inputs?|^fc ?0?2$",
    "input": r"input[- ]reg|eingangsregister|\b3x{1,4}\b|\b0?4h? read input|^input$|^fc ?0?4$",
    "holding": r"holding|halteregister|\b4x{1,4}\b|^fc ?0?3$",
    "parameter": r"^(?:id|pnu|parameter[- ]?(?:id|nr\.?|no\.?|number|nummer|adresse|address))$",
}
"""For each space the words that name it."""
_BITS = re.compile(
    r"(?:doppel-?|double[ -]?)?(?:bits?\s*)?(\d{1,2})(?:\s*(?:\+|\.\.+|-|–|bis|to|:|/)\s*(\d{1,2}))?", re.I
)
_RESERVED = re.compile(
    r"\W*(?:reserv(?:ed|iert)|nicht (?:verwendet|belegt|benutzt)|not used|unused|spare|intern(?:al)?|frei)\W*", re.I
)
_LABEL_LINE = re.compile(
    r"[ \t>(]*(?P<number>0x[0-9A-Fa-f]{1,4}|\d{1,5})\)?\s*(?:\.{2,}|…|:|=(?!=)|[-–](?=\s)|\s(?=\())\s*(?P<label>\S.*)"
)
_LABELS_IN_LINE = re.compile(
    r"(?:^|(?<=[,;)\s]))(?P<number>\d{1,5})\s*(?:=|:)\s*(?P<label>.+?)(?=[,;]?\s+\d{1,5}\s*(?:=|:)|[,;]?\s*$)"
)
_LABELS_IN_BRACKETS = re.compile(r"(?P<number>\d{1,5})\s*\((?P<label>[^()]*[^()\d\s][^()]*)\)[,;\s]*")
_MOST_LABELS, _LONGEST_LABEL = 512, 120


def clean(cell: str) -> str:
    """Return the cell without tags, entities and emphasis; line breaks stay."""
    text = _SPACES.sub(" ", cell).strip()
    if "<" in text:
        text = _TAGS.sub("", _BREAKS.sub("\n", text))
    if "&" in text:
        text = html.unescape(text)
    if "*" in text or "__" in text:
        text = _EMPHASIS.sub("", text)
    return _SPACES.sub(" ", text).strip()


def one_line(cell: str) -> str:
    """Return the cell on one line, with hyphenated words joined and footnote marks such as `*1` removed."""
    return " ".join(_FOOTNOTE.sub("", _HYPHEN.sub("", cell)).split())


def phrase(cell: str) -> str:
    """Return the cell on one line; empty if it is only a dash."""
    plain = one_line(cell)
    return "" if _DASH.fullmatch(plain) else plain


class Address(NamedTuple):
    """A printed number, its value, and whether it is hexadecimal."""

    printed: str
    value: int
    is_hex: bool


def addresses_in(cell: str, *, is_hex: bool) -> list[Address] | None:
    """Return the numbers of a cell that holds only addresses; None for any other cell.

    `10h`, `0x10` and `H'10` are hexadecimal; a number without such a mark is so if `is_hex`.
    """
    addresses = []
    for part in _ADDRESS_PARTS.split(cell):
        marked = _HEX_MARKED.fullmatch(part)
        digits = part if marked is None else marked[1] or marked[2] or marked[3]
        if re.fullmatch(r"[0-9A-Fa-f]{1,8}" if marked or is_hex else r"[0-9]{1,8}", digits):
            addresses.append(Address(part, int(digits, 16 if marked or is_hex else 10), bool(marked or is_hex)))
        elif part:
            return None
    return addresses


def looks_hex(cell: str) -> bool:
    """Return True for hexadecimal digits with letters and without a mark."""
    return re.fullmatch(r"(?=.*[A-Fa-f])(?=.*[0-9])[0-9A-Fa-f]{2,8}", cell.strip()) is not None


def space_in(text: str) -> str | None:
    """Return the space that a heading or a cell names."""
    return next((space for space, words in _SPACE_WORDS.items() if re.search(words, one_line(text).casefold())), None)


def access_in(cell: str) -> str | None:
    """Return r, w, rw or none; None if the words are unknown."""
    return _ACCESS.get(one_line(cell).casefold())


def type_in(cell: str) -> str | None:
    """Return the wire type; None if the words are unknown or, as `int`, leave sign or width open."""
    whole = one_line(cell).casefold()
    plain = " ".join(re.sub(r"[_\-().,]|\bbits?\b", " ", whole).split())
    return _TYPES.get(whole) or _TYPES.get(plain) or _TYPES.get(plain.replace(" ", ""))


def bits_in(cell: str) -> str | None:
    """Return the bits of a word, `7` or `7..4`."""
    match = _BITS.fullmatch(one_line(cell))
    if match is None:
        return None
    high, low = sorted((int(match[1]), int(match[2] or match[1])), reverse=True)
    return None if high > 15 else str(high) if high == low else f"{high}..{low}"


def is_reserved(title: str) -> bool:
    """Return True if a title says that the maker reserves the address."""
    return _RESERVED.fullmatch(title) is not None


def numbers_of(*texts: str) -> list[Fraction] | None:
    """Return the numbers of texts with a decimal point or comma.

    None if `3.000` may be three thousand: no other text of the cell shows which sign separates decimals.
    """
    signs = {sign for sign in ".," for text in texts if sign in text and not _MAYBE_THOUSANDS.fullmatch(text)}
    if any(_MAYBE_THOUSANDS.fullmatch(text) and text[-4] not in signs for text in texts):
        return None
    return [Fraction(text.replace("\u2212", "-").replace(",", ".").lstrip("+")) for text in texts]


@cache
def _unit_spellings() -> Mapping[str, str]:
    spellings: dict[str, str] = {}
    for unit in shipped().values():
        for spelling in unit.spellings:
            spellings.setdefault(spelling, unit.unit.symbol)
    return spellings


def unit_in(text: str) -> str:
    """Return the symbol of the shipped unit that a text names; empty if it names none."""
    plain = " ".join(text.split()).strip(" .;:[]()")
    if not plain or len(plain) > 24:
        return ""
    unit = shipped_unit(plain)
    return unit.symbol if unit else _unit_spellings().get(plain) or _UNIT_WORDS.get(plain.casefold(), "")


class Range(NamedTuple):
    """A printed range as a description writes it, and its unit.

    `in_units`: the numbers are values in the unit, because a unit or decimals show it; otherwise they may be raw.
    """

    text: str
    unit: str
    in_units: bool


def range_in(cell: str) -> Range | None:
    """Return the range of a cell that holds one range (`0-4000`, `0,0 bis 50,0 Hz`) or one list (`0, 1, 3`)."""
    plain = one_line(cell).strip(" ,;")
    if _LIST.fullmatch(plain) and not re.fullmatch(r"[-+]?\d+,\d+", plain):  # `0,1` is a tenth
        numbers = [int(number) for number in re.findall(r"[-+]?\d+", plain)]
        return Range(", ".join(map(str, numbers)), "", in_units=False)
    match = _RANGE.fullmatch(plain)
    ends = None if match is None else numbers_of(match[1], match[3])
    if match is None or ends is None:
        return None
    (low, high), unit = ends, unit_in(match[4] or match[2] or "")
    if low > high or ((match[4] or match[2]) and not unit):
        return None
    has_decimals = any(sign in match[1] + match[3] for sign in ".,")
    return Range(f"{number_text(low)}..{number_text(high)}", unit, bool(unit) or has_decimals)


def quantity_in(cell: str) -> tuple[Fraction, str] | None:
    """Return the number of a cell such as `0,1 Hz`, `1/100 s` or `x 0.1`, and the text after it."""
    match = _STEP.fullmatch(one_line(cell))
    if match is None:
        return None
    numbers = [Fraction(1, int(match["divisor"]))] if match["divisor"] else numbers_of(match["number"])
    return None if numbers is None else (numbers[0], match["unit"].strip())


def labels_in(cell: str) -> dict[str, str]:
    """Return the names of numbers: `0 = off, 1 = on`, `00 (off), 01 (on)`, or a line for each; else empty."""
    whole = one_line(cell)
    found = [_LABEL_LINE.fullmatch(line) for line in cell.split("\n") if line.strip()]
    if _LABELS_IN_BRACKETS.sub("", whole) == "":
        found = list(_LABELS_IN_BRACKETS.finditer(whole))
    elif len(found) < 2 or None in found:
        found = list(_LABELS_IN_LINE.finditer(whole))
    labels: dict[str, str] = {}
    for match in found:
        number = str(int(match["number"], 16 if match["number"].startswith("0x") else 10)) if match else ""
        label = _label(match["label"]) if match else ""
        if not label or number in labels or len(labels) >= _MOST_LABELS:
            return {}
        labels[number] = label
    return labels if len(labels) >= 2 else {}


def _label(text: str) -> str:
    plain = one_line(text).strip(" ,;.-–")
    if plain.startswith("(") and plain.endswith(")") and plain.count("(") == 1:
        plain = plain[1:-1]
    return plain[:_LONGEST_LABEL]
