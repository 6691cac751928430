"""Drafts a description from a device template of Wiren Board's gateway: `import wb`.

`templates` reads the file, `rows` its channels and parameters, `conditions` their conditions. Here are the facts of the
whole device (bus, slots, identification, and writes that set it up); repetitions become one row. Whatever is not
carried is a question in the draft.
"""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import Any

from fieldscribe.families import families
from fieldscribe.importing import compilable
from fieldscribe.importing.draft_text import (
    Document,
    DraftBlock,
    DraftGroup,
    DraftPoint,
    Head,
    Names,
    WholeDraft,
    scalar,
    snake,
)
from fieldscribe.importing.readers import MOST_ROWS, UnreadableError
from fieldscribe.importing.wb.conditions import Parameters
from fieldscribe.importing.wb.rows import Row, components_of
from fieldscribe.importing.wb.templates import (
    MOST_BYTES,
    Texts,
    in_slots,
    labels_text,
    number_of,
    objects,
    read_template,
    whole_of,
)
from fieldscribe.safe_files import read_regular
from fieldscribe.text import line
from fieldscribe.wording.numbers import number_text

_LEAST = 3
"""The least number of rows for a group with a rule of addresses."""
_DIFFERENT = ("when", "default")
"""The facts that may differ between rows that become one, in addition to their addresses."""
_FAMILY = next(family for family in families() if "holding" in family.spaces)
_SLOTS = range(1, 5)
"""The slots of modules; the gateway counts them again from 1 after the last."""
_SIGNATURE = (200, 20)
"""The registers of the model in devices of Wiren Board: the first one and their number, a character in each."""
_TIMES = {
    "response_timeout_ms": "response_timeout", "response_timeout": "response_timeout",
    "frame_timeout_ms": "frame_timeout", "guard_interval_us": "guard_interval",
    "min_request_interval": "request_interval",
}  # fmt: skip
_LONGEST, _MOST_STEPS = 1_000_000, 1000
"""The longest time in milliseconds, and the most steps of a command."""
_SHOWN = {
    *("name", "id", "channels", "parameters", "groups", "translations", "setup", "protocol", "stride", "shift"),
    *("enable_wb_continuous_read", "preserve_setup_order", "force_frame_timeout", "device_max_fail_cycles"),
    *("max_read_registers", "max_write_registers", "deprecated", *_TIMES),
}
"""Keys that are read elsewhere, or about the gateway and not the device."""


def draft_template(path: Path, device: str) -> WholeDraft:
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
    groups += _identification(template, names)
    for group in groups:
        group.facts |= _base_of(body) | _first_firmware(template)
    title = texts.english(str(template.get("title") or body.get("name") or template.get("device_type", device)))
    checksum = sha256(read_regular(path, MOST_BYTES).data).hexdigest()
    head = Head(
        device,
        [Document(path.name, checksum, "template", f"{path.name} of wb-mqtt-serial", has_lines=False)],
        _FAMILY.name,
        model=title,
        title=title,
        facts=["certainty: imported"],
        kind="a template",
        blocks=[*parameters.blocks, *_blocks_of(template, parameters)],
        bus=_bus_of(body, groups),
    )
    compilable(groups, head, with_head=True)  # a point that is a view of another is not folded
    return WholeDraft(folded(groups, head.blocks), head)


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


# Facts of the whole device.


def _bus_of(body: Mapping[str, Any], groups: Iterable[DraftGroup]) -> list[str]:
    """Return the bus, with the largest requests and with times."""
    spaces = {group.space for group in groups} | {_space(item) for item in objects(body.get("setup"))}
    lines = _FAMILY.part("description").bus_of(spaces).splitlines()
    for key, pattern in (("max_read_registers", "(read_.*_registers)"), ("max_write_registers", "(write_registers)")):
        most = whole_of(body.get(key))
        if most and 0 < most <= 125:
            lines = [re.sub(f" {pattern}$", rf" {{name: \1, max: {most}}}", text) for text in lines]
    times = {name: time for key, name in _TIMES.items() if 0 < (time := _milliseconds(key, body)) <= _LONGEST}
    listed = [f"    {name}: {number_text(time)} ms" for name, time in times.items()]
    return [*lines, *(["  timing:", *listed] if listed else [])]


def _milliseconds(key: str, body: Mapping[str, Any]) -> Fraction:
    """Return a time to the microsecond; 0 if there is none."""
    time = number_of(body.get(key)) or Fraction(0)
    milliseconds = time / 1000 if key.endswith("_us") else time
    return milliseconds if (milliseconds * 1000).denominator == 1 else Fraction(0)


