"""The facts of commands with steps."""

from dataclasses import asdict
from operator import itemgetter

from fieldscribe.facts import schema
from fieldscribe.facts.point_values import condition
from fieldscribe.facts.points import NAME, NOTE, SOURCE, TITLE
from fieldscribe.facts.table import API, BEHAVIOUR, WIRE, Fact, FactTable, Parts

_MASK = "The bits that are written, or compared; the others keep their value."
_WORD = schema.record(
    ("constant", "The constant.", schema.INTEGER),
    ("factor", "The factor of the argument.", schema.INTEGER),
    ("argument", "The name of the argument; null for none.", schema.TEXT_OR_NULL),
    ("mask", _MASK, schema.ADDRESS),
)
_RUN = "When clients carry it out: before all else, before each write of a point, again and again, or when called."
_ENDS = "The numbers that the caller chooses: the least and the greatest of each, by name."
_READ = "The function that reads the words: to wait for them, or to keep the other bits."

STEP: FactTable = (
    Fact("space", "The space of its address.", schema.STRING),
    Fact("address", "The address of the first word on the wire, or counted from its base.", schema.ADDRESS),
    Fact("base", "The base of the address, by name; null: it counts from 0.", schema.TEXT_OR_NULL),
    Fact("words", "Its words: constant + factor * argument, modulo 65536.", schema.list_of(_WORD, 1)).of(
        lambda step, _: list(map(asdict, step.words))
    ),
    Fact("read", _READ, schema.INTEGER_OR_NULL),
    Fact("write", "The function that writes the words; null for a step that waits.", schema.INTEGER_OR_NULL),
    Fact("within", "The longest time to wait, in milliseconds; null for a step that writes.", schema.INTEGER_OR_NULL),
    Fact("when", "The condition of the step.", schema.null_or(schema.ref("condition"))).of(
        lambda step, _: step.when and condition(step.when)
    ),
    Fact("says", "What it writes or waits for, as the author wrote it.", schema.STRING),
)
STEPPED_COMMAND: FactTable = (
    *(NAME, TITLE, NOTE),
    Fact("run", _RUN, schema.one_of("first", "before write", "every", "by caller"), BEHAVIOUR),
    Fact("every", "The period in milliseconds; null if it does not repeat.", schema.INTEGER_OR_NULL, BEHAVIOUR),
    Fact("arguments", _ENDS, schema.map_of(schema.list_of(schema.INTEGER, 2, 2)), API).of(
        lambda command, _: {name: list(ends) for name, ends in command.arguments.items()}
    ),
    Fact("steps", "Its requests in order.", schema.list_of(schema.ref("step"), 1), WIRE, table=STEP),
    SOURCE,
)
_PARTS = Parts("stepped command", "command", itemgetter("stepped_commands"), STEPPED_COMMAND, same_by=("steps",))
STEPPED_COMMANDS = Fact(
    "stepped_commands",
    "Commands of several requests.",
    schema.list_of(schema.ref("stepped_command")),
    table=STEPPED_COMMAND,
).differs(_PARTS)
