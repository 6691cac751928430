"""Bytes in the notation that people use for them, and dates that count seconds."""

from __future__ import annotations

import re
from datetime import UTC, datetime, timedelta
from fractions import Fraction
from ipaddress import AddressValueError, IPv4Address, IPv6Address

from fieldscribe.arithmetic.exact import half_away

_SEPARATORS = re.compile(r"[:\s-]")
_MICRO = 1_000_000
_ADDRESSES: dict[str, type[IPv4Address | IPv6Address]] = {"ipv4": IPv4Address, "ipv6": IPv6Address}


def notated(notation: str, data: bytes) -> str:
    """Return bytes as people write them: `192.168.0.1`, `00:1A:2B:3C:4D:5E`, `1.2.0.14`, `001A2B`."""
    if notation in _ADDRESSES:
        return str(_ADDRESSES[notation](data))
    if notation.startswith("version"):
        nibbles = [part for byte in data for part in divmod(byte, 16)]
        return ".".join(map(str, data if notation == "version" else nibbles))
    return data.hex(*":" * notation.startswith("eui")).upper()


def bytes_of(notation: str, text: str, count: int) -> bytes | None:
    """Return the bytes of such a text; None if these are not `count` bytes in the notation."""
    try:
        if notation in _ADDRESSES:
            return None if "%" in text else _ADDRESSES[notation](text.strip()).packed
        if notation.startswith("version"):
            parts = [int(part) for part in text.split(".") if part.isascii() and part.isdigit()]
            parts = parts if len(parts) == text.count(".") + 1 else []
            if notation != "version" and all(part < 16 for part in parts):
                parts = [high << 4 | low for high, low in zip(parts[::2], parts[1::2], strict=True)]
            elif notation != "version":
                return None
            data = bytes(parts)
        else:
            data = bytes.fromhex(_SEPARATORS.sub("", text))
    except (AddressValueError, ValueError):
        return None
    return data if len(data) == count else None


def date_of(epoch: str, seconds: Fraction) -> str:
    """Return the time so many seconds after a date: `2026-11-29T12:00:00Z`; empty if it is later than 9999-12-31."""
    try:
        time = _start(epoch) + timedelta(microseconds=half_away(seconds * _MICRO))
    except OverflowError:
        return ""
    return time.replace(tzinfo=None).isoformat() + "Z"


def epoch_in_unix(epoch: str) -> int:
    """Return how many seconds after 1970-01-01 a date is."""
    return (_start(epoch) - _start("1970-01-01")) // timedelta(seconds=1)


def seconds_of(epoch: str, text: str) -> Fraction | None:
    """Return how many seconds after a date a time is, in UTC if it says no zone; None for what is no time."""
    try:
        time = datetime.fromisoformat(text.strip())
    except ValueError:
        return None
    time = time if time.tzinfo is not None else time.replace(tzinfo=UTC)
    return Fraction((time - _start(epoch)) // timedelta(microseconds=1), _MICRO)


def _start(epoch: str) -> datetime:
    return datetime.fromisoformat(epoch).replace(tzinfo=UTC)
