"""Generated Rust: it passes every vector, is clean to clippy and rustfmt, never panics, and refuses misuse."""

from __future__ import annotations

import re
import shutil
import subprocess
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from fieldscribe.lowered import lower
from fieldscribe.model import Device, Flag
from fieldscribe.resources import render, templates_dir
from fieldscribe.targets import rust
from fieldscribe.targets.identifiers import clashes as found_clashes
from fieldscribe.targets.rust.layout import PointDoc, left_out
from fieldscribe.targets.rust.literals import type_name
from fieldscribe.targets.rust.scope import CratePoint, in_rust, scope_of
from support.described import SHIPPED, kitchen_sink, shipped
from support.made_once import made_once
from support.models import changed, entry, point, sample_device, titles
from support.places import TESTS
from support.rust_crates import write_crate
from support.rust_workspace import (
    MODELS,
    RUNTIMES,
    cargo,
    made_workspace,
    rust_program,
    rustc,
    write_programs,
)
from support.toolchains import run, succeed, tool
from support.vector_file import counts_of

PROGRAMS = TESTS / "rust"
FAILS = sorted(path.stem for path in (PROGRAMS / "fails").glob("*.rs"))


@pytest.fixture(scope="session")
def workspace(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> Path:
    """One cargo workspace of all crates; with what cargo builds it stays in pytest's cache."""
    return made_workspace(tmp_path_factory, request.config)


@pytest.fixture(scope="session")
def built(workspace: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What one call of cargo says that builds the programs of all devices which run their vectors."""
    return made_once(tmp_path_factory, "conformance", partial(write_programs, workspace))


def conforms(built: Path, device: str) -> subprocess.CompletedProcess[str]:
    """Runs the vectors of a device."""
    assert (built / device).exists(), (built / "stderr").read_text("utf-8")
    return run([built / device])


def clashes(device: Device) -> list[str]:
    return [one.name for one in found_clashes(rust.identifiers(device))]


def test_clashing_names_are_found() -> None:
    assert not any(clashes(make()) for make in MODELS.values())
    assert clashes(sample_device((point("a_b1", 0), point("a_b_1", 1)))) == ["AB1"]
    low = Flag(0, 1, "off", titles("Off"), 0, ())
    assert clashes(
        sample_device((point("word", 0, flags=(low, replace(low, low=1, name="off_active_low", active=1))),))
    )
    assert clashes(sample_device((point("word", 0, flags=(replace(low, name="all_false", active=1),)),)))


def sources(device: Device) -> dict[str, str]:
    """The sources of a crate by the name of the file."""
    return {Path(path).name: text for path, text in rust.outputs(device, render)}


def test_active_low_bits_say_so() -> None:
    low = Flag(1, 1, "motor_overload", titles("Overload"), 0, (entry(0, "zero"), entry(1, "one")))
    flags = (low, replace(low, low=0, name="ready", active=1))
    text = sources(sample_device((point("status", 0, flags=flags),)))["flags.rs"]
    assert "pub const ALL_FALSE: Self = Self(0x0002);" in text
    assert "pub const MOTOR_OVERLOAD_ACTIVE_LOW: u16 = 0x0002;" in text
    assert "pub const READY: u16 = 0x0001;" in text
    documented = (
        *("/// Motor overload.", "///", "/// True while the bit is 0.", "#[must_use]"),
        "pub const fn motor_overload(",
    )
    assert "\n    ".join(documented) in text
    assert "ZERO" not in text


def test_what_is_only_documented_has_its_address() -> None:
    settled = point("speed", 5)
    device = sample_device((settled, changed(settled, name="ramp", code="P1", generated=False)))
    assert left_out(device, lower(device)) == (("`ramp`, `P1`, holding 0005h (5)",),)
    assert "//! - `ramp`, `P1`, holding 0005h (5)" in sources(device)["points.rs"]
    drive = shipped("nord_sk5xxe")
    known = ["h (" in line for line, *_ in left_out(drive, lower(drive))]
    assert known == [bool(one.addresses) for one in drive.points if not one.generated]
    assert any(known)


def test_all_crates_name_the_compiler_that_they_need() -> None:
    """Checked by clippy's `incompatible_msrv` beside; Debian bookworm's `rustc-web` is 1.85 or later."""
    texts = [(templates_dir() / f"rust/runtime/{name}/Cargo.toml").read_text("utf-8") for name in RUNTIMES]
    texts.append(sources(sample_device())["Cargo.toml"])
    versions = {int(found[1]) for text in texts if (found := re.search(r'rust-version = "1\.(\d+)"', text))}
    assert len(versions) == 1
    assert max(versions) <= 85


def test_a_crate_asks_for_the_runtime_that_lies_beside_it() -> None:
    """Cargo refuses to package another."""
    manifest = dict(rust.outputs(sample_device(), render))["rust/sample_drive/Cargo.toml"]
    asked = tomllib.loads(manifest)["dependencies"]["fieldscribe_runtime"]["version"]
    beside = (templates_dir() / "rust/runtime/fieldscribe_runtime/Cargo.toml").read_text("utf-8")
    assert tomllib.loads(beside)["package"]["version"] == asked


def test_a_device_needs_the_runtime_alone(tmp_path: Path) -> None:
    """A workspace takes the device and the runtime; the vectors stay in a crate of their own."""
    write_crate(sample_device(), tmp_path / "made")
    for name in ("sample_drive", "fieldscribe_runtime"):
        shutil.copytree(tmp_path / "made/rust" / name, tmp_path / name)
    (tmp_path / "Cargo.toml").write_text('[workspace]\nresolver = "2"\nmembers = ["sample_drive"]\n', encoding="utf-8")
    done = cargo(tmp_path, "metadata", "--format-version=1")
    assert done.returncode == 0, done.stderr
    assert "fieldscribe_conformance" not in done.stdout


def test_what_a_device_has_not_makes_no_module() -> None:
    device = sample_device()
    assert "pub mod exceptions {" in sources(device)["lib.rs"]
    without = replace(device, bus=replace(device.bus, exceptions=()), commands=(), blocks={})
    assert re.findall(r"pub mod (\w+) ?\{", sources(without)["lib.rs"]) == []


def test_numbers_of_several_bits_are_shown_by_name() -> None:
    switch = Flag(0, 2, "switch", titles("Switch"), 1, (entry(0, "off"), entry(3, "on")))
    text = sources(sample_device((point("status", 0, flags=(switch,)),)))["flags.rs"]
    assert 'const NAMES_0: runtime::Names = &[(0, "off"), (3, "on")];' in text
    assert 'runtime::Flag::named("switch", 0x0003, NAMES_0)' in text


def test_a_step_is_information() -> None:
    scope = scope_of(kitchen_sink())
    points = [subject.point for subject in scope.subjects]
    docs = {one.item: PointDoc(one, scope.lowered).of(one.item, "", 0, "") for one in points}
    stepped = {one.item for one in points if one.steps}
    assert stepped == {
        item for item, doc in docs.items() if "(for information, not checked)" in " ".join(doc.split("\n    /// "))
    }
    assert stepped


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("device", ["kitchen_sink", "kitchen_can", "kitchen_uss"])
def test_the_first_page_runs(workspace: Path, device: str) -> None:
    """What it shows compiles; nothing answers it."""
    done = cargo(workspace, "test", "--quiet", "--package", device, "--doc")
    assert done.returncode == 0, done.stdout + done.stderr
    page = (workspace / device / "src/lib.rs").read_text("utf-8")
    shown = {"kitchen_sink": (".write::<", ".write_with::<", "Reading::Special", ".read_block(", ".command(")}
    assert all(one in page for one in shown.get(device, (".read::<",)))
    assert (".receive::<" in page) is (device == "kitchen_can")


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("device", [*MODELS, *SHIPPED])
def test_conforms(workspace: Path, built: Path, device: str) -> None:
    done = conforms(built, device)
    assert done.returncode == 0, done.stdout + done.stderr
    counts = counts_of((workspace.parent / "vectors" / f"{device}.txt").read_text("utf-8"), "rust")
    passed = dict(re.findall(r"^(\w+) (\d+) passed, 0 failed$", done.stdout, re.MULTILINE))
    assert int(passed.pop("total")) == sum(counts.values())
    assert {kind: int(n) for kind, n in passed.items()} == {kind: n for kind, n in counts.items() if n}


@pytest.mark.full(seconds=2)
def test_a_wrong_vector_is_noticed(
    workspace: Path, built: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (workspace.parent / "vectors/sample_drive.txt").read_text("utf-8")
    changed = text.replace("\naddress\tcoil\t0\t", "\naddress\tcoil\t1\t", 1)
    assert changed != text
    (tmp_path / "wrong.txt").write_text(changed, encoding="utf-8")
    monkeypatch.setenv("FIELDSCRIBE_VECTORS", str(tmp_path / "wrong.txt"))
    done = conforms(built, "sample_drive")
    assert done.returncode != 0
    assert re.search(r"^address \d+ passed, 1 failed$", done.stdout, re.MULTILINE)


@pytest.mark.full(seconds=1)
def test_vectors_of_another_description_are_refused(
    workspace: Path, built: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (workspace.parent / "vectors/sample_drive.txt").read_text("utf-8")
    (tmp_path / "other.txt").write_text(text.replace("\t1.2.0\t", "\t1.2.1\t", 1), encoding="utf-8")
    monkeypatch.setenv("FIELDSCRIBE_VECTORS", str(tmp_path / "other.txt"))
    done = conforms(built, "sample_drive")
    assert done.returncode != 0
    assert "is of another description" in done.stderr


@pytest.mark.full(seconds=1)
def test_vectors_that_are_not_there_say_what_to_set(
    built: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("FIELDSCRIBE_VECTORS", str(tmp_path / "none.txt"))
    done = conforms(built, "sample_drive")
    assert done.returncode != 0
    assert "set FIELDSCRIBE_VECTORS to the absolute path of sample_drive.txt" in done.stderr
    assert "panicked" not in done.stderr


def test_no_line_of_the_runtime_is_too_long() -> None:
    """What stands in a macro, and what has no place to break, rustfmt leaves as it is."""
    sources = sorted((templates_dir() / "rust/runtime").rglob("*.rs"))
    lines = ((path, line) for path in sources for line in path.read_text("utf-8").splitlines())
    assert not [(path.name, line) for path, line in lines if len(line) > 120]
    assert len(sources) > 40


@pytest.mark.parametrize("name", MODELS)
def test_the_table_has_every_point_once(name: str) -> None:
    device = MODELS[name]()
    text = sources(device)["lib.rs"]
    found = re.search(
        r"pub const POINTS: runtime::Points<\w+> = runtime::point_table! \{ points:\n(.*?)\n?\};", text, re.DOTALL
    )
    assert found
    assert found[1].split() == [subject.name for subject in scope_of(device).subjects]


@pytest.mark.full(seconds=90)  # builds them all
def test_clippy_has_nothing_to_say(built: Path) -> None:
    """Of what was compiled for the vectors: the compiler that warns compiles."""
    assert (built / "stderr").read_text("utf-8") == ""


@pytest.mark.full(seconds=4)
def test_unit_tests_of_the_runtime_pass(workspace: Path) -> None:
    """Its examples run in test_rust_page.py, with all features."""
    done = cargo(workspace, "test", "--quiet", "--package", "fieldscribe_runtime", "--lib")
    assert (done.returncode, done.stderr) == (0, ""), done.stdout + done.stderr


@pytest.mark.full
def test_rustfmt_changes_nothing(workspace: Path) -> None:
    tool("rustfmt")
    assert not succeed([tool("cargo"), "fmt", "--all", "--check"], cwd=workspace)


@pytest.mark.full(seconds=30)
def test_documentation_has_no_warning(workspace: Path, rust_libraries: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Checked without writing a page; those of other crates, with all features, in test_rust_page.py."""
    monkeypatch.setenv("RUSTC_BOOTSTRAP", "1")  # only an unstable option leaves the pages out
    check = [tool("rustdoc"), "-Zunstable-options", "--check", "--edition=2021", "-Dwarnings"]
    runtime = f"--extern=fieldscribe_runtime={rust_libraries}/libfieldscribe_runtime.rlib"
    for name in (*MODELS, *SHIPPED):
        succeed([*check, "--crate-name", name, runtime, workspace / name / "src/lib.rs"])


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize("name", FAILS)
def test_misuse_does_not_compile(rust_libraries: Path, name: str) -> None:
    source = PROGRAMS / "fails" / f"{name}.rs"
    text = source.read_text("utf-8")
    expected = text.splitlines()[0].removeprefix("// error: ").split()
    done = rustc(source, rust_libraries, "--emit=metadata")
    assert done.returncode != 0
    assert re.findall(r"error\[(E\d+)\]", done.stderr) == expected, done.stderr
    assert all(said in done.stderr for said in re.findall("^// says: (.*)$", text, re.MULTILINE)), done.stderr


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize(
    ("source", "device"),
    [
        ("client", "sample_drive"),
        ("texts", "rare"),
        ("can_client", "odd_can"),
        ("uss_client", "odd_uss"),
        ("trips", "trips"),
        ("mm4_gateway", "siemens_mm4"),
        ("mpu2s_gateway", "woodward_mpu2s"),
    ],
)
def test_programs_run(rust_libraries: Path, source: str, device: str, tmp_path: Path) -> None:
    """Clients talk to canned replies; every raw number survives every kind of rule."""
    crates = [rust_libraries / f"lib{name}.rlib" for name in ("fieldscribe_runtime", device)]
    assert not succeed([rust_program(PROGRAMS / f"{source}.rs", tmp_path / source, *crates)])


@pytest.mark.full(seconds=4)
@pytest.mark.parametrize("device", MODELS)
def test_nothing_can_panic(rust_libraries: Path, device: str, tmp_path: Path) -> None:
    """With checked arithmetic the compiler proves every sum: no object calls what panics."""
    probe = tmp_path / f"probe_{device}.rs"
    probe.write_text(probe_source(device), encoding="utf-8")
    done = rustc(probe, rust_libraries, "--emit=obj")
    assert done.returncode == 0, done.stderr
    for name in (probe.stem, device, "fieldscribe_runtime"):
        assert b"panicking" not in (rust_libraries / f"{name}.o").read_bytes(), name


WITHOUT_COUNTS = ("float", "text", "digits")
CLIENTS = {
    "modbus": """use fieldscribe_runtime::client::Transport;
use fieldscribe_runtime::modbus::Command;
use @DEVICE@::{Block, Client};
pub struct Line;
impl Transport for Line {
    type Error = ();
    fn exchange(&mut self, _: &[u8], _: &mut [u8]) -> Result<usize, ()> { Err(()) }
}
pub fn command(client: &mut Client<Line>, command: &Command<Device>) -> bool { client.command(command).is_ok() }
pub fn block(client: &mut Client<Line>, block: &Block) -> bool { client.read_block(block).is_ok() }""",
    "can": """use @DEVICE@::{Client, Frame, Receiver, Transport};
pub struct Line;
impl Transport for Line {
    type Error = ();
    fn send(&mut self, _: &Frame) -> Result<(), ()> { Err(()) }
    fn receive(&mut self) -> Result<Frame, ()> { Err(()) }
    fn pending(&mut self) -> Result<Option<Frame>, ()> { Err(()) }
}""",
    "uss": """use @DEVICE@::{Client, Transport};
pub struct Line;
impl Transport for Line {
    type Error = ();
    fn exchange(&mut self, _: &[u8], _: &mut [u8]) -> Result<usize, ()> { Err(()) }
}""",
}
"""What the probes of a family need beside the points."""
IDENTIFY = """use runtime::Identification;
pub fn identify(client: &mut Client<Line>, rows: &[Identification<Device>]) -> bool { client.identify(rows).is_ok() }"""


def probe_source(device: str) -> str:
    """A crate that calls every function of every point, and those of a client for one point of each kind."""
    model = MODELS[device]()
    names = "BitGroup, CountReadable, CountWritable, Encodable, Error, Point, Readable, Writable, runtime"
    client = CLIENTS.get(model.family, "").replace("@DEVICE@", device)
    lines = ["#![no_std]", f"use {device}::{{{names}, {type_name(device)} as Device}};", client]
    lines += [IDENTIFY] if client else []
    scope, known = scope_of(model), set()
    for subject in scope.subjects:
        name, point = f"{device}::points::{subject.name}", subject.point
        traits = " ".join(in_rust(model.family).traits(subject, scope))
        reached = model.family == "modbus" or "::Parameter" in traits
        bodies = [*probes(subject, name), *client_probes(subject, name, traits)]
        kind = (point.type, point.form, point.space, point.words, point.base, bool(point.bits), point.access)
        if reached and kind not in known:
            known.add(kind)
            bodies += parameter_probes(subject, name)
        item = subject.item
        lines += [f"#[inline(never)] pub fn {head.replace('(', f'_{item}(', 1)} {{ {body} }}" for head, body in bodies]
    return "\n".join(lines) + "\n"


def client_probes(subject: CratePoint, name: str, traits: str) -> Iterator[tuple[str, str]]:
    """Heads and bodies of functions that call what a client that blocks offers for a point."""
    point, read, write = subject.point, f"<{name} as Readable>", f"<{name} as Writable>"
    client, value = "client: &mut Client<Line>", f"<{name} as Point>::Value"
    with_head, with_body = ("", "") if point.bits else (f", with: {write}::With", ", with")
    if "uss::Sent" in traits and point.writable:
        head = f"send({client}, value: {value}{with_head}) -> bool"
        yield head, f"client.set{'_bits' if point.bits else '_with'}::<{name}>(value{with_body}).is_ok()"
    if "uss::Received" in traits:
        yield f"receive({client}, with: {read}::Factors) -> bool", f"client.receive_with::<{name}>(with).is_ok()"
    if "can::Received" in traits:
        receiver = f"Receiver<<{name} as runtime::can::Received>::Telegram>"
        yield f"hear(all: &mut {receiver}, frame: &Frame) -> bool", f"all.take(frame) && all.raw::<{name}>().is_ok()"


def parameter_probes(subject: CratePoint, name: str) -> Iterator[tuple[str, str]]:
    """Heads and bodies of functions that read and write a point over a client: values, counts, raw numbers."""
    point, client, with_ = subject.point, "client: &mut Client<Line>", f"with: <{name} as Writable>::With"
    value, raw, factors = (f"<{name} as {one}" for one in ("Point>::Value", "Point>::Raw", "Readable>::Factors"))
    if point.readable:
        yield f"get({client}, with: {factors}) -> bool", f"client.read_with::<{name}>(with).is_ok()"
        if is_counted(subject):
            yield f"get_count({client}, with: {factors}) -> bool", f"client.read_count_with::<{name}>(with).is_ok()"
    if not point.writable:
        return
    if point.bits:
        if point.readable and not point.arguments and point.encodes_values:
            yield f"put({client}, value: {value}) -> bool", f"client.update::<{name}>(value).is_ok()"
        return
    yield f"put_raw({client}, raw: {raw}, {with_}) -> bool", f"client.write_raw_with::<{name}>(raw, with).is_ok()"
    if point.encodes_values:
        yield f"put({client}, value: {value}, {with_}) -> bool", f"client.write_with::<{name}>(value, with).is_ok()"
    if is_counted(subject):
        head = f"put_count({client}, count: <{name} as CountWritable>::Count, {with_}) -> bool"
        yield head, f"client.write_count_with::<{name}>(count, with).is_ok()"


def is_counted(subject: CratePoint) -> bool:
    """Whether the point has counts."""
    return subject.point.form not in WITHOUT_COUNTS and subject.point.decimals is not None


def probes(subject: CratePoint, name: str) -> Iterator[tuple[str, str]]:
    """Heads and bodies of functions that call what a point offers; the name stands for the point's type."""
    raw, value, words = (
        f"<{name} as Point>::Raw",
        f"<{name} as Point>::Value",
        f"<{name} as Point>::Raw as runtime::Raw",
    )
    yield f"words(words: <{words}>::Words) -> {raw}", f"<{name} as Point>::from_words(words)"
    if subject.point.bits:
        yield f"insert(word: u16, raw: {raw}) -> u16", f"<{name} as BitGroup>::insert(word, raw)"
    read, write = f"<{name} as Readable>", f"<{name} as Writable>"
    counted = is_counted(subject)
    if subject.point.readable:
        if subject.point.text is not None and not (subject.point.text.is_bytes or subject.point.text.parts):
            yield "is(held: &runtime::HeldWords, text: &str) -> bool", f"runtime::is_text::<{name}>(held, text).is_ok()"
        head = f"(raw: {raw}, with: {read}::Factors) -> {read}::Output"
        yield f"decode{head}<{value}>", f"{read}::decode_with(raw, with)"
        if counted:
            count = f"<{name} as CountReadable>"
            yield f"decode_count{head}<{count}::Count>", f"{count}::decode_count_with(raw, with)"
    if subject.point.writable:
        tail = f", with: {write}::With) -> Result<{raw}, Error>"
        if subject.point.encodes_values:
            yield f"encode(value: {value}{tail}", f"<{name} as Encodable>::encode_with(value, with)"
        if counted:
            count = f"<{name} as CountWritable>"
            yield f"encode_count(count: {count}::Count{tail}", f"{count}::encode_count_with(count, with)"
