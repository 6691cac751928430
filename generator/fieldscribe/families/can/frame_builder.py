"""The frames that read and write parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask, insert, with_fixed, words_of
from fieldscribe.families.can.frames import CanFrame, build, carries, identifier
from fieldscribe.families.can.notation import frame_text
from fieldscribe.families.frame_results import BuiltFrames, WriteMethod, refused
from fieldscribe.pasted_numbers import number_of
from fieldscribe.user_errors import RefusedError, UnclearError, quoted
from fieldscribe.wording import fixed_text, label
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.model import Device, Message, Point
    from fieldscribe.user_errors import Options


def request_of(device: Device, *, writes: bool) -> Message | None:
    """The message that asks for a parameter, or that changes one."""
    asking = (message for message in device.messages if message.direction == "request" and carries(message, "address"))
    return next((message for message in asking if carries(message, "raw") == writes), None)


def read_frame(device: Device, address: int, unit: int | None = None) -> str:
    """The request that asks for a parameter; empty if there is no such message."""
    message = request_of(device, writes=False)
    if message is None:
        return ""
    chosen = device.bus.usual_unit if unit is None else unit
    status, frame = build(message, device.bus.units, chosen, address, 0)
    return frame_text(frame) if status == "ok" else ""


def write_frames(device: Device, point: Point, words: tuple[int, ...], unit: int | None) -> tuple[str, ...]:
    """A request for each word of a point. Raises RefusedError."""
    message = request_of(device, writes=True)
    if message is None or point.space != "parameter":
        raise refused(device.bus, point, "no_message")
    chosen = device.bus.usual_unit if unit is None else unit
    frames = []
    for address, word in zip(point.addresses, words, strict=True):
        status, frame = build(message, device.bus.units, chosen, address, word)
        if status != "ok":
            raise refused(device.bus, point, status)
        frames.append(frame_text(frame))
    return tuple(frames)


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """The frames that write a raw number; a bit group is put into the word of `--with-word`. Raises RefusedError."""
    del settings  # a message carries one parameter alone
    there: str | None = options.own.get("with_word")
    if point.bits is None:
        if there is not None:
            raise UnclearError(f"{label(point)} takes its whole word", "--with-word is for bit groups")
        return BuiltFrames(write_frames(device, point, words_of(point, raw), options.unit), _text_note(point))
    if there is None:
        mask = group_mask(point)
        ask = read_frame(device, point.addresses[0], options.unit) if point.addresses else ""
        raise RefusedError(
            "shared_word",
            f"{label(point)} shares its word with other points, so it takes the word that is there now",
            f"read it ({ask}) and say --with-word WORD: the bits of mask {hex_text(mask)} in it are replaced",
        )
    word = insert(point, _word(there), raw)
    notes = [f"the other bits stay as in {there.strip()}: the word becomes {hex_text(word)}"]
    if point.fixed is not None:
        notes.append(f"the word has bits that are always written so: {fixed_text(point)}")
    return BuiltFrames(write_frames(device, point, (word,), options.unit), tuple(notes))


def _text_note(point: Point) -> tuple[str, ...]:
    count = len(point.addresses)
    return (f"a text takes {count} messages, one for each word",) if point.text is not None and count > 1 else ()


def _word(text: str) -> int:
    asked = text.strip()
    number = number_of(f"0{asked}" if asked[-1:] in ("h", "H") else asked)
    if number is None or number > 0xFFFF:
        raise UnclearError(f"--with-word: `{quoted(text)}` is no word", "write it as 1234h, 0x1234 or 4660")
    return number


def read_text(device: Device, point: Point) -> str:
    """How to read the point, by a request or from a telegram; empty if it cannot be read."""
    if point.telegram is not None:
        return _telegram_text(device, point)
    message = request_of(device, writes=False)
    if message is None:
        return ""
    return f"{_messages_text(point, message)}to unit {device.bus.usual_unit}: {read_frame(device, point.addresses[0])}"


def way_to_write(device: Device, point: Point) -> WriteMethod | None:
    """How to write the point; None if it cannot be written."""
    message = request_of(device, writes=True)
    if point.telegram is not None or message is None:
        return None
    head = _messages_text(point, message)
    if point.bits is not None:
        fixed = f"; {fixed_text(point)}" if point.fixed is not None else ""
        return WriteMethod(
            f"{head}after the word was read: replace the bits of mask {hex_text(group_mask(point))} and write it back, "
            f"for other points share the word{fixed}"
        )
    if point.text is None:
        return WriteMethod(head.rstrip(", "), lambda raw: _written(device, point, raw), ", ")
    shown = _written(device, point, int.from_bytes(b"TEXT".ljust(2 * point.words), "big"))
    return WriteMethod(f'{head}for example "TEXT", padded with spaces{shown}' if shown else head.rstrip(", "))


def _written(device: Device, point: Point, raw: int) -> str:
    """The frames that write the point; empty where there are none."""
    try:
        frames = write_frames(device, point, words_of(point, with_fixed(point, raw)), None)
    except RefusedError:
        return ""
    return f"; to unit {device.bus.usual_unit}: {' '.join(frames)}"


def _messages_text(point: Point, message: Message) -> str:
    count = len(point.addresses)
    return f"message {message.name}, " if count == 1 else f"{count} messages {message.name}, one for each word, "


def _telegram_text(device: Device, point: Point) -> str:
    """Which frames and bytes of a telegram carry the point."""
    telegram = next((telegram for telegram in device.telegrams if telegram.name == point.telegram), None)
    message = next(
        (message for message in device.messages if telegram is not None and message.name == telegram.message), None
    )
    if telegram is None or message is None or not message.words:
        return ""
    unit = device.bus.usual_unit
    places = []
    for address in point.addresses:
        slot, word = divmod(address, message.words)
        at = [place for place, role in enumerate(message.roles) if role.kind == "word" and role.number >> 1 == word]
        data = bytes(
            {"constant": role.number, "unit": unit, "multiplexer": slot}.get(role.kind, 0) for role in message.roles
        )
        shown = frame_text(CanFrame(identifier(message, unit), data))
        mark = shown.index("#") + 1 + 2 * min(at)
        shown = f"{shown[:mark]}{'hhll' if max(at) > min(at) else 'll'}{shown[mark + 2 * len(at) :]}"
        slots = f"multiplexer {slot}, " if carries(message, "multiplexer") else ""
        places.append(f"{slots}bytes {' and '.join(map(str, at))} ({shown})")
    torn = ""
    if len({address // message.words for address in point.addresses}) > 1:
        torn = "; the words come in two frames: they belong together when the same high word came before and after"
    return f"sent by itself, message {message.name}; from unit {unit}: {', then '.join(places)}{torn}"
