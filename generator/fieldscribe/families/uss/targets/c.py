"""The view of the USS header: tasks, responses and errors, requests of points, words of process data."""

from collections.abc import Iterator, Sequence

from fieldscribe.families import Codes
from fieldscribe.families.uss import FAMILY, of_bus
from fieldscribe.families.uss.telegrams import READ_ELEMENT_TASK, READ_TASK, write_task
from fieldscribe.model import Code, Device, Point
from fieldscribe.targets.c import frames
from fieldscribe.targets.c.calls import Transfer
from fieldscribe.targets.c.point_views import GeneratedPoint
from fieldscribe.targets.c.scope import HeaderScope, PointView
from fieldscribe.targets.c.syntax import hexadecimal
from fieldscribe.targets.c.word_functions import places_of
from fieldscribe.targets.identifiers import Named, Owner
from fieldscribe.text import c_comment, c_string, upper


def header(device: Device, placed: Sequence[GeneratedPoint], scope: HeaderScope) -> frames.FramesHeader:
    """Return the header of frames, `<device>_uss.h`; `frames` read and write parameters, `words` are process data."""
    bus = device.bus
    telegrams = {telegram.name for telegram in device.telegrams}
    tasks = frozenset(code.number for code in bus.functions)
    numbers = [each for each in placed if each.point.addresses and each.point.text is None]
    parameters = [each for each in numbers if each.point.space == "parameter"]
    process_data = [each for each in numbers if each.point.telegram in telegrams and each.point.words <= 2]
    layouts = frames.Layouts(scope)
    of_points = frames.Frames(parameters, lambda point, view: _frame(point, view, tasks, layouts))
    words = frames.Frames(process_data, lambda point, view: _word(point, view, layouts, scope))
    kinds = [kind for kind in FAMILY.codes if bus.codes(kind.section)]
    return frames.frames_header(
        device,
        layouts,
        {"frames": of_points, "words": words},
        _identifiers(device, kinds, scope),
        broadcast="FIELDSCRIBE_USS_NO_BROADCAST" if bus.broadcast is None else hexadecimal(bus.broadcast, 2),
        pkw=of_bus(bus).pkw,
        pzd=of_bus(bus).pzd,
        tasks=[_task(code, scope) for code in bus.functions],
        codes=[_codes(kind, bus.codes(kind.section), scope) for kind in kinds],
    )


def _identifiers(device: Device, kinds: list[Codes], scope: HeaderScope) -> Iterator[Named]:
    """Yield the identifiers of the header that only this family has, with their owners."""
    target = Owner("target", "what the header of frames needs")
    yield target, [f"{scope.prefix}_{name}" for name in ("uss_tasks", "uss_pkw", "uss_profile", "device")]
    yield target, [_name_function(kind, scope) for kind in kinds]
    for kind in kinds:
        for code in device.bus.codes(kind.section):
            yield Owner(kind.key, code.name), (_enumerator(kind, code, scope),)


def _name_function(kind: Codes, scope: HeaderScope) -> str:
    return f"{scope.prefix}_{kind.kind}_name"


def _enumerator(kind: Codes, code: Code, scope: HeaderScope) -> str:
    return f"{scope.upper}_{upper(kind.kind)}_{upper(code.name)}"


def _task(code: Code, scope: HeaderScope) -> tuple[str, str, str]:
    """Return the enumerator of a task, the set of its responses as bits, and its comment."""
    answers = hexadecimal(sum(1 << answer for answer in set(code.answers)))
    return f"{scope.upper}_TASK_{upper(code.name)}", answers, c_comment(code.title["en"])


def _codes(kind: Codes, codes: tuple[Code, ...], scope: HeaderScope) -> dict[str, object]:
    """Return a list of codes: enumerators with comments, and the function that returns the name of a code."""
    entries = [
        (_enumerator(kind, code, scope), str(code.number), c_string(code.name), c_comment(code.title["en"]))
        for code in codes
    ]
    return {"title": f"{kind.kind.capitalize()}s", "function": _name_function(kind, scope), "entries": entries}


def _frame(point: Point, view: PointView, tasks: frozenset[int], layouts: frames.Layouts) -> frames.Frame | None:
    """Return the tasks of a parameter; None if no task of the device reaches it."""
    width, array = 2 if point.info.bits == 32 else 1, point.index is not None
    ram, eeprom = (write_task(width, array=array, keep=keep) for keep in (False, True))
    reading = [task for task in (READ_TASK, READ_ELEMENT_TASK) if task in tasks and point.readable][:1]
    writing = [ram] if point.writable and ram in tasks else []
    storing = [eeprom] if point.writable and point.keeps != "no" and eeprom in tasks else []
    if not (reading or writing or storing):
        return None
    changes = "w" if point.bits is None else "u"
    layout = layouts.of(point, range(width))

    def descriptor(tail: str, ways: list[tuple[int, str]]) -> frames.Descriptor:
        places = [f"{{{task}U, {view.fields.number}U, {point.index or 0}U, {width}U}}" for task, _ in ways]
        kind = f"fieldscribe_uss_{''.join(way for _, way in ways)}"
        return frames.Descriptor(kind, view.function + tail, f"{{{', '.join((layout, *places))}}}", tail)

    ways = [*((task, "r") for task in reading), *((task, changes) for task in writing)]
    descriptors = [descriptor("_frame", ways)] if ways else []
    descriptors += [descriptor("_eeprom_frame", [(task, changes) for task in storing])] if storing else []
    cases = [frames.lies(point, descriptor.name) for descriptor in descriptors]
    name, what = f"{view.function}_frame", frames.kind_of(view)
    if reading:
        cases.append(f"READ({name}, {what})")
    for kind, tail in [*(("write", "_frame") for _ in writing), *(("store", "_eeprom_frame") for _ in storing)]:
        if point.bits is None:
            cases.append(f'WRITE("{kind}", {view.function}{tail}, {what})')
        elif reading:
            cases.append(f'UPDATE("{kind}", {name}.read, {view.function}{tail}, {what})')
    changes_word = bool(reading) or point.bits is None
    calls = ((reading, "_frame"), (writing and changes_word, "_frame"), (storing and changes_word, "_eeprom_frame"))
    read, write, store = (f"{view.function}{tail}" if tasks else "" for tasks, tail in calls)
    transfer = Transfer("uss", read, write, store)
    return frames.Frame(tuple(descriptors), tuple(cases), transfer)


def _word(point: Point, view: PointView, layouts: frames.Layouts, scope: HeaderScope) -> frames.Frame:
    """Return the place of a point in the words of process data."""
    name, what = f"{view.function}_frame", frames.kind_of(view)
    position = f"{{{view.fields.number}U, {point.words}U}}"
    ways = f"{'h' if point.readable else ''}{'s' if point.writable else ''}"
    value = f"{{{', '.join((layouts.of(point, places_of(point)), *[position] * len(ways)))}}}"
    words = f"{view.macro}, {scope.upper}_TELEGRAM_{upper(point.telegram or '')}_WORDS"
    cases = [frames.lies(point, name)]
    if point.writable:
        cases += [f"SEND({name}, {what})", f"PUT({name}, {what}, {words})"]
    if point.readable:
        cases.append(f"TAKE({name}, {what}, {words})")
    if point.readable and not point.writable:
        cases.append(f"HEAR({name}, {what})")
    return frames.Frame((frames.Descriptor(f"fieldscribe_uss_{ways}", name, value, "_frame"),), tuple(cases))


IN_C = frames.CFamily(header, named_codes=tuple(codes.kind for codes in FAMILY.codes))
