"""Reads bytes and numbers as users paste them: with blanks, commas, colons, dashes, `0x`, or none of these."""

import re
from collections.abc import Sequence

from fieldscribe.diagnostics import UnclearError
from fieldscribe.text import line

_SEPARATORS = re.compile(r"[\s,;:|\-]+")
_MARK = re.compile(r"0[xX]|\\x|[hH]'")
_DIGITS = re.compile(r"[0-9A-Fa-f]+")

_HEX = re.compile(r"0x([0-9a-f]+)|([0-9][0-9a-f]*)h|h'([0-9a-f]+)'?", re.IGNORECASE)
_DECIMAL = re.compile(r"[0-9]+")
_LONGEST = 64


class HexError(ValueError):
    """A text that is not bytes."""


def parse_hex(text: str) -> bytes:
    """Return the bytes of a text. Raises HexError, which says what is wrong and where."""
    if data := _plain_bytes(text):
        return data
    spaced = _SEPARATORS.sub(" ", _MARK.sub(" 0x", text)).strip()
    if not spaced:
        raise HexError("there are no bytes")
    return _plain_bytes(spaced) or b"".join(_bytes_of(piece, place) for place, piece in enumerate(spaced.split(), 1))


def _plain_bytes(text: str) -> bytes:
    """Return the bytes of a text of digits only; no bytes for any other text."""
    try:
        return bytes.fromhex(text)
    except ValueError:
        return b""


def _bytes_of(piece: str, place: int) -> bytes:
    """Return the bytes of the `place`-th piece between separators. Raises HexError."""
    digits = piece.removeprefix("0x")
    if digits != piece and len(digits) == 1:
        digits = "0" + digits
    elif digits == piece and len(piece) == 3 and piece[2] in "hH":
        digits = piece[:2]
    if not _DIGITS.fullmatch(digits):
        raise HexError(f"`{line(piece[:24])}` (piece {place}) is not hexadecimal: only 0 to 9 and A to F count")
    if len(digits) % 2:
        count = f"{len(digits)} digit{'s' if len(digits) > 1 else ''}"
        raise HexError(f"`{line(piece[:24])}` (piece {place}) has {count}; two make a byte")
    return bytes.fromhex(digits)


def number_of(text: str) -> int | None:
    """Return a number in a notation of manuals: `4136`, `0x1028`, `1028h`, `H'1028`; None for anything else."""
    if len(text) > _LONGEST or not text.isascii():
        return None
    if match := _HEX.fullmatch(text):
        return int(match[1] or match[2] or match[3], 16)
    return int(text) if _DECIMAL.fullmatch(text) else None


def typed_bytes(text: str, what: str, example: str) -> bytes:
    """Return the bytes of a frame; messages call it `what` and show the example. Raises UnclearError."""
    try:
        return parse_hex(text)
    except HexError as error:
        raise UnclearError(f"not a {what}: {error}", f'write the bytes in hexadecimal, as in "{example}"') from error


def rejoined(words: Sequence[str], *sizes: int) -> list[str]:
    """Return the arguments as one frame if its quotes were forgotten: each argument has one of these sizes."""
    if len(words) > 2 and {len(word.strip()) for word in words} <= set(sizes):
        return [" ".join(words)]
    return list(words)