def _base_of(body: Mapping[str, Any]) -> dict[str, str]:
    """Return the base of a module's addresses, which depends on its slot, as the fact of a group."""
    stride, shift = whole_of(body.get("stride")), whole_of(body.get("shift"))
    if not in_slots(body) or not stride:
        return {}
    return {"base": f"slot * {stride}{f' + {shift}' if shift else ''}"}


def _identification(template: Mapping[str, Any], names: Names) -> list[DraftGroup]:
    """Return the group of the register that identifies the device."""
    if not _signatures(template):
        return []
    first, count = _SIGNATURE
    facts = {
        "at": f"{first}..{first + count - 1}",
        "access": "r",
        "type": "text",
        "characters": str(count),
        "per_word": "1",
        "padding": "00h",
    }
    point = DraftPoint(
        0, "holding", "Device signature", name=names.give("device_signature"), facts=facts, wire=first, views=True
    )
    group = DraftGroup("Identification", "holding", "hw", [point], name="identification", document="template")
    return [group]


def _signatures(template: Mapping[str, Any]) -> dict[str, str]:
    """Return the signatures of the devices that a template is for, and their first firmware."""
    listed = objects(template.get("hw"))
    return {str(each["signature"]): str(each.get("fw", "")) for each in listed if each.get("signature")}


def _first_firmware(template: Mapping[str, Any]) -> dict[str, str]:
    """Return the first firmware that a template is for, as the fact of a group, if all its devices have the same."""
    versions = set(_signatures(template).values())
    return {"since": scalar(f"firmware {versions.pop()}")} if len(versions) == 1 and versions != {""} else {}


def _blocks_of(template: Mapping[str, Any], parameters: Parameters) -> list[DraftBlock]:
    """Return further facts of the head."""
    body, blocks = template["device"], []
    signatures = _signatures(template)
    if signatures:
        block = DraftBlock([f"identify: {{device_signature: [{', '.join(map(scalar, signatures))}]}}"])
        if not _first_firmware(template):
            block.questions += [f"not carried: fw: {text} of {name}" for name, text in signatures.items() if text]
        blocks.append(block)
    if in_slots(body):
        blocks.append(DraftBlock([f"given: {{slot: {{range: {_SLOTS[0]}..{_SLOTS[-1]}}}}}"]))
    blocks.append(_set_up(body, parameters))
    if parameters.units:
        listed = [
            f"  {scalar(unit)}: {{name: {scalar(unit)}, quantity: as the template has it}}" for unit in parameters.units
        ]
        blocks.append(DraftBlock(["units:", *listed]))
    lost = DraftBlock([], [f"not carried: {key}: {body[key]}" for key in body if key not in _SHOWN])
    return [*blocks, lost]


