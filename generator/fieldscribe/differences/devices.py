"""The facts of a device, and of all its things that are no points, with their classes."""

from __future__ import annotations

from functools import cache, partial
from operator import itemgetter
from typing import TYPE_CHECKING

from fieldscribe.differences.classes import API, BEHAVIOUR, DOCS, WIRE
from fieldscribe.differences.points import ALIKE, NOTE, POINT, SOURCE, TITLE, grown, in_code, items
from fieldscribe.differences.table import Exported, Fact, Parts, said
from fieldscribe.families import family
from fieldscribe.wording.lines import without_lines

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.differences.table import Table, Weight


def _listed(key: str, device: Exported, name: str = "name") -> Iterator[Exported]:
    """The things under a key by their names."""
    return ({**thing, "name": str(thing[name])} for thing in device[key])


def _axes(device: Exported) -> Iterator[Exported]:
    return ({"name": axis, "values": values} for axis, values in device["variants"].items())


def _codes(section: str, device: Exported) -> Iterator[Exported]:
    """The numbered codes of a section; only functions have a largest count."""
    most = device["limits"]["most"] if section == "functions" else {}
    for number, code in device["codes"][section].items():
        yield {**code, "number": int(number), "most": most.get(number)}


def _groups(device: Exported) -> Iterator[Exported]:
    """The groups, each with the names of its points."""
    members: dict[str, list[str]] = {}
    for point in items(device):
        members.setdefault(point["group"], []).append(point["name"])
    return ({**group, "points": members.get(group["name"], [])} for group in device["groups"])


def _errata(device: Exported) -> Iterator[Exported]:
    """The errata by their ids, each with the list of its points."""
    for erratum in device["errata"]:
        points = erratum["point"]
        yield {**erratum, "name": erratum["id"], "point": [points] if isinstance(points, str) else points or []}


def _erratum_in_short(erratum: Exported) -> Exported:
    return {"points": erratum["point"], **{key: erratum[key] for key in ("where", "printed", "taken") if erratum[key]}}


def _sentence(old: str, new: str) -> str:
    """The class of a sentence: the lines of the manual that it names are for people."""
    return DOCS if without_lines(old) == without_lines(new) else BEHAVIOUR


def _limit(key: str, weight: Weight) -> Fact:
    return Fact(weight, lambda device: device["limits"][key], (f"limits.{key}",))


_SECTION: Table = {"title": TITLE, "note": NOTE, "source": SOURCE}
_COMMAND: Table = {
    "space": said("space", WIRE),
    "address": said("address", WIRE),
    "function": said("function", WIRE),
    "value": said("value", WIRE),
    "wears": said("wears", BEHAVIOUR),
    "busy": said("busy", BEHAVIOUR, refers="point"),
    **_SECTION,
}
_MESSAGE: Table = {
    "identifier": said("identifier", WIRE),
    "adds the unit": said("adds_unit", WIRE),
    "layout": said("layout", WIRE),
    "direction": said("direction", WIRE),
    "answers": said("answers", WIRE, refers="message"),
    "title": TITLE,
    "source": SOURCE,
}
_TELEGRAM: Table = {
    "direction": said("direction", WIRE),
    "words": said("words", WIRE),
    "message": said("message", WIRE, refers="message"),
    "title": TITLE,
    "source": SOURCE,
}
_FRAME: Table = {
    **{key: said(key, DOCS) for key in ("framing", "bytes", "corrected", "direction", "valid", "errata")},
    "meaning": said("meaning", DOCS, refers="point"),
    "answers": said("answers", DOCS, refers="frame"),
    "title": TITLE,
    "source": SOURCE,
}
_CODE: Table = {
    "number": said("number", WIRE),
    "max": Fact(BEHAVIOUR, itemgetter("most"), ("most",)),
    "broadcast": said("broadcast", BEHAVIOUR),
    "answers": said("answers", WIRE),
    "refusals": said("refusals", BEHAVIOUR),
    "title": TITLE,
}
_ERRATUM: Table = {
    "points": said("point", BEHAVIOUR, refers="point"),
    "printed": said("printed", _sentence),
    "taken": said("taken", _sentence),
    "certainty": said("certainty", BEHAVIOUR),
    "where": said("where", DOCS),
    "reason": said("reason", DOCS),
    "source": SOURCE,
}
_DOCUMENT: Table = {key: said(key, DOCS) for key in ("title", "language", "file", "sha256")}


