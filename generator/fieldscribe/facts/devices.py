"""The facts of a device and of its things other than points."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cache, partial
from operator import itemgetter
from typing import Any, TypeAlias

from fieldscribe.facts.point_values import grown, items
from fieldscribe.facts.points import ERRATA, NAME, NOTE, POINTS, SOURCE, TITLE
from fieldscribe.facts.schema import (
    ADDRESS,
    BOOLEAN,
    COUNT,
    DIRECTION,
    INTEGER,
    INTEGER_OR_NULL,
    STRING,
    TEXT_OR_NULL,
    TEXTS,
    TITLES,
    by_number,
    list_of,
    map_of,
    null_or,
    one_of,
    ref,
)
from fieldscribe.facts.steps import STEPPED_COMMANDS
from fieldscribe.facts.table import API, BEHAVIOUR, DOCS, WIRE, Context, Exported, Fact, FactTable, Parts, View
from fieldscribe.families import Family, families, family
from fieldscribe.model import Bus, Code, Erratum
from fieldscribe.wording import without_lines

Listed: TypeAlias = Callable[[Exported], Iterable[Exported]]

FORMAT = 7
"""The version of the exported shape."""
_HEX = {**STRING, "pattern": "^([0-9A-F]{2}( [0-9A-F]{2})*)?$"}


# What `diff` compares of the parts of a device.


def _named(key: str, device: Exported, name: str = "name") -> Iterator[Exported]:
    """Yield the things under a key, each with its name."""
    return ({**thing, "name": str(thing[name])} for thing in device[key])


def _axes(device: Exported) -> Iterator[Exported]:
    return ({"name": axis, "values": values} for axis, values in device["variants"].items())


def _numbered(section: str, device: Exported) -> Iterator[Exported]:
    """Yield the numbered codes of a section; only functions have a largest count."""
    most = device["limits"]["most"] if section == "functions" else {}
    for number, code in device["codes"][section].items():
        yield {**code, "number": int(number), "most": most.get(number)}


def _groups(device: Exported) -> Iterator[Exported]:
    """Yield the groups, each with the names of its points."""
    members: dict[str, list[str]] = {}
    for point in items(device):
        members.setdefault(point["group"], []).append(point["name"])
    return ({**group, "points": members.get(group["name"], [])} for group in device["groups"])


def _errata(device: Exported) -> Iterator[Exported]:
    """Yield the errata, named by their ids, each with the list of its points."""
    for erratum in device["errata"]:
        points = erratum["point"]
        yield {**erratum, "name": erratum["id"], "point": [points] if isinstance(points, str) else points or []}


def _identifications(device: Exported) -> Iterator[Exported]:
    """Yield what identifies the device, named by variant and point."""
    for identification in device["identifications"]:
        yield {**identification, "name": f"{identification['variant'] or device['device']}: {identification['point']}"}


def _found(device: Exported) -> Iterator[Exported]:
    """Yield the chain of blocks, if there is one."""
    return iter([device["found"]] if device["found"] else ())


def _open(erratum: Erratum, _: object) -> Mapping[str, str]:
    return dict(erratum.leaves_open)


def _erratum_in_short(erratum: Exported) -> Exported:
    return {"points": erratum["point"], **{key: erratum[key] for key in ("where", "printed", "taken") if erratum[key]}}


def _sentence(old: str, new: str) -> str:
    """Return the class of a changed sentence: another line number in it is only for people."""
    return DOCS if without_lines(old) == without_lines(new) else BEHAVIOUR


def _list(key: str, doc: str, parts: Parts) -> Fact:
    """Return a fact that is a list of things, with their parts for `diff`."""
    return Fact(key, doc, list_of(ref(parts.kind)), table=parts.table, views=(parts,))


def _parts(kind: str, table: FactTable, *same_by: str | View, listed: Listed | None = None, change: str = "") -> Parts:
    """Return things of a kind for `diff`; with `change`, added, removed and renamed ones are of that class."""
    parts = Parts(kind, kind, listed or partial(_named, f"{kind}s"), table, same_by=same_by)
    return replace(parts, added=change, removed=change, renamed=change) if change else parts


# The tables.

DOCUMENT: FactTable = (
    Fact("id", "The id by which sources cite it.", STRING),
    Fact("title", "Its title.", STRING, DOCS),
    Fact("language", "The language it is written in.", STRING, DOCS),
    Fact("file", "The name of the file that was read.", TEXT_OR_NULL, DOCS),
    Fact("sha256", "The SHA-256 of that file.", TEXT_OR_NULL, DOCS),
)
GROUP: FactTable = (NAME, TITLE, NOTE, SOURCE)
COMMAND: FactTable = (
    NAME,
    TITLE,
    NOTE,
    Fact("space", "The space of its address.", STRING, WIRE),
    Fact("address", "The address on the wire.", ADDRESS, WIRE),
    Fact("function", "The function to write with.", INTEGER, WIRE),
    Fact("value", "The value to write; null if any value will do.", INTEGER_OR_NULL, WIRE),
    Fact("wears", "How many such writes the memory survives.", INTEGER_OR_NULL, BEHAVIOUR),
    Fact("busy", "The point that says that the command is still running.", TEXT_OR_NULL, BEHAVIOUR, refers="point"),
    SOURCE,
)
IDENTIFICATION: FactTable = (
    Fact("variant", "The variant that it identifies: `axis=value`; null: the device.", TEXT_OR_NULL, BEHAVIOUR).of(
        lambda identification, _: None if identification.variant is None else str(identification.variant)
    ),
    Fact("point", "The point to read.", STRING, BEHAVIOUR, refers="point"),
    Fact("raws", "The raw numbers, one of which it holds.", list_of(INTEGER), BEHAVIOUR),
    Fact("texts", "The texts, one of which it holds.", TEXTS, BEHAVIOUR),
)
GIVEN: FactTable = (
    NAME,
    TITLE,
    Fact("low", "The least number.", INTEGER, BEHAVIOUR),
    Fact("high", "The greatest number.", INTEGER, BEHAVIOUR),
)
FOUND: FactTable = (
    NAME,
    TITLE,
    Fact("space", "The space of the blocks.", STRING, WIRE),
    Fact("marker", "The text before the first block, two characters a word.", STRING, WIRE),
    Fact("places", "The addresses where it may be, in the order of the search.", list_of(ADDRESS), WIRE),
    Fact("end", "The id that ends the chain.", INTEGER, WIRE),
)
BASE: FactTable = (
    NAME,
    Fact("formula", "The formula as the author wrote it.", STRING, DOCS),
    Fact("offset", "What is added to the multiples, or to the start of the block.", INTEGER, WIRE),
    Fact("terms", "The factors of given numbers.", map_of(INTEGER), WIRE, value=lambda base, _: dict(base.terms)),
    Fact("block", "The id of the found block; null: no block.", INTEGER_OR_NULL, WIRE),
    Fact("counts", "The factors of points of the block.", map_of(INTEGER), WIRE).of(
        lambda base, _: {name: factor for name, _, factor in base.counts}
    ),
)
_SENDER = Fact(
    "direction",
    "Who sends it: `request` the master, `response` the device when asked, `cyclic` the device by itself.",
    DIRECTION,
    WIRE,
)
MESSAGE: FactTable = (
    NAME,
    TITLE,
    _SENDER,
    Fact("answers", "The message that it answers.", TEXT_OR_NULL, WIRE, refers="message"),
    Fact("identifier", "The identifier.", ADDRESS, WIRE),
    Fact("adds_unit", "Whether the unit number is added to the identifier.", BOOLEAN).differs(
        View("adds the unit", WIRE, itemgetter("adds_unit"))
    ),
    Fact("layout", "What each byte holds.", list_of(ref("role"), 0, 8), WIRE).of(
        lambda message, _: [{"holds": role.kind, "number": role.number} for role in message.roles]
    ),
    Fact("length", "With signals: the number of bytes; null for a layout of 8.", INTEGER_OR_NULL, WIRE).of(
        lambda message, _: None if message.roles else message.length
    ),
    Fact("bits", "The bits of its identifier, if they are not those of the bus.", INTEGER_OR_NULL, WIRE),
    Fact("every", "How often it is sent, in milliseconds.", INTEGER_OR_NULL, BEHAVIOUR),
    SOURCE,
)
TELEGRAM: FactTable = (
    NAME,
    TITLE,
    _SENDER,
    Fact("words", "How many words it has.", COUNT, WIRE),
    Fact("message", "The message whose frames carry the words.", TEXT_OR_NULL, WIRE, refers="message"),
    SOURCE,
)
_FRAME: FactTable = (
    NAME,
    Fact("framing", "How its bytes are framed: `rtu`, `tcp`, ...", STRING, DOCS),
    TITLE,
    Fact("bytes", "The bytes as printed, in hexadecimal with spaces.", _HEX, DOCS).of(
        lambda frame, _: frame.printed.hex(" ").upper()
    ),
    Fact("corrected", "The bytes as they should read; those that are printed unless it is misprinted.", _HEX, DOCS).of(
        lambda frame, _: frame.corrected.hex(" ").upper()
    ),
    Fact("direction", "`request`, `response` or `cyclic`.", STRING, DOCS),
    Fact("answers", "The request that a response answers.", TEXT_OR_NULL, DOCS, refers="frame"),
    Fact("meaning", "Raw numbers by point name.", map_of(INTEGER), DOCS, refers="point", yaml=("says", "with")),
    Fact("valid", "False when the frame is misprinted.", BOOLEAN, DOCS),
)
_MEMBERS = View("points", API, itemgetter("points"))
_CODE_VIEWS = (
    View("number", WIRE, itemgetter("number")),
    View("max", BEHAVIOUR, itemgetter("most"), yaml=("functions",)),
)
CODE: FactTable = (
    NAME,
    TITLE,
    Fact(
        "broadcast",
        "Whether it may be sent to all units at once; null: as the protocol says.",
        null_or(BOOLEAN),
        BEHAVIOUR,
    ),
    Fact(
        "answers",
        "USS: of a task the responses that it can get, of a response or an error the tasks.",
        list_of(INTEGER),
        WIRE,
    ),
    Fact("refusals", "USS: of a task the responses that refuse it.", list_of(INTEGER), BEHAVIOUR),
)
ERRATUM: FactTable = (
    Fact("id", "Its name, never reused.", STRING),
    Fact(
        "point",
        "The point it is about; a list for several; null for none.",
        {"anyOf": [STRING, list_of(STRING, 2), {"type": "null"}]},
    )
    .differs(View("points", BEHAVIOUR, itemgetter("point"), refers="point", yaml=("point", "points")))
    .of(lambda erratum, _: erratum.points[0] if len(erratum.points) == 1 else list(erratum.points) or None),
    Fact("where", "The place, in words.", STRING, DOCS, value=lambda erratum, _: str(erratum.where)),
    SOURCE,
    Fact("printed", "What is printed.", STRING, _sentence),
    Fact("taken", "What this description takes instead.", STRING, _sentence),
    Fact("facts", "The printed facts by their keys.", map_of(STRING), published=False),
    Fact("reason", "Why.", STRING, DOCS, attribute="why", yaml=("why",)),
    Fact("certainty", "How sure that is.", one_of("certain", "likely", "unknown"), BEHAVIOUR),
    Fact("leaves_open", "What the manual leaves open, by the key of the fact.", map_of(STRING), DOCS, value=_open),
)
_LIMITS: FactTable = (
    Fact("framings", "The framings that the device speaks: `rtu`, `tcp`.", TEXTS, grown),
    Fact("units", "The lowest and the highest unit number.", list_of(INTEGER, 2, 2), BEHAVIOUR),
    Fact("broadcast", "The unit number of a broadcast; null when there is none.", INTEGER_OR_NULL, WIRE),
    Fact("most", "The most items in one request, by function number as decimal text.", by_number(COUNT)).of(
        lambda bus, _: {str(code.number): code.most for code in bus.functions if code.most is not None}
    ),
    Fact(
        "gaps",
        "Address ranges that no request may cross, by space: the first and the last address of each.",
        map_of(list_of(list_of(INTEGER, 2, 2))),
        BEHAVIOUR,
    ).of(lambda bus, _: {space: [list(gap) for gap in gaps] for space, gaps in bus.gaps.items()}),
    Fact("timing", "Times of the line, by name, as the manual says them.", map_of(STRING), BEHAVIOUR),
    Fact("note", "A remark for people; empty without one.", TITLES, DOCS, for_people=True),
)


@cache
def _with_family_facts(kind: str, table: FactTable, own_family: str) -> FactTable:
    """Return the table with the facts that families add; those of other families are empty."""
    facts = {fact.key: replace(fact, **_FOREIGN) for each in families() for fact in _offered(each, kind)}
    facts |= {fact.key: fact for fact in _offered(family(own_family), kind)}
    return (*table, *facts.values())


def _offered(of_family: Family, kind: str) -> FactTable:
    table: FactTable = getattr(of_family.part("bus_facts"), kind, ())
    return table


_FOREIGN: Mapping[str, Any] = {"derived": "it is a fact of another family", "weight": "", "views": ()}


def limits_table(own_family: str) -> FactTable:
    """Return the facts of the bus of a device of that family."""
    return _with_family_facts("LIMITS", _LIMITS, own_family)


def frame_table(own_family: str) -> FactTable:
    """Return the facts of worked examples of that family."""
    return (*_with_family_facts("FRAME", _FRAME, own_family), SOURCE, ERRATA)


_SECTIONS = {
    "exceptions": ("exception", "Exceptions"),
    "functions": ("function", "Functions"),
    "responses": ("response", "Responses of USS"),
}


@cache
def codes_table(own_family: str) -> FactTable:
    """Return the numbered codes by section; a change of codes without names in generated code breaks no code."""
    emitted = {codes.section for codes in family(own_family).codes if codes.emitted}
    sections = []
    for section, (kind, what) in _SECTIONS.items():
        parts = Parts(kind, kind, partial(_numbered, section), CODE, _CODE_VIEWS, same_by=("number",))
        if section not in emitted:
            parts = replace(parts, added=BEHAVIOUR, removed=BEHAVIOUR, renamed=DOCS)
        sections.append(
            Fact(section, f"{what}, by number as decimal text.", by_number(ref("code")), table=CODE, views=(parts,)).of(
                partial(_codes_of, section)
            )
        )
    serial = (
        Fact("serial", "Codes of serial settings, by setting: what each code means.", map_of(map_of(STRING)))
        .differs(View("serial", BEHAVIOUR, lambda device: device["codes"]["serial"]))
        .of(lambda bus, _: {setting: dict(codes) for setting, codes in bus.serial.items()})
    )
    return (*sections, serial)


def _codes_of(section: str, bus: Bus, _: Context) -> dict[str, Code]:
    return {str(code.number): code for code in bus.codes(section)}


@cache
def device_table(own_family: str) -> FactTable:
    """Return the facts of a device of that family."""
    limits, frame = limits_table(own_family), frame_table(own_family)
    codes = codes_table(own_family)
    errata = replace(_parts("erratum", ERRATUM, listed=_errata, change=BEHAVIOUR), summary=_erratum_in_short)
    return (
        Fact(
            "format",
            "The number of this contract.",
            {**INTEGER, "const": FORMAT},
            derived="it is the number of the contract",
        ).of(lambda _device, _: FORMAT),
        Fact("device", "The id of the device.", STRING, attribute="id"),
        Fact("version", "The version of its description.", STRING),
        Fact("family", "The rules of addressing and framing.", STRING, WIRE),
        Fact("vendor", "Who makes it.", STRING, DOCS),
        Fact("model", "The maker's name of the product.", STRING, DOCS),
        TITLE,
        NOTE,
        _list(
            "documents",
            "The manuals.",
            _parts("document", DOCUMENT, listed=partial(_named, "documents", name="id"), change=DOCS),
        ),
        Fact("variants", "The values of each variant axis.", map_of(TEXTS))
        .differs(Parts("variant", "variant", _axes, (), (View("values", grown, itemgetter("values")),), added=API))
        .of(lambda device, _: {axis: list(values) for axis, values in device.variants.items()}),
        Fact(
            "limits",
            "The limits of the bus.",
            ref("limits"),
            attribute="bus",
            table=limits,
            views=tuple(_inside("limits", view) for fact in limits for view in fact.compared()),
        ),
        _list(
            "groups", "The groups of points, in the author's order.", _parts("group", GROUP, _MEMBERS, listed=_groups)
        ),
        _list("points", "All points, in the author's order.", POINTS),
        _list(
            "commands", "Named constant writes.", _parts("command", COMMAND, "space", "address", "function", "value")
        ),
        STEPPED_COMMANDS,
        _list(
            "identifications",
            "What identifies the device and its variants, in the order of reading.",
            _parts("identification", IDENTIFICATION, listed=_identifications, change=BEHAVIOUR),
        ),
        _list("given", "Numbers that a client is given.", _parts("given", GIVEN, listed=partial(_named, "given"))),
        Fact(
            "found", "The chain of blocks that a client searches for; null: none.", null_or(ref("found")), table=FOUND
        ).differs(Parts("found", "found", _found, FOUND, added=WIRE, removed=WIRE)),
        _list("bases", "The bases of addresses that do not count from 0.", _parts("base", BASE, "formula")),
        _list(
            "messages", "Layouts of frames.", _parts("message", MESSAGE, "identifier", "bits", "direction", "layout")
        ),
        _list("telegrams", "Cyclic layouts of words.", _parts("telegram", TELEGRAM, "direction", "words", "message")),
        _list("frames", "The worked frames of the manual.", _parts("frame", frame, "bytes", change=DOCS)),
        Fact(
            "codes",
            "Numbers of the protocol.",
            ref("codes"),
            attribute="bus",
            table=codes,
            views=tuple(view for fact in codes for view in fact.views),
        ),
        _list("errata", "Where the manual is wrong, unclear or silent.", errata),
    )


def _inside(key: str, view: View | Parts) -> View:
    """Turn a view of an object into a view of the device that has the object under that key."""
    assert isinstance(view, View)
    return view._replace(label=_BUS_LABELS.get(view.label, view.label), value=lambda device: view.value(device[key]))


_BUS_LABELS = {"note": "note of the bus"}
