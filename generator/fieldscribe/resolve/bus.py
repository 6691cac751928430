"""The facts under `bus`, and the telegrams: cyclic layouts of words, with the messages whose frames carry them.

`pipeline` asks `bus_of` and `telegrams_of`. `FamilyReader` defines how a family reads its own keys.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from fieldscribe.families import BusKeys, Family, families
from fieldscribe.language.keys import keys_of_family
from fieldscribe.language.keys.places import BUS
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.model import Block, Bus, Code, FamilyFacts, Message, Point, Telegram
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scope import Scope, first_line, source_of, titles
from fieldscribe.resolve.values import integer, interval
from fieldscribe.resolve.word_contents import Taken, entry_titles, name_of
from fieldscribe.text import humanised

Messages = tuple[Message, ...]
Telegrams = Mapping[str, tuple[Telegram, int]]
"""Telegrams by name, each with how many of its words one multiplexed frame carries (0: not multiplexed)."""

TELEGRAM_SPACE = "telegram"
"""The space whose points are words of a telegram."""
SIGNAL_SPACE = "signal"
"""The space whose points are bits of a message; the words of these are a telegram of the same name."""
KEY_OF = {TELEGRAM_SPACE: "telegram", SIGNAL_SPACE: "message"}
"""What a group of such a space names."""

_MULTIPLEXED = 256
"""The number of frames that a multiplexer can distinguish."""
NO_BUS = Bus((), (0, 0), None, (), (), {}, {}, {}, {})
_LAST_CODE = 255
_TIME = re.compile(r"(about |at most )?(?:([0-9]{1,9})\.\.)?([0-9]{1,9}) (ms|s)\b.*")
_NUMBER = re.compile(r"([0-9]{1,8})(?:\.([0-9]))?")


class FamilyReader:
    """Reads the facts that only one family has. A family offers its reader as `READING` in its module `reading`."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> FamilyFacts | None:
        """Return the facts of the bus that only this family has; report what its protocol cannot do."""

    def frame(self, scope: Scope, node: Map, framing: str) -> FamilyFacts | None:
        """Return the facts of a worked example that only this family has."""

    def refuses(self, scope: Scope, bus: Bus, node: Map) -> bool:
        """Report a worked example that cannot occur on this bus; return True if it cannot."""
        del scope, bus, node
        return False

    def messages(self, scope: Scope, bus: Bus) -> tuple[Message, ...]:
        """Return the messages that the description lays out."""
        del bus
        laid_out = " and ".join(family.name for family in families() if family.lays_out_messages)
        for node in scope.listed("messages"):
            hint = f"leave it out: the frames of {scope.family.name} are known"
            scope.report.error("family-key", f"messages are for the family {laid_out}", node.span("name"), hint)
        return ()

    def lay_out(self, messages: Messages, points: Iterable[Point]) -> tuple[Messages, list[Point]]:
        """Return the messages with their signals, and the points with their places in the words of these."""
        return messages, list(points)

    def telegram(self, scope: Scope, node: Map, before: Sequence[Telegram]) -> None:
        """Report a telegram that the frames of the family cannot carry."""

    def writes(self, space: str) -> tuple[int, ...]:
        """Return the functions that write into a space."""
        del space
        return ()

    def able(self, bus: Bus, space: str, count: int, *, writes: bool) -> tuple[int, ...]:
        """Return the functions of the device that read or write this many items at once, the usual one first."""
        del bus, space, count, writes
        return ()

    def blocks(
        self, bus: Bus, points: Sequence[Point], variants: Mapping[str, tuple[str, ...]]
    ) -> tuple[Block, ...] | None:
        """Return the reads that fetch all points of a group; None if the family plans none."""


def reader_of(scope: Scope) -> FamilyReader:
    """Return the reader of the device's family."""
    part = scope.family.part("reading")
    reading: FamilyReader = part.READING if part is not None else FamilyReader()
    return reading


