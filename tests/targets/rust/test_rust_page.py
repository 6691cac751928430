"""Transports of Rust, and the page on them: vendored crates with all features, on real servers and buses in memory."""

from __future__ import annotations

import os
import re
import select
import shutil
import socket
import threading
import tomllib
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.simulation import simulated
from pymodbus import FramerType
from support.modbus_server import server
from support.places import ROOT, TESTS
from support.rust_programs import BLOCKS, FILES, PAGE, built_programs
from support.toolchains import run, succeed, tool

EACH_FAMILY = [
    word
    for name in ("fieldscribe_runtime", "jumo_controller", "siemens_mm4", "woodward_mpu2s")
    for word in ("--package", name)
]
"""The crates that differ by their features and manifests, small ones; test_rust.py has all devices without features."""


@pytest.fixture(scope="session")
def project(tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest) -> Path:
    """A project with vendored devices and all programs, built."""
    return built_programs(tmp_path_factory, request.config).parent / "project"


@contextmanager
def serial_line(port: int) -> Iterator[str]:
    """A pseudo terminal whose other end is a server; its path."""
    near, far = os.openpty()
    tty.setraw(near)
    tty.setraw(far)
    stop = threading.Event()
    with socket.create_connection(("127.0.0.1", port)) as connection:

        def pump() -> None:
            while not stop.is_set():
                ready = select.select([near, connection.fileno()], [], [], 0.05)[0]
                if connection.fileno() in ready:
                    os.write(near, connection.recv(512))
                if near in ready:
                    connection.sendall(os.read(near, 512))

        thread = threading.Thread(target=pump, daemon=True)
        thread.start()
        try:
            yield os.ttyname(far)
        finally:
            stop.set()
            thread.join(2)
            os.close(near)
            os.close(far)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("tcp", marks=pytest.mark.full(seconds=50)),  # builds them all
        *(
            pytest.param(name, marks=pytest.mark.full(seconds=1))
            for name in ("stream", "tokio", "embedded", "can", "by_name")
        ),
        pytest.param("faults", marks=pytest.mark.full(seconds=7)),
    ],
)
def test_transports(project: Path, name: str) -> None:
    built = project.parent / "built" / name
    with server(FramerType.RTU) as rtu, server() as tcp, server(FramerType.RTU) as behind, serial_line(behind) as path:
        ports: tuple[str | int, ...] = (path,) if name == "stream" else (rtu, tcp)
        assert succeed([built, *map(str, ports)]) == ""


