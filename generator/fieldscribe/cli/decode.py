"""`fieldscribe decode`: frames into meaning."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterable, Iterator
    from typing import IO

    from fieldscribe.cli.heard import Shown
    from fieldscribe.conversation.listener import Listener
    from fieldscribe.families.frame_results import FrameResult
    from fieldscribe.user_errors import UnclearError

HELP = "say what frames from the line mean"
EXAMPLE = """examples:
  fieldscribe decode hitachi_l200 "05 06 10 28 01 F4 0C 91"
  fieldscribe decode hitachi_l200 0801000600051C91 --format json
  fieldscribe decode hitachi_l200 "08 01 01 17 12 1A" --request "08 01 00 06 00 05 1C 91"
  fieldscribe decode woodward_mpu2s 321#DD00051513880064 321#DD010302000007D0
  fieldscribe decode woodward_mpu2s "DD 00 05 15 13 88 00 64" --can-id 321
  fieldscribe decode woodward_mpu2s --log candump.log
  candump -L can0 | fieldscribe decode woodward_mpu2s - --format jsonl
  fieldscribe decode siemens_mm4 "02 0E 01 143A 0000 0000 0000 047F 3333 58"
  fieldscribe decode siemens_mm4 --framing pkw "143A 0000 0000 0000" "243A 0000 4248 0000"
  fieldscribe decode siemens_mm4 --framing pzd --direction response "FA31 0000"

Each FRAME is one argument, or several whole frames behind each other; a reply is read by the request before it.
Streams are decoded line by line as they come, for as long as they last. --format json is one object and whole when the
last frame has come; --format jsonl has an object for each frame.

Ends with 1 when a frame is damaged, is no frame of the device (wrong length, checksum, header) or does not answer the
request before it; when it asks for what the device does not do (a unit, function, task, count, multiplexer, framing or
address that it has not, an address that the manual closes), or writes what it does not take (a value outside its range,
a point that is read only, other bits than those always written). What a reply brings is never a finding: any raw number
may come. Notes are no findings. Ends with 2 when a line of a stream is no frame; the others are decoded."""

_OBJECTS = 100_000
"""After so many new objects a collection is worth its time."""
_MOST_UNREAD = 10
"""Of so many lines that are no frames each has its message."""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_device, add_format
    from fieldscribe.cli.link import add_framing, add_own, add_with

    add_device(parser)
    parser.add_argument(
        "frames",
        nargs="*",
        metavar="FRAME",
        help='bytes in hexadecimal: "05 06 10 28", 05061028, 0x05,0x06, 05:06; CAN: 321#DD00, lines of candump; '
        "- reads frames from standard input, one a line",
    )
    parser.add_argument(
        "--log",
        action="append",
        default=[],
        metavar="FILE",
        help="read frames from a file, one a line; may be repeated",
    )
    parser.add_argument("--request", metavar="FRAME", help="the request that the frames answer")
    add_framing(parser, "default: seen from the bytes; uss")
    parser.add_argument("--unit", type=int, metavar="N", help="only frames to or from this unit")
    add_own(parser, "decode")
    add_with(parser)
    add_format(parser, ("jsonl",), "; json is one object, jsonl one object a line")


def run(arguments: Namespace) -> int:
    """Decode; the exit code: 1 when there is a fault or a finding."""
    from fieldscribe.cli.common import StopError, open_device, settings_of
    from fieldscribe.cli.heard import shown_as
    from fieldscribe.cli.link import options_of
    from fieldscribe.conversation.listener import Listener, decoder_of
    from fieldscribe.user_errors import UnclearError

    if not arguments.frames and not arguments.log:
        raise StopError("there is nothing to decode", "give frames, - for standard input, or --log FILE")
    device = open_device(arguments)
    options = options_of(device, arguments)
    settings = settings_of(device, arguments.given)
    try:
        listening = Listener(device, settings, decoder_of(device, options))
        telling = _Telling(listening, shown_as(arguments.format, device), arguments.unit)
        asked = listening.requests(options)
        for frames in _runs(arguments.frames):
            telling.tell([*asked, *listening.pasted(frames)]) if frames else telling.follow_input()
            asked = []
    except UnclearError as error:
        raise StopError(error.message, error.hint) from error
    telling.tell(asked)
    for name in arguments.log:
        with open(name, "rb") as log:
            telling.follow(log, name)
    return telling.end()


def _runs(words: list[str]) -> Iterator[list[str]]:
    """The arguments that belong together; an empty list stands for standard input."""
    from itertools import groupby

    for is_input, run_of_words in groupby(words, key=lambda word: word == "-"):
        yield [] if is_input else list(run_of_words)


class _Telling:
    """Prints what is heard as it is heard, and keeps how it ends."""

    def __init__(self, listening: Listener, shown: Shown, unit: int | None) -> None:
        self._listening = listening
        self._shown = shown
        self._unit = unit
        self._wrong = False
        self._unread = 0

    def tell(self, heard: Iterable[FrameResult]) -> None:
        """Print frames."""
        for frame in heard:
            if self._unit is None or frame.unit == self._unit:
                self._shown.frame(frame)
                self._wrong = self._wrong or frame.wrong

    def follow_input(self) -> None:
        """Decode the lines of standard input."""
        import sys

        from fieldscribe.cli.common import StopError

        if sys.stdin is None:
            raise StopError("standard input is closed", "give frames, or --log FILE")
        self.follow(sys.stdin, "standard input")

    def follow(self, stream: IO[str] | IO[bytes], name: str) -> None:
        """Decode the lines of a stream; what they say is out before more of it is waited for."""
        import gc
        import sys

        from fieldscribe.cli.lines import lines_of
        from fieldscribe.user_errors import UnclearError

        gc.set_threshold(_OBJECTS)
        gc.enable()  # it may last for days
        for number, text in lines_of(stream, sys.stdout.flush):
            try:
                self.tell(self._listening.pasted([text]))
            except UnclearError as error:
                self._pass_over(f"{name}:{number}", error)
        gc.disable()

    def _pass_over(self, where: str, error: UnclearError) -> None:
        """Say that a line is no frame; one of thousands must not hide what the others say."""
        from fieldscribe.cli.common import usage_error

        self._unread += 1
        if self._unread <= _MOST_UNREAD:
            usage_error(f"{where}: {error.message}", error.hint if self._unread == 1 else "")

    def end(self) -> int:
        """Print what belongs behind the last frame; the exit code."""
        from fieldscribe.cli import FINDINGS, FINE, USAGE
        from fieldscribe.cli.common import usage_error

        self._shown.end()
        if self._unread > _MOST_UNREAD:
            usage_error(f"{self._unread - _MOST_UNREAD} more lines are no frames")
        return USAGE if self._unread else FINDINGS if self._wrong else FINE
