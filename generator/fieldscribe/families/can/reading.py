"""Reads the family's own facts from the description."""

from __future__ import annotations

import re
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from fieldscribe.families.can import CanBus, CanExample, identifier_bits
from fieldscribe.families.can.frames import LENGTH
from fieldscribe.language.formula import FormulaError, evaluate, parse_expression
from fieldscribe.language.numbers import NumberError, parse_integer, shown
from fieldscribe.model import Bus, Message, Role
from fieldscribe.resolve.family_reader import FamilyReader
from fieldscribe.resolve.scope import Scope, humanised, source_of, titles
from fieldscribe.resolve.values import formula_finding, integer

if TYPE_CHECKING:
    from fieldscribe.diagnostics import Span
    from fieldscribe.language.nodes import Map
    from fieldscribe.model import Bus, Code
    from fieldscribe.resolve.scope import Scope


class CanReading(FamilyReader):
    """Frames have an identifier, and the description lays out their bytes."""

    def bus(self, scope: Scope, node: Map, functions: tuple[Code, ...]) -> CanBus:
        """How fast the bus is, and how long its identifiers are."""
        del scope, functions
        return CanBus(node.get("bitrate"), node.get("identifier_bits"))

    def frame(self, scope: Scope, node: Map, framing: str) -> CanExample:
        """The identifier of a frame; a finding where there is none."""
        del framing
        if "can_id" in node:
            return CanExample(integer(node["can_id"], node.span("can_id"), scope.report))
        if "can_id" not in node.broken:
            message = f"the frame `{node['name']}` says no identifier"
            scope.report.error("missing-key", message, node.span("name"), "add `can_id: …`")
        return CanExample()

    def messages(self, scope: Scope, bus: Bus) -> tuple[Message, ...]:
        """The messages that the description lays out."""
        return messages_of(scope, bus)


READING = CanReading()


_HOW = "write a number, unit, address, raw, multiplexer, telegram, or xor 0..5"
_WIDEST = {"unit": 2, "address": 2, "raw": 2, "multiplexer": 1, "telegram": LENGTH}
_UNITS = 256
_BYTES = re.compile(r"([0-7])(?:\.\.([0-7]))?")


def messages_of(scope: Scope, bus: Bus) -> tuple[Message, ...]:
    """All messages in the order of the description; one with a wrong layout is reported and left out."""
    result: dict[str, Message] = {}
    seen: dict[str, Span] = {}
    for node in scope.listed("messages"):
        name = str(node["name"])
        if name in seen:
            first = [(seen[name], "first given here")]
            message = f"two messages have the name `{name}`"
            scope.report.error("duplicate-name", message, node.span("name"), "rename one of them", first)
            continue
        seen[name] = node.span("name")
        laid_out = _message(scope, bus, node)
        if laid_out is not None:
            result[name] = laid_out
    _answers(scope, result)
    return tuple(result.values())


def _message(scope: Scope, bus: Bus, node: Map) -> Message | None:
    identifier = _identifier(scope, bus, node)
    roles = _roles(scope, node)
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
    )


def _identifier(scope: Scope, bus: Bus, node: Map) -> tuple[int, bool] | None:
    """The identifier, and whether the unit is added to it; None after a finding."""
    span, text = node.span("can_id"), str(node["can_id"])
    try:
        expression = parse_expression(text)
        at = [evaluate(expression, {"unit": Fraction(unit)}) for unit in range(_UNITS)]
    except FormulaError as error:
        if "is not known" in error.message:
            error.hint = "an identifier is a number, or a number + unit"
        formula_finding(error, span, scope.report)
        return None
    slope = at[1] - at[0]
    if at[0].denominator != 1 or slope not in (0, 1) or at != [at[0] + unit * slope for unit in range(_UNITS)]:
        hint = "write it as `33Fh`, or `320h + unit`"
        scope.report.error("bad-formula", f"`{text}` is no identifier", span, hint)
        return None
    first, adds = at[0].numerator, bool(slope)
    bits = identifier_bits(bus)
    ends = [first + unit * adds for unit in bus.units]
    if not 0 <= min(ends) <= max(ends) < 1 << bits:
        outside = min(ends) if min(ends) < 0 else max(ends)
        message = f"the identifier {outside:X}h lies outside {bits} bits"
        hint = (
            f"identifiers of {bits} bits are 0..{(1 << bits) - 1:X}h; `identifier_bits` and `units` stand under `bus`"
        )
        scope.report.error("address-outside-space", message, span, hint)
        return None
    return first, adds


