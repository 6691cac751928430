"""Reads lines of logs: a time, perhaps a direction, and a frame in hexadecimal."""

from __future__ import annotations

import re
from datetime import UTC, datetime

from fieldscribe.listening.chunks import BYTES, Chunk
from fieldscribe.pasted_numbers import parse_hex

_TIME = re.compile(
    r"[\[(]?(?:(?P<date>\d{4}-\d\d-\d\d)[T ])?(?P<hour>\d{1,2}):(?P<minute>\d\d):(?P<second>\d\d(?:[.,]\d{1,9})?)"
    r"(?:Z|[+-]\d\d:?\d\d)?[\])]?[\s:;,]+|[\[(]?(?P<epoch>\d{1,12}[.,]\d{1,9})[\])]?[\s:;,]+"
)
_WAYS = re.compile(r"(?:(?:TX|RX|REQ|RES|SENT|RECV|SEND|REQUEST|RESPONSE|REPLY|<-|->|<<|>>|<|>)[\s:]*)+", re.IGNORECASE)


def timed(text: str) -> tuple[float | None, str]:
    """Return the time at the beginning of a line, in seconds, and the rest of the line."""
    match = _TIME.match(text)
    if match is None:
        return None, text
    rest = text[match.end() :]
    if match["epoch"]:
        return float(match["epoch"].replace(",", ".")), rest
    seconds = int(match["hour"]) * 3600 + int(match["minute"]) * 60 + float(match["second"].replace(",", "."))
    if match["date"] is None:
        return seconds, rest
    try:
        day = datetime.strptime(match["date"], "%Y-%m-%d").replace(tzinfo=UTC)
    except ValueError:
        return seconds, rest
    return day.timestamp() + seconds, rest


def logged_bytes(text: str) -> Chunk:
    """Return the bytes in a line of a log. Raises HexError for a line without any."""
    time, rest = timed(text)
    way = _WAYS.match(rest)
    return Chunk(time, BYTES, parse_hex(rest[way.end() :] if way else rest))
