"""Cases for the parsers, written from the protocols alone: requests with answers that are right, wrong, or noise."""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from functools import reduce
from random import Random

from fieldscribe.model import Message
from support.described import made

_SIZES = (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 16, 255, 256, 260, 300)
_WORDS = (0, 1, 2, 3, 7, 8, 9, 16, 0x7F, 0xFF, 0x100, 0x7FFF, 0x8000, 0x8001, 0xFFFF)


def _crc_table() -> tuple[int, ...]:
    return tuple(
        reduce(lambda value, _: value >> 1 ^ (0xA001 if value & 1 else 0), range(8), byte) for byte in range(256)
    )


_CRC = _crc_table()


def _with_crc(body: bytes) -> bytes:
    value = 0xFFFF
    for byte in body:
        value = value >> 8 ^ _CRC[(value ^ byte) & 0xFF]
    return body + value.to_bytes(2, "little")


def _with_check(body: bytes) -> bytes:
    return body + bytes((reduce(lambda check, byte: check ^ byte, body, 0),))


def _word(random: Random) -> int:
    return random.choice(_WORDS) if random.random() < 0.5 else random.getrandbits(16)


def _mutated(random: Random, data: bytes) -> bytes:
    """A byte changed, some taken away or added; now and then something else altogether."""
    kind = random.random()
    if kind < 0.5 and data:
        place = random.randrange(len(data))
        return data[:place] + bytes((random.getrandbits(8),)) + data[place + 1 :]
    if kind < 0.7:
        return data[: random.randint(0, len(data))]
    if kind < 0.9:
        return data + random.randbytes(random.randint(1, 3))
    return random.randbytes(random.choice(_SIZES))


def modbus(random: Random, count: int) -> Iterator[bytes]:
    """Framing, unit, function, address, count, transaction, number to write; the answer."""
    for _ in range(count):
        function = random.choice((1, 2, 3, 4, 5, 6, 8, 15, 16))
        items = 1 if function in (5, 6, 8) else random.randint(1, 20) if random.random() < 0.9 else _word(random) % 2100
        items = items or 1
        unit, address, number, transaction = random.getrandbits(8), _word(random), _word(random), _word(random)
        tcp = random.random() < 0.4
        pdu = _modbus_pdu(random, function, address, items, number)
        if random.random() < 0.3:
            pdu = _mutated(random, pdu)
        frame = bytes((unit,)) + pdu
        head = struct.pack(">HHH", transaction, 0, len(frame))
        frame = head + frame if tcp else _with_crc(frame)
        if random.random() < 0.3:
            frame = _mutated(random, frame)
        fields = (tcp, unit, function, address, items, transaction, number, len(frame))
        yield struct.pack("<BBBHHHHH", *fields) + frame


def _modbus_pdu(random: Random, function: int, address: int, items: int, number: int) -> bytes:
    if random.random() < 0.1:
        return bytes((function | 0x80, random.getrandbits(8)))
    if function <= 4:
        size = (items + 7) // 8 if function <= 2 else 2 * items
        return bytes((function, size & 0xFF)) + random.randbytes(size % 256)
    sent = items if function >= 15 else 0xFF00 * (number & 1) if function == 5 else number
    return struct.pack(">BHH", function, address, sent)


def _messages() -> tuple[Message, ...]:
    """The layouts of the made device, as the model has them: built here without any target's code."""
    return tuple(message for message in made("kitchen_can").messages if message.roles)


def _laid_out(random: Random, message: Message, unit: int) -> bytes:
    """The bytes of a message with anything in it."""
    data = bytearray()
    for role in message.roles:
        known = {"constant": role.number, "unit": unit >> role.number, "multiplexer": random.randrange(8)}
        data.append(known.get(role.kind, random.getrandbits(8)) & 0xFF)
    for place, role in enumerate(message.roles):
        if role.kind == "xor":
            parts = [byte for at, byte in enumerate(data) if role.number >> at & 1]
            data[place] = reduce(lambda check, byte: check ^ byte, parts, 0)
    return bytes(data)


def can(random: Random, count: int) -> Iterator[bytes]:
    """The message, the unit, a position of the telegram; identifier and data."""
    messages = _messages()
    for _ in range(count):
        place = random.randrange(len(messages))
        message = messages[place]
        unit = 5 if random.random() < 0.8 else random.getrandbits(8)
        data = _laid_out(random, message, unit)
        frame = (_mutated(random, data) if random.random() < 0.4 else data)[:255]
        identifier = message.identifier + unit * message.adds_unit if random.random() < 0.95 else random.getrandbits(29)
        yield struct.pack("<BBHIH", place, unit, random.randrange(16), identifier, len(frame)) + frame


def uss(random: Random, count: int) -> Iterator[bytes]:
    """The link, the unit, task, parameter and index; the answer."""
    for _ in range(count):
        pkw = random.choice((0, 3, 4, 127)) if random.random() < 0.97 else random.getrandbits(8)
        pzd = random.randrange(5) if random.random() < 0.97 else random.getrandbits(8)
        unit, task = random.randrange(32), random.randrange(16) if pkw else 0
        parameter, index = random.randrange(32000), random.getrandbits(8)
        page = parameter // 2000
        pages = (page & 1) << 15 | (page >> 1 & 1) << 12 | (page >> 2 & 1) << 13 | (page >> 3 & 1) << 14
        words = [random.randrange(16) << 12 | parameter % 2000, pages | index, _word(random), _word(random)]
        part = words[:pkw] if pkw < 127 else words + [_word(random)] * random.randrange(-1, 3)
        data = [*part, *(_word(random) for _ in range(pzd))]
        body = bytes((2, (2 * len(data) + 2) % 256, unit)) + struct.pack(f">{len(data)}H", *data)
        if random.random() < 0.2:
            body = _mutated(random, body)
        frame = _with_check(body)
        if random.random() < 0.2:
            frame = _mutated(random, frame)
        fields = (pkw, pzd, random.random() < 0.2, unit, task, parameter, index, len(frame))
        yield struct.pack("<BBBBBHHH", *fields) + frame


CASES: dict[str, Callable[[Random, int], Iterator[bytes]]] = {"modbus": modbus, "can": can, "uss": uss}
