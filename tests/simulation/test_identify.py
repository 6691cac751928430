"""Who a simulated device says that it is: `identify` finds the device, its variants, and no other."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from importlib import import_module
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.simulation import simulated
from support.c_device import WARNINGS, write_headers
from support.described import described, kitchen_sink, loaded_in
from support.places import TESTS
from support.python_package import Slave, imported, write_package
from support.quick import full_but
from support.rust_workspace import rust_program
from support.toolchains import compiled, succeed

SINK = TESTS / "devices/kitchen_sink"
TOLD = ("fronius_datamanager",)
"""The devices whose manuals give something to tell them by."""
MODBUS = ("eastron_sdm630", "fronius_datamanager", "hitachi_l200", "jumo_controller", "nord_sk5xxe")
LINES = {**dict.fromkeys(MODBUS, ("tcp", "")), "siemens_mm4": ("serial", "uss://"), "woodward_mpu2s": ("can", "")}


@pytest.mark.parametrize("name", full_but(("hitachi_l200", *TOLD), LINES))
@pytest.mark.usefixtures("loads_once")
def test_each_device_is_itself_and_no_other(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    on, scheme = LINES[name]
    with simulated(name, on=on) as device:
        code = main(["identify", "--format", "json", "--line", scheme + device.url])
    found = json.loads(capsys.readouterr().out)
    assert (code, found["fits"]) == ((0, {name: {}}) if name in TOLD else (1, {}))
    assert (name in found["without_identify"]) == (name not in TOLD)


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize(("voltage", "model"), [*product(("230V", "400V"), ("small", "large"))])
def test_variants_are_what_was_simulated(voltage: str, model: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Texts and numbers, facts of the device and of variants about one point."""
    with simulated(SINK, on="tcp", variants=[f"voltage={voltage}", f"model={model}"]) as device:
        assert main(["identify", str(SINK), "--line", device.url]) == 0
    assert capsys.readouterr().out == f"it is kitchen_sink, voltage={voltage}, model={model}\n"


