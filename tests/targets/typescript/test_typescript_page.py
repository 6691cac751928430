"""Every program on the page for TypeScript compiles strictly, and runs as it stands there on a simulated drive."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from fieldscribe.simulation import simulated
from support.node_device import installed
from support.places import ROOT
from support.toolchains import succeed, tool
from support.typescript_packages import compile_types

PAGE = (ROOT / "descriptions/using/typescript.md").read_text("utf-8")
BLOCKS = re.findall(r"^```typescript\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)


@pytest.mark.full(seconds=3)
def test_the_programs_compile(tmp_path: Path) -> None:
    installed(tmp_path)
    (tmp_path / "page.ts").write_text("declare const console: { log(...of: unknown[]): void };\n" + "\n".join(BLOCKS))
    (tmp_path / "package.json").write_text('{"type": "module"}', "utf-8")
    options = {"target": "ES2022", "module": "nodenext", "lib": ["ES2020"], "strict": True, "types": []}
    (tmp_path / "tsconfig.json").write_text(json.dumps({"compilerOptions": options, "files": ["page.ts"]}), "utf-8")
    assert compile_types(tmp_path) == ""


def test_the_programs_run(tmp_path: Path) -> None:
    """They are JavaScript as they stand, too."""
    installed(tmp_path)
    with (
        simulated("hitachi_l200", on="serial", variants=["voltage_class=400V"]) as drive,
        simulated("fronius_datamanager") as inverter,
    ):
        text = "\n".join(BLOCKS).replace("/dev/ttyUSB0", str(drive.path)).replace("192.168.0.20", "127.0.0.1")
        (tmp_path / "page.mjs").write_text(text.replace("port: 502 ", f"port: {inverter.port} "), "utf-8")
        printed = succeed([tool("node"), "page.mjs"], cwd=tmp_path).splitlines()
    assert printed[:3] == ["50 Hz", "50 500 50 Hz", "50"]
    assert "500n" in printed
    assert "run 1" in printed
    assert printed[-2].startswith(
        "out_of_range A020 base_frequency 1000 A020 base_frequency: 1000 Hz is outside 0..400"
    )
    assert printed[-1] == "{}"


def test_the_first_program_is_short() -> None:
    assert len([line for line in BLOCKS[0].splitlines() if line]) <= 9
