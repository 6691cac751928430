"""Finds an order in which a device allows all writes of a snapshot's settings; and their journal.

The journal has a line before and after each write, on the disk before the next step. If a restore is interrupted, the
next one reads what was written.
"""

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from fieldscribe.arithmetic import codec
from fieldscribe.conversation.refusals import written_remarks
from fieldscribe.diagnostics import UnclearError
from fieldscribe.live.snapshots import Snapshot, is_setting, settings_of
from fieldscribe.model import Device, Point
from fieldscribe.safe_files import read_regular
from fieldscribe.text import line
from fieldscribe.wording import label


@dataclass(slots=True)
class Order:
    """The writes in order, as items with raw numbers; and what is not written.

    `refused` has the reasons for numbers that cannot be written; `unknown` are names that the description does not
    have; `others` can be written and differ, but are no settings; `same` counts what the device holds already.
    """

    writes: dict[str, int] = field(default_factory=dict)
    refused: dict[str, str] = field(default_factory=dict)
    unknown: list[str] = field(default_factory=list)
    others: list[str] = field(default_factory=list)
    same: int = 0


def ordered(model: Device, now: Snapshot, wanted: Snapshot, is_chosen: Callable[[Point], bool] = is_setting) -> Order:
    """Return the order of writes from `now` to `wanted`, for the chosen points.

    Raises UnclearError for another kind of device.
    """
    if wanted.device != model.id:
        raise UnclearError(f"the snapshot is of {wanted.device}, and this is {model.id}", "name the device it is of")
    points = {point.item: point for point in model.points if point.generated}
    known = {old: point.item for point in points.values() for old in point.old_items} | {item: item for item in points}
    order = Order(unknown=[name for name in wanted.points if name not in known])
    held = now.raws
    differing: dict[str, int] = {}
    equal: dict[str, int] = {}
    raws = {known[name]: raw for name, raw in wanted.raws.items() if name in known}
    chosen = {item for item in raws if points[item].writable and is_chosen(points[item])}
    theirs = settings_of(model, raws)
    ours = settings_of(model, held) | settings_of(model, {item: raws[item] for item in chosen})
    for item in [item for item in raws if points[item].writable]:
        here, raw = held.get(item), _same_value(points[item], raws[item], theirs, ours)
        if item not in chosen:
            order.others += [item] if here != raw else []
        elif here is None and not _will_exist(model, points[item], {**held, **raws}):
            order.refused[item] = now.missing.get(points[item].name, "the device does not have it")
        elif raw is None:
            order.refused[item] = "this device has no number for that value"
        elif here == raw:
            equal[item] = raw
        else:
            differing[item] = raw
    order.same = len(equal)
    _add_changed(points, differing, equal)
    names = {points[item].name for item in differing}
    for item in list(differing):
        if missing := [name for name in points[item].write_with if name not in names]:
            order.refused[item] = f"it is written in one request with {', '.join(missing)}, which is not restored"
            del differing[item]
    _Sorter(model, points, held, order).sort(differing)
    return order


def _same_value(point: Point, raw: int, theirs: codec.Settings, ours: codec.Settings) -> int | None:
    """Return the raw number here for the value of a raw number there; None if there is none.

    They are equal unless the scale depends on points that differ between the devices.
    """
    if all(theirs.get(name) == ours.get(name) for name in point.scale_arguments) or point.special(raw):
        return raw
    try:
        return codec.encode(point, codec.decode(point, raw, theirs), ours)
    except codec.CodecError:
        return None


def _will_exist(model: Device, point: Point, raws: Mapping[str, int]) -> bool:
    """Return True if a point that the device does not have now will exist after the other writes."""
    if point.when is None:
        return False
    values: dict[str, int | str] = {each.name: raws[each.item] for each in model.points if each.item in raws}
    values.update({axis: left[0] for axis, left in model.variants.items() if len(left) == 1})
    return values.keys() >= {*point.when.names} and point.when.holds(values)


def _add_changed(points: Mapping[str, Point], differing: dict[str, int], equal: dict[str, int]) -> None:
    """Add points that are correct now, but that another write changes, or that must be written with another point."""
    names = {points[item].name for item in differing}
    together = [point for point in points.values() if point.write_with]
    while changed := [
        item
        for item in equal
        if names.intersection(points[item].changes_with)
        or any(points[item].name in point.write_with and point.name in names for point in together)
    ]:
        differing.update({item: equal.pop(item) for item in changed})
        names.update(points[item].name for item in changed)