@pytest.fixture(scope="module")
def in_rust(rust_libraries: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[[int], list[str]]:
    """What the clients in Rust say of the device at a port: how many requests it took, and who it is."""
    crates = [rust_libraries / f"lib{crate}.rlib" for crate in ("fieldscribe_runtime", SINK.name)]
    program = rust_program(TESTS / "rust/identify.rs", tmp_path_factory.mktemp("rust") / "identify", *crates)
    return lambda port: succeed([program, f"127.0.0.1:{port}"]).splitlines()


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize(
    ("voltage", "model", "requests"), [("230V", "small", 4), ("230V", "large", 4), ("400V", "large", 5)]
)
def test_rust_finds_variants(in_rust: Callable[[int], list[str]], voltage: str, model: str, requests: int) -> None:
    """The client that blocks and those that do not; a point with several rows in turn is read once."""
    with simulated(SINK, on="tcp", variants=[f"voltage={voltage}", f"model={model}"]) as device:
        assert in_rust(device.port) == 3 * [f"{requests} voltage={voltage} model={model}"]


@pytest.mark.full(seconds=1)
def test_rust_knows_another_device(in_rust: Callable[[int], list[str]]) -> None:
    """By what a point holds, or by the refusal to read it; a variant that does not fit is left out."""
    with simulated(SINK, on="tcp", variants=["voltage=400V", "model=large"]) as device:
        device.values["control_mode"] = "idle"
        assert in_rust(device.port) == 3 * ["5 model=large"]
        device.values["model_name"] = "KS-3"
        assert in_rust(device.port) == 3 * ["2 it is another device by its model_name"]
    with simulated("hitachi_l200", on="tcp") as device:
        assert in_rust(device.port) == 3 * ["1 it is another device by its maker"]


@pytest.fixture(scope="module")
def in_c(tmp_path_factory: pytest.TempPathFactory) -> Callable[[int], str]:
    """What the call in C says of the device at a port: requests, status, if it is the one, variants, and a text."""
    folder = tmp_path_factory.mktemp("c")
    includes = write_headers(kitchen_sink(), folder) / "c"
    flags = ("-std=gnu99", *WARNINGS, f"-I{includes}")
    identify = compiled("gcc", flags, TESTS / "targets/c/programs/identify.c", folder / "identify")
    return lambda port: succeed([identify, str(port)])


@pytest.mark.parametrize(
    ("variants", "holds", "said"),
    [
        (("230V", "small"), {}, "4 ok 1 1 1 ok KS-1\n"),
        (("230V", "large"), {}, "4 ok 1 1 2 ok KS-2\n"),
        (("400V", "large"), {}, "5 ok 1 2 2 ok KS-2\n"),
        (("400V", "large"), {"control_mode": "idle"}, "5 ok 1 0 2 ok KS-2\n"),
        (("400V", "large"), {"model_name": "KS-3"}, "2 ok 0 0 0 ok KS-3\n"),
    ],
)
def test_c_finds_variants(
    in_c: Callable[[int], str], variants: tuple[str, str], holds: dict[str, str], said: str
) -> None:
    """In one call, as the clients in Python and Rust do."""
    voltage, model = variants
    with simulated(SINK, on="tcp", variants=[f"voltage={voltage}", f"model={model}"]) as device:
        for name, value in holds.items():
            device.values[name] = value
        assert in_c(device.port) == said


def test_c_knows_another_device(in_c: Callable[[int], str]) -> None:
    """By its refusal to read a point."""
    with simulated("hitachi_l200", on="tcp") as device:
        assert in_c(device.port) == "1 ok 0 0 0 exception \n"


TEXTS = described(
    "- {name: maker, at: 0, type: text, characters: 8, encoding: utf-8}\n"
    "- {name: line, at: 4, type: text, characters: 4, encoding: utf-16}\n",
    identify="{maker: Zürich}",
    variants="{series: {values: {a: {identify: {line: ä€}}, b: {identify: {line: ß}}}}}",
)
ZURICH = (0x5AC3, 0xBC72, 0x6963, 0x6820)
SERIES = {"a": (0xE4, 0x20AC, 0x20, 0x20), "b": (0xDF, 0x20, 0x20, 0x20)}


@pytest.fixture(scope="module")
def of_texts(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Path, Any]]:
    """The program in C and the package in Python that know a device by texts beyond ASCII."""
    folder = tmp_path_factory.mktemp("texts")
    device = loaded_in(folder, TEXTS)
    flags = ("-std=c99", *WARNINGS, f"-I{write_headers(device, folder) / 'c'}")
    program = compiled("gcc", flags, TESTS / "targets/c/programs/identify_texts.c", folder / "identify_texts")
    for package in imported(write_package(device, folder), "made_up"):
        yield program, package


@pytest.mark.parametrize(
    ("words", "in_c", "in_python"),
    [
        ((*ZURICH, *SERIES["a"]), "0 1 1", "{'series': 'a'}"),
        ((*ZURICH, *SERIES["b"]), "0 1 2", "{'series': 'b'}"),
        ((*ZURICH, 0xD800, 0, 0, 0), "0 1 0", "{}"),
        ((0x5AFC, 0x7269, 0x6368, 0x2020, *SERIES["a"]), "0 0 0", "maker: the words are no valid utf-8"),
    ],
)
def test_texts_beyond_ascii(of_texts: tuple[Path, Any], words: tuple[int, ...], in_c: str, in_python: str) -> None:
    """Words that are no text are another device, and no failure."""
    program, package = of_texts
    assert succeed([program, *(f"{word:x}" for word in words)]) == in_c
    slave = Slave()
    slave.words.update(enumerate(words))
    device = package.MadeUp(slave, unit=1)
    try:
        found = str(device.identify())
    except import_module("fieldscribe_runtime").OtherDeviceError as other:
        found = str(other)
    assert found.startswith(in_python)
