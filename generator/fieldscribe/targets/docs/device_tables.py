"""The tables of a device other than those of points and bus, in the form of a page."""

from collections.abc import Mapping

from fieldscribe import wording
from fieldscribe.grouping import grouped
from fieldscribe.model import Base, Device, Document, Erratum, Found, Frame, Identification, Named, Point
from fieldscribe.targets.docs.cells import Columns, Form
from fieldscribe.targets.docs.scope import DocsScope, place_text
from fieldscribe.targets.docs.tables import items_of
from fieldscribe.text import counted
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.frames import spaced


def facts(device: Device, form: Form) -> list[tuple[str, str]]:
    """Return label and text of each fact of the whole device."""
    generated = sum(point.generated for point in device.points)
    rows = [
        ("Device", form.code(device.id)),
        ("Version of the description", form.cell(device.version)),
        ("Family", form.cell(device.family)),
        ("Points", f"{len(device.points)}, {generated} of them generated"),
        ("Errata of the manual", str(len(device.errata))),
    ]
    rows += [
        (form.cell(f"Variants by {axis}"), form.cell(", ".join(values))) for axis, values in device.variants.items()
    ]
    return rows


def documents(device: Device, form: Form) -> str:
    """Return the table of the manuals."""
    columns: Columns[Document] = {
        "Document": lambda document: form.code(document.id),
        "Title": lambda document: form.cell(document.title),
        "Language": lambda document: form.cell(document.language),
        "File": lambda document: form.cell(document.file or ""),
        "SHA-256": lambda document: form.code(document.sha256) if document.sha256 else "",
    }
    return form.table(device.documents, columns)


def identifications(scope: DocsScope, form: Form) -> str:
    """Return the table of what identifies the device and its variants."""
    columns: Columns[Identification] = {
        "Of": lambda identification: form.cell(str(identification.variant or "the device")),
        "Point": lambda identification: form.narrow_link("point", identification.point),
        "Holds": lambda identification: form.lines(
            *(_meaning_of(scope.by_name[identification.point], raw, form) for raw in identification.raws),
            *map(form.code, identification.texts),
        ),
    }
    return form.table(scope.device.identifications, columns, always=columns)


def bases(device: Device, form: Form) -> str:
    """Return the table of the bases of addresses, with the numbers that a client is given."""
    given = {each.name: each for each in device.given}
    columns: Columns[Base] = {
        "Base": lambda base: form.cell(wording.base_text(base)),
        "Given": lambda base: form.lines(
            *(
                form.cell(f"{name}: {given[name].low}..{given[name].high}, {wording.title_text(given[name].title)}")
                for name, _ in base.terms
            )
        ),
        "Groups": lambda base: ", ".join(
            form.link("group", name)
            for name in dict.fromkeys(point.group for point in device.points if point.base == base.name)
        ),
    }
    return form.table(device.bases, columns, always=("Base", "Groups"))


def found(chain: Found, form: Form) -> str:
    """Return how to find the blocks."""
    places = ", ".join(map(wording.address_text, chain.places))
    return form.cell(
        f"{wording.title_text(chain.title)}: read {counted(len(chain.words), 'word')} of the space {chain.space} at "
        f"{places}, until the text there is {chain.marker}. Behind it stands the first block. A block starts with its "
        f"id and its length, the number of words behind these two; then comes the next block. The id "
        f"{hex_text(chain.end)} ends the chain. Addresses in a block count from its id."
    )


def frames(scope: DocsScope, form: Form) -> str:
    """Return the table of the frames that the manual prints."""
    columns: Columns[Frame] = {
        "Frame": lambda frame: form.lines(form.target("frame", frame.name), form.cell(wording.title_text(frame.title))),
        "Kind": lambda frame: form.lines(
            form.cell(f"{frame.framing} {frame.direction}"),
            f"answers {form.link('frame', frame.answers)}" if frame.answers else "",
        ),
        "Bytes": lambda frame: form.lines(
            form.code(spaced(frame.printed)), "" if frame.valid else f"correct: {form.code(spaced(frame.corrected))}"
        ),
        "Meaning": lambda frame: form.lines(
            *(_meaning(name, raw, scope.by_name, form) for name, raw in frame.meaning.items())
        ),
        "Errata": lambda frame: form.lines(*(form.link("erratum", erratum) for erratum in frame.errata)),
        "Source": lambda frame: form.source_cell(frame.source, scope.several),
    }
    return form.table(scope.device.frames, columns, always=columns)


def _meaning(name: str, raw: int, by_name: Mapping[str, Point], form: Form) -> str:
    return f"{form.code(name)} = {_meaning_of(by_name.get(name), raw, form)}"


def _meaning_of(point: Point | None, raw: int, form: Form) -> str:
    meaning = wording.meaning_text(point, raw) if point else ""
    return f"{raw} ({form.cell(meaning)})" if meaning else str(raw)


def errata(device: Device, form: Form) -> str:
    """Return the table of the errata."""
    items = items_of(device)
    columns: Columns[Erratum] = {
        "Erratum, about": lambda erratum: form.lines(
            form.narrow_target("erratum", erratum.id),
            *(form.narrow_link("point", item) for name in erratum.points for item in items.get(name, ())),
            _where(erratum, form),
        ),
        "Printed": lambda erratum: form.cell(erratum.printed),
        "Taken": lambda erratum: form.cell(erratum.taken),
        "Why": lambda erratum: form.cell(erratum.why),
        "Certainty": lambda erratum: form.cell(_certainty(erratum)),
        "Source": lambda erratum: form.source_cell(erratum.source, len(device.documents) > 1),
    }
    return form.table(device.errata, columns, always=columns)


def _certainty(erratum: Erratum) -> str:
    doubts = ", ".join(text for _, text in erratum.leaves_open)
    return f"{erratum.certainty}: the manual leaves open {doubts}" if doubts else erratum.certainty


def _where(erratum: Erratum, form: Form) -> str:
    """Return the subject of an erratum without points: a frame, a function, or a place in words."""
    match erratum.where:
        case Named("frame", str() as name):
            return f"frame {form.link('frame', name)}"
        case Named("function", int() as number):
            return f"function {hex_text(number, 2)}"
    return form.cell(str(erratum.where))


def missing(device: Device, form: Form) -> str:
    """Return the table of points that are only documented."""
    columns: Columns[Point] = {
        "Code": lambda point: form.cell(point.code or ""),
        "Name": lambda point: form.lines(form.link("point", point.item), form.cell(wording.title_text(point.title))),
        "Wire address": lambda point: place_text(point, form),
        "Why": lambda point: form.cell(point.reason or "no reason given"),
        "Errata": lambda point: ", ".join(form.link("erratum", erratum) for erratum in point.errata),
    }
    return form.table([point for point in device.points if not point.generated], columns)


def codes(device: Device, form: Form) -> str:
    """Return the table of special codes that points share, by the type, group or format that declares them."""
    sharing = grouped((point.specials_of, point) for point in device.points if point.shape.specials_of)
    rows = []
    for name, points in sharing.items():
        sharers = f"{form.target('codes', name)}: {counted(len(points), 'point')} of type {points[0].shape.wire_type}"
        for special in points[0].specials:
            if special.shared:
                numbers = wording.special_numbers(special, points[0].width)
                title, remarks = wording.title_text(special.title), wording.special_remarks(special)
                rows.append((sharers, numbers, form.code(special.name), form.cell(title), form.cell(remarks)))
                sharers = ""
    return form.by_rows(("Codes of", "Raw", "Name", "Title", "Remarks"), rows)
