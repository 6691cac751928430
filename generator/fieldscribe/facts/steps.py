"""The facts of commands with steps."""

from __future__ import annotations

from dataclasses import asdict
from operator import itemgetter

from fieldscribe.facts.point_values import condition
from fieldscribe.facts.points import NAME, NOTE, SOURCE, TITLE
from fieldscribe.facts.schema import (
    ADDRESS,
    INTEGER,
    INTEGER_OR_NULL,
    STRING,
    TEXT_OR_NULL,
    list_of,
    map_of,
    null_or,
    one_of,
    record,
    ref,
)
from fieldscribe.facts.table import API, BEHAVIOUR, WIRE, Fact, FactTable, Parts

_WORD = record(
    ("constant", "What is always added.", INTEGER),
    ("factor", "What the argument is multiplied by.", INTEGER),
    ("argument", "The name of the argument; null for none.", TEXT_OR_NULL),
    ("mask", "The bits that are written, or compared; the others stay as they are.", ADDRESS),
)

STEP: FactTable = (
    Fact("space", "The space of its address.", STRING, WIRE),
    Fact("address", "The address of the first word on the wire.", ADDRESS, WIRE),
    Fact(
        "words",
        "Its words: constant + factor * argument, modulo 65536.",
        list_of(_WORD, 1),
        value=lambda step, _: list(map(asdict, step.words)),
    ),
    Fact("read", "The function that reads the words: to wait for them, or for the bits that stay.", INTEGER_OR_NULL),
    Fact("write", "The function that writes the words; null for a step that waits.", INTEGER_OR_NULL),
    Fact("within", "The longest time to wait, in milliseconds; null for a step that writes.", INTEGER_OR_NULL),
    Fact(
        "when",
        "The condition under which the step is taken.",
        null_or(ref("condition")),
        value=lambda step, _: None if step.when is None else condition(step.when),
    ),
    Fact("says", "What it writes or waits for, as the author wrote it.", STRING),
)

STEPPED_COMMAND: FactTable = (
    NAME,
    TITLE,
    NOTE,
    Fact(
        "run",
        "When clients carry it out: before all else, before each write of a point, again and again, or when called.",
        one_of("first", "before write", "every", "by caller"),
        BEHAVIOUR,
    ),
    Fact(
        "every", "The milliseconds after which it is carried out again; null if it is not.", INTEGER_OR_NULL, BEHAVIOUR
    ),
    Fact(
        "arguments",
        "The numbers that the caller chooses: the least and the greatest of each, by name.",
        map_of(list_of(INTEGER, 2, 2)),
        API,
        value=lambda command, _: {name: list(ends) for name, ends in command.arguments.items()},
    ),
    Fact("steps", "Its requests in order.", list_of(ref("step"), 1), WIRE, table=STEP),
    SOURCE,
)
STEPPED_COMMANDS = Fact(
    "stepped_commands",
    "Commands of several requests.",
    list_of(ref("stepped_command")),
    table=STEPPED_COMMAND,
    views=(Parts("stepped command", "command", itemgetter("stepped_commands"), STEPPED_COMMAND, same_by=("steps",)),),
)
