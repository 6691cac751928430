"""USS in generated Python: its module, its usual line, and the link that it needs."""

from __future__ import annotations

from fieldscribe.families.uss import of_bus
from fieldscribe.model import Device
from fieldscribe.targets.python.device import RUNTIME, Line, PythonFamily


def _line(device: Device) -> Line:
    lengths, (low, high) = of_bus(device.bus).pkw, of_bus(device.bus).pzd
    pkw = lengths[0] if lengths and 4 not in lengths else 4  # a bus with errors may have none
    return Line(
        "serial",
        'UssLine("/dev/ttyUSB0", 9600)',
        'AsyncSerialLine(UssLine("/dev/ttyUSB0", 9600))',
        first=(f"from {RUNTIME}.uss import Link",),
        settings=(f"Link(pkw={pkw}, pzd={min(max(2, low), high)})",),
    )


IN_PYTHON = PythonFamily(
    module=f"{RUNTIME}.uss",
    exports=frozenset({"Profile", "Stored", "StoredWriteOnly", "Telegram"}),
    device="UssDevice",
    transport="UssTransport",
    line=_line,
    settings=(("link", "Link"),),
)