class _Sorter:
    """Simulates the writes: the next one depends on no open write, and the device allows it then."""

    def __init__(self, model: Device, points: Mapping[str, Point], held: Mapping[str, int], order: Order) -> None:
        self._model, self._points, self._order = model, points, order
        self._settings = settings_of(model, held)

    def sort(self, wanted: Mapping[str, int]) -> None:
        """Add the writes to the order."""
        for last in (False, True):  # what takes effect later comes last, such as settings of the line
            self._part(
                {item: raw for item, raw in wanted.items() if (self._points[item].takes_effect is not None) is last}
            )

    def _part(self, pending: dict[str, int]) -> None:
        while pending:
            allowed = [item for item, raw in pending.items() if not self._error(item, raw)]
            names = {self._points[item].name for item in pending}
            free = [item for item in allowed if not names.intersection(_waits_for(self._points[item]))]
            if not allowed:
                self._order.refused.update({item: self._error(item, raw) for item, raw in pending.items()})
                return
            for item in free or allowed[:1]:
                if self._error(item, pending[item]):
                    continue  # what was written before it in this round moved its limits
                self._order.writes[item] = pending[item]
                self._settings[self._points[item].name] = codec.setting_of(self._points[item], pending.pop(item))

    def _error(self, item: str, raw: int) -> str:
        """Return why a raw number may not be written now; empty if it may."""
        wrong, unchecked = written_remarks(self._model, self._points[item], raw, self._settings)
        return wrong or unchecked


def _waits_for(point: Point) -> Iterable[str]:
    """Yield the points to write before this one: those it depends on, exists by, or is changed by."""
    return {*point.arguments, *point.changes_with, *(() if point.when is None else point.when.names)} - {point.name}


def refusals(model: Device, order: Order) -> list[str]:
    """Return what cannot be written, with the reason."""
    points = {point.item: point for point in model.points}
    return [f"{label(points[item])}: {why}" for item, why in order.refused.items()]


_MOST_BYTES = 32 << 20


class Journal:
    """The journal of a running restore. `names` are its writes, in order."""

    def __init__(self, path: Path, names: list[str], facts: dict[str, Any]) -> None:
        """Start after the earlier entries of the file. Raises OSError."""
        self._path, self._stream = path, path.open("a", encoding="utf-8")
        if self._stream.tell():
            self._stream.write("\n")  # the last line of a killed restore may be incomplete
        started = datetime.now(UTC).isoformat(timespec="seconds")
        self.note(started=started, **facts, writes=names)

    def end(self) -> None:
        """Log the end."""
        self.note(ended=datetime.now(UTC).isoformat(timespec="seconds"))

    def close(self) -> None:
        """Close the file."""
        with suppress(OSError):  # a note that could not be written has raised it already
            self._stream.close()

    def note(self, **facts: Any) -> None:
        """Log facts: that write number `begin` is next, that the device accepted it (`done`) or `refused` it, ..."""
        try:
            self._stream.write(json.dumps(facts) + "\n")
            self._stream.flush()
            os.fsync(self._stream.fileno())
        except OSError as error:
            error.filename = str(self._path)
            raise


def interrupted(path: Path) -> list[str]:
    """Return what the last restore of a journal did, line by line, if it was interrupted; nothing otherwise.

    An incomplete line of the journal counts as missing. Raises OSError.
    """
    try:
        lines = read_regular(path, _MOST_BYTES).data.decode("utf-8", "replace").split("\n")
    except FileNotFoundError:
        return []
    notes: list[dict[str, Any]] = []
    for note in _notes(lines):
        notes = [note] if "writes" in note else [*notes, note]
    if not notes or "writes" not in notes[0] or "ended" in notes[-1]:
        return []
    head = notes[0]
    names = [line(str(name)) for name in head["writes"]]
    states = {note[key]: key for note in notes for key in ("begin", "done", "refused") if type(note.get(key)) is int}
    device = line(f"{head.get('device')}, unit {head.get('unit')}, {head.get('line')}")
    notice = [f"the restore of {line(str(head.get('started')))} to {device} did not end"]
    for what, keys in (("written", ("done",)), ("perhaps written", ("begin",)), ("not written", (None, "refused"))):
        if some := [name for number, name in enumerate(names) if states.get(number) in keys]:
            notice.append(f"{what}: {', '.join(some)}")
    return notice


def _notes(lines: list[str]) -> Iterator[dict[str, Any]]:
    """Yield the complete lines."""
    for text in lines:
        try:
            note = json.loads(text)
        except (ValueError, RecursionError):
            continue
        if isinstance(note, dict):
            yield note
