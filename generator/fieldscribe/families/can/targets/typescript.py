"""CAN in generated TypeScript: its class of devices, and its functions."""

from __future__ import annotations

from fieldscribe.targets.typescript.identifiers import TypeScriptFamily

_FRAMES = "can-frames"

IN_TYPESCRIPT = TypeScriptFamily(
    device="CanDevice",
    makers={
        "Profile": "canProfile",
        "Message": "canMessage",
        "Role": "canRole",
        "Signal": "canSignal",
        "Telegram": "telegramLayout",
    },
    modules={
        "CanDevice": "can",
        **dict.fromkeys(("canProfile", "canMessage", "canRole", "canSignal", "telegramLayout"), _FRAMES),
    },
)
