"""The facts of the whole device in a template: bus, slots, identification, and writes that set it up."""

import re
from collections.abc import Iterable, Mapping
from fractions import Fraction
from typing import Any

from fieldscribe.families import families
from fieldscribe.importing.draft_text import DraftBlock, DraftGroup, DraftPoint, Names, scalar
from fieldscribe.importing.wb.conditions import Parameters
from fieldscribe.importing.wb.templates import in_slots, number_of, objects, whole_of
from fieldscribe.text import line
from fieldscribe.wording.exact import number_text

FAMILY = next(family for family in families() if "holding" in family.spaces)
SLOTS = range(1, 5)
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


def bus_of(body: Mapping[str, Any], groups: Iterable[DraftGroup]) -> list[str]:
    """Return the bus, with the largest requests and with times."""
    spaces = {group.space for group in groups} | {_space(item) for item in objects(body.get("setup"))}
    lines = FAMILY.part("description").bus_of(spaces).splitlines()
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


def base_of(body: Mapping[str, Any]) -> dict[str, str]:
    """Return the base of a module's addresses, which depends on its slot, as the fact of a group."""
    stride, shift = whole_of(body.get("stride")), whole_of(body.get("shift"))
    if not in_slots(body) or not stride:
        return {}
    return {"base": f"slot * {stride}{f' + {shift}' if shift else ''}"}


def identification(template: Mapping[str, Any], names: Names) -> list[DraftGroup]:
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


def first_firmware(template: Mapping[str, Any]) -> dict[str, str]:
    """Return the first firmware that a template is for, as the fact of a group, if all its devices have the same."""
    versions = set(_signatures(template).values())
    return {"since": scalar(f"firmware {versions.pop()}")} if len(versions) == 1 and versions != {""} else {}


def blocks_of(template: Mapping[str, Any], parameters: Parameters) -> list[DraftBlock]:
    """Return further facts of the head."""
    body, blocks = template["device"], []
    signatures = _signatures(template)
    if signatures:
        block = DraftBlock([f"identify: {{device_signature: [{', '.join(map(scalar, signatures))}]}}"])
        if not first_firmware(template):
            block.questions += [f"not carried: fw: {text} of {name}" for name, text in signatures.items() if text]
        blocks.append(block)
    if in_slots(body):
        blocks.append(DraftBlock([f"given: {{slot: {{range: {SLOTS[0]}..{SLOTS[-1]}}}}}"]))
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


def _set_up(body: Mapping[str, Any], parameters: Parameters) -> DraftBlock:
    """Return the commands of these writes: one for each slot (steps have no base), or commands that run first."""
    block, steps = DraftBlock([]), list[tuple[str, int, str]]()
    for item in _writes(body):
        address, value, form = whole_of(item.get("address")), whole_of(item.get("value")), item.get("format", "u16")
        when = parameters.condition(str(item["condition"]), block.questions) if item.get("condition") else True
        if address is None or value is None or _space(item) not in ("holding", "coil") or form not in ("u16", "s16"):
            stated = f"{item.get('address')} = {item.get('value')}"
            block.questions.append(f"not carried: setup: {item.get('title')}: {stated}")
        elif when is not False:
            condition = "" if when is True else f", when: {scalar(str(when))}"
            words = f"words: [{value}]{condition}}}  # {line(str(item.get('title', '')))}"
            steps.append((f"  - {{space: {_space(item)}, at: ", address, f", {words}"))
    stride, shift = whole_of(body.get("stride")) or 0, whole_of(body.get("shift")) or 0
    for slot in SLOTS if in_slots(body) else (0,):
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
