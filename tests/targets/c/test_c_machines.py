"""Machines whose floating point is another: refused where it cannot give the promised bits, and right where it can."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.c_device import WARNINGS, Folders, conformance_source, write_headers
from support.files import write_files
from support.models import device_of, point, scaled
from support.toolchains import compiled, gcc_for_32_bits, run, succeed, tool

MADE = ("kitchen_sink", "kitchen_can", "kitchen_uss")
EXCESS = "The arithmetic here has excess precision"
SHORT = "A double has not 53 bits here"
SSE = ("-msse2", "-mfpmath=sse")
NO_FLOAT = "-DFIELDSCRIBE_NO_FLOAT"


@pytest.fixture(scope="module")
def narrow(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The header of a device all of whose points have at most 24 significant bits."""
    points = (point("speed", 0, scale=scaled(10), decimals=1), point("torque", 1, "s16", scale=scaled(100), decimals=2))
    return write_headers(device_of("sample_drive", points), tmp_path_factory.mktemp("narrow")) / "c/sample_drive.h"


@pytest.mark.parametrize("mode", ["gnu99", "c99", "c17", "gnu++17"])
@pytest.mark.parametrize("flags", [("-mfpmath=387", "-march=i686"), ("-mfpmath=387", "-msse2")], ids=" ".join)
def test_x87_arithmetic_is_refused(flags: tuple[str, ...], mode: str, folders: Folders) -> None:
    """There 0.15 of a step of 0.1 is a little more than one and a half before it is rounded, and less after that."""
    language = "c++" if "++" in mode else "c"
    words = [tool("gcc"), "-m32", *flags, "-O2", f"-std={mode}", "-ffreestanding", "-fsyntax-only", "-x", language]
    header = folders["sample_drive"] / "c/sample_drive.h"
    refused = run([*words, header])
    assert refused.returncode != 0
    assert EXCESS in refused.stderr
    assert run([*words, NO_FLOAT, header]).returncode == 0


FIFTEEN = """
#include "sample_drive.h"
int main(void)
{
    volatile double value = 0.15;
    uint16_t raw = 0U;
    return sample_drive_base_frequency_encode(value, &raw) == FIELDSCRIBE_OK && raw == 2U ? 0 : 1;
}
"""


def test_halves_are_rounded_on_32_bits_as_elsewhere(folders: Folders, tmp_path: Path) -> None:
    gcc = gcc_for_32_bits()
    source = write_files({"half.c": FIFTEEN}, tmp_path) / "half.c"
    for mode in ("gnu17", "c99"):
        flags = ("-m32", "-O2", f"-std={mode}", "-I", str(folders["sample_drive"] / "c"))
        assert EXCESS in run([gcc, *flags, "-mfpmath=387", "-c", "-o", tmp_path / "half.o", source]).stderr
        succeed([compiled("gcc", (*flags, *SSE), source, tmp_path / "half")])


@pytest.mark.full
@pytest.mark.parametrize(("device", "flags"), list(zip(MADE, ((NO_FLOAT,), SSE, SSE), strict=True)))
def test_devices_conform_on_32_bits(device: str, flags: tuple[str, ...], folders: Folders, tmp_path: Path) -> None:
    gcc_for_32_bits()
    words = ("-m32", "-std=gnu99", "-O0", *WARNINGS, *flags)
    program = compiled("gcc", words, conformance_source(folders[device], device), tmp_path / "conformance")
    succeed([program, folders[device] / "vectors" / f"{device}.txt"])


def test_doubles_of_32_bits_are_refused(folders: Folders, narrow: Path) -> None:
    """On AVR a double is a float: right for narrow points that say so, and for integers."""
    words = [tool("avr-gcc"), "-mmcu=atmega2560", "-std=c99", "-fsyntax-only", *WARNINGS, "-x", "c"]
    for header, flags, right in (
        (folders["sample_drive"] / "c/sample_drive.h", (), False),
        (folders["sample_drive"] / "c/sample_drive.h", ("-DFIELDSCRIBE_FLOAT32",), False),
        (narrow, (), False),
        (narrow, ("-DFIELDSCRIBE_FLOAT32",), True),
        (narrow, (NO_FLOAT,), True),
    ):
        done = run([*words, *flags, header])
        assert (done.returncode == 0) == right, done.stderr
        assert (SHORT in done.stderr) != right


@pytest.mark.parametrize(
    "device", [one if one == "sample_drive" else pytest.param(one, marks=pytest.mark.full(seconds=1)) for one in MADE]
)
def test_headers_have_no_warning_where_an_int_has_16_bits(device: str, folders: Folders, tmp_path: Path) -> None:
    family = {"kitchen_can": "can", "kitchen_uss": "uss"}.get(device, "modbus")
    source = (
        write_files({"all.c": f'#define FIELDSCRIBE_IMPLEMENTATION\n#include "{device}_{family}.h"\n'}, tmp_path)
        / "all.c"
    )
    words = ("-mmcu=atmega2560", "-std=c99", "-Os", *WARNINGS, NO_FLOAT, "-I", folders[device] / "c", "-c")
    succeed([tool("avr-gcc"), *words, "-o", tmp_path / "all.o", source])
