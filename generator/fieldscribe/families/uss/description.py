"""The keys that only this family has, and the text of a new description."""

from collections.abc import Collection

from fieldscribe.language.keys.bus import CODES
from fieldscribe.language.keys.places import BUS, FRAME
from fieldscribe.schema_types import Items, Key, Text, ValueShape, Whole

PKW = Whole(choices=(0, 3, 4, 127))

KEYS = (
    Key("pkw", BUS, "USS: the lengths in words that the parameter part can have; 127 is variable.").takes(
        [[0, 3, 4, 127]], Items(ValueShape("A length.", [4], PKW), 1)
    ),
    Key("pzd", BUS, "USS: how many words of process data there may be.").takes(["0..8"], Text(40), Whole()),
    Key("responses", BUS, "USS: the response ids with the tasks that they answer.").takes(
        [{"1": {"name": "value", "answers": [1, 2, 14]}}], CODES
    ),
    Key(
        "pkw", FRAME, "USS: the length of the parameter part that the link is set to; 127 (variable) unless said."
    ).takes([4], PKW),
)


SERVES = "parameters and process data in USS telegrams"
_BUS = """\
bus:
  units: 0..30
  broadcast: 32
  pkw: [0, 3, 4, 127]              # lengths of the parameter part in words; 127 is variable
  pzd: 0..2                        # words of process data
  functions:                       # the task ids, with the responses and refusals that answer them
    1: {name: read_value, answers: [1, 2], refusals: [7]}
    2: {name: write_word, answers: [1], refusals: [7]}
    3: {name: write_double_word, answers: [2], refusals: [7]}
  responses:                       # the response ids, with the tasks that they answer
    1: {name: word, answers: [1, 2]}
    2: {name: double_word, answers: [1, 3]}
    7: {name: cannot_execute, answers: [1, 2, 3]}
  exceptions:                      # the error values, with their tasks
    0: {name: illegal_parameter_number, answers: [1, 2, 3]}
"""
_FRAMES = """\
frames:                            # tasks and answers that the manual prints: each is compared with the points
- {name: read_first, framing: pkw, direction: request, bytes: 1001 0000 0000 0000}
- {name: read_first_answer, framing: pkw, answers: read_first, bytes: 1001 0000 01F4, says: {P0001: 50.0}}
"""
DEVICE = _BUS + _FRAMES
GROUP = """\
group: main
title: {en: Main}
space: parameter                   # parameter, or telegram for process data
access: rw                         # r, w, rw, none; a point may say otherwise
source: {document: manual, section: "1"}
points:
- code: P0001
  name: first_value                # replace it by the manual's first parameter
  title: {en: First value}
  at: 1                            # the number of the parameter
  range: 0..1000                   # raw, as it travels
  scale: value = raw * 0.1
  unit: "%"
"""


def bus_of(_spaces: Collection[str]) -> str:
    """Return the `bus` of a draft, with tasks that read and write."""
    return _BUS
