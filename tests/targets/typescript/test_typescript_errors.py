"""What is wrong with a reply is told in TypeScript as in Python, with both numbers where two do not agree."""

from __future__ import annotations

import json
from collections.abc import Iterator
from io import BytesIO
from typing import Any

import pytest
from support.places import ROOT
from support.python_package import imported, status
from support.toolchains import succeed, tool
from support.typescript_packages import install

PROGRAM = """
import { modbusProfile, modbusReplyShape, parseModbusReply } from "fieldscribe-runtime/modbus-frames";
import { ReplyReader } from "fieldscribe-runtime/receiving";
import { parseUssReply, ussProfile } from "fieldscribe-runtime/uss-frames";

const modbus = modbusProfile({ functions: { 1: 32, 3: 32, 5: 1, 6: 1, 16: 32 }, exceptions: { 2: "no_such_place" } });
const uss = ussProfile({ units: [0, 30], pkw: [0, 3, 4, 127], pzd: [0, 4], tasks: { 0: [0], 1: [1, 2] } });
function told([kind, asked, hex]) {
  const reply = Uint8Array.from(Buffer.from(hex.replaceAll(" ", ""), "hex"));
  try {
    if (kind === "uss") parseUssReply({ unit: 9, task: 1, parameter: 5 }, reply, uss, asked);
    else if (kind === "reader") {
      const reader = new ReplyReader(modbusReplyShape(Uint8Array.of(0, 1), asked, false));
      reader.take(reply) ?? reader.giveUp();
    }
    else parseModbusReply({ unit: 5, ...asked }, reply, modbus, kind, 7);
  } catch (error) {
    return [error.status, error.message];
  }
  return ["ok", ""];
}
console.log(JSON.stringify(JSON.parse(process.argv[2]).map(told)));
"""
READ = {"function": 3, "address": 40, "count": 2}
COILS = {"function": 1, "address": 40, "count": 9}
ONE = {"function": 6, "address": 40, "values": [500]}
COIL = {"function": 5, "address": 40, "values": [1]}
SEVERAL = {"function": 16, "address": 40, "values": [1, 2]}
LINK = {"pkw": 4, "pzd": 2}
ROWS: list[tuple[str, Any, str, str, str]] = [
    ("pdu", ONE, "05 06 0028 0007", "echo_mismatch", "500 was written to 0028h, but the device answered 7"),
    (
        *("pdu", ONE, "05 06 0029 01F4", "echo_mismatch"),
        "01F4h was written to 0028h, but the reply repeats 01F4h at 0029h",
    ),
    (
        *("pdu", COIL, "05 05 0028 0000", "echo_mismatch"),
        "FF00h was written to 0028h, but the reply repeats 0000h at 0028h",
    ),
    (
        *("pdu", SEVERAL, "05 10 0028 0003", "echo_mismatch"),
        "0002h was written to 0028h, but the reply repeats 0003h at 0028h",
    ),
    ("pdu", READ, "06 03 04 0001 0002", "wrong_unit", "unit 6 answered instead of 5"),
    ("pdu", READ, "05 84 02", "wrong_function", "the reply is to function 04h instead of 03h"),
    ("pdu", READ, "05 03 02 0001", "bad_byte_count", "the reply has 2 data bytes where 4 belong"),
    ("pdu", COILS, "05 01 01 01", "bad_byte_count", "the reply has 1 data bytes where 2 belong"),
    ("pdu", READ, "05 83 02", "exception", "the device answered exception 02h (no_such_place)"),
    ("pdu", READ, "05 83 04", "exception", "the device answered exception 04h (server_device_failure)"),
    (
        "pdu",
        READ,
        "05 83 0B",
        "exception",
        "the device answered exception 0Bh (gateway_target_device_failed_to_respond)",
    ),
    ("pdu", READ, "05 83 63", "exception", "the device answered exception 63h"),
    (
        "tcp",
        READ,
        "0008 0000 0007 05 03 04 0001 0002",
        "wrong_transaction",
        "the reply is to transaction 8 instead of 7",
    ),
    ("tcp", READ, "0007 0000 0006 05 03 04 0001 00", "bad_byte_count", "the reply has 3 data bytes where 4 belong"),
    ("tcp", READ, "0007 0000 0007 05 03 04 0001", "short_frame", "the reply has 11 bytes where 13 belong"),
    ("tcp", READ, "0007 0000 0003 05 03 04 0001", "long_frame", "the reply has 11 bytes where 9 belong"),
    (
        *("reader", "tcp", "0001 0000 0200 05 03 04", "long_frame"),
        "9 bytes came (00 01 00 00 02 00 05 03 04): the reply would have 518 bytes, and a frame has at most 260",
    ),
    ("reader", "tcp", "0001 0000", "timeout", "4 bytes came (00 01 00 00), which are no reply"),
    ("reader", "rtu", "00 03 02", "timeout", "3 bytes came (00 03 02), which are no reply; is the baud rate right?"),
    (
        *("uss", LINK, "02 0A 09 1005 0000 0001 0000 1D", "wrong_length"),
        "the reply has 12 bytes where 16 belong: is the link of the device set so?",
    ),
    (
        *("uss", {"pkw": 127, "pzd": 4}, "02 0A 09 1005 0000 0001 0000 1D", "wrong_length"),
        "the reply has 12 bytes where at least 18 belong: is the link of the device set so?",
    ),
    ("uss", LINK, "02 0E 09 1005 0000 0001 0000 1D", "wrong_length", "12 bytes are no whole reply"),
    (
        *("uss", {"pkw": 4, "pzd": 0}, "02 0A 09 3005 0000 0001 0000 35", "wrong_response"),
        "response 3 does not belong to task 1",
    ),
]


