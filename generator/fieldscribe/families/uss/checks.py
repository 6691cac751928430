"""Tasks, responses and error values of USS name each other alike on both sides."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fieldscribe.arithmetic.words import words_in
from fieldscribe.checks.frames_agree import (
    Seen,
    from_words,
    report_no_frame,
    report_no_request,
    report_refused,
    report_wrong_error,
    report_wrong_sum,
)
from fieldscribe.checks.reachability import report_missing
from fieldscribe.families.uss import FAMILY, of_bus, of_frame
from fieldscribe.families.uss.parts import MASKS, READ_TASK, VARIABLE, Link, part_of, write_task
from fieldscribe.families.uss.remarks import words_printed
from fieldscribe.families.uss.telegrams import (
    LEAST_BYTES,
    Request,
    answer_in,
    broadcast,
    build,
    check_byte,
    parse,
    request_in,
)
from fieldscribe.language.nodes import Map
from fieldscribe.model import Named
from fieldscribe.resolve.bus import code_list
from fieldscribe.resolve.printed_facts import PrintedFact

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.checks.frames_agree import Carries
    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Code, Frame, Point
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.frames import LocatedFrame


_LISTS = ("answers", "refusals")


def codes_agree(subject: Analysis) -> None:
    """Findings for codes that are named on one side only or do not exist, and for printed lists that disagree."""
    bus = subject.scope.bus
    if bus is None or not subject.bus_is_whole:
        return
    _named_back(subject, bus)
    _refused(subject, bus)
    for kind in FAMILY.codes:
        for code, raw, _ in _written(subject, bus, kind.section):
            _printed(subject, code, raw, kind.key)


def _written(subject: Analysis, bus: Map, section: str) -> Iterator[tuple[Code, Map, Span]]:
    """Each code that is written as a mapping, with the mapping and the place of its number."""
    by_name = {code.name: code for code in subject.bus.codes(section)}
    for key, node in bus.get(section, {}).items():
        if isinstance(node, Map) and node["name"] in by_name:
            yield by_name[node["name"]], node, bus[section].key_span(key)


def _named_back(subject: Analysis, bus: Map) -> None:
    """Findings for tasks and responses of which only one names the other."""
    tasks = {code.number: {*code.answers, *code.refusals} for code in subject.bus.functions}
    responses = {code.number: set(code.answers) for code in subject.bus.codes("responses")}
    for task, node, _ in _written(subject, bus, "functions"):
        for key in _LISTS:
            for number in getattr(task, key):
                if task.number not in responses.get(number, ()):
                    _one_sided(
                        subject, node.span(key), ("task", task.number), ("response", number), number in responses
                    )
    for response, node, _ in _written(subject, bus, "responses"):
        for number in response.answers:
            if response.number not in tasks.get(number, ()):
                names = ("response", response.number), ("task", number)
                _one_sided(subject, node.span("answers"), *names, number in tasks)


def _one_sided(subject: Analysis, span: Span, code: tuple[str, int], other: tuple[str, int], exists: bool) -> None:
    what = "which does not name it back" if exists else "which does not exist"
    message = f"the {code[0]} {code[1]} names the {other[0]} {other[1]}, {what}"
    hint = "take one of them in both lists, and give what is printed under `printed` with an erratum"
    subject.report.error("codes-disagree", message, span, hint if exists else f"declare it, or leave it out; {hint}")


def _refused(subject: Analysis, bus: Map) -> None:
    """Findings for error values of tasks that do not exist or are never refused."""
    tasks = {code.number: code for code in subject.bus.functions}
    for error, node, _ in _written(subject, bus, "exceptions"):
        for number in error.answers:
            task = tasks.get(number)
            if task is None or not task.refusals:
                what = "which does not exist" if task is None else "which is never refused"
                message = f"the error {error.number} names the task {number}, {what}"
                hint = "correct one of them, and give what is printed under `printed` with an erratum"
                subject.report.error("codes-disagree", message, node.span("answers"), hint)


def _printed(subject: Analysis, code: Code, node: Map, about: str) -> None:
    """Compare the printed lists with those that were taken."""
    printed: Map = node.get("printed") or Map(node.file, node.at)
    for key in _LISTS:
        if key not in printed:
            continue
        taken = sorted(getattr(code, key))
        codes = sorted(code_list(subject.scope, printed, key))
        if codes != taken:
            message = f"the {key} {_list(codes)} are printed for the {about} {code.number}, taken are {_list(taken)}"
            named, span = Named(about, code.number), printed.span(key)
            subject.report_printed(PrintedFact(named, key, list(printed[key]), taken, span, message))


def _list(numbers: list[int]) -> str:
    return ", ".join(map(str, numbers)) or "none"


_SHORT = 3
"""The words of a parameter part that carries values of one word only."""


def parameters_are_reachable(subject: Analysis) -> None:
    """One finding for each task that parameters need and that the device does not have."""
    report_missing(subject, _tasks)


def _tasks(subject: Analysis, points: list[Point]) -> Iterator[tuple[int, str, str]]:
    known = {code.number for code in subject.bus.functions}
    hint = "list the task under `functions`, or correct `access` or `keeps`"
    lengths = set(of_bus(subject.bus).pkw)
    if lengths == {0}:
        yield len(points), "no telegram has a parameter part", "correct `pkw`, which lists its lengths in words"
        return
    if lengths and lengths <= {0, _SHORT}:
        wide = sum(point.words > 1 for point in points)
        hint = "correct `pkw`, or the types"
        yield wide, f"a parameter part of {_SHORT} words carries no value of 32 bits", hint
        hint = "list the task under `functions`, or correct `access` or `keeps`"
    if READ_TASK not in known:
        yield sum(point.readable for point in points), f"the device has no task {READ_TASK}, which reads a value", hint
    needed: dict[int, int] = {}
    for point in points:
        for keep in {"yes": (True,), "no": (False,)}.get(point.keeps or "", (False, True)) if point.writable else ():
            task = write_task(point.words, array=point.index is not None, keep=keep)
            if task not in known and (point.keeps is not None or not keep):
                needed[task] = needed.get(task, 0) + 1
    for task, count in sorted(needed.items()):
        yield count, f"the device has no task {task}, which writes such a value", hint


_SHORT = 3


@dataclass(frozen=True, slots=True)
class _Asked:
    """A request with the link that it was sent over."""

    link: Link
    request: Request


def read(subject: Analysis, open_frame: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    """The frame as the device reads it; `Seen.request` is the request with its link."""
    frame = open_frame.frame
    if frame.framing == "broadcast":
        return _broadcast(subject, open_frame)
    if frame.framing == "uss":
        frame = _checked(subject, open_frame)
        if len(frame.corrected) < LEAST_BYTES or len(frame.corrected) % 2:
            return report_no_frame(subject, open_frame, "this is no telegram: STX, LGE, ADR, words and BCC")
        return _telegram(subject, replace(open_frame, frame=frame), words_in(frame.corrected[3:-1]), seen)
    if len(frame.printed) % 2:
        return report_no_frame(subject, open_frame, "the part is made of words")
    words = words_in(frame.printed)
    if frame.framing == "pzd":
        return _process_data(subject, open_frame, words)
    return _telegram(subject, open_frame, words, seen)


def _checked(subject: Analysis, open_frame: LocatedFrame) -> Frame:
    """The frame with its length byte and its check byte corrected."""
    frame = open_frame.frame
    if len(frame.printed) < LEAST_BYTES:
        return frame
    body = frame.printed[:1] + bytes((len(frame.printed) - 2 & 0xFF,)) + frame.printed[2:-1]
    right = body + bytes((check_byte(body),))
    report_wrong_sum(subject, open_frame, "lge", frame.printed[1:2], right[1:2])
    report_wrong_sum(subject, open_frame, "bcc", frame.printed[-1:], right[-1:])
    return replace(frame, corrected=right, valid=right == frame.printed)


def _telegram(subject: Analysis, open_frame: LocatedFrame, words: tuple[int, ...], seen: dict[str, Seen]) -> Seen:
    """Read a telegram, or a parameter part alone, which is read as a telegram without process data."""
    frame = open_frame.frame
    if frame.direction == "request":
        return _request(subject, open_frame, words)
    report_no_request(subject, open_frame)
    asked = seen.get(frame.answers or "")
    if asked is None or not isinstance(asked.request, _Asked):
        return Seen(replace(frame, valid=False))
    link, request = asked.request.link, asked.request.request
    if frame.framing == "uss":
        reply = parse(subject.bus, link, request, frame.corrected)
    else:
        reply = answer_in(subject.bus, link, request, words)
    if reply.status not in ("ok", "refused", "no_rights"):
        return report_refused(subject, open_frame, reply.status)
    report_wrong_error(subject, open_frame, reply.error if reply.status == "refused" else None)
    known = {code.number: code for code in subject.bus.exceptions}
    if reply.status == "refused" and known:
        error = known.get(reply.error)
        if error is None or (error.answers and request.task not in error.answers):
            what = "does not exist" if error is None else f"is not for the task {request.task}"
            return report_no_frame(subject, open_frame, f"the error {reply.error} {what}")
    value = (reply.width, reply.value) if reply.status == "ok" and reply.width else None
    return Seen(frame, asked.request, _carries(subject, request, value, reply.words, "response"))


def _request(subject: Analysis, open_frame: LocatedFrame, words: tuple[int, ...]) -> Seen:
    frame = open_frame.frame
    unit = frame.corrected[2] if frame.framing == "uss" else subject.bus.units[0]
    setting = _setting(frame)
    short = frame.framing == "pkw" and setting == VARIABLE and len(words) == _SHORT
    sent = len(words) if short else Link(setting, 0).sent
    if len(words) < sent or (frame.framing == "pkw" and len(words) != sent):
        return report_no_frame(subject, open_frame, f"the parameter part has {sent} words, {len(words)} are printed")
    part, rest = words[:sent], words[sent:]
    link = Link(setting, len(rest))
    named = part_of(part)
    request = Request(unit, 0, words=rest) if named is None else request_in(unit, named, link, rest)
    status, data = build(subject.bus, link, request)
    if status != "ok":
        return report_refused(subject, open_frame, status)
    built = words_in(data[3:-1])[: len(words)] if short else words_in(data[3:-1])
    if built != words:
        return report_no_frame(subject, open_frame, f"this request would be {words_printed(built)}")
    value = (request.width, request.value) if request.width else None
    return Seen(frame, _Asked(link, request), _carries(subject, request, value, rest, "request"))


def _setting(frame: Frame) -> int:
    """The length of the parameter part that the link is set to."""
    setting = of_frame(frame).pkw
    return VARIABLE if setting is None else setting


def _process_data(subject: Analysis, open_frame: LocatedFrame, words: tuple[int, ...]) -> Seen:
    low, high = of_bus(subject.bus).pzd
    if not low <= len(words) <= high:
        return report_no_frame(subject, open_frame, f"there are {low}..{high} words of process data, not {len(words)}")
    return Seen(open_frame.frame, None, _carries(subject, None, None, words, open_frame.frame.direction))


def _broadcast(subject: Analysis, open_frame: LocatedFrame) -> Seen:
    """Read a broadcast: four words of masks, then the process data."""
    words = words_in(open_frame.frame.printed)
    if len(open_frame.frame.printed) % 2 or len(words) < MASKS:
        return report_no_frame(subject, open_frame, "a broadcast starts with four words of masks")
    link = Link(MASKS, len(words) - MASKS)
    status, _ = broadcast(subject.bus, link, words[:MASKS], words[MASKS:])
    if status != "ok":
        return report_no_frame(subject, open_frame, f"this device takes no such broadcast: {status.replace('_', ' ')}")
    return Seen(open_frame.frame, None, _carries(subject, None, None, words[MASKS:], "request"))


def _carries(
    subject: Analysis,
    request: Request | None,
    value: tuple[int, int] | None,
    words: tuple[int, ...],
    direction: str,
) -> Carries:
    """Finds the raw numbers in a telegram: a parameter's value (number of words, number) and process data."""
    telegrams = {name for name, (telegram, _) in subject.places.telegrams.items() if telegram.direction == direction}

    def carries(point: Point) -> int | None:
        if not point.addresses:
            return None
        if point.telegram is not None:
            known = point.telegram in telegrams and max(point.addresses) < len(words)
            return from_words(point, tuple(words[place] for place in point.addresses)) if known else None
        if request is None or value is None:
            return None
        if (point.addresses[0], point.index or 0) != (request.parameter, request.index) or value[0] != point.words:
            return None
        number = value[1]
        return from_words(point, (number >> 16, number & 0xFFFF) if value[0] == 2 else (number,))

    return carries


CHECKS = (codes_agree, parameters_are_reachable)
