"""Reads CAN frames from text: `321#DD00051513880064`, lines of candump, bytes for a known identifier."""

import re
from collections.abc import Iterable, Iterator, Sequence

from fieldscribe.diagnostics import UnclearError
from fieldscribe.families.can.frames import CanFrame
from fieldscribe.pasted_numbers import HexError, parse_hex, rejoined
from fieldscribe.text import shortened

HINT = "write identifier and data in hexadecimal, as in 321#DD00051513880064, or give the identifier with --can-id 321"
MOST_IDENTIFIER = 0x1FFFFFFF
_STAMP = r"(?:(?P<stamp>\([0-9.]{1,32}\))\s+)?"
_LOGGED = re.compile(
    _STAMP
    + r"(?:(?P<bus>[A-Za-z][\w.-]{0,31})\s+)?(?:0[xX])?(?P<id>[0-9A-Fa-f]{1,8})#(?P<fd>#[0-9A-Fa-f])?(?P<data>[^\s#]*)"
    r"(?:\s+[RT])?"
)
_DUMPED = re.compile(
    _STAMP + r"(?P<bus>[A-Za-z][\w.-]{0,31})\s+(?:[RT]X\s+\S\s+\S\s+)?(?P<id>[0-9A-Fa-f]{3}|[0-9A-Fa-f]{8})\s+"
    r"\[(?P<size>[0-9]{1,2})\]\s*(?P<data>(?:[0-9A-Fa-f]{2}(?:\s+|$))*|remote request)(?:\s*'.*')?"
)
_BEHIND = re.compile(
    r"(?:\([0-9.]{1,32}\)\s+)?(?:[A-Za-z][\w.-]{0,31}\s+)?[0-9A-Fa-fxX]{1,10}##?[0-9A-Fa-fRr.]*(?:\s+[RT]\b)?"
)
_SEVERAL = re.compile(rf"(?:{_BEHIND.pattern}(?:\s+|$)){{2,}}")
_ALONE = re.compile(r"\([0-9.]{1,32}\)")
_REMOTE = re.compile(r"[Rr][0-8]?|remote request")


def read_frames(texts: Sequence[str], known: int | None = None) -> list[CanFrame]:
    """Return the frames in the arguments, one a line; `known` is the identifier of bare bytes. Raises UnclearError."""
    if len(texts) == 1 and texts[0].isprintable() and (match := _LOGGED.fullmatch(texts[0])):
        return [_matched(match)]
    lines = [line.strip() for text in _joined(texts) for line in text.splitlines() or [""]]
    if len(texts) == 1 and len(lines) == 1 and lines[0].count("#") > 1 and _SEVERAL.fullmatch(lines[0]):
        lines = [match[0].strip() for match in _BEHIND.finditer(lines[0])]
    return [_frame(line, known) for line in lines if line or len(lines) == 1]


def read_identifier(text: str) -> int:
    """Return an identifier, which is always hexadecimal: `321`, `0x321`, `321h`. Raises UnclearError."""
    match = re.fullmatch(r"(?:0[xX])?([0-9A-Fa-f]{1,8})h?", text.strip())
    if match is None or int(match[1], 16) > MOST_IDENTIFIER:
        raise UnclearError(f"`{shortened(text)}` is no CAN identifier", "write it in hexadecimal, as in --can-id 321")
    return int(match[1], 16)


def _joined(texts: Sequence[str]) -> Iterable[str]:
    """Return the arguments; join the pieces of one line if the user forgot the quotes."""
    if len(texts) == 1 or not any("#" in text for text in texts):
        return rejoined(texts, 2)
    return _lines_of_pieces(list(texts))


def _lines_of_pieces(words: list[str]) -> Iterator[str]:
    while words:
        size = 3 if _ALONE.fullmatch(words[0].strip()) and len(words) > 2 else 1
        yield " ".join(words[:size])
        del words[:size]


def _frame(line: str, known: int | None) -> CanFrame:
    match = _LOGGED.fullmatch(line) or _DUMPED.fullmatch(line)
    if match is not None:
        return _matched(match)
    if known is None or "#" in line:
        raise _unclear(f"`{shortened(line)}` has no identifier" if line else "there are no bytes")
    return CanFrame(known, _bytes(line))


def _matched(match: re.Match[str]) -> CanFrame:
    """Return the frame in a line of candump. Raises UnclearError."""
    stamp, bus, digits, data = match.group("stamp", "bus", "id", "data")
    number = int(digits, 16)
    if number > MOST_IDENTIFIER:
        raise _unclear(f"the identifier {number:X} is longer than 29 bits")
    if data[:1] in "rR" and _REMOTE.fullmatch(data):
        return CanFrame(number, b"", True, stamp or "", bus or "")
    return CanFrame(number, _bytes(data.replace(".", " ")) if data else b"", False, stamp or "", bus or "")


def _bytes(text: str) -> bytes:
    try:
        return parse_hex(text)
    except HexError as error:
        raise _unclear(str(error)) from error


def _unclear(why: str) -> UnclearError:
    return UnclearError(f"not a frame: {why}", HINT)