def bus_of(scope: Scope) -> Bus:
    """Return the bus of the device; report a missing or a second `bus`, and keys that it lacks."""
    holders = [file for file in scope.files if "bus" in file]
    keys = scope.family.bus
    if not holders:
        if not scope.is_lost("bus", "bus"):
            hint = f"add `bus:` with {', '.join((*keys.needed[:1], 'units', *keys.needed[1:]))}"
            scope.report.error("missing-key", "no file of the device says `bus`", scope.header.span(), hint)
        return NO_BUS
    for second in holders[1:]:
        first = [(holders[0].key_span("bus"), "first given here")]
        scope.report.error("duplicate-name", "`bus` is given twice", second.key_span("bus"), "write it once", first)
    node: Map = holders[0]["bus"]
    _check_keys(scope, node, keys)
    functions = codes_under(scope, node, "functions")
    family_facts = reader_of(scope).bus(scope, node, functions)
    timing = {key: str(value) for key, value in node.get("timing", {}).items()}
    serial = {key: _setting(value) for key, value in node.get("serial", {}).items()}
    return Bus(
        framings=tuple(node.get("framings", ())),
        units=ends_of(scope, node, "units", "are no unit addresses", keys.last_unit),
        broadcast=node.get("broadcast"),
        functions=functions,
        exceptions=codes_of(scope, node.get("exceptions"), keys.codes[0], keys.last_exception),
        gaps=_gaps(scope, node.get("gaps")),
        timing=timing,
        serial=serial,
        note=titles(node.get("note")),
        family_facts=family_facts,
        line_numbers=dict([*_times(timing), *_settings(serial)]),
    )


def _times(timing: Mapping[str, str]) -> Iterator[tuple[str, int]]:
    """Yield the times that a program can compute with, by name."""
    for key, text in timing.items():
        if number := _NUMBER.fullmatch(text):
            yield f"timing_{key}{'' if number[2] is None else '_tenths'}", int(number[1] + (number[2] or ""))
        elif time := _TIME.fullmatch(text):
            limit, least, most, unit = time.groups()
            if least is not None:
                yield f"timing_{key}_{unit}_min", int(least)
            yield f"timing_{key}_{unit}{'_max' if least is not None or limit == 'at most ' else ''}", int(most)


def _settings(serial: Mapping[str, Mapping[str, str]]) -> Iterator[tuple[str, int]]:
    """Yield the codes of serial settings by their meaning, and settings that are a single number."""
    for key, codes in serial.items():
        for code, text in codes.items():
            if not _NUMBER.fullmatch(code) or "." in code or (code == text and len(codes) > 1):
                continue
            meaning = "" if code == text else re.sub("[^a-z0-9]+", "_", f"_{text.lower()}").rstrip("_")
            yield f"serial_{key}{meaning}", int(code)


def _check_keys(scope: Scope, node: Map, keys: BusKeys) -> None:
    """Report missing keys that the family needs, and keys that it does not know."""
    family = scope.family.name
    for key in keys.needed:
        if key not in node and key not in node.broken:
            message = f"the key `{key}` is missing: the family {family} needs it"
            scope.report.error("missing-key", message, node.span(), f"add `{key}: …`")
    for key in node:
        if not _knows(scope.family, key) and not key.startswith("x-"):
            known = sorted(other.name for other in families() if _knows(other, key))
            message = f"the family {family} has no key `{key}`"
            hint = f"it belongs to {' and '.join(known)}: leave it out"
            scope.report.error("family-key", message, node.key_span(key), hint)
    stated = {*node, *(key for holder in ("serial", "timing") for key in node.get(holder, ()))}
    for key in node.get("lines", ()):
        if key not in stated:
            message = f"`lines` names `{key}`, which is not under `bus`"
            scope.report.error("unknown-key", message, node["lines"].key_span(key), "leave it out, or say it")
    if keys.broadcast is not None and node.get("broadcast", keys.broadcast) != keys.broadcast:
        message = f"{node['broadcast']} is no broadcast of the family {family}"
        hint = f"write {keys.broadcast}: bit 5 of the address byte, or leave it out"
        scope.report.error("wrong-choice", message, node.span("broadcast"), hint)


def _knows(family: Family, key: str) -> bool:
    """Return True if the family has this key under `bus`: a common key or one of its own."""
    return key in family.bus or any(fact.name == key and BUS in fact.places for fact in keys_of_family(family))


