"""What only a USS device can get wrong: codes that disagree, parameters that no task reaches, its worked frames."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from fieldscribe.arithmetic.words import split, words_in
from fieldscribe.checks import frames_agree
from fieldscribe.checks.coexistence import report_missing
from fieldscribe.checks.frames_agree import Seen, Words
from fieldscribe.families.uss import FAMILY, of_bus, of_frame
from fieldscribe.families.uss.remarks import words_printed
from fieldscribe.families.uss.telegrams import (
    LEAST_BYTES,
    MASKS,
    READ_TASK,
    SHORT,
    VARIABLE,
    Link,
    Request,
    answer_in,
    broadcast,
    build,
    check_byte,
    parse,
    part_of,
    request_in,
    write_task,
)
from fieldscribe.language.nodes import Map
from fieldscribe.model import Code, Frame, Named, Point
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.bus import code_list
from fieldscribe.resolve.errata import PrintedFact
from fieldscribe.resolve.frames import LocatedFrame

_LISTS = ("answers", "refusals")


def codes_agree(subject: Analysis) -> None:
    """Report codes that only one side names or that do not exist, and printed lists that disagree."""
    bus = subject.scope.bus
    if bus is None or not subject.bus_is_whole:
        return
    _tasks_and_responses_agree(subject, bus)
    _errors_have_tasks(subject, bus)
    for kind in FAMILY.codes:
        for code, node in _described_codes(subject, bus, kind.section):
            _printed_lists_agree(subject, code, node, kind.key)


def _described_codes(subject: Analysis, bus: Map, section: str) -> Iterator[tuple[Code, Map]]:
    """Yield each code that is described by a mapping, with the mapping."""
    by_name = {code.name: code for code in subject.bus.codes(section)}
    for node in bus.get(section, {}).values():
        if isinstance(node, Map) and node["name"] in by_name:
            yield by_name[node["name"]], node


def _tasks_and_responses_agree(subject: Analysis, bus: Map) -> None:
    """Report tasks and responses of which only one names the other."""
    tasks = {code.number: {*code.answers, *code.refusals} for code in subject.bus.functions}
    responses = {code.number: set(code.answers) for code in subject.bus.codes("responses")}
    for section, lists, kind, other_kind, others in (
        ("functions", _LISTS, "task", "response", responses),
        ("responses", _LISTS[:1], "response", "task", tasks),
    ):
        for code, node in _described_codes(subject, bus, section):
            named = [(key, number) for key in lists for number in getattr(code, key)]
            for key, number in named:
                if code.number not in others.get(number, ()):
                    what = "which does not name it back" if number in others else "which does not exist"
                    message = f"the {kind} {code.number} names the {other_kind} {number}, {what}"
                    hint = "take one of them in both lists, and give what is printed under `printed` with an erratum"
                    hint = hint if number in others else f"declare it, or leave it out; {hint}"
                    subject.report.error("codes-disagree", message, node.span(key), hint)


def _errors_have_tasks(subject: Analysis, bus: Map) -> None:
    """Report error values of tasks that do not exist or are never refused."""
    tasks = {code.number: code for code in subject.bus.functions}
    for error, node in _described_codes(subject, bus, "exceptions"):
        for number in error.answers:
            task = tasks.get(number)
            if task is None or not task.refusals:
                what = "which does not exist" if task is None else "which is never refused"
                message = f"the error {error.number} names the task {number}, {what}"
                hint = "correct one of them, and give what is printed under `printed` with an erratum"
                subject.report.error("codes-disagree", message, node.span("answers"), hint)


def _printed_lists_agree(subject: Analysis, code: Code, node: Map, about: str) -> None:
    """Compare the printed lists of a code with those of the description."""
    printed: Map = node.get("printed") or Map(node.file, node.start)
    for key in _LISTS:
        taken = sorted(getattr(code, key))
        codes = sorted(code_list(subject.scope, printed, key)) if key in printed else taken
        if codes != taken:
            codes_text, taken_text = (", ".join(map(str, numbers)) or "none" for numbers in (codes, taken))
            message = f"the {key} {codes_text} are printed for the {about} {code.number}, taken are {taken_text}"
            named, span = Named(about, code.number), printed.span(key)
            subject.report_printed(PrintedFact(named, key, list(printed[key]), taken, span, message))


def parameters_are_reachable(subject: Analysis) -> None:
    """Report each task that parameters need and that the device does not have."""
    report_missing(subject, _missing_tasks)


def _missing_tasks(subject: Analysis, points: list[Point]) -> Iterator[tuple[int, str, str, str]]:
    known = {code.number for code in subject.bus.functions}
    lengths = set(of_bus(subject.bus).pkw)
    if lengths == {0}:
        yield len(points), "no telegram has a parameter part", "pkw", "correct `pkw`, which lists its lengths in words"
        return
    if lengths and lengths <= {0, SHORT}:
        wide = sum(point.words > 1 for point in points)
        message = f"a parameter part of {SHORT} words carries no value of 32 bits"
        yield wide, message, "pkw", "correct `pkw`, or the types"
    hint = "list the task under `functions`, or correct `access` or `keeps`"
    if READ_TASK not in known:
        message = f"the device has no task {READ_TASK}, which reads a value"
        yield sum(point.readable for point in points), message, "functions", hint
    needed: Counter[int] = Counter()
    for point in points:
        for keep in {"yes": (True,), "no": (False,), "choice": (False, True)}.get(point.keeps or "no", ()):
            if point.writable:
                needed[write_task(point.words, array=point.index is not None, keep=keep)] += 1
    for task, count in sorted(needed.items()):
        if task not in known:
            yield count, f"the device has no task {task}, which writes such a value", "functions", hint


def read(subject: Analysis, open_frame: LocatedFrame, seen: dict[str, Seen]) -> Seen:
    """Read a worked frame, a whole telegram or one part, as the device would; `Seen.request` is (link, `Request`)."""
    frame = open_frame.frame
    if frame.framing == "broadcast":
        return _broadcast(subject, open_frame)
    if frame.framing == "uss":
        frame = _with_right_length_and_check(subject, open_frame)
        if len(frame.corrected) < LEAST_BYTES or len(frame.corrected) % 2:
            message = "this is no telegram: STX, LGE, ADR, words and BCC"
            return frames_agree.report_no_frame(subject, open_frame, message)
        return _telegram(subject, replace(open_frame, frame=frame), words_in(frame.corrected[3:-1]), seen)
    if len(frame.printed) % 2:
        return frames_agree.report_no_frame(subject, open_frame, "the part is made of words")
    words = words_in(frame.printed)
    if frame.framing == "pzd":
        return _process_data(subject, open_frame, words)
    return _telegram(subject, open_frame, words, seen)


def _with_right_length_and_check(subject: Analysis, open_frame: LocatedFrame) -> Frame:
    frame = open_frame.frame
    if len(frame.printed) < LEAST_BYTES:
        return frame
    body = frame.printed[:1] + bytes((len(frame.printed) - 2 & 0xFF,)) + frame.printed[2:-1]
    right = body + bytes((check_byte(body),))
    frames_agree.report_wrong_sum(subject, open_frame, "lge", frame.printed[1:2], right[1:2])
    frames_agree.report_wrong_sum(subject, open_frame, "bcc", frame.printed[-1:], right[-1:])
    return replace(frame, corrected=right, valid=right == frame.printed)


def _telegram(subject: Analysis, open_frame: LocatedFrame, words: tuple[int, ...], seen: dict[str, Seen]) -> Seen:
    """Read a telegram; a parameter part alone is read as a telegram without process data."""
    frame = open_frame.frame
    if frame.direction == "request":
        return _request(subject, open_frame, words)
    frames_agree.report_no_request(subject, open_frame)
    before = seen.get(frame.answers or "")
    if before is None or before.request is None:
        return Seen(replace(frame, valid=False))
    link, request = before.request
    if frame.framing == "uss":
        reply = parse(subject.bus, link, request, frame.corrected)
    else:
        reply = answer_in(subject.bus, link, request, words)
    if reply.status not in ("ok", "refused", "no_rights"):
        return frames_agree.report_refused(subject, open_frame, reply.status)
    frames_agree.report_wrong_error(subject, open_frame, reply.error if reply.status == "refused" else None)
    errors = {code.number: code for code in subject.bus.exceptions}
    if reply.status == "refused" and errors:
        error = errors.get(reply.error)
        if error is None or (error.answers and request.task not in error.answers):
            what = "does not exist" if error is None else f"is not for the task {request.task}"
            return frames_agree.report_no_frame(subject, open_frame, f"the error {reply.error} {what}")
    value = split(reply.value, reply.width) if reply.status == "ok" else ()
    return Seen(frame, before.request, _words(subject, "response", reply.words, request, value))


def _request(subject: Analysis, open_frame: LocatedFrame, words: tuple[int, ...]) -> Seen:
    frame = open_frame.frame
    unit = frame.corrected[2] if frame.framing == "uss" else subject.bus.units[0]
    setting = of_frame(frame).pkw
    setting = VARIABLE if setting is None else setting
    short = frame.framing == "pkw" and setting == VARIABLE and len(words) == SHORT
    sent = len(words) if short else Link(setting, 0).sent
    if len(words) < sent or (frame.framing == "pkw" and len(words) != sent):
        message = f"the parameter part has {sent} words, {len(words)} are printed"
        return frames_agree.report_no_frame(subject, open_frame, message)
    part, rest = part_of(words[:sent]), words[sent:]
    link = Link(setting, len(rest))
    request = Request(unit, 0, words=rest) if part is None else request_in(unit, part, link, rest)
    status, data = build(subject.bus, link, request)
    if status != "ok":
        return frames_agree.report_refused(subject, open_frame, status, unit)
    built = words_in(data[3:-1])[: len(words)] if short else words_in(data[3:-1])
    if built != words:
        return frames_agree.report_no_frame(subject, open_frame, f"this request would be {words_printed(built)}")
    value = split(request.value, request.width)
    return Seen(frame, (link, request), _words(subject, "request", rest, request, value))


def _process_data(subject: Analysis, open_frame: LocatedFrame, words: tuple[int, ...]) -> Seen:
    low, high = of_bus(subject.bus).pzd
    if not low <= len(words) <= high:
        message = f"there are {low}..{high} words of process data, not {len(words)}"
        return frames_agree.report_no_frame(subject, open_frame, message)
    return Seen(open_frame.frame, None, _words(subject, open_frame.frame.direction, words))


def _broadcast(subject: Analysis, open_frame: LocatedFrame) -> Seen:
    """Read a broadcast: four words of masks, then the process data."""
    words = words_in(open_frame.frame.printed)
    if len(open_frame.frame.printed) % 2 or len(words) < MASKS:
        return frames_agree.report_no_frame(subject, open_frame, "a broadcast starts with four words of masks")
    link = Link(MASKS, len(words) - MASKS)
    status, _ = broadcast(subject.bus, link, words[:MASKS], words[MASKS:])
    if status != "ok":
        message = f"this device takes no such broadcast: {status.replace('_', ' ')}"
        return frames_agree.report_no_frame(subject, open_frame, message)
    return Seen(open_frame.frame, None, _words(subject, "request", words[MASKS:]))


def _words(
    subject: Analysis,
    direction: str,
    words: tuple[int, ...],
    request: Request | None = None,
    value: tuple[int, ...] = (),
) -> Words:
    """Return the words of process data in this direction, and the value that a request is about."""
    telegrams = [name for name, (telegram, _) in subject.places.telegrams.items() if telegram.direction == direction]
    carried = {(name, address, 0): (word,) for name in telegrams for address, word in enumerate(words)}
    return carried if request is None else {**carried, ("parameter", request.parameter, request.index): value}


CHECKS = (codes_agree, parameters_are_reachable)
