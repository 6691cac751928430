"""USS in generated TypeScript: its class of devices, its functions, and the link that it needs."""

from __future__ import annotations

from fieldscribe.targets.typescript.identifiers import TypeScriptFamily

IN_TYPESCRIPT = TypeScriptFamily(
    device="UssDevice",
    makers={"Profile": "ussProfile", "Telegram": "telegramLayout"},
    modules={"UssDevice": "uss", "ussProfile": "uss-frames", "telegramLayout": "can-frames"},
    options=(("link", 'import("fieldscribe-runtime/uss-frames").UssLink'),),
)
