"""How a point of a CAN device is read and written, with frames as examples."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask, with_fixed, words_of
from fieldscribe.asked import RefusedError
from fieldscribe.families.can.frames import CanFrame, carries, identifier
from fieldscribe.families.can.notation import frame_text
from fieldscribe.families.can.sending import read_frame, request_of, write_frames
from fieldscribe.families.frame_results import WriteMethod
from fieldscribe.wording import fixed_text
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from fieldscribe.model import Device, Message, Point


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
