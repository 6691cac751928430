"""Explains what stands in frames: messages and their identifiers, functions, tasks, responses, errors."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe import wording
from fieldscribe.families import family
from fieldscribe.pasted_numbers import number_of
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.families import Codes
    from fieldscribe.model import Code, Device, Message

Answer = tuple[str, str, list[tuple[str, str]]]
"""How the question was understood, a heading, and rows."""

_WORDS = {"address": "address", "raw": "value", "word": "word"}


def find_exchanges(device: Device, what: str) -> Iterator[Answer]:
    """Every meaning that a name, or a number with its kind (`task:1`, `can:321`), has in frames."""
    prefix, colon, rest = what.partition(":")
    forced = prefix.strip().lower() if colon else ""
    asked = (rest if colon else what).strip()
    own = family(device.family)
    for codes in own.codes:
        for code in device.bus.codes(codes.section):
            by_number = forced == codes.kind and number_of(asked) == code.number
            if by_number or (forced in ("", "name", codes.kind) and asked.lower() == code.name):
                yield f"{codes.kind} {code.number}", *_code(device, codes, code)
    for message in device.messages:
        if forced in ("", "name") and asked.lower() == message.name:
            yield f"message {message.name}", *_message(device, message)
    number = _identifier(asked) if own.lays_out_messages and forced == own.name else None
    for message in device.messages if number is not None else ():
        low, high = device.bus.units if message.adds_unit else (0, 0)
        if number is not None and message.identifier + low <= number <= message.identifier + high:
            unit = f" of unit {number - message.identifier}" if message.adds_unit else ""
            yield f"{own.name.upper()} identifier {hex_text(number, 3)}{unit}", *_message(device, message)


def _identifier(text: str) -> int | None:
    """An identifier, hexadecimal as in the tools for the bus: `321`, `0x321`, `321h`."""
    digits = text.lower().removeprefix("0x").removesuffix("h")
    plain = 0 < len(digits) <= 8 and all(digit in "0123456789abcdef" for digit in digits)
    return int(digits, 16) if plain else None


def _code(device: Device, codes: Codes, code: Code) -> tuple[str, list[tuple[str, str]]]:
    rows = []
    if code.most is not None:
        rows.append(("At most", f"{code.most} in one request"))
    if code.broadcast is not None:
        rows.append(("Broadcast", "yes" if code.broadcast else "no"))
    other = next(
        (other_codes for other_codes in family(device.family).codes if other_codes.section == codes.belongs_to), None
    )
    if other is not None:
        known = {other_code.number: other_code.name for other_code in device.bus.codes(other.section)}
        answers, refusals = (_named(numbers, known) for numbers in (code.answers, code.refusals))
        asks = codes.section == "functions"  # a request without an answer gets a row, too
        rows += [(f"{other.kind.capitalize()}s", answers or ("none" if asks else "")), ("Refused by", refusals)]
    return f"{codes.kind} {code.number} {code.name}: {wording.title_text(code.title)}", rows


def _named(numbers: tuple[int, ...], known: Mapping[int, str]) -> str:
    return ", ".join(f"{number} {known.get(number, '')}".strip() for number in numbers)


def _message(device: Device, message: Message) -> tuple[str, list[tuple[str, str]]]:
    low, high = device.bus.units
    where = hex_text(message.identifier, 3)
    if message.adds_unit:
        where = f"{where} + unit: {hex_text(message.identifier + low, 3)} to {hex_text(message.identifier + high, 3)}"
    rows = [
        (f"{device.family.upper()} identifier", where),
        ("Direction", message.direction),
        ("Answers", message.answers or ""),
    ]
    rows += [(f"Byte {place}", _role(role.kind, role.number)) for place, role in enumerate(message.roles)]
    telegrams = [telegram.name for telegram in device.telegrams if telegram.message == message.name]
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
