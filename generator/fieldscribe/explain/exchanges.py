"""What can be explained of frames: messages and their identifiers, functions, tasks, responses, errors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.explain.lookup import number_of
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Code, Device, Message

Found = tuple[str, str, list[tuple[str, str]]]
"""As what the question was read, a heading, and rows."""

_KINDS: Mapping[str, tuple[tuple[str, str], ...]] = {
    "modbus": (("function", "functions"), ("exception", "exceptions")),
    "uss": (("task", "functions"), ("response", "responses"), ("error", "exceptions")),
}
"""What the numbers of a family are called, and where the bus has them."""

_OTHER_SIDE = {"task": ("response", "responses"), "response": ("task", "functions"), "error": ("task", "functions")}
_WORDS = {"address": "address", "raw": "value", "word": "word"}


def find_exchanges(device: Device, what: str) -> Iterator[Found]:
    """Everything about frames that a name or a number with its kind (`task:1`, `can:321`) means."""
    prefix, colon, rest = what.partition(":")
    forced = prefix.strip().lower() if colon else ""
    asked = (rest if colon else what).strip()
    for kind, field in _KINDS.get(device.family, ()):
        for code in getattr(device.bus, field):
            by_number = forced == kind and number_of(asked) == code.number
            if by_number or (forced in ("", "name", kind) and asked.lower() == code.name):
                yield f"{kind} {code.number}", *_code(device, kind, code)
    for message in device.messages:
        if forced in ("", "name") and asked.lower() == message.name:
            yield f"message {message.name}", *_message(device, message)
    number = _identifier(asked) if forced == "can" else None
    for message in device.messages if number is not None else ():
        low, high = device.bus.units if message.adds_unit else (0, 0)
        if number is not None and message.can_id + low <= number <= message.can_id + high:
            unit = f" of unit {number - message.can_id}" if message.adds_unit else ""
            yield f"CAN identifier {hex_text(number, 3)}{unit}", *_message(device, message)


def _identifier(text: str) -> int | None:
    """A CAN identifier, hexadecimal as on every CAN tool: `321`, `0x321`, `321h`."""
    digits = text.lower().removeprefix("0x").removesuffix("h")
    plain = 0 < len(digits) <= 8 and all(one in "0123456789abcdef" for one in digits)
    return int(digits, 16) if plain else None


def _code(device: Device, kind: str, code: Code) -> tuple[str, list[tuple[str, str]]]:
    rows = []
    if code.most is not None:
        rows.append(("At most", f"{code.most} in one request"))
    if code.broadcast is not None:
        rows.append(("Broadcast", "yes" if code.broadcast else "no"))
    other = _OTHER_SIDE.get(kind)
    if other is not None:
        known: dict[int, str] = {one.number: one.name for one in getattr(device.bus, other[1])}
        for label, numbers in ((f"{other[0].capitalize()}s", code.answers), ("Refused by", code.refusals)):
            said = ", ".join(f"{number} {known.get(number, '')}".strip() for number in numbers)
            rows.append((label, said or ("none" if kind == "task" and label != "Refused by" else "")))
    return f"{kind} {code.number} {code.name}: {wording.title_text(code.title)}", rows


def _message(device: Device, message: Message) -> tuple[str, list[tuple[str, str]]]:
    low, high = device.bus.units
    where = hex_text(message.can_id, 3)
    if message.adds_unit:
        where = f"{where} + unit: {hex_text(message.can_id + low, 3)} to {hex_text(message.can_id + high, 3)}"
    rows = [("CAN identifier", where), ("Direction", message.direction), ("Answers", message.answers or "")]
    rows += [(f"Byte {place}", _role(role.kind, role.number)) for place, role in enumerate(message.roles)]
    telegrams = [one.name for one in device.telegrams if one.message == message.name]
    rows.append(("Telegram", ", ".join(telegrams)))
    return f"message {message.name}: {wording.title_text(message.title)}", rows


def _role(kind: str, number: int) -> str:
    if kind == "constant":
        return f"always {hex_text(number, 2)}"
    if kind == "xor":
        places = [str(place) for place in range(8) if number >> place & 1]
        return f"bytes {', '.join(places)} combined by exclusive or"
    if kind == "word":
        return f"word {number // 2} of the frame, {'low' if number & 1 else 'high'} byte"
    if kind in ("address", "raw"):
        return f"{_WORDS[kind]}, {'high' if number else 'low'} byte"
    return {"unit": "unit number", "multiplexer": "multiplexer: which words of the telegram follow"}.get(kind, kind)
