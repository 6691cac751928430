"""Packages of the TypeScript target as npm would install them: beside the runtime, in a folder `node_modules`."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterable
from pathlib import Path

from fieldscribe.model import Device
from fieldscribe.resources import render, templates_dir
from fieldscribe.targets import typescript

from support.files import write_files
from support.places import ROOT
from support.toolchains import NODE_MODULES, npm_program, succeed

RUNTIME = templates_dir() / "typescript/runtime"
SHIPPED = ROOT / "generated/typescript"
RUNNER = Path(__file__).with_name("run_vectors.mjs")


def install(folder: Path, packages: Iterable[Path | Device] = ()) -> Path:
    """Install packages, generated ones or those of a model, with the runtime; return the folder of modules."""
    modules = folder / "node_modules"
    runtime = Path(os.environ.get("FIELDSCRIBE_PACKAGES") or RUNTIME)  # a changed one, where mutants are judged
    for name in ("fieldscribe-runtime", "fieldscribe-conformance"):
        shutil.copytree(runtime / name, modules / name, dirs_exist_ok=True)
    for package in packages:
        if isinstance(package, Path):
            shutil.copytree(package, modules / package.name.replace("_", "-"), dirs_exist_ok=True)
        else:
            texts = dict(typescript.outputs(package, render))
            write_files({path.split("/", 2)[2]: text for path, text in texts.items()}, modules / package_name(package))
    return modules


def package_name(device: Device) -> str:
    """Return what the package of a device is called."""
    return device.id.replace("_", "-")


def compile_types(folder: Path, *options: str) -> str:
    """Check the TypeScript programs of a folder without output; return what the compiler says."""
    return succeed([*npm_program("typescript", "bin/tsc"), "--noEmit", "-p", folder, *options])


def declarations(folder: Path) -> dict[str, str]:
    """Return the types of the runtime by file, as the compiler reads them out of the comments, strictly checked.

    Types that are written by hand are checked with the programs of users.
    """
    written = ("index", "types")  # their types are written by hand
    for path in (RUNTIME / "fieldscribe-runtime").iterdir():
        if (path.suffix == ".js") != (path.name.partition(".")[0] in written):
            shutil.copy(path, folder)
    (folder / "node_modules").symlink_to(NODE_MODULES)
    options = {"target": "ES2020", "module": "nodenext", "lib": ["ES2021", "DOM"], "strict": True, "types": ["node"]}
    options |= {"allowJs": True, "checkJs": True, "declaration": True, "emitDeclarationOnly": True, "outDir": "types"}
    options |= {"noUnusedLocals": True, "noImplicitReturns": True, "skipLibCheck": True}
    (folder / "package.json").write_text('{"type": "module"}', "utf-8")
    (folder / "tsconfig.json").write_text(json.dumps({"compilerOptions": options, "include": ["*.js"]}), "utf-8")
    succeed([*npm_program("typescript", "bin/tsc"), "-p", folder])
    return {path.name: path.read_text("utf-8") for path in sorted((folder / "types").iterdir())}
