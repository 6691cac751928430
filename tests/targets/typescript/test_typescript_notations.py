"""Bytes in the notation of people: in TypeScript the same as in the generator."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fieldscribe.arithmetic import texts as notations
from support.notation_rows import BYTES, NONE
from support.toolchains import succeed, tool
from support.typescript_packages import install

PROGRAM = """
import { bytes, holding, readWrite } from "fieldscribe-runtime";
function held([notation, text, count]) {
  const words = Array.from({ length: Math.ceil(count / 2) }, (_, at) => at);
  const point = readWrite(bytes(count, notation), { name: "held", at: holding(...words), group: "all" });
  try {
    const raw = point.encode(text);
    return [BigInt(raw).toString(16), point.decode(raw)];
  } catch (error) {
    return [error.status];
  }
}
console.log(JSON.stringify(JSON.parse(process.argv[2]).map(held)));
"""


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> list[Any]:
    """What the runtime says of all rows: the bytes as a number and their text, or the status."""
    folder = tmp_path_factory.mktemp("notations")
    install(folder)
    (folder / "program.mjs").write_text(PROGRAM, "utf-8")
    rows = [*((notation, text, len(held) // 2) for notation, text, held in BYTES), *NONE]
    found: list[Any] = json.loads(succeed([tool("node"), "program.mjs", json.dumps(rows)], cwd=folder))
    return found


@pytest.mark.parametrize("row", range(len(BYTES)), ids=[text for _, text, _ in BYTES])
def test_bytes(answers: list[Any], row: int) -> None:
    notation, _, held = BYTES[row]
    assert answers[row] == [f"{int(held, 16):x}", notations.notated(notation, bytes.fromhex(held))]


@pytest.mark.parametrize("row", range(len(NONE)), ids=[f"{notation} {text[:20]}" for notation, text, _ in NONE])
def test_what_is_none(answers: list[Any], row: int) -> None:
    assert answers[len(BYTES) + row] == ["out_of_range"]
