"""CAN in generated Python: its module and its usual line."""

from __future__ import annotations

from fieldscribe.model import Device
from fieldscribe.targets.python.device import RUNTIME, Line, PythonFamily

_BUS = 'can.Bus("can0", interface="socketcan")'


def _line(_: Device) -> Line:
    return Line("can", f"CanLine({_BUS})", f"AsyncCanLine({_BUS})", ("import can",))


IN_PYTHON = PythonFamily(
    module=f"{RUNTIME}.can",
    exports=frozenset({"Message", "Profile", "Role", "Signal", "Telegram"}),
    device="CanDevice",
    transport="CanTransport",
    line=_line,
)
