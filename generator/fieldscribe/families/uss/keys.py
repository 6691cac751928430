"""The keys that only this family has."""

from __future__ import annotations

from fieldscribe.kinds import Items, Key, Shape, Text, Whole
from fieldscribe.language.keys.bus import CODES
from fieldscribe.language.keys.places import BUS, FRAME

PKW = Whole(choices=(0, 3, 4, 127))

KEYS = (
    Key(
        "pkw",
        BUS,
        "USS: the lengths in words that the parameter part can have; 127 is variable.",
        [[0, 3, 4, 127]],
        Items(Shape("A length.", [4], PKW), 1),
    ),
    Key("pzd", BUS, "USS: how many words of process data there may be.", ["0..8"], Text(40), Whole()),
    Key(
        "responses",
        BUS,
        "USS: the response ids with the tasks that they answer.",
        [{"1": {"name": "value", "answers": [1, 2, 14]}}],
        CODES,
    ),
    Key(
        "pkw",
        FRAME,
        "USS: the length of the parameter part that the link is set to; 127 (variable) unless said.",
        [4],
        PKW,
    ),
)
