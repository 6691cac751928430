"""Modbus in generated TypeScript: its class of devices, and its functions."""

from __future__ import annotations

from fieldscribe.targets.typescript.identifiers import TypeScriptFamily

IN_TYPESCRIPT = TypeScriptFamily(
    device="ModbusDevice",
    makers={"Profile": "modbusProfile", "Block": "modbusBlock", "Base": "modbusBase", "Chain": "modbusChain"},
    modules={
        "ModbusDevice": "modbus",
        "modbusBlock": "modbus",
        "modbusProfile": "modbus-frames",
        "modbusBase": "bases",
        "modbusChain": "bases",
    },
)
