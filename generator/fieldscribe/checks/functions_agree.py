"""The printed amount of data of a function is that of its largest count: 16 bits a register, 8 coils a byte."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.checks.subject import Printed
from fieldscribe.families import modbus

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject
    from fieldscribe.language.nodes import Map

_COILS = frozenset({0x01, 0x02, 0x05, 0x0F})


def check(subject: Subject) -> None:
    """Functions whose printed bytes do not follow from their largest count, and spaces that no function reaches."""
    bus = subject.scope.bus
    if bus is None or subject.scope.header["family"] != "modbus":
        return
    if subject.bus_is_whole:
        _reached(subject, bus)
    by_name = {code.name: code for code in subject.bus.functions}
    for key, raw in bus.get("functions", {}).items():
        printed = raw.get("printed", {}).get("bytes") if not isinstance(raw, str) else None
        code = by_name.get(raw if isinstance(raw, str) else raw["name"])
        if printed is None or code is None or code.most is None:
            continue
        right = (code.most + 7) // 8 if code.number in _COILS else 2 * code.most
        if printed != right:
            message = f"{printed} bytes are printed for {key}, {code.most} items are {right} bytes"
            span = raw["printed"].span("bytes")
            subject.disagrees(Printed(f"function:{code.number}", "bytes", printed, right, span, message))


def _reached(subject: Subject, bus: Map) -> None:
    """One finding for each space whose points could be read or written, but by no function of the device."""
    known = {code.number for code in subject.bus.functions}
    points = [one.point for one in subject.resolved if one.point.generated]
    for space, functions in modbus.SPACES.items():
        inside = [point for point in points if point.space == space]
        writers = {functions.write_one, functions.write_many} - {None}
        for verb, count, able in (
            ("reads", sum(point.readable for point in inside), functions.read in known),
            ("writes", sum(point.writable for point in inside), bool(writers & known) or not writers),
        ):
            if count and not able:
                message = f"no function {verb} `{space}`, where {count} point{'s' * (count > 1)} would need it"
                hint = "list the function under `functions`, or correct `access` or `space`"
                subject.report.error("no-function", message, bus.key_span("functions"), hint)
