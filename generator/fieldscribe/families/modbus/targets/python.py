"""Modbus in generated Python: its module and its usual lines."""

from __future__ import annotations

from fieldscribe.targets.python.device import RUNTIME, Line, PythonFamily

SERIAL = Line("serial", 'SerialLine("/dev/ttyUSB0", 9600)', 'AsyncSerialLine(SerialLine("/dev/ttyUSB0", 9600))')
NETWORK = Line("tcp", 'TcpLine("192.168.0.20")', 'AsyncTcpLine("192.168.0.20")')

IN_PYTHON = PythonFamily(
    module=RUNTIME,  # the Modbus names come from the runtime itself
    exports=frozenset({"Base", "Block", "Chain", "Profile"}),
    device="Device",
    transport="Transport",
    line=lambda device: SERIAL if "rtu" in device.bus.framings else NETWORK,
)