def ends_of(scope: Scope, node: Map, key: str, complaint: str, last: int) -> tuple[int, int]:
    """Return the ends of an interval under `bus`, such as `units`; zeros if it is missing, or after a finding."""
    if key not in node:
        return 0, 0
    ends = interval(str(node[key]), node.span(key), scope.report)
    if ends is not None and 0 <= ends[0] <= ends[1] <= last:
        return ends
    if ends is not None:
        message = f"{key} {ends[0]}..{ends[1]} {complaint}"
        scope.report.error("address-outside-space", message, node.span(key), f"they lie in 0..{last}")
    node.broken += (key,)
    return 0, 0


def codes_under(scope: Scope, node: Map, key: str) -> tuple[Code, ...]:
    """Return the numbered codes under a key that the family needs."""
    keys = scope.family.bus
    return codes_of(scope, node.get(key) if key in keys.needed else None, *keys.codes)


def codes_of(scope: Scope, node: Map | None, first: int, last: int) -> tuple[Code, ...]:
    """Return the codes of a mapping of numbers to names, in the author's order."""
    result: list[Code] = []
    taken = Taken(scope.report, "code")
    if node is None:
        return ()
    for key, value in node.items():
        span, name = node.key_span(key), name_of(value)
        number = integer(key, span, scope.report)
        if number is not None and not first <= number <= last:
            message = f"the code {key} lies outside {first}..{last}"
            scope.report.error("address-outside-space", message, span, "correct the code")
        elif number is not None and taken.take(number, number, name, span, span):
            result.append(_code(scope, number, name, value))
    return tuple(result)


def _code(scope: Scope, number: int, name: str, value: Map | str) -> Code:
    text = entry_titles(value, name)
    if isinstance(value, str):
        return Code(number, name, text, None)
    answers, refusals = (code_list(scope, value, key) for key in ("answers", "refusals"))
    line = first_line(value.get("line"))
    return Code(number, name, text, value.get("max"), value.get("broadcast"), answers, refusals, line)


def code_list(scope: Scope, node: Map, key: str) -> tuple[int, ...]:
    """Return the numbers of a list of codes; `11..14` stands for several."""
    codes: dict[int, None] = {}
    items: Seq = node.get(key) or Seq(node.file, node.start)
    for place, item in enumerate(items):
        ends = interval(str(item), items.span(place), scope.report)
        if ends is not None and not 0 <= ends[0] <= ends[1] <= _LAST_CODE:
            message = f"the code {item} lies outside 0..{_LAST_CODE}"
            scope.report.error("address-outside-space", message, items.span(place), "correct the code")
        elif ends is not None:
            codes.update(dict.fromkeys(range(ends[0], ends[1] + 1)))
    return tuple(codes)


def _gaps(scope: Scope, node: Map | None) -> dict[str, tuple[tuple[int, int], ...]]:
    """Return the intervals of addresses under `gaps` by space."""
    result: dict[str, tuple[tuple[int, int], ...]] = {}
    known, last = scope.family.spaces, scope.family.last_address
    for space, texts in node.items() if node is not None else ():
        if node is not None and space not in known:
            scope.unknown("space", space, node.key_span(space), known)
            continue
        gaps = [
            (interval(str(text), texts.span(index), scope.report), texts.span(index))
            for index, text in enumerate(texts)
        ]
        for gap, span in gaps:
            if gap is not None and not 0 <= gap[0] <= gap[1] <= last:
                message = f"the gap {gap[0]}..{gap[1]} lies outside 0..{last}"
                scope.report.error("address-outside-space", message, span, "gaps are given in numbers on the wire")
        result[space] = tuple(sorted(gap for gap, _ in gaps if gap is not None))
    return result


def _setting(value: Any) -> dict[str, str]:
    """Return a serial setting as texts by key; the texts of a list, or a single text, are their own keys."""
    if isinstance(value, Map):
        return {key: str(text) for key, text in value.items()}
    if isinstance(value, Seq):
        return {str(item): str(item) for item in value}
    return {str(value): str(value)}


# Telegrams.


