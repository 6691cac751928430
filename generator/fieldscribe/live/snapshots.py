"""A snapshot of a device as a file: names, values with units, and the raw numbers that restore them."""

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from fractions import Fraction
from pathlib import Path
from typing import Any, NamedTuple, get_origin

from fieldscribe_runtime import AnyDevice, CodecError, FieldscribeError

from fieldscribe.arithmetic import codec
from fieldscribe.diagnostics import UnclearError
from fieldscribe.live.readings import NOT_THERE, PartialReads, in_words, may_be_read
from fieldscribe.live.writing import reading_of
from fieldscribe.model import Device, Point
from fieldscribe.safe_files import read_regular
from fieldscribe.text import shortened

DEFAULTS = "defaults"
"""The source of the snapshot of defaults: the manual."""

_FORMAT = 1
_MOST_BYTES = 32 << 20


class Held(NamedTuple):
    """The number of a point: its code, value, unit, text, and raw number (None if only the value is known).

    `kind` is `setting`, `written` (for other writable points), or `read`.
    """

    code: str | None
    value: int | float | str | None
    unit: str
    text: str
    raw: int | None
    kind: str


@dataclass(frozen=True, slots=True)
class Snapshot:
    """A device at one time: the numbers of its points by name, and why others have none.

    `given` are the numbers that its addresses depend on, as in `slot=3`.
    """

    device: str
    version: str
    digest: str
    line: str
    unit: int
    taken: str
    variants: dict[str, str]
    given: list[str]
    points: dict[str, Held]
    missing: dict[str, str]

    @property
    def title(self) -> str:
        """Return its device and time."""
        return f"{self.device}, unit {self.unit}, {self.taken}" if self.taken else f"{self.device}, {self.line}"

    @property
    def raws(self) -> dict[str, int]:
        """The raw numbers by item."""
        return {item: held.raw for item, held in self.points.items() if held.raw is not None}

    def as_text(self) -> str:
        """Return the text of its file."""
        facts = asdict(self) | {"points": {name: held._asdict() for name, held in self.points.items()}}
        return json.dumps({"snapshot": _FORMAT, **facts}, indent=1) + "\n"


def take(model: Device, device: AnyDevice, line: str, progress: Callable[[str], None]) -> Snapshot:
    """Read all groups of a device; everything is read anew. Raises FieldscribeError if the line is lost.

    Points that only select pages are left out: reading the selected points writes them.
    """
    raws: dict[str, int] = {}
    missing: dict[str, str] = {}
    reads, left_out = PartialReads(device), model.selecting
    for number, group in enumerate(device.GROUPS, 1):
        progress(f"reading group {number} of {len(device.GROUPS)}: {group}")
        points = [point for point in model.points if point.group == group and point.name not in left_out]
        values = reads.read(group, [point.item for point in points if may_be_read(model, point)])
        if reads.gone is not None:
            raise reads.gone
        for row, value in zip(device.rows(values), values.values(), strict=True):
            if isinstance(value, FieldscribeError) and not isinstance(value, CodecError):
                missing.update({} if row["status"] in NOT_THERE else {row["name"]: in_words(value)})
                continue
            handle: Any = device.point(row["name"])
            try:
                raws[handle.facts.item] = handle.read_raw() if row["raw"] is None else row["raw"]
            except FieldscribeError as error:
                missing[row["name"]] = in_words(error)
    variants = {axis: value for axis, value in device.variants.items() if value is not None}
    taken = datetime.now(UTC).isoformat(timespec="seconds")
    held = dict(_held(model, raws))
    return Snapshot(model.id, model.version, model.digest, line, device.unit, taken, variants, [], held, missing)


def defaults(model: Device) -> Snapshot:
    """Return the snapshot of the manual's defaults: only points that have one. Raises UnclearError without any."""
    raws = {point.item: point.default_raw for point in model.points if point.default_raw is not None}
    points = dict(_held(model, raws))
    for point in model.points:
        if point.default is not None and point.item not in points:
            text = f"{float(point.default):.12g} {point.unit.symbol}".rstrip()
            points[point.item] = Held(point.code, float(point.default), point.unit.symbol, text, None, _kind(point))
    if not points:
        raise UnclearError(f"the description of {model.id} gives no defaults", "name another snapshot to compare with")
    return Snapshot(model.id, model.version, model.digest, DEFAULTS, 0, "", {}, [], points, {})


def settings_of(model: Device, raws: Mapping[str, int]) -> dict[str, int | Fraction]:
    """Return raw numbers by item as settings by name, for scales and limits."""
    points = {point.item: point for point in model.points}
    return {points[item].name: codec.setting_of(points[item], raw) for item, raw in raws.items() if item in points}


