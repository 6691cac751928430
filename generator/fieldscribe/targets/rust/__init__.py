"""The Rust target: a `no_std` crate per device, and one for its vectors, on top of a small runtime crate."""

from collections.abc import Iterable, Iterator

from fieldscribe.model import Device
from fieldscribe.resources import Render, runtime_files
from fieldscribe.targets.rust.identifiers import device_name_taken, identifiers
from fieldscribe.targets.rust.scope import scope_of

_SOURCES = ("points", "enums", "flags", "with")

FAMILY_PART = "targets.rust"
WEIGHT = 0.6


def outputs(device: Device, render: Render, *, tests: bool = True) -> Iterable[tuple[str, str]]:
    """Yield the files of the crate and of the one that tests it: path below the output folder, and text."""
    from fieldscribe.targets.rust.device import device_context, texts_of

    scope = scope_of(device)
    context = device_context(device, scope, render)
    folder = f"rust/{device.id}"
    yield f"{folder}/Cargo.toml", render("rust/Cargo.toml.j2", context)
    yield f"{folder}/README.md", render("rust/README.md.j2", context)
    yield f"{folder}/src/lib.rs", render(f"rust/{device.family}.rs.j2", context)
    for name in (*_SOURCES, *(("special",) if context["codes"] else ())):
        texts = texts_of(name, device, scope, render)
        yield f"{folder}/src/{name}.rs", render(f"rust/{name}.rs.j2", {**context, **texts})
    if tests:
        from fieldscribe.targets.rust.conformance import arms, conformance_tables

        tables = conformance_tables(scope, device)
        suite = {**context, "tables": tables, "arms": dict(arms(tables))}
        yield f"{folder}/conformance/Cargo.toml", render("rust/conformance.toml.j2", context)
        yield f"{folder}/conformance/tests/conformance.rs", render(f"rust/{device.family}_conformance.rs.j2", suite)


def runtime(device: Device, *, tests: bool = True) -> Iterator[tuple[str, str]]:
    """Yield the source files of the crates that they need: path below the output folder, and below the templates."""
    del device
    for crate in ("fieldscribe_runtime", *(("fieldscribe_conformance",) if tests else ())):
        for name in runtime_files(f"rust/runtime/{crate}"):
            yield f"rust/{crate}/{name}", f"rust/runtime/{crate}/{name}"


__all__ = ["device_name_taken", "identifiers", "outputs", "runtime"]
