"""Drafts a description from a device template of Wiren Board's gateway: `import wb`.

`templates` reads the file, `rows` its channels and parameters, `conditions` says when they exist, `heads` has what
concerns the whole device, and `folding` writes repeats as one row. What is not carried is a question in the draft.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

from fieldscribe.importing import compilable
from fieldscribe.importing.draft_text import Document, DraftGroup, Head, Names, snake
from fieldscribe.importing.readers import MOST_ROWS, UnreadableError
from fieldscribe.importing.wb.folding import folded
from fieldscribe.importing.wb.heads import FAMILY, base_of, blocks_of, bus_of, first_firmware, identification
from fieldscribe.importing.wb.parameters import Parameters
from fieldscribe.importing.wb.rows import Row, components_of
from fieldscribe.importing.wb.templates import MOST_BYTES, Texts, labels_text, objects, read_template
from fieldscribe.safe_files import read_regular


class Draft(NamedTuple):
    """The groups and the head of a drafted device."""

    groups: list[DraftGroup]
    head: Head

    @property
    def not_carried(self) -> Counter[str]:
        """How many facts are questions, by their keys."""
        texts = [text for group in self.groups for text in group.comments]
        texts += [text for group in self.groups for point in group.points for text in point.questions]
        texts += [text for block in self.head.blocks for text in block.questions]
        return Counter(text.removeprefix("not carried: ").partition(":")[0] for text in texts)


def draft(path: Path, device: str) -> Draft:
    """Draft a device from a template. Raises UnreadableError, OSError."""
    template = read_template(path)
    body = template["device"]
    texts = Texts(body.get("translations"))
    rows = list(_rows(body, texts))
    if not 0 < len(rows) <= MOST_ROWS:
        raise UnreadableError(
            f"the template has {len(rows)} channels and parameters", hint=f"1 to {MOST_ROWS} are read"
        )
    for row in rows:
        row.read()
    names, parameters = Names(), Parameters(rows, texts)
    for row in rows:
        title = row.key if row.is_parameter and row.key else row.point.title
        row.point.name = names.give(snake(title, "point"), "" if row.point.wire is None else str(row.point.wire))
    for row in rows:
        if row.labels:
            row.point.facts["enum"] = labels_text(row.labels, texts)
        parameters.set_condition(row)
    groups = _groups(body, [row for row in rows if not row.is_choice], texts)
    groups += identification(template, names)
    for group in groups:
        group.facts |= base_of(body) | first_firmware(template)
    title = texts.english(str(template.get("title") or body.get("name") or template.get("device_type", device)))
    checksum = sha256(read_regular(path, MOST_BYTES).data).hexdigest()
    head = Head(
        device,
        [Document(path.name, checksum, "template", f"{path.name} of wb-mqtt-serial", has_lines=False)],
        FAMILY.name,
        model=title,
        title=title,
        facts=["certainty: imported"],
        kind="a template",
        blocks=[*parameters.blocks, *blocks_of(template, parameters)],
        bus=bus_of(body, groups),
    )
    compilable(groups, head, with_head=True)  # a point that is a view of another one is not folded
    return Draft(folded(groups, head.blocks), head)


def _rows(body: Mapping[str, Any], texts: Texts) -> Iterator[Row]:
    """Yield the parameters and the channels of a device."""
    parameters = body.get("parameters")
    if isinstance(parameters, dict):
        parameters = [{"id": key} | item for key, item in parameters.items() if isinstance(item, dict)]
    yield from (Row(item, texts, is_parameter=True) for item in objects(parameters))
    for item in objects(body.get("channels")):
        yield from (Row(part, texts, is_parameter=False) for part in components_of(item))


def _groups(body: Mapping[str, Any], rows: Sequence[Row], texts: Texts) -> list[DraftGroup]:
    """Return the points in the groups of the template, one for each space."""
    listed = objects(body.get("groups"))
    titles = {str(group.get("id")): str(group.get("title") or group.get("id")) for group in listed}
    groups: dict[tuple[str, str], DraftGroup] = {}
    for row in rows:
        key = str(row.item.get("group") or ("Parameters" if row.is_parameter else "Channels"))
        title, space = titles.get(key, key), row.point.space
        english = texts.english(title)
        group = groups.setdefault(
            (key, space), DraftGroup(english, space, "", document="template", titles=texts.others(title))
        )
        group.points.append(row.point)
    names = Names()
    for group in groups.values():
        group.name = names.give(snake(group.title, "points"), group.space)
    return list(groups.values())
