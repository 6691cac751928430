"""Random words for the commands, in process: no traceback, no internal error, and no exit code but 0, 1 and 2."""

from __future__ import annotations

import gc
import io
import os
import shlex
import shutil
import sys
import tempfile
import time
import traceback
from argparse import ArgumentParser
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from random import Random

from fieldscribe.cli import COMMANDS, command_named, main

from fuzz.languages import Result

MADE = Path(__file__).resolve().parents[1] / "devices"
_WITHOUT_BLANKS = """
    nothing . device.yaml speed P0700 A020 wire:16 modicon:40017 code:P11 wire: 0x10 1028h -5 1e400 nan 50.0
    text json dbc c python,rust c,c, vectors voltage=230V voltage= = speed=5 model é
    010300000001840A 325#FF0501FB0190FF6E 320 0x320 FF zz # rtu tcp pkw 127 0 255 256 -1 99999999999999999999
    -- - -x --no-such
"""
FREE = (
    *("devices/kitchen_can", "kitchen_sink", "kitchen_can", "kitchen_uss", "devices"),
    *("", " ", "01 03 02 00 2A 39 9B", "12BC 0000", "1" * 600, "\x00a", "\u202e"),
    *_WITHOUT_BLANKS.split(),
)

ENDLESS = ("watch", "monitor", "simulate")
"""Commands that run until somebody stops them."""


def options(command: str) -> list[str]:
    """The options of a command, as its parser has them."""
    parser = ArgumentParser(add_help=True)
    command_named(command).add_arguments(parser)
    return sorted(name for action in parser._actions for name in action.option_strings)


def line(seed: int, index: int, known: dict[str, list[str]]) -> list[str]:
    """The command line of that number: always the same words."""
    random = Random(f"{seed}/{index}")
    command = random.choice(sorted(known)) if random.random() < 0.97 else random.choice(FREE)
    device = [random.choice(FREE[:5])] if random.random() < 0.8 else []
    pool = [*known.get(command, ()), *FREE]
    return [command, *device, *(random.choice(pool) for _ in range(random.randrange(6)))]


def trial(words: list[str]) -> str | None:
    """What is wrong with how a command line ends; none if nothing is."""
    out, said = io.StringIO(), io.StringIO()
    sys.stdin = io.TextIOWrapper(io.BytesIO())
    try:
        with redirect_stdout(out), redirect_stderr(said):
            code = main(words)
    except BaseException:
        return traceback.format_exc()
    finally:
        sys.stdin = sys.__stdin__
    if code not in (0, 1, 2):
        return f"exit code {code}"
    if "internal error" in said.getvalue() or "Traceback" in said.getvalue():
        return said.getvalue()
    return None


def fuzz_words(count: int, seed: int, keep: Path) -> Result:
    """So many command lines in a folder of their own; those that went wrong are kept as files."""
    started, findings = time.perf_counter(), []
    known = {command: options(command) for command in COMMANDS if command not in ENDLESS}
    debug = os.environ.pop("FIELDSCRIBE_DEBUG", None)
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        shutil.copytree(MADE, "devices")
        for index in range(count):
            words = line(seed, index, known)
            failed = trial(words)
            if failed is not None:
                file = keep / f"words_{seed}_{index}.txt"
                file.write_text(shlex.join(words) + "\n" + failed, "utf-8", "surrogatepass")
                findings.append(f"fieldscribe {shlex.join(words)!a}, kept as {file}:\n{failed[-1500:]}")
            if index % 50 == 0:
                gc.collect()  # main() turns it off, as a run is short
    gc.enable()
    if debug is not None:
        os.environ["FIELDSCRIBE_DEBUG"] = debug
    return Result("words for the command line", count, tuple(findings), time.perf_counter() - started)
