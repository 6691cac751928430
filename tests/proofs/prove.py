"""Proves with Frama-C that no input makes the C parsers and builders of frames do anything undefined.

    .venv/bin/python tests/proofs/prove.py [--machine x86_16 gcc_x86_32 x86_64] [--family modbus can uss] [--ends]

Each function of a family's header has a harness in <family>.c, which Frama-C's value analysis (EVA) follows for all
arguments, bytes, lengths, requests and profiles of their types at once. One run follows all harnesses of a family, each
from the same beginning; where it does not hold, each harness has a run of its own, which names it. No alarm means: no
access outside of an array, nothing read that was not set, no division by zero, no shift too far, no signed overflow,
and no cast that loses bits.
`split` has it follow each length alone, in an array of exactly that length; --ends leaves out those between 24 and the
longest but 12, which takes half of the time. Ends with 1 on any alarm.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
RUNTIME = ROOT / "templates" / "c" / "runtime"
GENERATED = ROOT / "generated" / "c"
FAMILIES = ("cores", "words", "dates", "modbus", "modbus_identify", "modbus_steps", "can", "uss")
"""The headers with functions to prove; in fieldscribe.h, `words` is how raw numbers lie in words, `cores` all else."""
SOURCES = (*FAMILIES, "shipped")
"""The sources of harnesses: one for the functions of each of these, one with the tables of shipped devices."""
MACHINES = ("x86_16", "gcc_x86_32", "x86_64")
OPTIONS = (
    *("-eva", "-lib-entry", "-eva-precision", "0", "-eva-auto-loop-unroll", "8", "-eva-split-limit", "4096"),
    *("-warn-signed-overflow", "-warn-signed-downcast", "-warn-unsigned-downcast", "-warn-pointer-downcast"),
    *("-warn-left-shift-negative", "-warn-right-shift-negative", "-warn-invalid-bool", "-warn-invalid-pointer"),
    *("-eva-no-results", "-eva-msg-key=-initial-state,-final-states"),
)
MORE = {
    "cores": ("-warn-special-float", "none", "-eva-precision", "2"),
    "dates": ("-warn-unsigned-overflow",),
    "modbus": (
        "-eva-slevel-function",
        "fieldscribe_modbus_stands:16,fieldscribe_modbus_select:64,fieldscribe_modbus_settle:256",
    ),
    "modbus_identify": ("-eva-slevel-function", "fieldscribe_is_same_text:16"),
}
"""Values may be infinite and NaN, as IEEE 754 has it; what a function stores is known by what it returns.
No number of a date wraps around. Each step of a loop up to a mark, which its array has, is followed alone.
"""
LIMIT = 600
"""Seconds after which an analysis is taken to hang."""


@dataclass(frozen=True)
class Proof:
    """What Frama-C said of harnesses; `alarms` is none when it could not analyse it."""

    harness: str
    machine: str
    alarms: int | None
    seconds: float
    said: str

    @property
    def holds(self) -> bool:
        """Whether nothing undefined can happen."""
        return self.alarms == 0


def header_of(family: str, runtime: Path = RUNTIME) -> Path:
    """The header that holds the functions of a family."""
    return runtime / ("fieldscribe.h" if family in ("cores", "words") else f"fieldscribe_{family}.h")


def functions(family: str, runtime: Path = RUNTIME) -> list[str]:
    """The functions that a family's header defines, without their prefix, in its order."""
    name = _NAMES.get(family, rf"fieldscribe_{family}_(\w+)")
    found = re.findall(
        rf"^[a-zF][^;{{}}#]*?\b{name}\([^;{{}}]*\)\n\{{", header_of(family, runtime).read_text("utf-8"), re.MULTILINE
    )
    return list(dict.fromkeys(found))


_NAMES = {
    "words": r"fieldscribe_((?:take|put|layout)_\w+)",
    "cores": r"fieldscribe_(?!take_|put_|layout_)(\w+)",
    "dates": r"fieldscribe_(\w+)",
    "modbus_identify": r"fieldscribe_(?:modbus_)?(\w+)",
}
"""What the names of functions are where they do not begin with that of the header."""


def harnesses(source: Path) -> list[str]:
    """The harnesses of a source, in its order."""
    return re.findall(r"^void prove_(\w+)\(", source.read_text("utf-8"), re.MULTILINE)


def unproven(family: str, runtime: Path = RUNTIME) -> list[str]:
    """The functions of a family that have no harness, and the harnesses that have no function."""
    known = functions(family, runtime)
    if family == "cores":  # one harness calls many small functions
        called = re.findall(r"\bfieldscribe_(\w+)\(", (HERE / "cores.c").read_text("utf-8"))
        return [name for name in known if name not in called]
    proven = {name.partition("__")[0] for name in harnesses(HERE / f"{family}.c")}
    return [name for name in known if name not in proven] + sorted(proven - set(known))


