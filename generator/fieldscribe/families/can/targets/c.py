"""The view of the CAN header: messages, cyclic telegrams, and the frames of each point."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from fieldscribe.families.can import identifier_bits, of_bus, signals
from fieldscribe.families.can.frames import carriers, frame_count, request_and_answer
from fieldscribe.model import Device, Message, Point, Role, Telegram
from fieldscribe.targets.c import frames
from fieldscribe.targets.c.groups import Members, Part, StructView
from fieldscribe.targets.c.point_views import GeneratedPoint
from fieldscribe.targets.c.scope import HeaderScope, PointView
from fieldscribe.targets.c.syntax import hexadecimal
from fieldscribe.targets.identifiers import Named, Owner
from fieldscribe.text import c_comment, upper

_View = dict[str, Any]
"""What the template gets of a message, a telegram or a group."""


def header(device: Device, placed: Sequence[GeneratedPoint], scope: HeaderScope) -> frames.FramesHeader:
    """Return the header of frames, `<device>_can.h`."""
    carrying = carriers(device)
    exchanges = [request_and_answer(device.messages, writes=writes) for writes in (False, True)]
    # the arrays of the messages that read, answer that, write, answer that; empty for a missing one
    arrays = tuple(_array(message, scope) for exchange in exchanges for message in exchange)
    members = Members(scope)
    telegrams = [
        _telegram(telegram, carrying[telegram.name], placed, members)
        for telegram in device.telegrams
        if telegram.name in carrying and carrying[telegram.name].words
    ]
    of_signals = [_signals(message, placed, members) for message in device.messages if message.fields]
    groups = list(_groups(device, scope))
    layouts = frames.Layouts(scope)
    return frames.frames_header(
        device,
        layouts,
        _sections(device, placed, layouts, arrays),
        (*_identifiers(device, telegrams, groups, scope), *_names_of(of_signals)),
        identifier_bits=identifier_bits(device.bus),
        bitrate=of_bus(device.bus).bitrate,
        messages=[_message(message, scope) for message in device.messages if message.roles],
        telegrams=telegrams,
        signals=of_signals,
        exchanges=arrays,
        exceptions=frames.exceptions_of(device, scope),
        groups=groups,
    )


def _sections(
    device: Device, placed: Sequence[GeneratedPoint], layouts: frames.Layouts, arrays: Sequence[str]
) -> dict[str, frames.Frames]:
    """Return the frames of parameters, and those of points in telegrams."""
    carried = carriers(device)
    reached = [each for each in placed if each.point.addresses]
    parameters = [each for each in reached if each.point.space == "parameter" and _fits(each.point, 1)]
    cyclic = [
        each
        for each in reached
        if each.point.telegram in carried and (each.point.place.bit is not None or _fits(each.point, 2))
    ]
    return {
        "parameters": frames.Frames(parameters, lambda point, view: _parameter(point, view, layouts, arrays)),
        "cyclic": frames.Frames(cyclic, lambda point, view: _cyclic(point, view, layouts)),
    }


def _identifiers(device: Device, telegrams: list[_View], groups: list[_View], scope: HeaderScope) -> Iterator[Named]:
    """Yield the identifiers of the header that only this family has, with their owners."""
    fixed = (f"{scope.prefix}_can_profile", f"{scope.prefix}_can_dialogue", f"{scope.upper}_CAN_BITRATE")
    yield Owner("target", "what the header of frames needs"), fixed
    for message in (message for message in device.messages if message.roles):
        yield Owner("message", message.name), (_array(message, scope),)
    for telegram in telegrams:
        values = telegram["numbers"]
        names = telegram["constant"], telegram["slots_name"], *values.names, f"{values.struct}_take"
        yield Owner("telegram", telegram["name"]), names
    for group in groups:
        yield Owner("group", group["title"]), (group["array"], group["count_name"])


def _array(message: Message | None, scope: HeaderScope) -> str:
    return "" if message is None else f"{scope.prefix}_message_{message.name}"


def _message(message: Message, scope: HeaderScope) -> _View:
    """Return the layout of a message; `roles` are kinds and numbers."""
    return {
        "name": message.name,
        "array": _array(message, scope),
        "comment": c_comment(message.title["en"]),
        "id": hexadecimal(message.identifier, 3),
        "adds_unit": "true" if message.adds_unit else "false",
        "roles": [(f"FIELDSCRIBE_CAN_{upper(role.kind)}", _role_number(role)) for role in message.roles],
    }


def _role_number(role: Role) -> str:
    return hexadecimal(role.number, 2) if role.kind in ("constant", "xor") else f"{role.number}U"


def _telegram(telegram: Telegram, message: Message, placed: Sequence[GeneratedPoint], members: Members) -> _View:
    """Return the view of a telegram. A point whose words are in two frames is not a member of its struct."""
    scope, per_frame = members.scope, message.words
    macro = f"{scope.upper}_TELEGRAM_{upper(telegram.name)}"

    def parts() -> Iterator[Part]:
        brought: dict[int, list[tuple[str, str, str]]] = {}
        for each in placed:
            if each.point.telegram == telegram.name and each.point.addresses:
                first, last = min(each.point.addresses), max(each.point.addresses)
                if first // per_frame == last // per_frame and last - first < each.point.words:
                    brought.setdefault(first // per_frame, []).append(members.of(each, first % per_frame))
        for frame in sorted(brought):
            yield Part.of(f"{frame}U", brought[frame])

    return {
        "name": telegram.name,
        "constant": f"{scope.prefix}_telegram_{telegram.name}",
        "words_name": f"{macro}_WORDS",
        "slots_name": f"{macro}_SLOTS",
        "slots": frame_count(telegram, message),
        "message": _array(message, scope),
        "per_frame": per_frame,
        "numbers": StructView(f"{scope.prefix}_{telegram.name}_values", parts),
    }


def _signals(message: Message, placed: Sequence[GeneratedPoint], members: Members) -> _View:
    """Return a message of signals: rows of its table, and the choices that select some, by the name of their array.

    `always` are the first words of those parts that every frame has.
    """
    scope = members.scope
    name, macro = f"{scope.prefix}_signals_{message.name}", f"{scope.upper}_SIGNALS_{upper(message.name)}"
    choices: dict[object, tuple[str, list[tuple[int, int, str]]]] = {}
    for field in message.fields:
        if field.when and field.when not in choices:
            several = [(message.fields[at].word, raw, raw != raws[-1]) for at, raws in field.when for raw in raws]
            rows = [(word, raw, "true" if more else "false") for word, raw, more in several]
            choices[field.when] = f"{name}_{len(choices)}", rows
    mine = [each for each in placed if each.point.telegram == message.name and each.point.readable]
    by_word = {each.point.addresses[0]: each for each in mine}

    def parts() -> Iterator[Part]:
        for words, _ in signals.parts(message):
            points = [by_word[word] for word in words if word in by_word]
            yield Part.of(f"{words.start}U", (members.of(each, each.point.addresses[0]) for each in points))

    return {
        "name": message.name,
        "comment": c_comment(message.title["en"]),
        "constant": name,
        "array": f"{name}_rows",
        "words_name": f"{macro}_WORDS",
        "every_name": f"{macro}_EVERY",
        "every": message.every,
        "words": sum(field.words for field in message.fields),
        "id": hexadecimal(message.identifier, 3),
        "adds_unit": "true" if message.adds_unit else "false",
        "length": message.length,
        "rows": [
            (
                field.start,
                field.width,
                "true" if field.low_first else "false",
                len(choices[field.when][1]) if field.when else 0,
                choices[field.when][0] if field.when else "NULL",
            )
            for field in message.fields
        ],
        "choices": list(choices.values()),
        "reads": bool(mine),
        "always": {f"{words.start}U" for words, when in signals.parts(message) if not when},
        "numbers": StructView(f"{scope.prefix}_{message.name}_values", parts),
    }


def _names_of(views: Iterable[_View]) -> Iterator[Named]:
    for view in views:
        names = [view["constant"], view["array"], view["words_name"], *(name for name, _ in view["choices"])]
        names += [] if view["every"] is None else [view["every_name"]]
        names += [*view["numbers"].names, f"{view['numbers'].struct}_take"] if view["reads"] else []
        yield Owner("message", view["name"]), tuple(names)


def _groups(device: Device, scope: HeaderScope) -> Iterator[_View]:
    """Yield the addresses to read for each group, each word once."""
    for group in device.groups:
        first_with: dict[int, str] = {}
        for point in device.points:
            if point.generated and point.readable and point.group == group.name and point.space == "parameter":
                for address in point.addresses:
                    first_with.setdefault(address, point.item)
        if first_with:
            name = f"{scope.prefix}_{group.name}_group"
            count = f"{scope.upper}_{upper(group.name)}_GROUP_COUNT"
            rows = [(hexadecimal(address), item) for address, item in first_with.items()]
            sizes = {"count_name": count, "count": f"{len(rows)}U"}
            yield {"title": group.name, "array": name, **sizes, "rows": rows}


def _fits(point: Point, words: int) -> bool:
    """Return True if a point is a text, or has at most this many words."""
    return point.text is not None or point.words <= words


def _parameter(point: Point, view: PointView, layouts: frames.Layouts, arrays: Sequence[str]) -> frames.Frame | None:
    """Return the frames of a parameter, one for each word; None if the device has no message for it."""
    read_request, read_answer, write_request, write_answer = map(bool, arrays)
    read, write = read_request and point.readable, write_request and point.writable
    if not read and not write:
        return None
    text = point.text is not None
    place = f"{{{view.function}_addresses, {point.words}U}}" if text else f"{{{view.fields.start}}}"
    parts = [*([] if text else [layouts.of(point, (0,))]), *[place] * (read + write)]
    ways = f"{'r' if read else ''}{('w' if point.bits is None else 'u') if write else ''}"
    cases = ["READ"] if read and read_answer else []
    if write and write_answer and (cases or point.bits is None):
        cases.append("WRITE" if point.bits is None else "WRITE_SHARED")
    return _frame(point, view, ways, parts, cases)


def _cyclic(point: Point, view: PointView, layouts: frames.Layouts) -> frames.Frame:
    """Return the place of a point in its telegram."""
    if point.text is not None:
        parts = [f"{{{view.function}_addresses, {point.words}U}}"]
    else:
        parts = [layouts.of(point, range(point.words)), f"{{{view.fields.start}, {view.fields.end}}}"]
    return _frame(point, view, "h", parts, ["RECEIVED" if point.place.bit is None else "SIGNAL"])


def _frame(point: Point, view: PointView, ways: str, parts: list[str], cases: Sequence[str]) -> frames.Frame:
    """Return the frames of a point; the letters are r (read), w (write), u (update) and h (receive).

    `cases` are the macros of the conformance program for them.
    """
    name, text = f"{view.function}_frame", point.text is not None
    kind = f"fieldscribe_can_{'text_' if text else ''}{ways}"
    of_text = tuple(f"{case}_TEXT({view.function}, {view.macro})" for case in cases)
    answers = of_text if text else frames.exchanges(view, name, cases)
    return frames.Frame((frames.Descriptor(kind, name, f"{{{', '.join(parts)}}}", "_frame"),), answers)


IN_C = frames.CFamily(header)
