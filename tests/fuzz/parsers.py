"""The parsers in Python over the cases on standard input: one line for each, as the programs in C and Rust print it.

python parsers.py FAMILY < cases, with the generated packages on the path.
"""

from __future__ import annotations

import struct
import sys
from collections.abc import Callable, Iterator
from importlib import import_module
from typing import Any

UNIT = 5


def cases(form: str) -> Iterator[tuple[Any, ...]]:
    """The fields of each case and its frame."""
    data = sys.stdin.buffer.read()
    head, at = struct.Struct(form), 0
    while at < len(data):
        *fields, length = head.unpack_from(data, at)
        at += head.size + length
        yield (*fields, data[at - length : at])


def modbus() -> Iterator[str]:
    """Answers of Modbus devices."""
    runtime: Any = import_module("fieldscribe_runtime.modbus")
    frames: Any = import_module("fieldscribe_runtime.modbus.frames")
    errors: Any = import_module("fieldscribe_runtime.errors")
    profile = runtime.Profile(functions={})
    for tcp, unit, function, address, count, transaction, number, frame in cases("<BBBHHHHH"):
        values: tuple[int, ...] = ()
        if function > 4:
            values = tuple(number >> at % 16 & 1 for at in range(count)) if function in (5, 15) else (number,) * count
        request = frames.Request(unit, function, address, count if function <= 4 else 0, values)
        try:
            found = frames.parse(request, frame, profile, frames.TCP if tcp else frames.RTU, transaction)
            yield " ".join(map(str, ("ok", 0, *found)))
        except errors.ExceptionReplyError as error:
            yield f"exception {error.code}"
        except errors.FrameError as error:
            yield f"{error.status} 0"


def can() -> Iterator[str]:
    """CAN frames, with the messages of kitchen_can."""
    frames: Any = import_module("fieldscribe_runtime.can.frames")
    errors: Any = import_module("fieldscribe_runtime.errors")
    receivers: Any = import_module("fieldscribe_runtime.can.receiver")
    profile = import_module("kitchen_can").KitchenCan.PROFILE
    messages = [message for message in profile.messages if message.roles]
    listening = [receivers.Receiver(profile, name, UNIT) for name in ("measurements", "heartbeat")]
    for message, unit, position, identifier, data in cases("<BBHIH"):
        frame = frames.Frame(identifier, data)
        try:
            line = "ok {} {}".format(*frames.parse(messages[message], unit, frame))
        except errors.FrameError as error:
            line = f"{error.status} 0 0"
        for receiver, place in zip(listening, (position, 0), strict=True):
            line += f" {int(receiver.take(frame))}"
            try:
                line += f" ok {receiver.word(place)}"
            except errors.TelegramError as error:
                line += f" {error.status} 0"
        yield line


def uss() -> Iterator[str]:
    """Answers of USS drives, with the tasks of kitchen_uss."""
    frames: Any = import_module("fieldscribe_runtime.uss.frames")
    errors: Any = import_module("fieldscribe_runtime.errors")
    profile = import_module("kitchen_uss").KitchenUss.PROFILE
    for pkw, pzd, single_first, unit, task, parameter, index, frame in cases("<BBBBBHHH"):
        link = frames.Link(pkw, pzd, bool(single_first))
        request = frames.Request(unit, task, parameter, index)
        try:
            found = frames.parse(request, frame, profile, link)
            said = ("ok", found.response, found.width, found.value, 0, *found.words)
        except errors.RefusedError as error:
            said = ("refused", 7, 0, 0, error.code, *error.words)
        except errors.FrameError as error:
            said = (error.status, 0, 0, 0, 0, *(() if error.status == "wrong_length" else error.words))
        yield " ".join(map(str, said))


FAMILIES: dict[str, Callable[[], Iterator[str]]] = {"modbus": modbus, "can": can, "uss": uss}

if __name__ == "__main__":
    sys.stdout.write("".join(line + "\n" for line in FAMILIES[sys.argv[1]]()))