def _writes(body: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the writes that set a device up, in the order in which the gateway sends them."""
    writes = objects(body.get("setup"))
    if not body.get("preserve_setup_order"):
        writes.sort(key=lambda item: (_space(item), number_of(item.get("address")) or 0))
    return writes


def _space(item: Mapping[str, Any]) -> str:
    return str(item.get("reg_type", "holding"))


def _stated(stated: object) -> str:
    """Return a number of a template as it is printed, other things as they are."""
    return number_text(stated) if isinstance(stated, Fraction) else str(stated)


def _set_up(body: Mapping[str, Any], parameters: Parameters) -> DraftBlock:
    """Return the commands of these writes: one for each slot (steps have no base), or commands that run first."""
    block, steps = DraftBlock([]), list[tuple[str, int, str]]()
    for item in _writes(body):
        address, value, form = whole_of(item.get("address")), whole_of(item.get("value")), item.get("format", "u16")
        when = parameters.condition(str(item["condition"]), block.questions) if item.get("condition") else True
        if address is None or value is None or _space(item) not in ("holding", "coil") or form not in ("u16", "s16"):
            title = f"{item['title']}: " if item.get("title") else ""
            stated = f"{_stated(item.get('address'))} = {_stated(item.get('value'))}"
            block.questions.append(f"not carried: setup: {title}{stated}")
        elif when is not False:
            condition = "" if when is True else f", when: {scalar(str(when))}"
            words = f"words: [{value}]{condition}}}  # {line(str(item.get('title', '')))}"
            steps.append((f"  - {{space: {_space(item)}, at: ", address, f", {words}"))
    stride, shift = whole_of(body.get("stride")) or 0, whole_of(body.get("shift")) or 0
    for slot in _SLOTS if in_slots(body) else (0,):
        run, suffix = ("by caller", f"_in_slot_{slot}") if slot else ("first", "")
        for number, first in enumerate(range(0, len(steps), _MOST_STEPS), 1):
            head = ["commands:"] if not block.lines else []
            name = f"set_up{suffix}{f'_{number}' if number > 1 else ''}"
            part = [
                f"{start}{at + slot * stride + shift * (slot > 0)}{end}"
                for start, at, end in steps[first:][:_MOST_STEPS]
            ]
            block.lines += [*head, f"- name: {name}", f"  run: {run}", "  steps:", *part]
    return block


# Rows that repeat.


def folded(groups: Sequence[DraftGroup], blocks: Sequence[DraftBlock]) -> list[DraftGroup]:
    """Return the groups, each followed by those of its repetitions; conditions use the new names of points."""
    points, names, renamed = Names(), Names(), dict[str, str]()
    for group in groups:
        names.give(group.name)
        for point in group.points:
            points.give(point.name)
    single = {word for group in groups for point in group.points if (word := point.facts.get("view_of"))}
    result = [part for group in groups for part in _parts(group, single, points, names, renamed)]

    def new(text: str) -> str:
        return re.sub(r"\w+", lambda match: renamed.get(match[0], match[0]), text)

    for point in (point for group in result for point in group.points):
        point.facts |= {key: new(point.facts[key]) for key in ("when", "each") if key in point.facts}
    for block in blocks:
        block.lines = [new(text) if " when: " in text else text for text in block.lines]
    return result


def _parts(
    group: DraftGroup, single: Collection[str], points: Names, names: Names, renamed: dict[str, str]
) -> Iterator[DraftGroup]:
    """Yield the group without its repeats, and a group for the repeats of each distance."""
    by_step: dict[tuple[int, int], list[DraftPoint]] = {}
    left = {id(point): point for point in group.points}
    for place in (0, -1):
        for rows in _foldable((point for point in left.values() if point.name not in single), place):
            run = {_number(point.title, place): point for point in rows}
            places = [point.wire or 0 for point in run.values()]
            steps = {second - first for first, second in pairwise(places)}
            if len(run) == len(rows) and list(run) == list(range(min(run), min(run) + len(run))) and len(steps) == 1:
                step = steps.pop()
                if step > 0:
                    by_step.setdefault((min(run), step), []).append(_array_row(run, place, points, renamed))
                    for point in rows:
                        del left[id(point)]
    group.points = list(left.values())
    if group.points:
        yield group
    for (first, step), rows in by_step.items():
        rule = {"addressing": f"number + {'index' if first == 0 else f'(index - {first})'} * {step}"}
        name = names.give(f"{group.name}_repeated")
        yield replace(group, points=rows, name=name, comments=[], facts=group.facts | rule)


def _foldable(points: Iterable[DraftPoint], place: int) -> list[list[DraftPoint]]:
    """Return the points that differ only in one number of their titles, and in what may differ."""
    by_facts: dict[object, list[DraftPoint]] = {}
    for point in points:
        if (
            point.facts["at"] == str(point.wire)
            and _number(point.title, place) >= 0
            and not {"write_at", "view_of"} & point.facts.keys()
        ):
            facts = {key: text for key, text in point.facts.items() if key not in ("at", *_DIFFERENT)}
            titles = [_without(title, place) for title in (point.title, *point.titles.values())]
            present = [key in point.facts for key in _DIFFERENT]
            key = (*titles, *point.titles, *facts.items(), *present, *point.questions, *point.remarks)
            by_facts.setdefault(key, []).append(point)
    return [rows for rows in by_facts.values() if len(rows) >= _LEAST]


def _number(title: str, place: int) -> int:
    numbers = re.findall("[0-9]{1,3}", title)
    return int(numbers[place]) if numbers else -1


def _without(title: str, place: int) -> str:
    """Return a title without its first (0) or last (-1) number."""
    matches = list(re.finditer(" ?[0-9]{1,3}", title))
    rest = title[: matches[place].start()] + title[matches[place].end() :] if matches else title
    return rest.strip(" -–:.,#") or title


def _array_row(run: dict[int, DraftPoint], place: int, points: Names, renamed: dict[str, str]) -> DraftPoint:
    """Return the row of an array for the points by index."""
    first = next(iter(run.values()))
    title = _without(first.title, place)
    titles = {language: _without(text, place) for language, text in first.titles.items()}
    point = replace(
        first, title=title, titles=titles, name=points.give(snake(title, "element")), facts=dict(first.facts)
    )
    point.facts["indices"] = f"{min(run)}..{max(run)}"
    renamed |= {each.name: f"{point.name}_index_{index}" for index, each in run.items()}
    lines = []
    for index, row in run.items():
        facts = [f"{key}: {row.facts[key]}" for key in _DIFFERENT if row.facts.get(key) != first.facts.get(key)]
        lines += [f"\n  {index}: {{{', '.join(facts)}}}"] if facts else []
    if lines:
        point.facts["each"] = "".join(lines)
    return point
