"""The Rust target: a `no_std` crate per device, and one for its vectors, on top of a small runtime crate."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.resources import runtime_files
from fieldscribe.targets.rust.identifiers import device_name_taken, identifiers
from fieldscribe.targets.rust.subjects import scope_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.model import Device
    from fieldscribe.render import Render
    from fieldscribe.targets.rust.subjects import CrateScope

SEES_TITLES = False

_SOURCES = ("points", "enums", "flags", "with")
_RUNTIMES = ("fieldscribe_runtime", "fieldscribe_conformance")

NEEDS_FAMILY = True
NAMES_CONTAIN_POINT = True


def outputs(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """Yield the generated files: path relative to the output folder, and text."""
    from fieldscribe.targets.rust.conformance import arms, conformance_tables
    from fieldscribe.targets.rust.device import device_context

    scope = scope_of(device)
    context = device_context(device, scope, render)
    folder = f"rust/{device.id}"
    for path, text in _crate(device, scope, context, render):
        yield f"rust/{path}", text
    tables = conformance_tables(scope, device)
    suite = {**context, "tables": tables, "kinds": {table.name for table in tables}, "arms": tuple(arms(tables))}
    yield f"{folder}/conformance/Cargo.toml", render("rust/conformance.toml.j2", context)
    yield f"{folder}/conformance/tests/conformance.rs", render(f"rust/{device.family}_conformance.rs.j2", suite)


def runtime(_: Device) -> Iterator[tuple[str, str]]:
    """Yield the real source files beside the output: output path, and path under the templates."""
    for crate in _RUNTIMES:
        for name in runtime_files(f"rust/runtime/{crate}"):
            yield f"rust/{crate}/{name}", f"rust/runtime/{crate}/{name}"


def vendored(device: Device, render: Render) -> Iterable[tuple[str, str]]:
    """Return the crate, as it lies in a project."""
    from fieldscribe.targets.rust.device import device_context

    scope = scope_of(device)
    return _crate(device, scope, device_context(device, scope, render), render)


def vendored_runtime(device: Device) -> Iterator[tuple[str, str]]:
    """Yield the crate that it depends on: path, and path under the templates."""
    del device
    for name in runtime_files(f"rust/runtime/{_RUNTIMES[0]}"):
        yield f"{_RUNTIMES[0]}/{name}", f"rust/runtime/{_RUNTIMES[0]}/{name}"


def _crate(
    device: Device, scope: CrateScope, context: Mapping[str, object], render: Render
) -> Iterator[tuple[str, str]]:
    from fieldscribe.targets.rust.device import texts_of

    yield f"{device.id}/Cargo.toml", render("rust/Cargo.toml.j2", context)
    yield f"{device.id}/README.md", render("rust/README.md.j2", context)
    yield f"{device.id}/src/lib.rs", render(f"rust/{device.family}.rs.j2", context)
    for name in (*_SOURCES, *(("special",) if context["codes"] else ())):
        texts = texts_of(name, device, scope, render)
        yield f"{device.id}/src/{name}.rs", render(f"rust/{name}.rs.j2", {**context, **texts})


__all__ = ["SEES_TITLES", "device_name_taken", "identifiers", "outputs", "runtime", "vendored", "vendored_runtime"]
