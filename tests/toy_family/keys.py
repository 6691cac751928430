"""The key that only bells have."""

from __future__ import annotations

from fieldscribe.kinds import Key, Whole
from fieldscribe.language.keys.places import BUS

KEYS = (Key("strikes", BUS, "How often a bell may be struck in a minute.", [60], Whole(0, 10_000)),)