def _kind(kind: str, key: str, facts: Table, *alike: str) -> Parts:
    return Parts(kind, partial(_listed, key), facts, (key,), alike)


def _alike_in_class(parts: Parts, weight: str) -> Parts:
    """Parts of which all that comes, goes or is called otherwise is of one class."""
    return parts._replace(added=weight, removed=weight, renamed=weight)


_OF_ALL: Table = {
    "family": said("family", WIRE),
    "vendor": said("vendor", DOCS),
    "model": said("model", DOCS),
    "title": TITLE,
    "note": NOTE,
    "variant": Parts("variant", _axes, {"values": said("values", grown)}, ("variants",), added=API),
    "framings": _limit("framings", grown),
    "units": _limit("units", BEHAVIOUR),
    "broadcast": _limit("broadcast", WIRE),
    "gaps": _limit("gaps", BEHAVIOUR),
    "timing": _limit("timing", DOCS),
    "note of the bus": _limit("note", DOCS),
    "serial": Fact(BEHAVIOUR, lambda device: device["codes"]["serial"], ("codes.serial",)),
    "group": Parts("group", _groups, _SECTION, ("groups",), (Fact(API, itemgetter("points"), ()),)),
    "point": Parts("point", items, POINT, ("points",), ALIKE, in_code=in_code),
    "command": _kind("command", "commands", _COMMAND, "space", "address", "function", "value"),
    "message": _kind("message", "messages", _MESSAGE, "identifier", "direction", "layout"),
    "telegram": _kind("telegram", "telegrams", _TELEGRAM, "direction", "words", "message"),
    "erratum": _alike_in_class(Parts("erratum", _errata, _ERRATUM, ("errata",), shown=_erratum_in_short), BEHAVIOUR),
    "document": _alike_in_class(
        Parts("document", partial(_listed, "documents", name="id"), _DOCUMENT, ("documents",)), DOCS
    ),
}

DEVICE_FOLLOWS = {
    "format": "is the number of the contract",
    "device": "tells the device",
    "version": "is what the differences ask to change",
}
"""Keys of the contract that say nothing of their own, and why."""

_SECTIONS = {"functions": "function", "exceptions": "exception", "responses": "response"}


@cache
def table_of(family_name: str) -> Table:
    """The facts of a device of that family, those that only its family has among them."""
    part = family(family_name).part("bus_facts")
    limits: dict[str, str] = getattr(part, "LIMIT_CLASSES", {})
    frame: dict[str, str] = getattr(part, "FRAME_CLASSES", {})
    emitted = {codes.section for codes in family(family_name).codes if codes.emitted}
    own_frame: Table = {**_FRAME, **{key: said(key, weight) for key, weight in frame.items()}}
    return {
        **_OF_ALL,
        "frame": _alike_in_class(_kind("frame", "frames", own_frame, "bytes"), DOCS),
        **{kind: _numbered(kind, section, section in emitted) for section, kind in _SECTIONS.items()},
        **{key: _limit(key, weight) for key, weight in limits.items()},
    }


def _numbered(kind: str, section: str, emitted: bool) -> Parts:
    """Numbered codes; those that generated code has no names for break no code."""
    parts = Parts(kind, partial(_codes, section), _CODE, (f"codes.{section}",), ("number",))
    return parts if emitted else parts._replace(added=BEHAVIOUR, removed=BEHAVIOUR, renamed=DOCS)
