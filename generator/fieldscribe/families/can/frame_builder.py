"""Builds the CAN frames that read and write points, for `encode` and as examples for `explain`."""

from fieldscribe import wording
from fieldscribe.arithmetic.codec import Settings
from fieldscribe.arithmetic.words import group_mask, insert, with_fixed, words_of
from fieldscribe.diagnostics import RefusedError, UnclearError
from fieldscribe.families.can import signals
from fieldscribe.families.can.frames import CanFrame, build, carriers, carries, identifier, request_and_answer
from fieldscribe.families.frame_results import BuiltFrames, Options, WriteMethod, refused
from fieldscribe.model import Device, Message, Point
from fieldscribe.pasted_numbers import number_of
from fieldscribe.text import shortened
from fieldscribe.wording import fixed_text, label
from fieldscribe.wording.numbers import hex_text


def frames_for(device: Device, point: Point, raw: int, settings: Settings, options: Options) -> BuiltFrames:
    """Return the frames that write a raw number. Raises RefusedError, UnclearError.

    A bit group is put into the word of `--with-word`.
    """
    del settings  # a message carries one parameter
    if point.place.bit is not None and point.writable:
        frame = signal_frame(device, point, raw, options.unit)
        return BuiltFrames((frame,), ("all other bits of the message are 0: its other signals travel with it",))
    word_text: str | None = options.of_family.get("with_word")
    if point.bits is None:
        if word_text is not None:
            raise UnclearError(f"{label(point)} takes its whole word", "--with-word is for bit groups")
        count = len(point.addresses)
        notes = [f"a text takes {count} messages, one for each word"] if point.text is not None and count > 1 else []
        return BuiltFrames(write_frames(device, point, words_of(point, raw), options.unit), tuple(notes))
    if word_text is None:
        mask = group_mask(point)
        request = read_frame(device, point.addresses[0], options.unit) if point.addresses else ""
        raise RefusedError(
            "shared_word",
            f"{label(point)} shares its word with other points, so it takes the word that is there now",
            f"read it ({request}) and say --with-word WORD: the bits of mask {hex_text(mask)} in it are replaced",
        )
    word = insert(point, _word(word_text), raw)
    notes = [f"the other bits stay as in {word_text.strip()}: the word becomes {hex_text(word)}"]
    if point.fixed is not None:
        notes.append(f"the word has bits that are always written so: {fixed_text(point)}")
    return BuiltFrames(write_frames(device, point, (word,), options.unit), tuple(notes))


def _word(text: str) -> int:
    digits = text.strip()
    number = number_of(f"0{digits}" if digits[-1:] in ("h", "H") else digits)
    if number is None or number > 0xFFFF:
        raise UnclearError(f"--with-word: `{shortened(text)}` is no word", "write it as 1234h, 0x1234 or 4660")
    return number


def signal_frame(device: Device, point: Point, raw: int, unit: int | None = None) -> str:
    """Return a frame of the message of a signal with this raw number; all other bits are 0."""
    message = next(message for message in device.messages if message.name == point.telegram)
    number, _ = signals.field_of(message, point)
    data = signals.data_of(message, {number: raw})
    return CanFrame(identifier(message, device.bus.usual_unit if unit is None else unit), data).text


def read_frame(device: Device, address: int, unit: int | None = None) -> str:
    """Return the request that reads a parameter; empty if there is no such message."""
    message, _ = request_and_answer(device.messages, writes=False)
    if message is None:
        return ""
    status, frame = build(message, device.bus.units, device.bus.usual_unit if unit is None else unit, address, 0)
    return frame.text if status == "ok" else ""


def write_frames(device: Device, point: Point, words: tuple[int, ...], unit: int | None) -> tuple[str, ...]:
    """Return a request for each word of a point. Raises RefusedError."""
    message, _ = request_and_answer(device.messages, writes=True)
    if message is None or point.space != "parameter":
        raise refused(device.bus, point, "no_message")
    chosen = device.bus.usual_unit if unit is None else unit
    frames = []
    for address, word in zip(point.addresses, words, strict=True):
        status, frame = build(message, device.bus.units, chosen, address, word)
        if status != "ok":
            raise refused(device.bus, point, status)
        frames.append(frame.text)
    return tuple(frames)


def read_text(device: Device, point: Point) -> str:
    """Return how to read the point, by a request or from a telegram; empty if it cannot be read."""
    if point.telegram is not None:
        return _telegram_text(device, point)
    message, _ = request_and_answer(device.messages, writes=False)
    if message is None:
        return ""
    return f"{_messages_text(point, message)}to unit {device.bus.usual_unit}: {read_frame(device, point.addresses[0])}"


def way_to_write(device: Device, point: Point) -> WriteMethod | None:
    """Return how to write the point; None if it cannot be written."""
    message, _ = request_and_answer(device.messages, writes=True)
    if point.place.bit is not None:
        how = f"message {point.telegram}, together with its other signals"
        return WriteMethod(how, lambda raw: f": {signal_frame(device, point, raw)}", ", ")
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
        return WriteMethod(head.rstrip(", "), lambda raw: _write_example(device, point, raw), ", ")
    example = _write_example(device, point, int.from_bytes(b"TEXT".ljust(2 * point.words), "big"))
    return WriteMethod(f'{head}for example "TEXT", padded with spaces{example}' if example else head.rstrip(", "))


def _write_example(device: Device, point: Point, raw: int) -> str:
    """Return the frames that write the point; empty if there are none."""
    try:
        frames = write_frames(device, point, words_of(point, with_fixed(point, raw)), None)
    except RefusedError:
        return ""
    return f"; to unit {device.bus.usual_unit}: {' '.join(frames)}"


def _messages_text(point: Point, message: Message) -> str:
    count = len(point.addresses)
    return f"message {message.name}, " if count == 1 else f"{count} messages {message.name}, one for each word, "


def _telegram_text(device: Device, point: Point) -> str:
    """Return which frames and bytes of a telegram carry the point."""
    message = carriers(device).get(point.telegram or "")
    if message is not None and message.fields:
        every = "by itself" if message.every is None else f"every {message.every} ms"
        frame = CanFrame(identifier(message, device.bus.usual_unit), b"").text
        return f"sent {every}, message {message.name}; {wording.bits_in_message(point)} (from CAN {frame[:-1]})"
    if message is None or not message.words:
        return ""
    marks = "llhh" if point.swapped else "hhll"
    places = ", then ".join(_place_text(message, device.bus.usual_unit, address, marks) for address in point.addresses)
    torn = ""
    if len({address // message.words for address in point.addresses}) > 1:
        torn = "; the words come in two frames: they belong together when the same high word came before and after"
    return f"sent by itself, message {message.name}; from unit {device.bus.usual_unit}: {places}{torn}"


def _place_text(message: Message, unit: int, address: int, marks: str) -> str:
    """Return the multiplexer and the bytes of one word, with a frame in which they are marked."""
    slot, word = divmod(address, message.words)
    at = [place for place, role in enumerate(message.roles) if role.kind == "word" and role.number >> 1 == word]
    known = {"unit": unit, "multiplexer": slot}
    data = bytes(role.number if role.kind == "constant" else known.get(role.kind, 0) for role in message.roles)
    frame = CanFrame(identifier(message, unit), data).text
    mark = frame.index("#") + 1 + 2 * min(at)
    frame = f"{frame[:mark]}{marks if max(at) > min(at) else 'll'}{frame[mark + 2 * len(at) :]}"
    slots = f"multiplexer {slot}, " if carries(message, "multiplexer") else ""
    return f"{slots}bytes {' and '.join(map(str, at))} ({frame})"
