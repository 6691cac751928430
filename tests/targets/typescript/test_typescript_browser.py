"""Generated TypeScript in Chromium: all vectors pass, as modules and as one classic script without any module."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from fieldscribe.resources import render
from fieldscribe.targets import vectors
from support.described import kitchen_sink, made
from support.places import ROOT
from support.toolchains import NODE_MODULES, npm_package, succeed, tool
from support.typescript_packages import SHIPPED, install
from support.vector_file import counts_of

BOTH = ("modules", "classic")
PROGRAM = Path(__file__).with_name("programs") / "browser.mjs"


@pytest.mark.full(seconds=20)
def test_every_vector_passes_in_a_browser(tmp_path: Path) -> None:
    """The kitchens in both forms, the seven devices as modules: their pages run them as classic scripts."""
    files = {path.stem: path for path in sorted((ROOT / "generated/vectors").glob("*.txt"))}
    shipped = [SHIPPED / name for name in files]
    forms = dict.fromkeys(files, ("modules",))
    others = [made("kitchen_blocks"), made("kitchen_can"), made("kitchen_uss"), made("kitchen_codes"), kitchen_sink()]
    modules = install(tmp_path, [*shipped, *others])
    for device in others:
        files[device.id] = tmp_path / f"{device.id}.txt"
        files[device.id].write_text(next(iter(vectors.outputs(device, render)))[1], encoding="utf-8")
    npm_package("playwright-core")
    pairs = [f"{name.replace('_', '-')}={path}={','.join(forms.get(name, BOTH))}" for name, path in files.items()]
    browser = tool("chromium-headless-shell")
    found = json.loads(succeed([tool("node"), PROGRAM, browser, NODE_MODULES, modules, *pairs]))
    for name, path in files.items():
        expected = {kind: n for kind, n in counts_of(path.read_text("utf-8"), "typescript").items() if n}
        for form in forms.get(name, BOTH):
            result = found[f"{name.replace('_', '-')} {form}"]
            assert not result["failed"], (name, form, result["shown"])
            assert result["passed"] == expected, (name, form)
