"""The crates of all models in one cargo workspace, and how they are compiled."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable
from functools import partial
from pathlib import Path

from fieldscribe.model import Device

from support.described import kitchen_sink, made, shipped
from support.files import write_files
from support.models import sample_device, trip_device
from support.places import ROOT
from support.rust_crates import can_device, odd_device, rare_device, uss_device, without_registry, write_crate
from support.toolchains import run, tool

SHIPPED = sorted(path.parents[1].name for path in (ROOT / "generated/rust").glob("*/src/points.rs"))


MODELS: dict[str, Callable[[], Device]] = {
    "sample_drive": sample_device,
    "rare": rare_device,
    "odd": odd_device,
    "trips": trip_device,
    "kitchen_sink": kitchen_sink,
    "kitchen_codes": partial(made, "kitchen_codes"),
    "kitchen_blocks": partial(made, "kitchen_blocks"),
    "kitchen_can": partial(made, "kitchen_can"),
    "kitchen_uss": partial(made, "kitchen_uss"),
    "result": partial(made, "odd_names"),
    "odd_can": can_device,
    "odd_uss": uss_device,
}


RUNTIMES = ("fieldscribe_runtime", "fieldscribe_conformance")


GATEWAYS = ("siemens_mm4", "woodward_mpu2s")
"""Real devices that programs of users are written for."""


WORKSPACE = """\
[workspace]
resolver = "2"
members = @MEMBERS@

[profile.dev]
debug = false
incremental = false
"""


def write_workspace(out: Path) -> None:
    """The crates of all devices and their vectors, in a workspace that is built as quickly as it can be."""
    for make in MODELS.values():
        write_crate(make(), out)
    for device in SHIPPED:
        shutil.copytree(ROOT / "generated/rust" / device, out / "rust" / device)
        shutil.copy(ROOT / "generated/vectors" / f"{device}.txt", out / "vectors")
    devices = [*MODELS, *SHIPPED]
    without_registry(out / "rust")
    members = json.dumps([*RUNTIMES, *devices, *(f"{device}/conformance" for device in devices)])
    config = (
        f"build.rustc-workspace-wrapper = {json.dumps(tool('clippy-driver'))}\nenv.CLIPPY_ARGS = {json.dumps(LINTS)}\n"
    )
    texts = {"Cargo.toml": WORKSPACE.replace("@MEMBERS@", members), ".cargo/config.toml": config}
    write_files(texts, out / "rust")


LINTS = "".join(f"-Wclippy::{group}__CLIPPY_HACKERY__" for group in ("pedantic", "incompatible_msrv"))
"""What clippy looks for beside its usual lints, as `cargo clippy` passes it to the compiler that warns as it builds."""


def bring_up_to_date(kept: Path, made: Path) -> None:
    """Makes the kept files those that were made; cargo builds none again that is left as it is."""
    texts = {path.relative_to(made): path.read_bytes() for path in made.rglob("*") if path.is_file()}
    for path, text in texts.items():
        place = kept / path
        if not place.is_file() or place.read_bytes() != text:
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(text)
    for place in (*kept.glob("rust/*/src/**/*.rs"), *kept.glob("rust/*/**/tests/*.rs")):
        if place.relative_to(kept) not in texts:
            place.unlink()


def write_libraries(workspace: Path, out: Path) -> None:
    for name in GATEWAYS:
        write_crate(shipped(name), out)
    (out / "built").mkdir()
    for name in ("fieldscribe_runtime", *MODELS, *GATEWAYS):
        folder = out / "rust" if name in GATEWAYS else workspace
        done = rustc(folder / name / "src/lib.rs", out / "built", "--crate-name", name, "--emit=link,metadata,obj")
        assert done.returncode == 0, done.stderr


def rustc(source: Path, out: Path, *flags: str) -> subprocess.CompletedProcess[str]:
    """Compiles one file as a library, with the libraries of the folder at hand."""
    known = [f"--extern={path.stem.removeprefix('lib')}={path}" for path in sorted(out.glob("lib*.rlib"))]
    checked = ("-Copt-level=3", "-Cpanic=abort", "-Coverflow-checks=on", "-Ccodegen-units=1")
    return run(
        [
            tool("rustc"),
            "--edition=2021",
            "--crate-type=lib",
            *checked,
            "-L",
            out,
            *known,
            *flags,
            "--out-dir",
            out,
            source,
        ]
    )


def cargo(workspace: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Runs cargo without the network, and with it where something was never fetched."""
    done = run([tool("cargo"), "--offline", *words], cwd=workspace)
    return done if done.returncode == 0 else run([tool("cargo"), *words], cwd=workspace)