def _held(model: Device, raws: Mapping[str, int]) -> Iterator[tuple[str, Held]]:
    """Yield the entry of each point; scales use the numbers of the same device."""
    points = {point.item: point for point in model.points}
    settings = settings_of(model, raws)
    for item, raw in raws.items():
        point = points[item]
        known = {name: settings[name] for name in point.arguments if name in settings}
        reading = reading_of(model, point, raw, known)
        value = reading.text if point.text is not None else reading.value
        yield item, Held(point.code, value, reading.unit, reading.text, raw, _kind(point))


def is_setting(point: Point) -> bool:
    """Return True if a point is a setting by its description, not a command or setpoint."""
    kept = point.keeps not in (None, "no") or point.changes == "never" or point.default is not None
    return point.writable and kept and point.changes != "always"


def _kind(point: Point) -> str:
    return "setting" if is_setting(point) else "written" if point.writable else "read"


def read_snapshot(path: Path) -> Snapshot:
    """Return the snapshot in a file. Raises UnclearError, OSError."""
    writes = "`fieldscribe snapshot DEVICE --out FILE` writes one"
    wrong = UnclearError(f"{path} is no snapshot", writes)
    try:
        data = json.loads(read_regular(path, _MOST_BYTES).data)
        if data.pop("snapshot") != _FORMAT:
            raise UnclearError(f"{path} is a snapshot of another version of fieldscribe", "take it again")
        points = {name: Held(**held) for name, held in data.pop("points").items()}
        snapshot = Snapshot(points=points, **data)
    except FileNotFoundError as error:
        raise UnclearError(f"there is no file {path}", f"name a snapshot first; {writes}") from error
    except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        raise wrong from error
    kinds: dict[str, Any] = {name: get_origin(kind) or kind for name, kind in Snapshot.__annotations__.items()}
    typed = all(isinstance(getattr(snapshot, name), kind) for name, kind in kinds.items())
    texts = typed and all(isinstance(text, str) for text in _texts(snapshot))
    if not texts or not all(_is_held(held) for held in points.values()):
        raise wrong
    return snapshot


def contradictions(model: Device, snapshot: Snapshot) -> Iterator[str]:
    """Yield the points whose raw number and value differ in meaning; somebody changed one of them by hand.

    A snapshot by another edition of the description is not examined: raw numbers may have another meaning there.
    """
    items = {point.item for point in model.points} if snapshot.digest == model.digest else ()
    raws = {item: raw for item, raw in snapshot.raws.items() if item in items}
    for item, found in _held(model, raws):
        held = snapshot.points[item]
        if held.value is not None and held.value != found.value and held.value == held.value:  # no NaN
            label = f"{held.code or ''} {item}".lstrip()
            yield f"{label}: its raw number {held.raw} is {found.text}, and its value says {held.value}"


def may_be_replaced(path: Path) -> bool:
    """Return True if there is no file, an empty one, or a snapshot of any version: nothing else is lost. OSError."""
    if not path.exists():
        return True
    try:
        data = read_regular(path, _MOST_BYTES).data
        held = json.loads(data or "{}")
    except (ValueError, RecursionError):
        return False
    return not data or (isinstance(held, dict) and "snapshot" in held)


def _texts(snapshot: Snapshot) -> Iterator[object]:
    """Yield the entries that must be texts."""
    yield from (*snapshot.variants.values(), *snapshot.given, *snapshot.missing.values())


def _is_held(held: Held) -> bool:
    kinds = Held.__annotations__
    return all(isinstance(each, kinds[name]) and not isinstance(each, bool) for name, each in held._asdict().items())


class Difference(NamedTuple):
    """A point that two snapshots differ in; None where one has no such point."""

    name: str
    first: Held | None
    second: Held | None

    @property
    def label(self) -> str:
        """Return the code and the name."""
        code = next((held.code for held in (self.first, self.second) if held is not None and held.code), "")
        return f"{code} {self.name}".lstrip()


def compared(first: Snapshot, second: Snapshot, *, also_read: bool = True) -> list[Difference]:
    """Return what differs by value and unit; points without a default are not compared with the manual's defaults.

    `also_read` also compares read-only points.

    Raises UnclearError for snapshots of two kinds of devices.
    """
    if first.device != second.device:
        message = f"{shortened(first.device)} and {shortened(second.device)} are different kinds of devices"
        raise UnclearError(message, "compare snapshots of one kind")
    names = dict.fromkeys((*first.points, *second.points))
    if DEFAULTS in (first.line, second.line):
        names = {name: None for name in names if name in first.points and name in second.points}
    pairs = [Difference(name, first.points.get(name), second.points.get(name)) for name in names]
    if not also_read:
        pairs = [pair for pair in pairs if "read" not in {held.kind for held in (pair.first, pair.second) if held}]
    return [pair for pair in pairs if _meaning(pair.first) != _meaning(pair.second)]


def _meaning(held: Held | None) -> object:
    """Return what is compared: the value with its unit; the raw number where there is no value."""
    return None if held is None else (held.raw if held.value is None else held.value, held.unit)