@pytest.fixture(scope="module")
def told(tmp_path_factory: pytest.TempPathFactory) -> list[list[str]]:
    """The status and the message of each row in TypeScript."""
    folder = tmp_path_factory.mktemp("errors")
    install(folder)
    (folder / "program.mjs").write_text(PROGRAM, "utf-8")
    found: list[list[str]] = json.loads(
        succeed([tool("node"), "program.mjs", json.dumps([row[:3] for row in ROWS])], cwd=folder)
    )
    return found


@pytest.fixture(scope="module")
def runtime() -> Iterator[Any]:
    """The frames of Modbus and USS in Python."""
    for _ in imported(ROOT / "generated/python", "fieldscribe_runtime"):
        from fieldscribe_runtime import modbus, uss

        yield modbus.frames, uss.frames


@pytest.mark.parametrize("row", range(len(ROWS)), ids=[f"{kind} {hexadecimal}" for kind, _, hexadecimal, *_ in ROWS])
def test_a_wrong_reply(told: list[list[str]], runtime: Any, row: int) -> None:
    kind, asked, hexadecimal, expected, text = ROWS[row]
    assert told[row] == [expected, text]
    modbus, uss = runtime
    reply = bytes.fromhex(hexadecimal)
    if kind == "uss":
        profile = uss.Profile((0, 30), (0, 3, 4, 127), (0, 4), {0: (0,), 1: (1, 2)})
        assert status(uss.parse, uss.Request(9, 1, 5), reply, profile, uss.Link(**asked)) == (expected, text)
    elif kind == "reader":
        with pytest.raises(TimeoutError if expected == "timeout" else modbus.FrameError) as error:
            modbus.receive(BytesIO(reply).read, b"\0\1", asked)
        assert str(error.value) == text
    else:
        functions = {1: 32, 3: 32, 5: 1, 6: 1, 16: 32}
        profile = modbus.Profile(functions, exceptions={2: "no_such_place"})
        request = modbus.Request(5, **{key: tuple(one) if key == "values" else one for key, one in asked.items()})
        assert status(modbus.parse, request, reply, profile, kind, 7) == (expected, text)
