"""CAN databases: each as a device, whose own database means the same in random frames."""

from __future__ import annotations

import random
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from fieldscribe.cli.import_dbc import database_of, text_of
from fieldscribe.diagnostics import Report
from fieldscribe.families.can.dbc import export
from fieldscribe.importing import compilable
from fieldscribe.importing.dbc import DbcDraft
from fieldscribe.importing.draft_text import Document, Head
from fieldscribe.importing.tables import UnreadableError
from fieldscribe.pipeline import load_device

from corpus.collection import Collection, Drafted

FRAMES = 20


def _files(folder: Path) -> list[Path]:
    return sorted(folder.rglob("*.dbc"))


def _draft(file: Path) -> Drafted | None:
    """None for what cantools does not read, and for files without signals."""
    text = text_of(file.read_bytes())
    try:
        database = database_of(text)
    except UnreadableError:
        return None
    drafted = DbcDraft(database, text)
    if not drafted.groups:
        return None
    document = Document(file.name, "ab" * 32, "database")
    head = Head("device", [document], "can", facts=drafted.head(), kind="a CAN database", bus=drafted.bus())
    compiled = compilable(drafted.groups, head, with_head=True)
    different = _different(database, compiled)
    if different:
        raise ValueError(f"frames of {len(different)} messages mean something else: {', '.join(different[:5])}")
    return Drafted(drafted.groups, head)


def _different(database: Any, compiled: str) -> list[str]:
    """The messages whose random frames have other values in the database of the device."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "device.yaml")
        path.write_text(compiled, "utf-8")
        device = load_device(path, Report())
    assert device is not None
    again = database_of(export(device).decode("latin-1"))
    others = {(one.frame_id, one.is_extended_frame): one for one in again.messages}
    return [
        message.name
        for message in database.messages
        if message.signals and not _same(message, others.get((message.frame_id, message.is_extended_frame)))
    ]


def _same(message: Any, other: Any) -> bool:
    chance = random.Random(message.name)
    frames = [chance.randbytes(message.length) for _ in range(FRAMES)]
    return other is not None and all(_values(message, data) == _values(other, data) for data in frames)


def _values(message: Any, data: bytes) -> list[str]:
    """The values in the order of their numbers, for names differ."""
    try:
        values = message.decode(data, decode_choices=False).values()
    except Exception as error:
        return [type(error).__name__]
    return sorted(repr(float(value)) for value in values)


DBC = Collection("dbc", _files, _draft)
