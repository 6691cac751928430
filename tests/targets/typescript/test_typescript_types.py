"""What type checkers, bundlers and npm make of the packages.

After a change of the runtime say `FIELDSCRIBE_ACCEPT=1 pytest tests/targets/typescript/test_typescript_types.py`, which
writes its types anew.
"""

from __future__ import annotations

import json
import os
import re
import shutil
from collections import Counter
from pathlib import Path

import pytest
from support.toolchains import npm_package, npm_program, succeed, tool
from support.typescript_packages import RUNTIME, SHIPPED, compile_types, declarations, install

PROGRAMS = Path(__file__).parent / "programs"
SOURCES = RUNTIME / "fieldscribe-runtime"
DEVICES = sorted(path for path in SHIPPED.iterdir() if path.name != "fieldscribe-runtime")
STRICT = {"strict": True, "exactOptionalPropertyTypes": True, "noUncheckedIndexedAccess": True}


@pytest.mark.full(seconds=6)
def test_the_types_of_the_runtime_are_current(tmp_path: Path) -> None:
    """The compiler checks its sources strictly, and makes the types of them that lie beside."""
    for name, text in declarations(tmp_path).items():
        if os.environ.get("FIELDSCRIBE_ACCEPT"):
            (SOURCES / name).write_text(text, "utf-8")
        assert (SOURCES / name).read_text("utf-8") == text, name


@pytest.mark.full(seconds=3)
def test_programs_of_users(tmp_path: Path) -> None:
    """All devices in one program under the strictest settings, with what must not compile."""
    install(tmp_path, DEVICES)
    shutil.copy(PROGRAMS / "types.ts", tmp_path)
    (tmp_path / "package.json").write_text('{"type": "module"}', "utf-8")
    options = {
        "target": "ES2020",
        "lib": ["ES2020"],
        "module": "nodenext",
        "types": [],
        "skipDefaultLibCheck": True,
        **STRICT,
    }
    (tmp_path / "tsconfig.json").write_text(json.dumps({"compilerOptions": options, "files": ["types.ts"]}), "utf-8")
    assert compile_types(tmp_path) == ""


@pytest.mark.full(seconds=5)
@pytest.mark.parametrize("package", ["fieldscribe-runtime", "siemens-mm4"])
def test_packages_as_npm_packs_them(package: str, tmp_path: Path) -> None:
    modules = install(tmp_path, DEVICES)
    succeed([tool("npm"), "pack", "--offline", "--silent", modules / package], cwd=tmp_path)
    [packed] = tmp_path.glob("*.tgz")
    assert "All good!" in succeed([*npm_program("publint", "src/cli.js"), "run", packed, "--strict"])
    profile = ("--profile", "esm-only", "--no-color", "--no-emoji")
    succeed([*npm_program("@arethetypeswrong/cli", "dist/index.js"), packed, *profile])


def test_modules_need_nothing_newer_than_es2020(tmp_path: Path) -> None:
    """Nothing is left for a compiler to do that writes modules for ES2020."""
    files = [path for folder in SHIPPED.iterdir() for path in folder.glob("*.js")]
    targets = ("es2020", "esnext")
    for target in targets:
        options = (f"--outbase={SHIPPED}", f"--outdir={tmp_path / target}", f"--target={target}", "--log-level=error")
        succeed([npm_package("esbuild") / "bin/esbuild", *files, *options])
    old, new = (
        {path.relative_to(tmp_path / target): path.read_text("utf-8") for path in (tmp_path / target).rglob("*.js")}
        for target in targets
    )
    assert len(old) == len(files)
    assert old == new


def test_bundles_hold_what_is_used(tmp_path: Path) -> None:
    """A program of one point brings its codec, and neither other points, other forms nor a client."""
    install(tmp_path, DEVICES)
    program = 'import { baseFrequency } from "hitachi-l200";\nconsole.log(baseFrequency.decode(500));\n'
    (tmp_path / "program.mjs").write_text(program, "utf-8")
    options = ("--bundle", "--format=esm", "--minify-syntax", "--log-level=error")
    bundle = succeed([npm_package("esbuild") / "bin/esbuild", "program.mjs", *options], cwd=tmp_path)
    assert "base_frequency" in bundle
    assert not re.findall(r"carrier_frequency|class HitachiL200|ipv6|modbusProfile", bundle)


def test_one_name_means_one_thing() -> None:
    """Documentation joins all modules into one scope: no two of them define a name."""
    defined = re.compile(r"^(?:export )?(?:async )?(?:function\*?|class|const|let) \[?(\w+)", re.MULTILINE)
    sources = [path for folder in RUNTIME.iterdir() for path in folder.glob("*.js")]
    names = Counter(name for path in sources for name in set(defined.findall(path.read_text("utf-8"))))
    assert [name for name, count in names.items() if count > 1] == []