def program(family: str, names: Sequence[str]) -> str:
    """Return a C program whose entry calls any one of these harnesses with arbitrary arguments."""
    parameters = ["unsigned which"]
    calls: list[str] = []
    for name in names:
        [signature] = re.findall(
            rf"^void prove_{name}\(([^)]*)\)", (HERE / f"{family}.c").read_text("utf-8"), re.MULTILINE
        )
        types = [] if signature == "void" else [one.rpartition(" ")[0] for one in signature.split(", ")]
        arguments = [f"{name}_{at}" for at in range(len(types))]
        parameters += [f"{kind} {argument}" for kind, argument in zip(types, arguments, strict=True)]
        calls.append(f"    case {len(calls)}U: prove_{name}({', '.join(arguments)}); break;\n")
    switch = "".join(["{\n    switch (which) {\n", *calls, "    default: break;\n    }\n}\n"])
    return f'#include "{family}.c"\n\nvoid prove_any({", ".join(parameters)})\n{switch}'


def prove(family: str, names: Sequence[str], machine: str, runtime: Path = RUNTIME, *, ends: bool = False) -> Proof:
    """Has Frama-C follow harnesses of a family in one run; with `ends`, at short lengths and near the longest."""
    includes = f"-cpp-extra-args=-I{runtime} -I{HERE} -I{GENERATED}{' -DENDS' * ends}"
    started = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "any.c"
        source.write_text(program(family, names), "utf-8")
        main = ("-main", "prove_any", "-machdep", machine)
        command = ["frama-c", *OPTIONS, *MORE.get(family, ()), *main, includes, str(source)]
        try:
            done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=LIMIT)
            said = done.stdout + done.stderr
        except subprocess.TimeoutExpired:
            said = f"no result after {LIMIT} seconds"
    counted = re.search(r"(\d+) alarms? generated by the analysis", said)
    # a harness that is not reached proves nothing
    reached = re.search(r"(\d+) functions analyzed", said)
    alarms = int(counted[1]) if counted and reached and int(reached[1]) > len(names) else None
    return Proof(
        names[0] if len(names) == 1 else f"{len(names)} harnesses", machine, alarms, time.perf_counter() - started, said
    )


def prove_family(family: str, machine: str, *, ends: bool = False) -> list[Proof]:
    """Follow all harnesses of a family in one run; if it does not hold, follow each alone too."""
    names = harnesses(HERE / f"{family}.c")
    proof = prove(family, names, machine, ends=ends)
    return [proof] if proof.holds else [proof, *(prove(family, [name], machine, ends=ends) for name in names)]


def prove_all(wanted: Iterable[tuple[str, str]], *, ends: bool = False) -> list[Proof]:
    """Follows families on machines, two at a time, and prints a line for each proof as it comes."""
    proofs = []
    print(f"{'functions':<34} {'machine':<11} {'alarms':>6} {'seconds':>8}")
    with ThreadPoolExecutor(2) as pool:
        started = [(family, pool.submit(prove_family, family, machine, ends=ends)) for family, machine in wanted]
        for family, future in started:
            for proof in future.result():
                proofs.append(proof)
                alarms = "failed" if proof.alarms is None else proof.alarms
                title = f"{family} {proof.harness}"
                print(f"{title:<34} {proof.machine:<11} {alarms:>6} {proof.seconds:>8.1f}", flush=True)
                if not proof.holds:
                    print(*alarm_lines(proof.said), sep="\n")
    return proofs


def alarm_lines(said: str) -> list[str]:
    """What Frama-C warned of, or its last words."""
    lines = said.splitlines()
    marked = [at for at, line in enumerate(lines) if "[eva:alarm]" in line or "user error" in line]
    return [f"    {line.strip()}" for at in marked for line in lines[at : at + 3]] or [
        f"    {lines[-1]}" if lines else ""
    ]


def main(argv: Sequence[str] | None = None) -> int:
    """Print the table; 1 on any alarm."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machine", nargs="+", choices=MACHINES, default=list(MACHINES))
    parser.add_argument("--family", nargs="+", choices=SOURCES, default=list(SOURCES))
    parser.add_argument("--ends", action="store_true", help="follow short lengths and those near the longest alone")
    chosen = parser.parse_args(argv)
    if shutil.which("frama-c") is None:
        print("frama-c is missing: install frama-c-base", file=sys.stderr)
        return 2
    families = [family for family in chosen.family if family in FAMILIES]
    missing = {family: unproven(family) for family in families}
    for family, names in missing.items():
        if names:
            where = f"{header_of(family).name} and {family}.c"
            print(f"{where}: function without a harness, or the reverse: {', '.join(names)}")
    wanted = [(family, machine) for machine in chosen.machine for family in chosen.family]
    proofs = prove_all(wanted, ends=chosen.ends)
    bad = [proof for proof in proofs if not proof.holds]
    covered = sum(len(functions(family)) for family in families)
    told = f"{covered} functions on {', '.join(chosen.machine)}"
    print(f"{told}: {'nothing undefined for any input' if not bad else f'{len(bad)} do not hold'}")
    return 1 if bad or any(missing.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
