"""What points of generated TypeScript know without a device: ends, words, bytes, and what is wrong with a value."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from support.described import made
from support.toolchains import succeed, tool
from support.typescript_packages import install

PROGRAM = """
import { KitchenSink } from "kitchen-sink";
import { KitchenCodes } from "kitchen-codes";
import { KitchenCan } from "kitchen-can";
function why(work) {
  try {
    return work();
  } catch (error) {
    return error.message;
  }
}
const [sink, codes, can] = [KitchenSink, KitchenCodes, KitchenCan].map((one) => Object.fromEntries(one.table.points));
function told(expression) {
  try {
    const value = new Function("sink", "codes", "can", "why", `return ${expression}`)(sink, codes, can, why);
    return typeof value === "bigint" ? `${value}n` : value === undefined ? null : value;
  } catch (error) {
    return error.status ?? String(error);
  }
}
console.log(JSON.stringify(JSON.parse(process.argv[2]).map(told)));
"""
ROWS: list[tuple[str, Any]] = [
    ("[sink.plainU16.access, sink.writeOnly_.access, sink.doorOpen.access]", ["rw", "w", "r"]),
    ("[sink.plainS16.minimum, sink.plainS16.maximum]", [-32768, 32767]),
    ("[sink.ratio.minimum, sink.ratio.maximum]", [0, 100]),
    ("[sink.plainF32.minimum, sink.plainF32.maximum, sink.openF32.minimum ?? 'none']", [-100.5, 100.5, "none"]),
    ("codes.lowerLimit.maximum ?? 'none'", 400),
    ("codes.byBand.maximum ?? 'none'", "none"),
    ("can.faultText1.maximum ?? 'none'", "none"),
    ("sink.plainU16.fromWords(5)", "wrong_type"),
    ("sink.plainU32.fromWords([1])", "wrong_length"),
    ("sink.plainU16.encode(65536)", "out_of_range"),
    ("sink.plainU16.toWords(65536)", "out_of_range"),
    ("sink.plainU16.toWords(-1)", "out_of_range"),
    ("sink.plainU16.encode(1.5)", "out_of_range"),
    ("sink.plainU16.encode('5')", "wrong_type"),
    ("sink.plainS16.decode(32768)", "out_of_range"),
    ("sink.plainF32.decodeCount(0)", "wrong_type"),
    ("can.faultText1.decodeCount(0n)", "wrong_type"),
    ("can.faultText1.encode('x'.repeat(17))", "out_of_range"),
    ("can.faultText1.encode(7)", "out_of_range"),
    ("can.faultText1.encode('\\u20ac')", "out_of_range"),
    ("can.inputDelays.encode(7)", "wrong_type"),
    ("can.inputDelays.encode([1])", "wrong_length"),
    ("can.started.encode('soon')", "wrong_type"),
    ("can.started.encode(new Date(NaN))", "wrong_type"),
    ("can.nodeKey.encode('00:11:22:33:44')", "out_of_range"),
    ("codes.upperLimit.encode('inactive')", "wrong_type"),
    ("codes.lowerLimit.encode('inactive', { upperLimit: 100 })", "wrong_type"),
    (
        "why(() => codes.upperLimit.encode('inactive'))",
        "upper_limit: takes a number or a special code, as in special.inactive, not 'inactive'",
    ),
    (
        "why(() => codes.lowerLimit.encode('by_input'))",
        "lower_limit: takes a number or a special code, as in special.name, not 'by_input'",
    ),
    (
        "why(() => can.commandNumber.check(0xff))",
        "command_number: raw 255 has not 8000h in the bits 8000h, as it must",
    ),
    ("codes.upperLimit.decode(0).name", "inactive"),
    ("String(codes.voltage.decode(0xfff4))", "transducer_fault"),
    ("codes.mode.encode(9)", "unknown_value"),
    ("can.relayFlags.encode({ horn: true, mode: 1 })", "wrong_type"),
    ("can.relayFlags.encode({ mode: 4 })", "wrong_type"),
    ("sink.plainU16.decodeBytes(Uint8Array.of(1, 2, 3), 1)", 515),
    ("sink.plainU16.decodeBytes(Uint8Array.of(1, 2, 3), 2)", "wrong_length"),
    ("sink.plainS16.decodeBytes(Uint8Array.of(0xff, 0xfe))", -2),
    ("sink.plainU32.decodeBytes(Uint8Array.of(9, 1, 2, 3, 4), 1)", 16909060),
    ("sink.energyTotal.encode(1)", "wrong_type"),
    ("sink.batchKind.decode(-4294967296n)", "-4294967296n"),
    ("sink.makerCode.nameOf(0xfffffffe)", "last_maker"),
]


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> list[Any]:
    """What each expression of the rows is, or the error that it raises."""
    folder: Path = tmp_path_factory.mktemp("codecs")
    install(folder, [made(name) for name in ("kitchen_sink", "kitchen_codes", "kitchen_can")])
    (folder / "program.mjs").write_text(PROGRAM, "utf-8")
    expressions = json.dumps([expression for expression, _ in ROWS])
    found: list[Any] = json.loads(succeed([tool("node"), "program.mjs", expressions], cwd=folder))
    return found


@pytest.mark.parametrize("row", range(len(ROWS)), ids=[expression for expression, _ in ROWS])
def test_a_point(answers: list[Any], row: int) -> None:
    assert answers[row] == ROWS[row][1]
