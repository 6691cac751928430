"""The view of the USS header: tasks, responses and errors, requests point by point, words of process data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.names import upper
from fieldscribe.targets.c.can import raw_of_word, word_of_raw
from fieldscribe.targets.c.literals import hexadecimal
from fieldscribe.targets.c.places import fixed_number, fixes
from fieldscribe.targets.identifiers import Owner
from fieldscribe.text import c_comment, c_string

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Code, Device, Point, Telegram
    from fieldscribe.targets.c.scope import Scope
    from fieldscribe.targets.c.views import DeviceView, PointView

_READ = (1, 6)
_RAM = {(1, False): 2, (2, False): 3, (1, True): 7, (2, True): 8}
_EEPROM = {(1, False): 14, (2, False): 13, (1, True): 12, (2, True): 11}
"""The tasks that write a value of one or two words, of a parameter or (True) of an element of one."""


@dataclass(frozen=True, slots=True)
class CodesView:
    """Numbers of the protocol with names: enumerators with comments, and the function that tells the name."""

    title: str
    function: str
    entries: tuple[tuple[str, str, str, str], ...]


@dataclass(frozen=True, slots=True)
class RequestView:
    """The requests of one point: `read`, `ram` and `eeprom` are enumerators of tasks, or empty."""

    function: str
    macro: str
    raw_type: str
    index: str
    read: str
    ram: str
    eeprom: str
    width: int
    shares: bool
    value_of_raw: str
    raw_of_value: str


@dataclass(frozen=True, slots=True)
class WordView:
    """A point in the words of process data."""

    function: str
    macro: str
    raw_type: str
    telegram: str
    words_name: str
    read: bool
    write: bool
    double: bool
    raw_of_word: str
    word_of_raw: str


@dataclass(frozen=True, slots=True)
class StartView:
    """The words of a telegram to send, before anything is put in."""

    name: str
    function: str
    words_name: str


@dataclass(frozen=True, slots=True)
class BusView:
    """The USS header of a device."""

    guard: str
    units: tuple[int, int]
    broadcast: str
    pkw: tuple[int, ...]
    pzd: tuple[int, int]
    tasks: tuple[tuple[str, str, str], ...]
    codes: tuple[CodesView, ...]
    requests: tuple[RequestView, ...]
    starts: tuple[StartView, ...]
    words: tuple[WordView, ...]


def uss_view(device: Device, view: DeviceView, scope: Scope) -> BusView:
    """The view of `<device>_uss.h`."""
    bus = device.bus
    views = {entry.item: entry for group in view.groups for entry, _ in group.entries if entry is not None}
    points = [point for point in device.points if point.generated and point.places and point.text is None]
    tasks = {code.number: f"{scope.upper}_TASK_{upper(code.name)}" for code in bus.functions}
    requests = (_request(point, views[point.item], tasks, scope) for point in points if point.space == "parameter")
    telegrams = {one.name: one for one in device.telegrams}
    words = [point for point in points if point.telegram in telegrams and point.words <= 2]
    return BusView(
        guard=f"{scope.upper}_USS_H",
        units=bus.units,
        broadcast="FIELDSCRIBE_USS_NO_BROADCAST" if bus.broadcast is None else hexadecimal(bus.broadcast, 2),
        pkw=bus.pkw,
        pzd=bus.pzd,
        tasks=tuple(
            (tasks[code.number], hexadecimal(sum(1 << one for one in set(code.answers))), c_comment(code.title["en"]))
            for code in bus.functions
        ),
        codes=tuple(
            _codes(title, kind, codes, scope)
            for title, kind, codes in (
                ("Tasks", "task", bus.functions),
                ("Responses", "response", bus.responses),
                ("Errors", "error", bus.exceptions),
            )
            if codes
        ),
        requests=tuple(request for request in requests if request is not None),
        starts=tuple(_start(one, scope) for one in device.telegrams if one.direction == "request"),
        words=tuple(_word(point, views[point.item], telegrams[point.telegram or ""], scope) for point in words),
    )


def identifiers(bus: BusView, view: DeviceView) -> Iterator[tuple[str, Owner]]:
    """Every identifier of the header, with what it belongs to."""
    yield from ((f"{view.prefix}_{name}", Owner("target")) for name in ("uss_tasks", "uss_pkw", "uss_profile"))
    for codes in bus.codes:
        yield codes.function, Owner("target")
        yield from ((name, Owner("code", name)) for name, _, _, _ in codes.entries)
    for start in bus.starts:
        yield start.function, Owner("telegram", start.name)
    for request in bus.requests:
        item = request.function[len(view.prefix) + 1 :]
        tails = ["_read_request", "_from_reply"] if request.read else []
        tails += ["_write_request"] if request.ram else []
        tails += ["_write_eeprom_request"] if request.eeprom else []
        yield from ((request.function + tail, Owner("point", item, f"function {tail}")) for tail in tails)
    for word in bus.words:
        item = word.function[len(view.prefix) + 1 :]
        yield from ((word.function + tail, Owner("point", item)) for tail in ("_to_pzd", "_from_pzd"))


def adapters(bus: BusView) -> Iterator[tuple[str, str]]:
    """How parameters, and words of process data, answer vectors of whole exchanges."""
    for one in bus.requests:
        if one.read:
            yield one.function, f"READ({one.function}, {one.raw_type})"
        tail = "_SHARED" if one.shares else ""
        for kind, call, task in (("write", "write_request", one.ram), ("store", "write_eeprom_request", one.eeprom)):
            if task and (one.read or not one.shares):
                yield one.function, f'WRITE{tail}("{kind}", {one.function}, {call}, {one.raw_type})'
    starts = {start.name: start.function for start in bus.starts}
    for word in bus.words:
        if word.write and word.telegram in starts:
            yield word.function, f"SEND({word.function}, {word.raw_type}, {starts[word.telegram]}, {word.words_name})"
        if word.write:
            yield word.function, f"PUT({word.function}, {word.raw_type}, {word.macro}, {word.words_name})"
        if word.read:
            yield word.function, f"TAKE({word.function}, {word.macro}, {word.words_name})"
        if word.read and word.telegram not in starts:
            yield word.function, f"HEAR({word.function}, {word.words_name})"


def _codes(title: str, kind: str, codes: tuple[Code, ...], scope: Scope) -> CodesView:
    prefix = f"{scope.upper}_{upper(kind)}"
    entries = (
        (f"{prefix}_{upper(code.name)}", str(code.number), c_string(code.name), c_comment(code.title["en"]))
        for code in codes
    )
    return CodesView(title, f"{scope.prefix}_{kind}_name", tuple(entries))


def _request(point: Point, view: PointView, tasks: dict[int, str], scope: Scope) -> RequestView | None:
    """None for a point that no task of the device reaches."""
    width = 2 if point.info.bits == 32 else 1
    if point.info.bits > 32:
        return None
    key = (width, point.index is not None)
    read = next((tasks[task] for task in _READ if task in tasks), "") if point.readable else ""
    ram = tasks.get(_RAM[key], "") if point.writable else ""
    eeprom = tasks.get(_EEPROM[key], "") if point.writable and point.keeps != "no" else ""
    if not (read or ram or eeprom):
        return None
    return RequestView(
        view.function,
        view.macro,
        view.raw_type,
        f"{view.macro}_INDEX" if point.index is not None else "0U",
        read,
        ram,
        eeprom,
        width,
        point.bits is not None,
        _to_value(point, view, scope) if width == 2 else word_of_raw(point, view, "word", scope),
        _from_value(point, scope) if width == 2 else raw_of_word(point, view, "word"),
    )


def _from_value(point: Point, scope: Scope) -> str:
    """The raw number of a 32-bit value."""
    return f"{scope.helper('signed32')}(reply->value)" if point.info.signed else "reply->value"


def _to_value(point: Point, view: PointView, scope: Scope) -> str:
    """The 32-bit value of a raw number, with its constant bits."""
    number = _number(point, view, scope)
    return f"(uint32_t){number}" if point.info.signed else number


def _number(point: Point, view: PointView, scope: Scope) -> str:
    """The raw number of several words, with its constant bits: one made of masks may lack them."""
    return fixed_number(point, view.macro, scope, "raw") if fixes(point) else "raw"


def _start(telegram: Telegram, scope: Scope) -> StartView:
    macro = f"{scope.upper}_TELEGRAM_{upper(telegram.name)}_WORDS"
    return StartView(telegram.name, f"{scope.prefix}_telegram_{telegram.name}_start", macro)


def _word(point: Point, view: PointView, telegram: Telegram, scope: Scope) -> WordView:
    word = f"words[{view.macro}_ADDRESS]"
    return WordView(
        view.function,
        view.macro,
        view.raw_type,
        telegram.name,
        f"{scope.upper}_TELEGRAM_{upper(telegram.name)}_WORDS",
        point.readable,
        point.writable,
        point.words == 2,
        raw_of_word(point, view, word),
        _number(point, view, scope) if point.words == 2 else word_of_raw(point, view, word, scope),
    )