def _roles(scope: Scope, node: Map) -> tuple[Role, ...] | None:
    """The role of each byte; None after a finding."""
    layout: Map = node["layout"]
    role_of: dict[int, Role] = {}
    fine = "layout" not in node.broken and not layout.broken
    for key, value in layout.items():
        first_text, dots, last_text = key.partition("..")
        first, last = parse_integer(first_text), parse_integer(last_text if dots else first_text)
        if last < first:
            message = f"bytes `{key}` run downwards"
            scope.report.error("range-reversed", message, layout.key_span(key), f"write {last}..{first}")
            fine = False
            continue
        if last >= LENGTH:
            message = f"byte {last} lies outside the {LENGTH} bytes of a message"
            scope.report.error("bit-outside-word", message, layout.key_span(key), f"bytes are 0..{LENGTH - 1}")
            fine = False
            continue
        roles = _Part(scope, str(value).strip(), layout.span(key), last - first + 1).roles()
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
    if missing or not fine:
        return None
    return tuple(role_of[byte] for byte in range(LENGTH)) if _sums_fit(scope, node, role_of) else None


@dataclass(frozen=True, slots=True)
class _Part:
    """One entry of a layout: its text, and how many bytes it covers."""

    scope: Scope
    text: str
    span: Span
    count: int

    def roles(self) -> list[Role] | None:
        """The role of each byte; None after a finding."""
        if self.text.startswith("xor "):
            return self._xor(self.text[4:])
        return self._carried() if self.text in _WIDEST else self._constant()

    def _carried(self) -> list[Role] | None:
        text, count = self.text, self.count
        if count > _WIDEST[text] or (text == "telegram" and count % 2):
            hint = "each word of it takes two bytes" if text == "telegram" else f"it takes at most {_WIDEST[text]}"
            self._refuse(f"`{text}` cannot take {count} bytes", hint)
            return None
        if text == "telegram":
            return [Role("word", number) for number in range(count)]
        if text == "multiplexer":
            return [Role("multiplexer", 0)]
        return [Role(text, 8 * below) for below in reversed(range(count))]

    def _constant(self) -> list[Role] | None:
        try:
            number = parse_integer(self.text)
        except NumberError:
            self._refuse(f"`{shown(self.text)}` is nothing that a byte can hold", _HOW)
            return None
        if not 0 <= number < 1 << 8 * self.count:
            bytes_ = f"{self.count} byte{'s' * (self.count > 1)}"
            self._refuse(f"{self.text} does not fit into {bytes_}", f"0..{(1 << 8 * self.count) - 1:X}h does")
            return None
        return [Role("constant", byte) for byte in number.to_bytes(self.count, "big")]

    def _xor(self, text: str) -> list[Role] | None:
        """The roles of a checksum: each of its bytes is the exclusive or of every `count`-th byte of an interval."""
        interval = _BYTES.fullmatch(text.strip())
        if interval is None:
            self._refuse(f"`xor {shown(text)}` names no bytes", _HOW)
            return None
        low, high = int(interval[1]), int(interval[2] or interval[1])
        if low > high or (high - low + 1) % self.count:
            message = f"`xor {text}` cannot be made of pieces of {self.count} byte{'s' * (self.count > 1)}"
            self._refuse(message, "name the lower byte first, and as many bytes as whole pieces have")
            return None
        pieces = [range(low + place, high + 1, self.count) for place in range(self.count)]
        return [Role("xor", sum(1 << byte for byte in piece)) for piece in pieces]

    def _refuse(self, message: str, hint: str) -> None:
        self.scope.report.error("wrong-choice", message, self.span, hint)


def _sums_fit(scope: Scope, node: Map, role_of: dict[int, Role]) -> bool:
    """Whether no checksum covers another checksum, and no role stands in two places."""
    sums = sum(1 << byte for byte, role in role_of.items() if role.kind == "xor")
    if any(role.kind == "xor" and role.number & sums for role in role_of.values()):
        message = "a checksum cannot be made of a checksum"
        scope.report.error("wrong-choice", message, node.span("layout"), "name the bytes before it")
        return False
    carried = [role for role in role_of.values() if role.kind not in ("constant", "xor")]
    twice = next((role.kind for role in carried if carried.count(role) > 1), None)
    if twice is not None:
        message = f"`{'telegram' if twice == 'word' else twice}` stands in two places"
        scope.report.error("duplicate-name", message, node.span("layout"), "write its bytes as one interval")
        return False
    return True


def _answers(scope: Scope, messages: dict[str, Message]) -> None:
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
        asked = messages.get(answers)
        if asked is None:
            scope.unknown("message", answers, node.span("answers"), list(messages))
        elif asked.direction != "request":
            message = f"`{answers}` is no request"
            scope.report.error("wrong-choice", message, node.span("answers"), "a response answers a request")
