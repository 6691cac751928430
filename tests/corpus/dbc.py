"""CAN databases: each as a device, whose own database means the same in random frames."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import chain
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from cantools.database.can import Node
from cantools.database.errors import DecodeError
from fieldscribe.cli.importing import database_of, text_of
from fieldscribe.diagnostics import Report
from fieldscribe.families.can.dbc import export
from fieldscribe.importing import compilable
from fieldscribe.importing.dbc import DbcDraft
from fieldscribe.importing.draft_text import Document, Head
from fieldscribe.importing.readers import UnreadableError
from fieldscribe.pipeline import load_device

from corpus.collection import Collection, Counts, Drafted, Points
from corpus.registers import Register, UnlikeError, names_of
from corpus.writing import nearest, real

FRAMES = 20
NODE = "fieldscribe_device"
"""The device: it sends every other message, and the others are sent to it."""


def _files(folder: Path) -> list[Path]:
    return sorted(folder.rglob("*.dbc"))


def _draft(file: Path) -> Drafted | None:
    """None for what cantools does not read, and for files without signals."""
    text = text_of(file.read_bytes())
    try:
        database = database_of(text)
    except UnreadableError:
        return None
    database.nodes.append(Node(NODE, None))
    for message in database.messages[::2]:
        message.senders.append(NODE)
    drafted = DbcDraft(database, text, NODE)
    if not drafted.groups:
        return None
    document = Document(file.name, "ab" * 32, "database")
    head = Head("device", [document], "can", facts=drafted.head(), kind="a CAN database", bus=drafted.bus())
    compiled = compilable(drafted.groups, head, with_head=True)
    different = set(_different(database, compiled))
    for group in drafted.groups:
        for point in group.points if group.title in different else ():
            point.questions.append("not carried: frames: they mean something else")
    return Drafted(drafted.groups, head)


def _different(database: Any, compiled: str) -> list[str]:
    """The messages whose random frames have other values in the database of the device."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "device.yaml")
        path.write_text(compiled, "utf-8")
        device = load_device(path, Report())
    assert device is not None
    again = database_of(export(device).decode("latin-1"))
    others = {(one.frame_id, one.is_extended_frame): one for one in again.messages}
    return [
        message.name
        for message in database.messages
        if message.signals and not _same(message, others.get((message.frame_id, message.is_extended_frame)))
    ]


def _same(message: Any, other: Any) -> bool:
    chance = random.Random(message.name)
    frames = [chance.randbytes(message.length) for _ in range(FRAMES)]
    return other is not None and all(_values(message, data) == _values(other, data) for data in frames)


def _values(message: Any, data: bytes) -> list[str]:
    """The values in the order of their numbers, for names differ."""
    try:
        values = message.decode(data, decode_choices=False).values()
    except Exception as error:
        return [type(error).__name__]
    return sorted(repr(float(value)) for value in values)


def expected(file: Path, points: Points, chance: random.Random, counts: Counts) -> Iterator[tuple[str, Iterator[str]]]:
    """Yield points with vectors for random frames, as cantools takes them apart."""
    of_message: dict[str, dict[str, Mapping[str, Any]]] = {}
    for point in points:
        of_message.setdefault(point["source"]["section"], {})[point["title"]["en"]] = point
    for message in database_of(text_of(file.read_bytes())).messages:
        given = of_message.get(message.name, {})
        known = [signal for signal in message.signals if _title(signal) in given]
        taken: dict[str, list[tuple[bytes, float]]] = {}
        for _ in range(counts.read if known else 0):
            data = _frame(message, chance)
            try:
                raws = message.decode(data, decode_choices=False, scaling=False)
            except DecodeError:  # its multiplexer allows no such frame
                continue
            for name, raw in raws.items():
                taken.setdefault(name, []).append((data, raw))
        for signal in known:
            if not (signal.is_float and (signal.scale, signal.offset) != (1, 0)):
                point = given[_title(signal)]
                read = _vectors(message, signal, taken.get(signal.name, []), point)
                written = _register(signal).written(point, chance, counts.written * (point["access"] == "w"))
                yield point["name"], chain(read, written)


def _title(signal: Any) -> str:
    return str(signal.name).replace("_", " ").strip() or str(signal.name)


def _bits(signal: Any) -> list[int]:
    """Return the bits of a signal from its lowest, counted from bit 0 of byte 0."""
    if signal.byte_order == "little_endian":
        return list(range(signal.start, signal.start + signal.length))
    bits, at = [], signal.start
    for _ in range(signal.length):
        bits.append(at)
        at = at - 1 if at % 8 else at + 15
    return bits[::-1]


