"""Programs in Rust with vendored crates: those of the pages, and those beside the transports; built once a run."""

from __future__ import annotations

import os
import re
import shutil
from functools import partial
from pathlib import Path

import pytest
from fieldscribe.cli import main

from support.made_once import made_once
from support.places import ROOT, TESTS
from support.rust_workspace import config
from support.toolchains import crates, run, tool

PAGE = "\n".join(
    (ROOT / f"descriptions/using/{name}.md").read_text("utf-8") for name in ("rust", "rust-transports", "rust-builds")
)
BLOCK = re.compile(r"(?:`(?P<name>[\w./]+)`:\n\n)?^```(?P<kind>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
BLOCKS = {
    kind: [match for match in BLOCK.finditer(PAGE) if match["kind"] == kind and not match["name"]]
    for kind in ("rust", "toml", "sh")
}
FILES = {match["name"]: match["text"] for match in BLOCK.finditer(PAGE) if match["name"]}
DEVICES = {
    "hitachi_l200": (),
    "eastron_sdm630": (),
    "fronius_datamanager": (),
    "siemens_mm4": ("P1082",),
    "woodward_mpu2s": ("generator_frequency*", "voltage_controller", "operating_hours", "telegram_identification"),
    "jumo_controller": (),
    "nord_sk5xxe": (),
}
"""What is vendored: whole devices on Modbus, and points of the others."""

AROUND = """\
#![allow(unused, reason = "a block of a page shows what there is")]
use hitachi_l200::{points as p, Client, Framing};
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let line = hitachi_l200::runtime::transports::tcp::TcpLine::new("192.168.0.20:4001");
    let mut drive = hitachi_l200::Client::new(line, hitachi_l200::Framing::Rtu, 1);
@BLOCK@
    @CALL@
    Ok(())
}
"""
CALLS = {
    "struct Recorder": """let stream = std::net::TcpStream::connect("192.168.0.20:4001")?;
    let mut drive = Client::new(Recorder(stream), Framing::Rtu, 1);
    println!("{}", drive.read::<p::OutputFrequency>()?);""",
    "fn slow_down": """let uart = programs::uart::Uart::new(&[&programs::uart::word(7)]);
    println!("{:?}", slow_down(uart, || ()));""",
    "fn watch": """println!("{:?}", watch(programs::bus::Controller { speaks: true, ..Default::default() }));""",
}
"""How a block that only declares a function or a type is used."""

PLACES = {
    "192.168.0.20:4001": "RTU",
    "192.168.0.20:502": "TCP",
    "192.168.0.21:502": "INVERTER",
    "/dev/ttyUSB0": "TTY",
    "points.txt": "POINTS",
}
"""The addresses and the file on the page, and where a program finds those of the test."""


def program(block: str) -> str:
    """A block of the page as a whole program."""
    if "fn main()" not in block:
        call = next((call for mark, call in CALLS.items() if mark in block), "")
        block = AROUND.replace("@BLOCK@", block).replace("@CALL@", call)
    for address, variable in PLACES.items():
        block = block.replace(f'"{address}"', f'std::env::var("{variable}").unwrap()')
    return block


PAGES = """\
//! The programs of the page, by their numbers: what they have in common is compiled and linked once.

use std::process::{ExitCode, Termination};

@MODULES@
fn main() -> ExitCode {
    match std::env::var("PAGE").unwrap().as_str() {
@CALLS@
        number => panic!("there is no program {number}"),
    }
}
"""


def write_pages(folder: Path) -> None:
    """One program that is each block of the page by its number in the environment, since blocks have arguments."""
    folder.mkdir()
    modules, calls = "", []
    for number, block in enumerate(BLOCKS["rust"]):
        text = re.sub(r"^(async )?fn main\(\)", r"pub \1fn main()", program(block["text"]), flags=re.MULTILINE)
        (folder / f"page_{number:02}.rs").write_text(text, "utf-8")
        modules += f"mod page_{number:02};\n"
        calls.append(f'        "{number}" => page_{number:02}::main().report(),')
    text = PAGES.replace("@MODULES@", modules).replace("@CALLS@", "\n".join(calls))
    (folder / "main.rs").write_text(text, "utf-8")


def built_programs(factory: pytest.TempPathFactory, config: pytest.Config) -> Path:
    """Return the folder of the built programs, beside that of the project; what cargo keeps is in pytest's cache."""
    target = config.cache.mkdir("transports") if config.cache else None
    return made_once(factory, "transports", partial(write_project, target)) / "built"


def write_project(target: Path | None, out: Path) -> None:
    project = out / "project"
    shutil.copytree(TESTS / "rust/transports", project)
    for device, points in DEVICES.items():
        chosen = ("--points", ",".join(points)) if points else ()
        assert main(["vendor", "rust", device, "--out", str(project / "drivers"), *chosen]) == 0
    write_pages(project / "src/bin/pages")
    (project / ".cargo").mkdir()
    settings = {"build.rustdoc": str(TESTS / "rust/rustdoc.sh")}
    if target:
        settings["build.target-dir"] = str(target)
    (project / ".cargo/config.toml").write_text(config(settings), "utf-8")
    crates(project)
    done = run([tool("cargo"), "build", "--offline", "--quiet", "--bins"], cwd=project)
    (out / "stderr").write_text(done.stderr, "utf-8")
    assert done.returncode == 0, done.stderr
    shutil.copytree(target / "debug" if target else project / "target/debug", out / "built", ignore=only_programs)


def only_programs(folder: str, names: list[str]) -> list[str]:
    """What is no program in the folder that cargo fills."""
    return [name for name in names if "." in name or os.path.isdir(os.path.join(folder, name))]
