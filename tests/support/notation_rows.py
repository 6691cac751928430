"""Texts that stand for bytes in a notation, and texts that are none."""

from __future__ import annotations

BYTES = [
    ("hex", "001A2B3C", "001A2B3C"),
    ("hex", "00 1a:2b-FF", "001A2BFF"),
    ("ipv4", "192.168.0.1", "C0A80001"),
    ("ipv6", "2001:db8::1", f"20010DB8{'0' * 23}1"),
    ("ipv6", " ::ffff:1.2.3.4 ", f"{'0' * 20}FFFF01020304"),
    ("eui48", "00:1A:2B:3C:4D:5E", "001A2B3C4D5E"),
    ("eui48", "001a2b-3c4d5e", "001A2B3C4D5E"),
    ("eui64", "00:1A:2B:FF:FE:3C:4D:5E", "001A2BFFFE3C4D5E"),
    ("version", "1.2.0.255", "010200FF"),
    ("version of nibbles", "1.15.0.3", "1F03"),
]
"""A notation, a text in it, and the bytes that it stands for."""
NONE = [
    ("hex", "0", 1),
    ("hex", "0g", 1),
    ("hex", "", 1),
    ("hex", "001A2B", 2),
    ("ipv4", "1.2.3", 4),
    ("ipv4", "1.2.3.256", 4),
    ("ipv4", "::1", 4),
    ("ipv6", "1.2.3.4", 16),
    ("ipv6", "::1%eth0", 16),
    ("eui48", "00:1A:2B:3C:4D", 6),
    ("version", "1.2", 1),
    ("version", "1..2", 2),
    ("version", "1.256", 2),
    ("version", "-1.2", 2),
    ("version", "\u0661.2", 2),
    ("version", "1" * 5000, 1),
    ("version of nibbles", "1.16", 1),
    ("version of nibbles", "1.2.3", 1),
]
"""A notation, a text that is none in it, and how many bytes are wanted."""
