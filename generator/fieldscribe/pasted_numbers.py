"""Bytes and numbers as people paste them: with blanks, commas, colons, dashes, `0x`, or none of these."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from fieldscribe.text import line
from fieldscribe.user_errors import UnclearError

if TYPE_CHECKING:
    from collections.abc import Sequence

_BETWEEN = re.compile(r"[\s,;:|\-]+")
_MARK = re.compile(r"0[xX]|\\x|[hH]'")
_DIGITS = re.compile(r"[0-9A-Fa-f]+")

_HEX = re.compile(r"0x([0-9a-f]+)|([0-9][0-9a-f]*)h|h'([0-9a-f]+)'?", re.IGNORECASE)
_DECIMAL = re.compile(r"[0-9]+")
_LONGEST = 64


class HexError(ValueError):
    """The text does not stand for bytes."""


def parse_hex(text: str) -> bytes:
    """The bytes that a text means. Raises HexError with what is wrong and where."""
    if data := _pairs(text):
        return data
    spaced = _BETWEEN.sub(" ", _MARK.sub(" 0x", text)).strip()
    if data := _pairs(spaced):
        return data
    pieces = spaced.split()
    if not pieces:
        raise HexError("there are no bytes")
    return b"".join(_piece(piece, place) for place, piece in enumerate(pieces, 1))


def _pairs(text: str) -> bytes:
    """The bytes of pairs of digits with or without blanks, which Python reads by itself; none where there is more."""
    try:
        return bytes.fromhex(text)
    except ValueError:
        return b""


def number_of(text: str) -> int | None:
    """A number in a notation of the manuals: `4136`, `0x1028`, `1028h`, `H'1028`; None for anything else."""
    if len(text) > _LONGEST or not text.isascii():
        return None
    if match := _HEX.fullmatch(text):
        return int(match[1] or match[2] or match[3], 16)
    return int(text) if _DECIMAL.fullmatch(text) else None


def typed_bytes(text: str, what: str, example: str) -> bytes:
    """The bytes of a frame, called what its family calls it. Raises UnclearError."""
    try:
        return parse_hex(text)
    except HexError as error:
        raise UnclearError(f"not a {what}: {error}", f'write the bytes in hexadecimal, as in "{example}"') from error


def rejoined(words: Sequence[str], *sizes: int) -> list[str]:
    """The frames that arguments mean; arguments of a byte or word each are one frame whose quotes were forgotten."""
    if len(words) > 2 and len({len(word.strip()) for word in words} - set(sizes)) == 0:
        return [" ".join(words)]
    return list(words)


def _piece(piece: str, place: int) -> bytes:
    """The bytes of one piece between blanks or commas, which is the `place`-th. Raises HexError."""
    digits = piece.removeprefix("0x")
    if digits != piece and len(digits) == 1:
        digits = "0" + digits
    elif digits == piece and len(piece) == 3 and piece[2] in "hH":
        digits = piece[:2]
    shown = line(piece[:24])
    if not _DIGITS.fullmatch(digits):
        raise HexError(f"`{shown}` (piece {place}) is not hexadecimal: only 0 to 9 and A to F count")
    if len(digits) % 2:
        raise HexError(
            f"`{shown}` (piece {place}) has {len(digits)} digit{'s' if len(digits) > 1 else ''}; two make a byte"
        )
    return bytes.fromhex(digits)
