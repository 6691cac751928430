"""What a device said when its present version was generated first: `manifest/<device>.facts.json`.

It is the exported model, where what many points (errata, frames, ...) say alike is written once. It stays as it is
until the version is raised by the step that the changes since then ask for: who has the output alone can tell that.
"""

from __future__ import annotations

import json
from collections import Counter
from typing import TYPE_CHECKING, Any, NamedTuple

from fieldscribe.export import FORMAT
from fieldscribe.output.manifests import FOLDER
from fieldscribe.safe_files import read_regular

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from fieldscribe.model import Device
    from fieldscribe.output.manifests import Manifests

_FORMATS = [1, FORMAT]
"""Those of the record and of the exported model: one that another compiler wrote is replaced where it differs."""
_MOST_BYTES = 512 << 20
_SOME, _LONG, _NUMBER = 64, 60, "#"
_ENCODER = json.JSONEncoder()


class Record(NamedTuple):
    """A version, a checksum of all that the device said, and how it is written."""

    version: str
    checksum: str
    data: bytes


class Owed(NamedTuple):
    """The recorded version, the step that what changed since then asks for, and the lowest version that takes it."""

    recorded: str
    step: str
    least: str


def facts_path(device: str) -> str:
    """Where the record of a device is, relative to the output folder."""
    return f"{FOLDER}/{device}.facts.json"


def kept_record(out: Path, manifests: Manifests, device: Device) -> Record | None:
    """The record in the output folder; None if there is none, or none of ours, or one that we cannot read."""
    try:
        data = read_regular(out / facts_path(device.id), _MOST_BYTES).data.replace(b"\r\n", b"\n")
        head = json.loads(data[: data.index(b"\n")].rstrip(b",") + b"}")
        if head["format"] != _FORMATS or not manifests.vouch_for(facts_path(device.id), device.id, data):
            return None
        return Record(str(head["version"]), str(head["facts"]), data)
    except (OSError, ValueError, KeyError, TypeError):
        return None


def record_of(device: Device) -> Record:
    """The record of what the device says now."""
    from fieldscribe.export import export_model

    head = {"format": _FORMATS, "device": device.id, "version": device.version, "facts": checksum(device)}
    model = export_model(device)
    lists = {key: value for key, value in model.items() if _is_of_things(value)}
    plain = {key: value for key, value in model.items() if key not in lists}
    parts = [_text(head)[:-1], *(f"{json.dumps(key)}: {_things(things)}" for key, things in lists.items())]
    text = ",\n".join([*parts, f'"rest": {_text(plain)}}}\n'])
    return Record(device.version, str(head["facts"]), text.encode())


def model_of(record: Record) -> dict[str, Any]:
    """The exported model that a record holds."""
    said: dict[str, Any] = json.loads(record.data)
    lists = {key: value for key, value in said.items() if isinstance(value, dict) and key != "rest"}
    return {**said["rest"], **{key: [*_read(**value)] for key, value in lists.items()}}


def checksum(device: Device) -> str:
    """A checksum of all that a device says, titles and notes too, but for its version."""
    from dataclasses import replace

    from fieldscribe.plain import checksum_of

    return checksum_of(replace(device, version="", digest=""))


def owed(record: Record, device: Device) -> Owed | None:
    """What the version lacks for the changes since the record; None where nothing changed, or it was raised enough."""
    from fieldscribe.differences import is_taken, next_version, step_between

    if record.checksum == checksum(device):
        return None
    try:
        step = step_between(model_of(record), device)
    except (ValueError, KeyError, TypeError, AttributeError, IndexError):
        return None  # somebody wrote it, and its checksum into the manifest
    if step is None or is_taken(record.version, device.version, step):
        return None
    return Owed(record.version, step, next_version(record.version, step) or "")


def _is_of_things(value: object) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(item, dict) for item in value)


def _things(things: Any) -> str:
    """Things, a line each, behind what most of them say, and long values that several say, which they name by number.

    What most say is looked for in some of them: it decides nothing but how long the text is.
    """
    some = things[:: len(things) // _SOME + 1]
    most = {key: _most(key, some) for key in things[0] if all(key in thing for thing in things)}
    rows = [{key: said for key, said in thing.items() if key not in most or most[key] != said} for thing in things]
    often: dict[str, dict[str, int]] = {}
    for key in most:
        times = Counter(repr(row[key]) for row in rows if isinstance(row.get(key), dict | list))
        repeated = [said for said, count in times.items() if count > 1 and len(said) >= _LONG]
        often |= {key: {said: number for number, said in enumerate(repeated)}} if repeated else {}
    values: dict[str, dict[int, str]] = {key: {} for key in often}
    for row in rows:
        for key in sorted(often.keys() & row.keys()):
            number = often[key].get(repr(row[key]))
            if number is not None:
                if number not in values[key]:
                    values[key][number] = _text(row[key])
                row[key] = {_NUMBER: number}
    listed = ", ".join(f"{json.dumps(key)}: [{', '.join(texts.values())}]" for key, texts in values.items())
    each = ",\n".join(map(_text, rows))
    return f'{{"most": {_text(most)}, "often": {{{listed}}}, "each": [\n{each}]}}'


def _read(most: dict[str, Any], often: dict[str, list[Any]], each: list[dict[str, Any]]) -> Iterator[dict[str, Any]]:
    """The things that were written so."""
    for row in each:
        for key in often.keys() & row.keys():
            if isinstance(row[key], dict) and row[key].keys() == {_NUMBER}:
                row[key] = often[key][row[key][_NUMBER]]
        yield {**most, **row}


def _most(key: str, things: list[dict[str, Any]]) -> Any:
    [(text, _)] = Counter(_text(thing[key]) for thing in things).most_common(1)
    return json.loads(text)


def _text(value: object) -> str:
    return _ENCODER.encode(value)
