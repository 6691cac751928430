"""The printed amount of data of a function is that of its largest count: 16 bits a register, 8 coils a byte."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.checks.subject import Printed

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject

_COILS = frozenset({0x01, 0x02, 0x05, 0x0F})


def check(subject: Subject) -> None:
    """Functions whose printed bytes do not follow from their largest count."""
    bus = subject.scope.bus
    if bus is None:
        return
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
