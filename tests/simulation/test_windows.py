"""A simulated device whose window means what a page and an index select, and clients that follow them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

import pytest
from fieldscribe.live.connection import device_class
from fieldscribe.simulation import Simulated, simulated
from fieldscribe_runtime import FieldscribeError
from fieldscribe_runtime.transports.tcp import TcpLine
from support.c_device import WARNINGS, write_headers
from support.described import kitchen_sink
from support.foreign_clients import Ask, Refused, pymodbus
from support.modbus_points import SINK
from support.node_device import NodeError, installed, node_device
from support.rust_workspace import rust_program
from support.toolchains import compiled, succeed
from support.typescript_packages import install
from support.windows import HELD, INDEX, PAGE, SENT, VALUES, WINDOW, by_pymodbus, over_tcp

PROGRAMS = Path(__file__).parent / "programs"

DELAYS = [f"input_delay_index_{index}" for index in (1, 2, 3)]


@pytest.fixture
def sink() -> Iterator[Simulated]:
    with simulated(SINK) as device:
        device.values.update(zip(DELAYS, (1.0, 2.0, 3.0), strict=True))
        device.values["output_mode"] = "on"
        yield device


@pytest.fixture
def ask(sink: Simulated) -> Iterator[Ask]:
    with pymodbus(sink, "tcp") as asking:
        yield asking


def test_a_window_answers_what_is_selected(sink: Simulated, ask: Ask) -> None:
    for page, index, held in ((1, 10, 10), (1, 12, 30), (2, 12, 1), (1, 12, 30)):
        ask(6, PAGE, [page])
        ask(6, INDEX, [index])
        assert ask(3, WINDOW, [1]) == [held]
    ask(6, WINDOW, [45])
    assert [sink.values[name] for name in DELAYS] == [1, 2, 4.5]
    assert ask(3, WINDOW, [3])[0] == 45
    sink.values[DELAYS[2]] = 5
    assert ask(3, WINDOW, [1]) == [50]


def test_without_a_selection_a_read_is_zero_and_a_write_is_refused(sink: Simulated, ask: Ask) -> None:
    ask(6, PAGE, [0])
    assert ask(3, WINDOW, [3]) == [0, 0, 0]
    with pytest.raises(Refused):
        ask(6, WINDOW, [1])


def test_a_strict_device_refuses_what_is_not_selected() -> None:
    absent = "input_delay_index_1 exists only when page == inputs and array_index == 10"
    with pytest.raises(AssertionError, match=absent), simulated(SINK, strict=True) as device:
        _goes_by_pages(device)


def _goes_by_pages(device: Simulated) -> None:
    with pymodbus(device, "tcp") as ask:
        ask(6, PAGE, [0])
        with pytest.raises(Refused):
            ask(3, WINDOW, [1])
        ask(6, PAGE, [2])
        assert ask(3, WINDOW, [1]) == [device.values["output_mode"] == "on"]


@contextmanager
def simulated_registers() -> Iterator[tuple[int, list[tuple[int, int]]]]:
    """Yield the port of a simulated device that holds the same, and what was written."""
    sent: list[tuple[int, int]] = []

    def take(record: str) -> None:
        request = bytes.fromhex(json.loads(record).get("request", ""))
        if request[7:8] == b"\6":
            sent.append((int.from_bytes(request[8:10], "big"), int.from_bytes(request[10:12], "big")))

    with simulated(SINK, framing="tcp", trace=take) as device:
        held = zip(DELAYS, (1.0, 2.0, 3.0), strict=True)
        device.values.update({**dict(held), "input_counter_index_2": 102, "output_mode": "on"})
        yield device.port, sent


SERVERS = {"by hand": over_tcp, "pymodbus": by_pymodbus, "simulated": simulated_registers}
Server = Callable[[], AbstractContextManager[tuple[int, list[tuple[int, int]]]]]


@pytest.fixture(params=SERVERS)
def server(request: pytest.FixtureRequest) -> Server:
    return SERVERS[request.param]


def said(call: Callable[..., Any]) -> Iterator[str]:
    """Yield what a client does in the order of the programs: `call` takes a point and a method."""
    steps = (
        *((2, "read_raw", ()), ("input_counter_index_2", "read_raw", ()), ("page", "read_raw", ())),
        *((2, "read_raw", ()), (3, "write_raw", (45,)), ("output_mode", "read_raw", ()), (3, "read_raw", ())),
        *(("page", "write_raw", (0,)), (3, "read_raw", ()), (1, "write_raw", (501,)), (3, "read_raw", ())),
        *(("", "read_at", ("holding", 0x7FFF)), (3, "read_raw", ())),
    )
    for point, method, arguments in steps:
        name = f"input_delay_index_{point}" if isinstance(point, int) else point
        try:
            found = call(name, method, *arguments)
        except (FieldscribeError, NodeError) as error:
            yield str(error.status)
        else:
            yield "ok" if method == "write_raw" else f"ok {found}"


def test_python(server: Server) -> None:
    with server() as (port, sent), TcpLine("127.0.0.1", port) as line:
        kind: Any = device_class(kitchen_sink())
        device = kind(line, 1)

        def call(name: str, method: str, *given: Any) -> Any:
            return getattr(getattr(device, name) if name else device, method)(*given)

        assert [*said(call)] == HELD
    assert sent == SENT


@pytest.mark.full(seconds=2)
def test_typescript(server: Server, tmp_path: Path) -> None:
    folder = installed(tmp_path)
    install(folder, [kitchen_sink()])
    names = {"read_raw": "readRaw", "write_raw": "writeRaw", "read_at": "readAt"}
    with (
        server() as (port, sent),
        node_device(folder, "kitchen_sink", {"kind": "tcp", "port": port, "framing": "tcp"}, unit=1) as node,
    ):
        found = [*said(lambda name, method, *given: node(name or None, names[method], *given))]
        assert found == HELD
    assert sent == SENT


@pytest.fixture(scope="module")
def in_c(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("windows")
    flags = ("-std=c99", "-D_POSIX_C_SOURCE=200809L", *WARNINGS[:3], "-Werror")
    headers = write_headers(kitchen_sink(), folder) / "c"
    return compiled("gcc", (*flags, f"-I{headers}"), PROGRAMS / "windows.c", folder / "windows")


def test_c(in_c: Path, server: Server) -> None:
    with server() as (port, sent):
        assert succeed([in_c, str(port)]).splitlines() == HELD
    assert sent == SENT


@pytest.fixture(scope="module")
def in_rust(rust_libraries: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    crates = [rust_libraries / f"lib{crate}.rlib" for crate in ("fieldscribe_runtime", "kitchen_sink")]
    return rust_program(PROGRAMS / "windows.rs", tmp_path_factory.mktemp("windows") / "windows", *crates)


@pytest.mark.full(seconds=2)
@pytest.mark.parametrize("how", ["blocking", "async", "local", "by name"])
def test_rust(in_rust: Path, server: Server, how: str) -> None:
    with server() as (port, sent):
        printed = succeed([in_rust, str(port), how]).splitlines()
    assert (printed, sent) == (VALUES if how == "by name" else HELD, SENT)
