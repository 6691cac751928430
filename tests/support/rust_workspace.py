"""The crates of all models in one cargo workspace, and how they are compiled."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import pytest
from fieldscribe.model import Device

from support.described import SHIPPED, kitchen_sink, made, shipped
from support.files import write_files
from support.made_once import made_once
from support.models import sample_device, trip_device
from support.places import ROOT
from support.rust_crates import can_device, odd_device, rare_device, uss_device, without_registry, write_crate
from support.toolchains import run, succeed, tool

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
    texts = {"Cargo.toml": WORKSPACE.replace("@MEMBERS@", members), ".cargo/config.toml": config({})}
    write_files(texts, out / "rust")


LINTS = "".join(f"-Wclippy::{group}__CLIPPY_HACKERY__" for group in ("pedantic", "incompatible_msrv"))
"""What clippy looks for beside its usual lints, as `cargo clippy` passes it to the compiler that warns as it builds."""


QUICK = "profile.dev.debug = false\nprofile.dev.incremental = false\n"
"""How cargo builds what is run once."""


def config(settings: Mapping[str, str]) -> str:
    """Cargo's settings, with which it builds quickly and the compiler warns as it builds."""
    clippy = {"build.rustc-workspace-wrapper": tool("clippy-driver"), "env.CLIPPY_ARGS": LINTS}
    return QUICK + "".join(f"{key} = {json.dumps(value)}\n" for key, value in {**clippy, **settings}.items())


def made_workspace(factory: pytest.TempPathFactory, config: pytest.Config) -> Path:
    """Return the folder of the workspace, which is made once a run."""
    cache = config.cache

    def make(out: Path) -> None:
        write_workspace(out)
        if cache:
            bring_up_to_date(cache.mkdir("crates"), out)

    made = made_once(factory, "crates", make)
    return (cache.mkdir("crates") if cache else made) / "rust"


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


def write_programs(workspace: Path, out: Path) -> None:
    """Builds what runs the vectors of each device by one call: a program by the device's name, and what cargo says."""
    words = ("--keep-going", "--workspace", "--test", "conformance", "--message-format=json-render-diagnostics")
    done = cargo(workspace, "build", "--quiet", *words)
    (out / "stderr").write_text(done.stderr, "utf-8")
    for artifact in map(json.loads, done.stdout.splitlines()):
        if artifact.get("executable"):
            device = Path(artifact["manifest_path"]).parents[1].name
            (out / device).symlink_to(artifact["executable"])


def built_libraries(factory: pytest.TempPathFactory, config: pytest.Config) -> Path:
    """Return the folder of the crates of the models and of the gateways, as libraries and objects."""
    workspace = made_workspace(factory, config)
    return made_once(factory, "libraries", partial(write_libraries, workspace)) / "built"


def write_libraries(workspace: Path, out: Path) -> None:
    for name in GATEWAYS:
        write_crate(shipped(name), out)
    (out / "built").mkdir()
    for name in ("fieldscribe_runtime", *MODELS, *GATEWAYS):
        folder = out / "rust" if name in GATEWAYS else workspace
        done = rustc(folder / name / "src/lib.rs", out / "built", "--crate-name", name, "--emit=link,metadata,obj")
        assert done.returncode == 0, done.stderr


CHECKED = ("-Copt-level=3", "-Cpanic=abort", "-Coverflow-checks=on", "-Ccodegen-units=1")


def rustc(source: Path, libraries: Path, *flags: str, out: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Compiles one file as a library, with the libraries of the folder at hand, among them or into another folder."""
    known = externs(*sorted(libraries.glob("lib*.rlib")))
    out_dir = ("--out-dir", out or libraries)
    return run([tool("rustc"), "--edition=2021", "--crate-type=lib", *CHECKED, *known, *flags, *out_dir, source])


def rust_program(source: Path, program: Path, *libraries: Path) -> Path:
    """Compiles a program with these libraries, without a warning; returns it."""
    assert not succeed([tool("rustc"), "--edition=2021", "-Cpanic=abort", *externs(*libraries), "-o", program, source])
    return program


def externs(*libraries: Path) -> list[str]:
    """The flags by which a compiler finds libraries and what they need."""
    folders = dict.fromkeys(f"-L{path.parent}" for path in libraries)
    return [*folders, *(f"--extern={path.stem.removeprefix('lib')}={path}" for path in libraries)]


MANY = 1800
"""Seconds after which cargo is taken to hang that builds all crates, on a busy machine too."""


def cargo(workspace: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Runs cargo without the network, and with it where something was never fetched."""
    done = run([tool("cargo"), "--offline", *words], cwd=workspace, limit=MANY)
    return done if done.returncode == 0 else run([tool("cargo"), *words], cwd=workspace, limit=MANY)