@pytest.mark.full(seconds=1)
def test_the_programs_of_the_page_run(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    printed = []
    with server(FramerType.RTU, word=1) as rtu, server(word=1) as tcp, simulated("fronius_datamanager") as inverter:
        monkeypatch.setenv("RTU", f"127.0.0.1:{rtu}")
        monkeypatch.setenv("TCP", f"127.0.0.1:{tcp}")
        monkeypatch.setenv("INVERTER", f"127.0.0.1:{inverter.port}")
        monkeypatch.setenv("POINTS", str(tmp_path / "points.txt"))
        (tmp_path / "points.txt").write_text("A020\nrun_source\n", encoding="utf-8")
        for number in range(len(BLOCKS["rust"])):
            monkeypatch.setenv("PAGE", str(number))
            with serial_line(rtu) as path:  # programs keep a port to themselves
                monkeypatch.setenv("TTY", path)
                printed.append(succeed([project.parent / "built/pages"]).splitlines())
        monkeypatch.setenv("PAGE", str(next(at for at, found in enumerate(printed) if "it is one: None" in found)))
        inverter.values["manufacturer"] = "Another"
        for port in (inverter.port, tcp):  # of another maker, and without a block
            monkeypatch.setenv("INVERTER", f"127.0.0.1:{port}")
            assert succeed([project.parent / "built/pages"]) == "it is another device\n"
    first, serial, many, values, by_address, from_file, by_name, chosen, identified, failing, gateway, *printed = (
        printed
    )
    shared, own, tokio, anew, uart, genset = printed
    assert first == serial == anew == ["0.1 Hz"]
    assert shared == ["0.1", "0.1"]
    assert gateway == tokio == ["0.1"]
    assert own == ["> [01, 03, 10, 01, 00, 01, D1, 0A]", "0.1"]
    assert many == ["0.1 Hz", "0.1 A"]
    assert values == ["Modbus 500", "50 Ok(500)", "500", "inactive", "None"]
    assert by_address == ["Some(500)"]
    assert from_file == ["Base frequency: 50 Hz", "Run source: modbus "]
    assert by_name[:2] == ["base_frequency at 1028h: Some((0.0, 400.0)) Hz", "Number(50.0) 500"]
    assert {"output_frequency 0.1", "motor_current 0.1", "trip_count 1"} < set(by_name)
    assert chosen == ["base_frequency: 50"]
    assert identified == ["it is one: None"]
    assert failing[0] == "0.1"
    assert f"// {failing[1]}\n" in PAGE
    assert failing[2].endswith(" A")
    assert uart == ["Ok(0.7)"]
    assert genset == ["49.98 Hz", "49.98 Hz", "Ok(())"]


def test_the_readme_has_the_first_program() -> None:
    assert BLOCKS["rust"][0]["text"] in (ROOT / "README.md").read_text("utf-8")


@pytest.mark.full(seconds=1)
def test_vendored_crates_are_clean_with_all_features(project: Path) -> None:
    """The compiler that built the programs warns."""
    tool("rustfmt")
    features = tomllib.loads((project / "drivers/fieldscribe_runtime/Cargo.toml").read_text("utf-8"))["features"]
    drivers = tomllib.loads((project / "Cargo.toml").read_text("utf-8"))["dependencies"].values()
    assert {"default", *(name for one in drivers if "path" in one for name in one.get("features", ()))} == set(features)
    assert succeed([tool("cargo"), "fmt", *EACH_FAMILY, "--check"], cwd=project) == ""
    assert re.findall("--> drivers/.*", (project.parent / "stderr").read_text("utf-8")) == []


@pytest.mark.full(seconds=5)
def test_first_pages_run_and_have_no_warning_with_all_features(project: Path) -> None:
    """Those of the programs, which come along so that cargo builds nothing anew."""
    words = [
        "test",
        "--offline",
        "--quiet",
        "--doc",
        "--package",
        "programs",
        "--package",
        "hitachi_l200",
        *EACH_FAMILY,
    ]
    said = succeed([tool("cargo"), *words], cwd=project)
    assert "failed" not in said.replace("0 failed", "")
    assert "```no_run" in (project / "drivers/hitachi_l200/src/lib.rs").read_text("utf-8")


@pytest.mark.full(seconds=8)
def test_cargo_packages_the_crates(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Together, since no registry has the runtime; the only thing missing is where the sources are."""
    version = re.search(r"cargo 1\.(\d+)", succeed([tool("cargo"), "--version"]))
    if version is None or int(version[1]) < 90:
        pytest.skip("cargo before 1.90 packages one crate at a time, with what it needs in a registry")
    # Cargo unpacks the runtime into its home and would find there what an earlier run packaged.
    usual, home = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo")), tmp_path / "cargo"
    (home / "registry").mkdir(parents=True)
    for name in ("config.toml", "registry/index", "registry/cache"):
        if (usual / name).exists():
            (home / name).symlink_to(usual / name)
    monkeypatch.setenv("CARGO_HOME", str(home))
    monkeypatch.setenv("RUSTC_WORKSPACE_WRAPPER", "")  # clippy has seen them
    done = run([tool("cargo"), "package", "--offline", "--allow-dirty", *EACH_FAMILY], cwd=project)
    assert done.returncode == 0, done.stderr
    assert set(re.findall("^warning: (.*)$", done.stderr, re.MULTILINE)) == {
        "manifest has no documentation, homepage or repository"
    }
    assert done.stderr.count("Verifying ") == len(EACH_FAMILY) // 2


@pytest.mark.full(seconds=9)
def test_firmware_builds(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RUSTC_WORKSPACE_WRAPPER", "")  # clippy has seen it
    target = "thumbv6m-none-eabi"
    libraries = succeed([tool("rustc"), "--print", "target-libdir", "--target", target]).strip()
    if not os.path.isdir(libraries):
        pytest.skip(f"the library for {target} is missing: rustup target add {target}")
    for device, features in (
        ("jumo_controller", "embedded-io,embedded-io-async"),
        ("siemens_mm4", "embedded-io"),
        ("woodward_mpu2s", "embedded-can"),
    ):
        words = ["check", "--offline", "--quiet", "--target", target, "--package", device, "--features", features]
        assert succeed([tool("cargo"), *words], cwd=project) == ""


@pytest.mark.full(seconds=12)
def test_a_description_is_compiled_on_build(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Anew when it changed, and only then; without a registry."""
    assert main(["vendor", "rust", "hitachi_l200", "--out", str(tmp_path / "drivers"), "--points", "A020"]) == 0
    device = tmp_path / "device"
    shutil.copytree(ROOT / "descriptions/hitachi_l200", device / "descriptions/hitachi_l200")
    manifest = next(match["text"] for match in BLOCKS["toml"] if "[package]" in match["text"])
    for name, text in ({"Cargo.toml": manifest} | FILES).items():
        (device / name).parent.mkdir(exist_ok=True)
        (device / name).write_text(text, "utf-8")
    monkeypatch.setenv("FIELDSCRIBE", str(ROOT / ".venv/bin/fieldscribe"))
    monkeypatch.setenv("CARGO_TARGET_DIR", str(tmp_path / "target"))
    check = partial(run, [tool("cargo"), "check", "--offline", "--verbose", "--features", "std"], cwd=device)
    assert re.search("Running `.*rustc --crate-name hitachi_l200 ", check().stderr)
    assert "Fresh hitachi_l200" in check().stderr
    part = device / "descriptions/hitachi_l200/standard_a.yaml"
    good = part.read_text("utf-8")
    part.write_text(good.replace("name: base_frequency\n", "name: basic_frequency\n"), "utf-8")
    assert part.read_text("utf-8") != good
    assert "Dirty hitachi_l200" in check().stderr
    made = list((tmp_path / "target").rglob("rust/hitachi_l200/src/points.rs"))
    assert ["BasicFrequency of " in place.read_text("utf-8") for place in made] == [True]
    part.write_text(good.replace("at: 1028h", "at: 1028g"), "utf-8")
    refused = check()
    assert refused.returncode != 0
    assert "fieldscribe did not compile the description" in refused.stderr
    monkeypatch.setenv("FIELDSCRIBE", "no_such_program")
    assert "is fieldscribe on PATH, or in FIELDSCRIBE?" in check().stderr


def test_the_page_says_what_is_vendored() -> None:
    """The command and the dependency are those of the project that the test builds."""
    [command] = [match["text"].strip() for match in BLOCKS["sh"]]
    assert command == "fieldscribe vendor rust hitachi_l200 --out drivers"
    manifest = (TESTS / "rust/transports/Cargo.toml").read_text("utf-8")
    assert 'hitachi_l200 = { path = "drivers/hitachi_l200", features = ["std"' in BLOCKS["toml"][0]["text"]
    assert 'hitachi_l200 = { path = "drivers/hitachi_l200", features = ["std"' in manifest
