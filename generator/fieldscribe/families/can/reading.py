"""Reads the facts that only CAN has from the description: bit rate, identifiers, and the layout of messages."""

import re
from collections.abc import Collection, Iterable
from dataclasses import replace

from fieldscribe.diagnostics import Span
from fieldscribe.families.can import USUAL_BITS, CanBus, CanExample, identifier_bits
from fieldscribe.families.can.frames import LENGTH
from fieldscribe.families.can.signals import placed
from fieldscribe.language.nodes import Map
from fieldscribe.language.numbers import integer_in, parse_integer
from fieldscribe.model import Bus, Code, Message, Point, Role
from fieldscribe.resolve.bus import FamilyReader, Messages
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.values import FactError, formula_multiples, integer
from fieldscribe.text import humanised, shortened

_HOW = "write a number, unit, address, raw, multiplexer, telegram, or xor 0..5"
_WIDEST = {"unit": 2, "address": 2, "raw": 2, "multiplexer": 1, "telegram": LENGTH}
"""The most bytes that each word of a layout covers."""
_MOST_BITS = 29
_TO_ALL = 0xF0
"""From this byte on, a parameter group of J1939 has no destination."""
_USUAL_PRIORITY, _EVERYONE = 6, 0xFF
_TIME = re.compile(r"([0-9]{1,7}) ?(ms|s)")
_BYTES = re.compile(r"([0-7])(?:\.\.([0-7]))?")


