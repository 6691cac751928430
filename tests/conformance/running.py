"""All vectors of a file against a package, and what the runtime promises beside."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from support.vector_file import File, Vector

from conformance import can, exchanges, facts, flags, modbus, names, numbers, runtime, uss, words
from conformance.package import Package

_THEMES = (numbers, names, flags, words, facts, exchanges, modbus, can, uss)
CHECKS = {kind: check for theme in _THEMES for kind, check in theme.CHECKS.items()}


def passes(package: Package, vector: Vector) -> tuple[bool, str]:
    """Whether the generated code does what the vector says, and what it raised."""
    check = CHECKS.get(vector["kind"])
    try:
        return check is not None and check(package, vector), ""
    except Exception as error:  # whatever generated code raises, the vector has failed
        return False, f"{type(error).__name__}: {error}"


def run(folder: Path, device: str, vectors: Path, show: int = 0) -> tuple[Counter[str], Counter[str], list[Vector]]:
    """How many vectors of each kind passed and failed, and the first `show` that failed."""
    package = Package(folder, device)
    passed: Counter[str] = Counter()
    failed: Counter[str] = Counter()
    shown: list[Vector] = []
    file = File(vectors.read_text(encoding="utf-8"))
    for vector in file:
        if vector["kind"] not in file.counts:
            continue  # Python has no such thing
        good, reason = passes(package, vector)
        (passed if good else failed)[vector["kind"]] += 1
        if not good and len(shown) < show:
            shown.append({**vector, "reason": reason})
    if file.counts != dict(passed + failed):
        shown.append({"kind": "other counts than the file says"})
        failed["incomplete"] += 1
    if file.head[2:] != [package.module.__version__, package.module.__digest__]:
        shown.append({"kind": "another version or digest than the file's"})
        failed["of another description"] += 1
    for reason in _whole(package):
        (failed if reason else passed)["runtime"] += 1
        shown += [{"kind": "runtime", "reason": reason}] if reason else []
    return passed, failed, shown


def _whole(package: Package) -> Iterator[str]:
    """What is wrong with each promise of the runtime, and with the flags of the package; empty where nothing is."""
    for check in (flags.check_widths, *runtime.CHECKS):
        try:
            check(package)
        except Exception as error:  # whatever it raises, the promise is not kept
            yield f"{check.__module__} {check.__name__}: {type(error).__name__}: {error}"
        else:
            yield ""