def _frame(message: Any, chance: random.Random) -> bytes:
    """Return a random frame, in which multiplexers more often have numbers that select something."""
    data = bytearray(chance.randbytes(message.length))
    for signal in message.signals:
        ids = [
            number
            for other in message.signals
            if other.multiplexer_signal == signal.name
            for number in other.multiplexer_ids
        ]
        named = list(ids or signal.choices or ())
        if named and chance.random() < 0.5:
            _put(data, signal, chance.choice(named))
    return bytes(data)


def _put(data: bytearray, signal: Any, raw: int) -> None:
    for place, bit in enumerate(_bits(signal)):
        data[bit // 8] = data[bit // 8] & ~(1 << bit % 8) | (raw >> place & 1) << bit % 8


def _alone(message: Any, signal: Any, raw: int) -> bytes:
    """Return the frame of this signal alone, with multiplexers that select it: at the last number that does."""
    data = bytearray(message.length)
    _put(data, signal, raw)
    while signal.multiplexer_signal:
        selecting = message.get_signal_by_name(signal.multiplexer_signal)
        _put(data, selecting, max(signal.multiplexer_ids))
        signal = selecting
    return bytes(data)


def _vectors(message: Any, signal: Any, taken: list[tuple[bytes, float]], point: Mapping[str, Any]) -> Iterator[str]:
    ratio, offset = (Fraction(str(number)) for number in (signal.scale, signal.offset))
    titles = {int(number): str(title) for number, title in (signal.choices or {}).items()}
    titles = {number: title for number, title in titles.items() if number < 1 << signal.length}
    names = names_of(point, titles) if point["enum"] else {}
    yield f"telegram\t{point['telegram']}\t0"
    for data, found in taken:
        pattern = sum((data[bit // 8] >> bit % 8 & 1) << place for place, bit in enumerate(_bits(signal)))
        raw = pattern if signal.is_float else int(found)
        yield f"can_signal\t{message.frame_id}\t{data.hex()}\tok\t{raw}\t{_alone(message, signal, raw).hex()}"
        if point["access"] == "w":
            continue
        if signal.is_float:
            yield from [f"decode\t{raw}\tok\t{real(found)}"] if math.isfinite(found) else []
        elif ratio == 1 and not offset:
            yield from [f"decode_count\t{raw}\tok\t{raw}"] if raw < 1 << 63 else []
            yield from [f"name\t{raw}" + (f"\t{names[raw]}" if raw in titles else "")] if names else []
        else:
            code = next((one for one in point["special"] if one["raw"][0] <= raw <= one["raw"][1]), None)
            if (code is None) != (raw not in titles):
                raise UnlikeError(f"{raw} is no special code, or should be one")
            value = f"special\t-\t{code['name']}" if code else f"ok\t{real(nearest(raw * ratio + offset))}"
            yield f"decode\t{raw}\t{value}"


def _register(signal: Any) -> Register:
    """Return a signal as it is written: between its limits, if these are raw numbers of it and leave out no name.

    Beside a scale, a number with a name is none that a value may become.
    """
    ratio, offset = (Fraction(str(number)) for number in (signal.scale, signal.offset))
    named = {int(raw): str(title) for raw, title in (signal.choices or {}).items() if _holds(signal, int(raw))}
    kind = "f" if signal.is_float else "s" if signal.is_signed else "u"
    one = Register(kind, signal.length, ratio=ratio, offset=offset)
    if ratio == 1 and not offset:
        one.names = named
    else:
        one.codes = {raw & (1 << signal.length) - 1: title for raw, title in named.items()}
    if not (signal.is_float or signal.is_multiplexer or signal.minimum is None or signal.maximum is None):
        ends = [(Fraction(str(end)) - offset) / ratio for end in (signal.minimum, signal.maximum)]
        low, high = sorted(ends)
        fit = low < high and all(end.denominator == 1 and _holds(signal, int(end)) for end in ends)
        if fit and all(low <= raw <= high for raw in one.names):
            one.ends = low * ratio + offset, high * ratio + offset
            one.ends = min(one.ends), max(one.ends)
    return one


def _holds(signal: Any, raw: int) -> bool:
    least = -(1 << signal.length - 1) if signal.is_signed else 0
    return bool(least <= raw < least + (1 << signal.length))


DBC = Collection("dbc", _files, _draft, expected)