class CanReading(FamilyReader):
    """Reads the bus, the identifiers of frames, and the layouts of messages."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> CanBus:
        """Return the bit rate, and the length of identifiers."""
        del scope, functions
        return CanBus(node.get("bitrate"), node.get("identifier_bits"))

    def frame(self, scope: Scope, node: Map, framing: str) -> CanExample:
        """Return the identifier of a frame; report a frame without one."""
        del framing
        if "can_id" in node:
            return CanExample(integer(node["can_id"], node.span("can_id"), scope.report))
        if "can_id" not in node.broken:
            message = f"the frame `{node['name']}` has no identifier"
            scope.report.error("missing-key", message, node.span("name"), "add `can_id: …`")
        return CanExample()

    def messages(self, scope: Scope, bus: Bus) -> tuple[Message, ...]:
        """Return all messages in the order of the description; report and leave out those with a wrong layout."""
        result: dict[str, Message] = {}
        for node in scope.unique("messages"):
            read = _message(scope, bus, node)
            if read is not None:
                result[read.name] = read
        _check_answers(scope, result, {str(node["name"]) for node in scope.listed("messages")})
        return tuple(result.values())

    def lay_out(self, messages: Messages, points: Iterable[Point]) -> tuple[Messages, list[Point]]:
        """Return the messages with their signals, and the points with their places in the words of these."""
        result, carried = list(points), {message.name: message for message in messages}
        for name, message in carried.items():
            of_message = (
                []
                if message.roles
                else [
                    (number, point) for number, point in enumerate(result) if point.telegram == name and point.addresses
                ]
            )
            if of_message:
                carried[name], places = placed(message, [point for _, point in of_message])
                for (number, point), place in zip(of_message, places, strict=True):
                    result[number] = replace(point, place=place)
        return tuple(carried.values()), result


READING = CanReading()


def _message(scope: Scope, bus: Bus, node: Map) -> Message | None:
    if "can_id" in node or "can_id" in node.broken:
        identifier = _identifier(scope, bus, node)
        if "pgn" in node:
            message, hint = "`pgn` and `can_id` exclude each other", "leave one of them out"
            scope.report.error("two-meanings", message, node.key_span("pgn"), hint)
    else:
        identifier = _group(scope, node)
    laid_out = "layout" in node or "layout" in node.broken
    roles = _roles(scope, node) if "layout" in node else None if laid_out else ()
    if laid_out and "length" in node:
        message = f"the {LENGTH} bytes of a `layout` are the length of the message"
        scope.report.error("two-meanings", message, node.key_span("length"), "leave `length` out")
    every = _milliseconds(scope, node)
    if identifier is None or roles is None:
        return None
    return Message(
        name=str(node["name"]),
        title=titles(node.get("title"), humanised(node["name"])),
        direction=node["direction"],
        answers=node.get("answers"),
        identifier=identifier[0],
        adds_unit=identifier[1],
        roles=roles,
        source=source_of(scope, node),
        length=LENGTH if laid_out else int(node.get("length", LENGTH)),
        bits=_bits(bus, node) if _bits(bus, node) != identifier_bits(bus) else None,
        every=every,
    )


def _bits(bus: Bus, node: Map) -> int:
    """Return the bits of the identifier of a message."""
    return int(node.get("identifier_bits", _MOST_BITS if "pgn" in node else identifier_bits(bus)))


def _milliseconds(scope: Scope, node: Map) -> int | None:
    """Return the period of a message in milliseconds; report a text that is not a time."""
    text = node.get("every")
    match = None if text is None else _TIME.fullmatch(str(text))
    if text is not None and match is None:
        message = f"`{shortened(str(text))}` is no time"
        scope.report.error("bad-number", message, node.span("every"), "write it as `100 ms` or `1 s`")
    return None if match is None else int(match[1]) * (1000 if match[2] == "s" else 1)


def _group(scope: Scope, node: Map) -> tuple[int, bool] | None:
    """Return the identifier of a parameter group of J1939, and True if the unit is added to it."""
    if "pgn" not in node:
        if "pgn" not in node.broken:
            message = f"the message `{node['name']}` has no identifier"
            scope.report.error("missing-key", message, node.span("name"), "add `can_id: …`, or the `pgn` of J1939")
        return None
    pgn = integer(node["pgn"], node.span("pgn"), scope.report)
    addressed = pgn is not None and pgn >> 8 & 0xFF < _TO_ALL
    if pgn is None or not 0 <= pgn < 1 << 18 or (addressed and pgn & 0xFF):
        if pgn is not None:
            hint = "it has 18 bits; the low byte of one below 0F000h is 0, for the destination stands there"
            scope.report.error("wrong-choice", f"{pgn:X}h is no parameter group", node.span("pgn"), hint)
        return None
    if "destination" in node and not addressed:
        message = "this parameter group goes to all"
        scope.report.error("two-meanings", message, node.key_span("destination"), "leave `destination` out")
    destination = int(node.get("destination", _EVERYONE)) if addressed else 0
    first = int(node.get("priority", _USUAL_PRIORITY)) << 26 | pgn << 8 | destination << 8
    sender = node.get("source_address", 0)
    if sender == "unit":
        return first, True
    number = integer(sender, node.span("source_address"), scope.report) if "source_address" in node else 0
    return None if number is None else (first | number, False)


def _identifier(scope: Scope, bus: Bus, node: Map) -> tuple[int, bool] | None:
    """Return the identifier, and True if the unit is added to it; None if it cannot be read."""
    span = node.span("can_id")
    try:
        first, factors = formula_multiples(
            str(node["can_id"]), ("unit",), span, "an identifier is a number, or a number + unit", "320h + unit"
        )
    except FactError as error:
        error.report(scope.report)
        return None
    adds, bits = factors.get("unit") == 1, _bits(bus, node)
    if factors and not adds:
        scope.report.error(
            "bad-formula", f"`{node['can_id']}` is no identifier", span, "write it as `33Fh`, or `320h + unit`"
        )
        return None
    low, high = sorted(first + unit * adds for unit in bus.units)
    known = scope.bus is not None and not {"identifier_bits", "units"} & {*scope.bus.broken}
    if known and not 0 <= low <= high < 1 << bits:
        message = f"the identifier {low if low < 0 else high:X}h lies outside {bits} bits"
        hint = (
            f"identifiers of {bits} bits are 0..{(1 << bits) - 1:X}h; `identifier_bits` and `units` stand under `bus`"
        )
        if bits == USUAL_BITS and 0 <= low <= high < 1 << _MOST_BITS:
            hint = f"write `identifier_bits: {_MOST_BITS}` under `bus`"
        scope.report.error("address-outside-space", message, span, hint)
    return first, adds


def _roles(scope: Scope, node: Map) -> tuple[Role, ...] | None:
    """Return the role of each byte; None after a finding."""
    layout: Map = node["layout"]
    role_of: dict[int, Role] = {}
    fine = "layout" not in node.broken and not layout.broken
    for key, value in layout.items():
        first_text, dots, last_text = key.partition("..")
        first, last = parse_integer(first_text), parse_integer(last_text if dots else first_text)
        finding: tuple[str, str, str] | None = None
        if last < first:
            finding = "range-reversed", f"bytes `{key}` run downwards", f"write {last}..{first}"
        elif last >= LENGTH:
            message = f"byte {last} lies outside the {LENGTH} bytes of a message"
            finding = "bit-outside-word", message, f"bytes are 0..{LENGTH - 1}"
        if finding is not None:
            scope.report.error(finding[0], finding[1], layout.key_span(key), finding[2])
            fine = False
            continue
        roles = _roles_of_entry(scope, str(value).strip(), layout.span(key), last - first + 1)
        fine = fine and roles is not None
        for byte, role in zip(range(first, last + 1), roles or (), strict=False):
            if byte in role_of:
                message = f"byte {byte} is laid out twice"
                scope.report.error("bits-overlap", message, layout.key_span(key), "each byte has one meaning")
                fine = False
            role_of[byte] = role
    missing = [byte for byte in range(LENGTH) if byte not in role_of]
    if missing and fine:
        message = f"byte {missing[0]} of `{node['name']}` means nothing"
        hint = f"say what each of the bytes 0..{LENGTH - 1} holds; unused ones are a constant"
        scope.report.error("missing-key", message, node.span("layout"), hint)
    if missing or not fine or not _roles_fit(scope, node, role_of):
        return None
    return tuple(role_of[byte] for byte in range(LENGTH))


def _roles_of_entry(scope: Scope, text: str, span: Span, count: int) -> list[Role] | None:
    """Return the roles of the bytes of one entry of a layout; None after a finding."""
    result = _checksum(text, count) if text.startswith("xor ") else _field(text, count)
    if isinstance(result, tuple):
        scope.report.error("wrong-choice", result[0], span, result[1])
        return None
    return result


def _field(text: str, count: int) -> list[Role] | tuple[str, str]:
    """Return the roles of a field or a constant, or the message and the hint of a finding."""
    if text not in _WIDEST:
        return _constant(text, count)
    if count > _WIDEST[text] or (text == "telegram" and count % 2):
        hint = "each word of it takes two bytes" if text == "telegram" else f"it takes at most {_WIDEST[text]}"
        return f"`{text}` cannot take {count} bytes", hint
    if text == "telegram":
        return [Role("word", number) for number in range(count)]
    return [Role(text, 8 * below) for below in reversed(range(count))]


def _constant(text: str, count: int) -> list[Role] | tuple[str, str]:
    number = integer_in(text)
    if number is None:
        return f"`{shortened(text)}` is not something that a byte can hold", _HOW
    if not 0 <= number < 1 << 8 * count:
        return f"{text} does not fit into {_bytes(count)}", f"0..{(1 << 8 * count) - 1:X}h does"
    return [Role("constant", byte) for byte in number.to_bytes(count, "big")]


def _checksum(text: str, count: int) -> list[Role] | tuple[str, str]:
    """Return the roles of a checksum: each byte is the exclusive or of every `count`-th byte of an interval."""
    interval = _BYTES.fullmatch(text.removeprefix("xor ").strip())
    if interval is None:
        return f"`xor {shortened(text.removeprefix('xor '))}` names no bytes", _HOW
    low, high = int(interval[1]), int(interval[2] or interval[1])
    if low > high or (high - low + 1) % count:
        hint = "name the lower byte first, and as many bytes as whole pieces have"
        return f"`{text}` cannot be made of pieces of {_bytes(count)}", hint
    pieces = [range(low + place, high + 1, count) for place in range(count)]
    return [Role("xor", sum(1 << byte for byte in piece)) for piece in pieces]


def _bytes(count: int) -> str:
    return f"{count} byte{'s' * (count > 1)}"


def _roles_fit(scope: Scope, node: Map, role_of: dict[int, Role]) -> bool:
    """Report a checksum of a checksum, or a role in two places; return True if there is none."""
    sums = sum(1 << byte for byte, role in role_of.items() if role.kind == "xor")
    fields = [role for role in role_of.values() if role.kind not in ("constant", "xor")]
    twice = next((role.kind for role in fields if fields.count(role) > 1), None)
    if any(role.kind == "xor" and role.number & sums for role in role_of.values()):
        finding = "wrong-choice", "a checksum cannot be made of a checksum", "name the bytes before it"
    elif twice is not None:
        message = f"`{'telegram' if twice == 'word' else twice}` stands in two places"
        finding = "duplicate-name", message, "write its bytes as one interval"
    else:
        return True
    scope.report.error(finding[0], finding[1], node.span("layout"), finding[2])
    return False


def _check_answers(scope: Scope, messages: dict[str, Message], all_names: Collection[str]) -> None:
    """Report responses that name no existing request, and `answers` at other messages."""
    for node in scope.listed("messages"):
        name, answers = str(node["name"]), node.get("answers")
        if name not in messages:
            continue
        if answers is None:
            if node["direction"] == "response" and "answers" not in node.broken:
                message = f"the response `{name}` answers nothing"
                scope.report.error("missing-key", message, node.span("name"), "name the request under `answers`")
            continue
        if node["direction"] != "response":
            message = f"`{name}` answers, but is no response"
            scope.report.error("wrong-choice", message, node.span("direction"), "write `direction: response`")
        request = messages.get(answers)
        if request is None and answers not in all_names:
            scope.unknown("message", answers, node.span("answers"), list(messages))
        elif request is not None and request.direction != "request":
            message = f"`{answers}` is no request"
            scope.report.error("wrong-choice", message, node.span("answers"), "a response answers a request")
