"""Devices made from the model are those of the generated packages: each fact, each class, and what vectors say."""

from __future__ import annotations

import enum
import subprocess
import sys
from collections.abc import Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from types import BuiltinFunctionType, FunctionType, MethodType, ModuleType
from typing import Any

import pytest
from fieldscribe.live.connection import device_class
from fieldscribe.model import Device
from fieldscribe.resources import use_python_runtime
from support.async_classes import async_device_class
from support.described import SHIPPED, kitchen_sink, made, shipped
from support.files import write_files
from support.models import sample_device
from support.places import PACKAGES, ROOT, TESTS
from support.python_package import imported, write_package
from support.quick import full_but
from support.rust_crates import odd_device

MADE = [made("kitchen_blocks"), made("kitchen_can"), made("kitchen_codes"), made("kitchen_uss"), kitchen_sink()]
MADE += [made("odd_names"), odd_device(), sample_device()]


@pytest.mark.parametrize("name", full_but(("hitachi_l200",), SHIPPED))
def test_shipped_devices_are_those_of_their_packages(name: str) -> None:
    same_as_generated(shipped(name), PACKAGES)


@pytest.mark.parametrize("device", full_but(MADE[-1:], MADE), ids=lambda device: str(device.id))
def test_other_devices_are_those_of_their_packages(device: Device, tmp_path: Path) -> None:
    same_as_generated(device, write_package(device, tmp_path))


PACKAGE = """
from pathlib import Path
from fieldscribe.live.connection import device_class
from fieldscribe.pipeline import load_device
from fieldscribe.diagnostics import Report
from support.async_classes import async_device_class

_device = load_device(Path({path!r}), Report())
Live = device_class(_device)
LiveAsync = async_device_class(_device, Live)
for _each in (Live, LiveAsync):
    _each.__init__.__annotations__.update(dict.fromkeys(_device.variants))
__version__, __digest__ = _device.version, _device.digest
"""


@pytest.mark.full(seconds=2)
@pytest.mark.parametrize("name", ["hitachi_l200", "nord_sk5xxe", "siemens_mm4", "woodward_mpu2s"])
def test_every_vector_passes(name: str, tmp_path: Path) -> None:
    """Against a package that makes the device as it is imported: one of each family, and one with addresses by rule."""
    text = PACKAGE.format(path=str(ROOT / "descriptions" / name / "device.yaml"))
    write_files({f"{name}/__init__.py": text, f"{name}/points.py": ""}, tmp_path)
    vectors = ROOT / f"generated/vectors/{name}.txt"
    command = [sys.executable, str(TESTS / "conformance"), str(tmp_path), name, str(vectors)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    total = done.stdout.rpartition("total ")[2]
    failed = [line for line in done.stderr.splitlines() if "'kind': 'runtime'" not in line]  # files of code, pickles
    assert not failed, total
    assert int(total.partition(" ")[0]) > 100


def same_as_generated(device: Device, folder: Path) -> None:
    """Compare both classes of a device with those of its package."""
    live = [facts_of(device_class(device)), facts_of(async_device_class(device))]
    with contextmanager(imported)(folder, device.id) as package:
        kinds = [kind for kind in vars(package).values() if isinstance(kind, type) and hasattr(kind, "POINTS")]
        for found, expected in zip(live, map(facts_of, kinds), strict=True):
            assert not {name: (found.get(name), fact) for name, fact in expected.items() if found.get(name) != fact}
            assert found == expected


def facts_of(kind: Any) -> dict[str, Any]:
    """All that a class says beside the classes of the runtime, its points in order."""
    own = [
        base for base in kind.__mro__ if not base.__module__.startswith(("fieldscribe_runtime", "builtins", "typing"))
    ]
    members = {name: member for base in own for name, member in vars(base).items() if not name.startswith("__")}
    first = next(base.__name__ for base in kind.__mro__ if base.__module__.startswith("fieldscribe_runtime."))
    order = {"name": kind.__name__, "base": first, "order": [*kind.POINTS]}
    return {**order, **{name: plain(member) for name, member in members.items() if name != "_abc_impl"}}


def plain(value: Any) -> Any:
    """What an object of the runtime holds, as names and numbers."""
    if isinstance(value, (str, int, float, type(None))) and not isinstance(value, enum.Enum):
        return type(value).__name__, value
    if isinstance(value, (tuple, list)):
        return [plain(item) for item in value]
    if isinstance(value, Mapping):
        return [(plain(key), plain(item)) for key, item in value.items() if key != "__orig_class__"]  # for mypy
    if isinstance(value, type):
        return class_of(value) if issubclass(value, enum.Enum) else value.__name__
    if isinstance(value, (FunctionType, BuiltinFunctionType, MethodType, classmethod, partial)):
        return getattr(value, "__name__", "")
    members = getattr(value, "__dict__", None)
    if members is not None:  # without `__orig_class__`, by which typing remembers the argument of a generic class
        members = {name: member for name, member in members.items() if not name.startswith("__")}
    return type(value).__name__, plain(repr(value) if members is None else members)


def class_of(kind: type[enum.Enum]) -> Any:
    """The numbers of a class of numbers, or the bits of a word with what reads each flag."""
    numbers = {name: int(member.value) for name, member in kind.__members__.items()}
    readers = {name: plain(each) for base in kind.__mro__ for name, each in vars(base).items() if hasattr(each, "told")}
    return kind.__name__, [base.__name__ for base in kind.__mro__], numbers, readers, hasattr(kind, "of")


def test_another_runtime_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Objects of two runtimes do not fit together."""
    other = ModuleType("fieldscribe_runtime")
    other.__file__ = str(PACKAGES / "fieldscribe_runtime/__init__.py")
    monkeypatch.setitem(sys.modules, "fieldscribe_runtime", other)
    with pytest.raises(ImportError, match=r"was imported from .*generated/python/fieldscribe_runtime"):
        use_python_runtime()
