"""Files that tests write: their own, and those of targets with the runtime beside them."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType

from fieldscribe.model import Device
from fieldscribe.resources import render, templates_dir
from fieldscribe.targets import Target

from support.places import ROOT


def write_files(texts: Mapping[str, str], out: Path) -> Path:
    """Write files, text or bytes, by their paths in a folder; return the folder."""
    out.mkdir(parents=True, exist_ok=True)
    for path, text in texts.items():
        (out / path).parent.mkdir(parents=True, exist_ok=True)
        (out / path).write_bytes(text.encode("utf-8", "surrogatepass"))
    return out


def copy_compiler(package: Path) -> Path:
    """Copy the compiler's package with the bytecode that Python has of it, which is as new as its sources."""
    source = ROOT / "generator/fieldscribe"
    shutil.copytree(source, package)
    if sys.pycache_prefix:
        kept, place = (Path(sys.pycache_prefix, *folder.parts[1:]) for folder in (source, package))
        if kept.is_dir():
            shutil.copytree(kept, place, ignore=shutil.ignore_patterns("*.pyc.*"))
    return package


def generate(device: Device, out: Path, *targets: ModuleType) -> Path:
    """Write the outputs of these targets for a device, and their runtimes; return the folder."""
    for target in map(Target, targets):
        copies = {path: (templates_dir() / source).read_text("utf-8") for path, source in target.runtime(device)}
        write_files({**dict(target.outputs(device, render)), **copies}, out)
    return out
