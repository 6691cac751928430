"""The frames that read and write parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import group_mask, insert, words_of
from fieldscribe.asked import RefusedError, UnclearError, quoted
from fieldscribe.families.can.frames import build, carries
from fieldscribe.families.can.notation import frame_text
from fieldscribe.families.frame_results import BuiltFrames, refused
from fieldscribe.pasted_numbers import number_of
from fieldscribe.wording import fixed_text, label
from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from fieldscribe.arithmetic.codec import Settings
    from fieldscribe.asked import Options
    from fieldscribe.model import Device, Message, Point


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