def telegrams_of(scope: Scope, messages: tuple[Message, ...]) -> Telegrams:
    """Return all telegrams by name, in the order of the text."""
    result: dict[str, tuple[Telegram, int]] = {}
    by_name = {message.name: message for message in messages}
    for node in scope.unique("telegrams"):
        name = str(node["name"])
        if TELEGRAM_SPACE not in scope.family.spaces:
            family = scope.header["family"]
            message = f"the family {family} has no telegrams"
            scope.report.error("family-key", message, node.span("name"), "leave it out")
            continue
        carried = _carried(scope, node, by_name)
        _check_carrier(scope, node, by_name, [telegram for telegram, _ in result.values()])
        telegram = Telegram(
            name=name,
            title=titles(node.get("title"), humanised(name)),
            direction=node["direction"],
            words=node["length"],
            message=node.get("message"),
            source=source_of(scope, node),
        )
        result[name] = (telegram, carried)
    for carrier in (message for message in messages if not message.roles):
        name = carrier.name
        if name in result:
            node = next(node for node in scope.listed("telegrams") if node["name"] == name)
            text, hint = f"the signals of the message `{name}` are a telegram of that name", "rename one of them"
            scope.report.error("duplicate-name", text, node.span("name"), hint)
        result[name] = Telegram(name, carrier.title, carrier.direction, 0, name, carrier.source), 0
    return result


def telegram_of(scope: Scope, telegrams: Telegrams, facts: PointFacts, space: str) -> Telegram | None:
    """Return the telegram that the point's group belongs to; None after a finding."""
    key, group = KEY_OF[space], facts.group
    name = group.get(key)
    if name is None:
        if key not in group.broken:
            hint = f"add `{key}: …` to the group"
            span = group.span("space") if "space" in group else facts.span()
            what = "words" if space == TELEGRAM_SPACE else "signals"
            text = f"the {what} of the space `{space}` belong to a {key}"
            scope.report.error("missing-key", text, span, hint)
        return None
    of_signals = space == SIGNAL_SPACE  # their words are not counted yet
    known = {each: telegram for each, (telegram, _) in telegrams.items() if (telegram.words == 0) is of_signals}
    if name not in known:
        scope.unknown(key, name, group.span(key), list(known))
    return known.get(name)


def _check_carrier(scope: Scope, node: Map, messages: Mapping[str, Message], before: list[Telegram]) -> None:
    """Report a telegram without a message, with one of another direction, or with one that another telegram uses."""
    name, direction, carrier = str(node["name"]), node["direction"], node.get("message")
    if not scope.family.lays_out_messages:
        reader_of(scope).telegram(scope, node, before)
        return
    if carrier is None:
        if "message" not in node.broken:
            text = f"nothing says which message carries `{name}`"
            scope.report.error("missing-key", text, node.span("name"), "add `message: …`")
        return
    message, other = messages.get(carrier), next((earlier for earlier in before if earlier.message == carrier), None)
    if message is not None and message.direction != direction:
        text = f"`{name}` has the direction {direction}, its message `{carrier}` has {message.direction}"
        scope.report.error("wrong-choice", text, node.span("direction"), f"write `direction: {message.direction}`")
    elif other is not None:
        text = f"the message `{carrier}` carries `{other.name}` already"
        hint = "nobody could tell whose words they are: give each telegram its own message, or make them one"
        scope.report.error("two-meanings", text, node.span("message"), hint)


def _carried(scope: Scope, node: Map, messages: Mapping[str, Message]) -> int:
    """Return how many words one of several frames carries, or 0 for a single frame; report layouts that do not fit."""
    name = node.get("message")
    if name is None or not scope.family.lays_out_messages:
        return 0
    message = messages.get(name)
    span = node.span("message")
    if message is None:
        known = [str(item["name"]) for item in scope.listed("messages")]
        if name not in known:
            scope.unknown("message", name, span, known)
        return 0
    words, multiplexed = message.words, any(role.kind == "multiplexer" for role in message.roles)
    most = words * (_MULTIPLEXED if multiplexed else 1)
    if node["length"] > most:
        text = f"the frames of `{name}` carry at most {most} words, the telegram has {node['length']}"
        hint = "its layout needs `telegram`, and a `multiplexer` where there are several frames"
        scope.report.error("too-many-items", text, span, hint)
        return 0
    return words if multiplexed else 0
