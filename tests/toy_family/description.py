"""The key that only bells have, and what a new description of bells starts with."""

from __future__ import annotations

from fieldscribe.language.keys.places import BUS
from fieldscribe.schema_types import Key, Whole

KEYS = (Key("strikes", BUS, "How often a bell may be struck in a minute.").takes([60], Whole(0, 10_000)),)

SERVES = "bells"
DEVICE = """\
bus: {units: 1..4}
frames: [{name: ring_first, bytes: 31 41, says: {first: 0}}]
"""
GROUP = """\
group: tones
title: {en: Tones}
space: tone
access: w
source: {document: manual, section: "1"}
points:
- {name: first, at: 0, range: 0..9}
"""
