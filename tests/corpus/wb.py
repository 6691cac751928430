"""Device templates of wb-mqtt-serial: those that speak Modbus and are not deprecated."""

from __future__ import annotations

from pathlib import Path

from fieldscribe.importing.tables import UnreadableError
from fieldscribe.importing.wb import draft
from fieldscribe.importing.wb.templates import read_template

from corpus.collection import Collection, Drafted


def _files(folder: Path) -> list[Path]:
    return sorted(file for file in folder.rglob("config-*") if file.name.endswith((".json", ".json.jinja")))


def _draft(file: Path) -> Drafted | None:
    try:
        template = read_template(file)
    except UnreadableError as error:
        if "the protocol is" in error.message:
            return None
        raise
    if template.get("deprecated") or template["device"].get("deprecated"):
        return None
    drafted = draft(file, "device")
    return Drafted(drafted.groups, drafted.head)


WB = Collection("wb", _files, _draft)
