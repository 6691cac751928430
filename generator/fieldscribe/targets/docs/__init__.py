"""The documentation target: a Markdown reference, a table of the points and a table of the special codes (CSV)."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from fieldscribe.model import Device
    from fieldscribe.render import Render
    from fieldscribe.targets.identifiers import Names

FOR_PEOPLE = True

NEEDS_FAMILY = False
KEEPS_NAMES = True


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """The files for one device: path relative to the output folder, and text."""
    from fieldscribe.targets.docs.page import page_of
    from fieldscribe.targets.docs.sheet import sheet_of
    from fieldscribe.targets.docs.special_codes import sheet_of_codes
    from fieldscribe.targets.docs.subjects import scope_of

    scope = scope_of(device)
    yield f"docs/{device.id}.md", render("docs/device.md.j2", {"page": page_of(scope)}).rstrip("\n") + "\n"
    yield f"docs/{device.id}.csv", sheet_of(scope)
    if codes := sheet_of_codes(device):
        yield f"docs/{device.id}_special_codes.csv", codes


def runtime(device: Device) -> Iterable[tuple[str, str]]:
    """Documentation needs no runtime."""
    del device
    return ()


def identifiers(device: Device) -> Iterable[Names]:
    """Pages have no identifiers that could clash."""
    del device
    return ()


def device_name_taken(name: str) -> str:
    """A page may have any name."""
    del name
    return ""
