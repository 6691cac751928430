"""The Rust target: a `no_std` crate per device, with a conformance test, on top of one small runtime crate."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.conformance import arms, conformance_tables, row_lines
from fieldscribe.targets.rust.device import device_context
from fieldscribe.targets.rust.identifiers import identifiers
from fieldscribe.targets.rust.subjects import scope_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.model import Device
    from fieldscribe.render import Render

_SOURCES = ("lib", "points", "enums", "flags", "with")
_RUNTIME = (
    "Cargo.toml",
    "src/arithmetic.rs",
    "src/can/client.rs",
    "src/can/error.rs",
    "src/can/message.rs",
    "src/can/mod.rs",
    "src/can/receiver.rs",
    "src/check.rs",
    "src/client.rs",
    "src/digits.rs",
    "src/error.rs",
    "src/flags.rs",
    "src/form/digits.rs",
    "src/form/flags.rs",
    "src/form/floating.rs",
    "src/form/mod.rs",
    "src/form/named.rs",
    "src/form/plain.rs",
    "src/form/ruled.rs",
    "src/form/scaled.rs",
    "src/form/text.rs",
    "src/form/wide.rs",
    "src/info.rs",
    "src/lib.rs",
    "src/macros.rs",
    "src/modbus/client.rs",
    "src/modbus/error.rs",
    "src/modbus/function.rs",
    "src/modbus/mod.rs",
    "src/modbus/profile.rs",
    "src/modbus/reply.rs",
    "src/modbus/request.rs",
    "src/path.rs",
    "src/pattern.rs",
    "src/point.rs",
    "src/raw.rs",
    "src/rule.rs",
    "src/scale.rs",
    "src/special.rs",
    "src/text.rs",
    "src/uss/client.rs",
    "src/uss/error.rs",
    "src/uss/mod.rs",
    "src/uss/profile.rs",
    "src/uss/reply.rs",
    "src/uss/request.rs",
)
_CONFORMANCE = (
    "Cargo.toml",
    "src/can.rs",
    "src/can_clients.rs",
    "src/lib.rs",
    "src/modbus.rs",
    "src/modbus_clients.rs",
    "src/runtime.rs",
    "src/uss.rs",
    "src/uss_clients.rs",
)


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """The generated files: path relative to the output folder, and text."""
    scope = scope_of(device)
    context = device_context(device, scope)
    folder = f"rust/{device.id}"
    yield f"{folder}/Cargo.toml", render("rust/Cargo.toml.j2", context)
    for name in (*_SOURCES, *(("special",) if context["codes"] else ())):
        yield f"{folder}/src/{name}.rs", render(f"rust/{name}.rs.j2", context)
    tables = conformance_tables(scope, device)
    lines = [(kind, run, tuple(map(row_lines, rows))) for kind, run, rows in tables]
    suite = {**context, "tables": lines, "kinds": {kind for kind, _, _ in tables}, "arms": tuple(arms(tables))}
    yield f"{folder}/tests/conformance.rs", render("rust/conformance.rs.j2", suite)


def runtime(_: Device) -> Iterator[tuple[str, str]]:
    """The real source files beside the output: output path, and path under the templates."""
    for name in _RUNTIME:
        yield f"rust/fieldscribe_runtime/{name}", f"rust/runtime/fieldscribe_runtime/{name}"
    for name in _CONFORMANCE:
        yield f"rust/fieldscribe_conformance/{name}", f"rust/runtime/fieldscribe_conformance/{name}"


__all__ = ["identifiers", "outputs", "runtime"]
