# SPDX-License-Identifier: 0BSD
"""Forms of bytes with a notation of their own, such as IP addresses, and of times counted from a date."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from .arguments import shown
from .errors import MalformedError, WrongTypeError
from .forms import Integer
from .rules import round_ratio
from .texts import Text
from .wrappers import Around

if TYPE_CHECKING:
    from collections.abc import Sequence
    from datetime import datetime
    from ipaddress import IPv4Address, IPv6Address

    from .fast import Way
    from .forms import Allowed, Form
    from .rules import Raws

_SEPARATORS = re.compile(r"[:\s-]")
_NUMBERS = re.compile(r"[0-9]{1,3}(\.[0-9]{1,3})*", re.ASCII)
_NIBBLE = 16
_MICRO = 1_000_000


class Bytes(Text):
    """Bytes in words as a text in a notation: hex, ipv4, ipv6, eui48, eui64, version, or version of nibbles."""

    def __init__(self, count: int, notation: str, *, per_word: int = 2, low_first: bool = False) -> None:
        super().__init__(count, notation, per_word=per_word, low_first=low_first)
        self._address: type[IPv4Address | IPv6Address] | None = None
        if notation.startswith("ip"):
            import ipaddress  # only devices with such points need it

            self._address = ipaddress.IPv4Address if notation == "ipv4" else ipaddress.IPv6Address

    def decode(self, raw: int, raws: Raws) -> str:
        """Return the bytes in their notation: `192.168.0.1`, `00:1A:2B:3C:4D:5E`, `1.2.0.14`, `001A2B`."""
        data = self._characters_of(raw)
        if self._address is not None:
            return str(self._address(data))
        if self.encoding.startswith("version"):
            return ".".join(map(str, data if self.encoding == "version" else _nibbles(data)))
        return data.hex(*":" * self.encoding.startswith("eui")).upper()

    def converted(self, value: str, raws: Raws) -> int | None:
        """Return the words of a text in this notation; None if the number of bytes differs."""
        if not isinstance(value, str):
            return None
        try:
            data = self._bytes_of(value)
        except ValueError:
            return None
        return self._words_of(data, b"") if len(data) == self.characters else None

    def _bytes_of(self, value: str) -> bytes:
        if self._address is not None:
            return b"" if "%" in value else self._address(value.strip()).packed
        if not self.encoding.startswith("version"):
            return bytes.fromhex(_SEPARATORS.sub("", value))
        if not _NUMBERS.fullmatch(value):
            return b""
        parts = [int(part) for part in value.split(".")]
        return bytes(parts if self.encoding == "version" else _joined(parts))

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the words: all bytes may be written."""
        return raw if 0 <= raw < 1 << self.wire.bits else None

    def choices(self, unit: str) -> str | None:
        """Return what a refused text is."""
        return f"not {self.characters} byte{'s' if self.characters > 1 else ''} as {self.encoding}"


def _nibbles(data: bytes) -> list[int]:
    return [part for byte in data for part in divmod(byte, _NIBBLE)]


def _joined(parts: Sequence[int]) -> list[int]:
    """Return the bytes of nibbles; an empty list for an odd number of them or invalid ones."""
    if len(parts) % 2 or max(parts) >= _NIBBLE:
        return []
    return [high << 4 | low for high, low in zip(parts[::2], parts[1::2], strict=True)]


class Time(Around["datetime", "datetime | float"]):
    """A time in UTC, counted in seconds from a date by another form; encoding also takes seconds."""

    def __init__(self, form: Form[Any, Any], epoch: str) -> None:
        super().__init__(form)
        import datetime  # only devices with such points need it

        self.epoch = datetime.datetime.fromisoformat(epoch).replace(tzinfo=datetime.UTC)
        self._datetime = datetime.datetime
        self._micro = datetime.timedelta(microseconds=1)

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return the slow way."""
        return slow

    def decode(self, raw: int, raws: Raws) -> datetime:
        """Return the time to the nearest microsecond; raises MalformedError for a time beyond Python's range."""
        seconds: float = self.form.decode(raw, raws)
        try:
            num, den = seconds.as_integer_ratio()
            return self.epoch + round_ratio(num * _MICRO, den) * self._micro
        except (OverflowError, ValueError):
            raise MalformedError(f"raw {raw} is a time beyond Python's range") from None

    def converted(self, value: datetime | float, raws: Raws) -> int | None:
        """Return the raw number of a time; a count of seconds rounds to nearest, halves away from the date."""
        if not isinstance(value, self._datetime):
            return self.form.converted(value, raws)
        if value.tzinfo is None:
            raise WrongTypeError(f"takes a time with a zone, as in datetime.now(timezone.utc), not {shown(value)}")
        count = (value - self.epoch) // self._micro
        seconds = round_ratio(count, _MICRO) if isinstance(self.form, Integer) else count / _MICRO
        return self.form.converted(seconds, raws)

    def shown(self, raw: int, raws: Raws, display: int | None = None) -> str:
        """Return the time: `2026-11-29T12:00:00+00:00`; in seconds beyond Python's range, or with `display`."""
        try:
            return self.decode(raw, raws).isoformat() if display is None else self.form.shown(raw, raws, display)
        except MalformedError:
            return self.form.shown(raw, raws)
