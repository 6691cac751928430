"""Generated C: it compiles without a warning everywhere, passes every vector, and stays small."""

from __future__ import annotations

import platform
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import pytest
from _pytest.mark.structures import ParameterSet
from fieldscribe.model import Device
from fieldscribe.targets import c
from fieldscribe.targets.identifiers import clashes
from support.c_device import (
    MADE,
    SANITIZERS,
    SANITIZING,
    STANDARDS,
    WARNINGS,
    Folders,
    conformance_source,
    driver,
    program,
    rare_device,
    run_program,
    write_c,
)
from support.described import kitchen_sink, made
from support.made_once import made_once
from support.models import FREQUENCY_SOURCE, point, sample_device, trip_device
from support.places import ROOT
from support.toolchains import compiled, run, succeed, tool
from support.vector_file import counts_of, spoil

GENERATED = ROOT / "generated"
IN_CORE = ("jumo_controller", "siemens_mm4")
SHIPPED = sorted(path.stem for path in (GENERATED / "vectors").glob("*.txt") if path.stem not in IN_CORE)
FLOATS: dict[str, tuple[str, ...]] = {
    "float": (),
    "float32": ("-DFIELDSCRIBE_FLOAT32",),
    "no_float": ("-DFIELDSCRIBE_NO_FLOAT",),
}
COMPILERS = ("gcc", "clang")


class Build(NamedTuple):
    """One way to compile a conformance program."""

    compiler: str
    floats: str
    standard: str
    optimize: str
    sanitized: bool

    @property
    def flags(self) -> tuple[str, ...]:
        sanitizers = SANITIZERS[self.compiler] if self.sanitized else ()
        return (*STANDARDS[self.standard], *WARNINGS, *FLOATS[self.floats], self.optimize, *sanitizers)


def sanitized(device: str, standard: str, floats: str) -> ParameterSet:
    """Return a build with the sanitizers of clang, which look for all that those of gcc do, and for more."""
    # they see most where nothing is optimized away
    return way(device, Build("clang", floats, standard, "-O0", sanitized=True))


def optimized(device: str, standard: str, floats: str) -> ParameterSet:
    """Return a build by gcc as firmware has it."""
    return way(device, Build("gcc", floats, standard, "-O2", sanitized=False))


def plain(device: str, compiler: str, standard: str, floats: str) -> ParameterSet:
    """Return a build that is not optimized."""
    return way(device, Build(compiler, floats, standard, "-O0", sanitized=False))


def way(device: str, build: Build) -> ParameterSet:
    return pytest.param(device, build, id=f"{device}-{named(build)}", marks=pytest.mark.full(seconds=3))


def named(build: Build) -> str:
    return "-".join(map(str, build[:4]))


QUICKEST = Build("clang", "float", "c99", "-O0", sanitized=False)
"""The core suite takes the build that compiles quickest: the sanitizers cost three times as much."""


@pytest.fixture(scope="session")
def sample(folders: Folders) -> Path:
    return folders["sample_drive"]


@pytest.fixture(scope="session")
def sink(folders: Folders) -> Path:
    return folders["kitchen_sink"]


def conforms(folder: Path, device: str, build: Build, out: Path) -> None:
    """Runs all vectors and holds the counts against those of the file."""
    compiler = driver(build.compiler, build.standard)
    program = compiled(compiler, build.flags, conformance_source(folder, device), out / "conformance")
    vectors = folder / "vectors" / f"{device}.txt"
    done = run([program, vectors])
    assert done.returncode == 0, done.stdout + done.stderr
    counts = counts_of(vectors.read_text("utf-8"), "c")
    left_out = ("decode", "encode") if build.floats == "no_float" else ()
    assert passed(done.stdout) == {kind: n for kind, n in counts.items() if n and kind not in left_out}


def passed(output: str) -> dict[str, int]:
    """How many vectors of each kind passed."""
    rows = [line.split() for line in output.splitlines()]
    return {row[0]: int(row[1]) for row in rows if row[0] != "total"}


@pytest.mark.parametrize(
    ("device", "build"),
    [
        sanitized("sample_drive", "c++17", "no_float"),
        sanitized("rare", "c99", "float"),
        sanitized("kitchen_sink", "c17", "float"),
        sanitized("kitchen_codes", "c++11", "no_float"),
        sanitized("kitchen_can", "c11", "float32"),
        sanitized("kitchen_uss", "c++20", "float"),
        optimized("sample_drive", "c11", "float"),
        plain("rare", "clang", "c++11", "float32"),
        plain("kitchen_sink", "clang", "c99", "float32"),
        optimized("kitchen_codes", "c17", "float"),
        optimized("kitchen_can", "c++20", "no_float"),
        optimized("kitchen_uss", "c++17", "float32"),
    ],
)
def test_models_conform(device: str, build: Build, folders: Folders, tmp_path: Path) -> None:
    """Each device in two ways; both compilers build each standard, with floating point, in binary32 and without.

    Where values are float, those that a float cannot hold are not asked.
    """
    conforms(folders[device], device, build, tmp_path)


@pytest.mark.parametrize(
    ("device", "build"),
    [
        *(pytest.param(device, QUICKEST, id=device) for device in IN_CORE),
        *(
            plain(device, COMPILERS[1 - turn % 2], ("c++20", "c99")[turn % 2], "float")
            for turn, device in enumerate(SHIPPED)
        ),
        optimized("siemens_mm4", "c99", "float"),
        optimized("nord_sk5xxe", "c17", "float"),
    ],
)
def test_shipped_devices_conform(device: str, build: Build, tmp_path: Path) -> None:
    """The made devices have every mechanism and are built in more ways; the shipped ones take long to compile."""
    conforms(GENERATED, device, build, tmp_path)


ALL = [sample_device(), rare_device(), kitchen_sink(), *map(made, ("kitchen_blocks", "kitchen_can", "kitchen_uss"))]


def frames_header(folder: Path, device: str) -> Path:
    """The header of a device's frames, whatever its family."""
    return next((folder / "c").glob(f"{device}_*.h"))


@pytest.mark.parametrize("device", ALL, ids=lambda device: str(device.id))
def test_every_identifier_is_one_thing(device: Device) -> None:
    assert list(clashes(c.identifiers(device))) == []


def test_a_clash_is_found() -> None:
    entries = (replace(FREQUENCY_SOURCE.entries[0], name="address"),)
    points = (point("base", 1, enum=replace(FREQUENCY_SOURCE, name="base", entries=entries)),)
    clash = replace(sample_device(points), frames=(), blocks={})
    assert [one.name for one in clashes(c.identifiers(clash))] == ["SAMPLE_DRIVE_BASE_ADDRESS"]


VENDORED = {"hitachi_l200": (6_800, 400_000), "woodward_mpu2s": (10_000, 480_000)}
"""Lines and bytes of the headers of points and frames that a firmware team is asked to vendor, at most."""


@pytest.mark.parametrize("device", VENDORED)
def test_what_a_firmware_team_vendors_is_small(device: str) -> None:
    """Without the shared runtimes and the conformance program; no line is longer than a screen."""
    texts = [path.read_text("utf-8") for path in (GENERATED / "c").glob(f"{device}*.h")]
    lines, size = VENDORED[device]
    assert sum(text.count("\n") for text in texts) <= lines
    assert sum(len(text.encode()) for text in texts) <= size
    assert max(len(line) for text in texts for line in text.splitlines()) <= 120


def test_lines_of_a_comment_are_aligned() -> None:
    """The asterisks of a comment at the left margin stand one below the other."""
    for header in (ROOT / "generated/c").glob("*.h"):
        assert not re.search(r"^  +\*", header.read_text("utf-8").partition("#ifndef")[0], re.MULTILINE), header.name


def test_a_function_is_one_or_two_statements(sink: Path) -> None:
    """All else is in the cores."""
    text = (sink / "c/kitchen_sink.h").read_text("utf-8")
    bodies = re.findall(r"^\{\n(.*?)^\}|\{ ([^\n]*) \}$", text, re.MULTILINE | re.DOTALL)
    functions = [block or line for block, line in bodies if "return" in block + line]
    assert len(functions) > 300
    assert max(body.count(";") for body in functions) <= 2


FUSED = """
#include "sample_drive.h"
int main(void)
{
    volatile double value = -0.3; /* times ten it is -3 rounded, and a little more than that when the product is not */
    int16_t raw = 0;
    return sample_drive_temperature_encode(value, &raw) == FIELDSCRIBE_OK && raw == -1 ? 0 : 1;
}
"""


@pytest.mark.parametrize("standard", ["c99", "gnu99"])
@pytest.mark.parametrize("compiler", COMPILERS)
def test_steps_are_never_fused(compiler: str, standard: str, sample: Path, tmp_path: Path) -> None:
    """A fused multiply-add rounds once where two roundings are meant; GNU modes fuse unless they are kept from it."""
    if platform.machine() != "x86_64" or " fma " not in Path("/proc/cpuinfo").read_text("utf-8"):
        pytest.skip("needs an x86-64 processor with FMA")
    (tmp_path / "fused.c").write_text(FUSED, encoding="utf-8")
    flags = (f"-std={standard}", "-O2", "-mfma", "-ffp-contract=fast", "-I", str(sample / "c"))
    succeed([compiled(compiler, flags, tmp_path / "fused.c", tmp_path / "fused")])


@pytest.mark.parametrize(
    "build", [(), *(pytest.param((f"-DFIELDSCRIBE_{one}",), marks=pytest.mark.full) for one in ("NO_FLOAT", "FLOAT32"))]
)
@pytest.mark.parametrize("language", ["c99", pytest.param("c++17", marks=pytest.mark.full(seconds=1))])
def test_headers_have_no_clang_warning_at_all(
    language: str, build: tuple[str, ...], folders: Folders, tmp_path: Path
) -> None:
    left_out = "padded declaration-after-statement unused-function c++98-compat c++98-compat-pedantic old-style-cast"
    flags = [*STANDARDS[language], "-Weverything", *(f"-Wno-{one}" for one in left_out.split()), *build, "-Werror"]
    source = tmp_path / "headers.c"
    headers = [frames_header(folders[device], device).name for device in MADE]
    source.write_text("".join(f'#include "{header}"\n' for header in headers), encoding="utf-8")
    places = [f"-I{folders[device]}/c" for device in MADE]
    succeed([tool("clang"), *flags, "-fsyntax-only", "-Wno-zero-as-null-pointer-constant", *places, source])


@pytest.fixture(scope="session")
def conformance(folders: Folders, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The conformance program of a made device, built once."""

    def program(device: str) -> Path:
        source, flags = conformance_source(folders[device], device), QUICKEST.flags
        return made_once(
            tmp_path_factory, f"built-{device}", lambda out: compiled(QUICKEST.compiler, flags, source, out / "program")
        )

    return lambda device: program(device) / "program"


@pytest.mark.parametrize(
    "device",
    ["sample_drive", *(pytest.param(one, marks=pytest.mark.full(seconds=1)) for one in ("kitchen_can", "kitchen_uss"))],
)
def test_conformance_catches_each_kind(
    device: str, folders: Folders, conformance: Callable[[str], Path], tmp_path: Path
) -> None:
    text, spoiled = spoil((folders[device] / "vectors" / f"{device}.txt").read_text("utf-8"), "c")
    (tmp_path / "vectors.txt").write_text(text, encoding="utf-8")
    done = run([conformance(device), tmp_path / "vectors.txt"])
    assert done.returncode == 1
    failed = {row[0]: int(row[3]) for row in map(str.split, done.stdout.splitlines())}
    assert failed == {**spoiled, "total": sum(spoiled.values())}


@pytest.mark.parametrize(
    ("lines", "reason"),
    [
        (("address\tcoil\t0\t1\t", "address\tcoil\t7\t1\t"), "address, here 0"),
        (("decode_count\t0\tok\t0", "decode_count\t0\toverflow\t0"), "status, here ok"),
        (("name\t0\tkeypad", "name\t0\tkeys"), "name, here keypad"),
        (("words\t0\t0,0", "words\t0\t0,1"), "words"),
        (("read\t010100000001fdca=", "read\t010100000002bdcb="), "the bytes that are sent"),
        (("decode_count\t0\tok\t0", "decode_count\t0\tok\t0\tcode"), "special"),
        (("point\trun_command", "point\tno_such_point"), "nothing in the program answers it"),
    ],
)
def test_a_failure_says_what_differs(
    lines: tuple[str, str], reason: str, sample: Path, conformance: Callable[[str], Path], tmp_path: Path
) -> None:
    right, wrong = lines
    text = (sample / "vectors" / "sample_drive.txt").read_text("utf-8")
    (tmp_path / "vectors.txt").write_text(text.replace(f"\n{right}", f"\n{wrong}", 1), encoding="utf-8")
    done = run([conformance("sample_drive"), tmp_path / "vectors.txt"])
    assert f"  differs: {reason}\n" in done.stderr


def test_vectors_of_another_description_are_refused(
    sample: Path, conformance: Callable[[str], Path], tmp_path: Path
) -> None:
    text = (sample / "vectors" / "sample_drive.txt").read_text("utf-8")
    program = conformance("sample_drive")
    for old, new in (("\t0123", "\t1123"), ("vectors\t2", "vectors\t3"), ("\tsample_drive\t", "\tsample\t")):
        (tmp_path / "vectors.txt").write_text(text.replace(old, new, 1), encoding="utf-8")
        assert run([program, tmp_path / "vectors.txt"]).returncode == 1
    assert run([program]).returncode == 2
    assert run([program, tmp_path / "absent.txt"]).returncode == 2


def test_a_file_that_lacks_vectors_is_refused(sample: Path, conformance: Callable[[str], Path], tmp_path: Path) -> None:
    text = (sample / "vectors" / "sample_drive.txt").read_text("utf-8")
    program = conformance("sample_drive")
    (tmp_path / "vectors.txt").write_text("\n".join(text.split("\n")[:-2]) + "\n", encoding="utf-8")
    assert run([program, tmp_path / "vectors.txt"]).returncode == 1


def test_no_float_is_left(folders: Folders) -> None:
    for device in MADE:
        command = [tool("gcc"), "-E", "-P", "-std=c99", "-ffreestanding", "-DFIELDSCRIBE_NO_FLOAT"]
        text = succeed([*command, "-x", "c", frames_header(folders[device], device)])
        own = text[text.index("typedef enum") :]
        assert not re.search(r"\b(double|float)\b|[0-9]\.[0-9]", own)


FLOAT32 = program("float32")


@pytest.mark.parametrize("build", ["-DFIELDSCRIBE_FLOAT32", "-DFIELDSCRIBE_FLOAT64"])
def test_every_raw_survives_the_value(build: str, sample: Path, tmp_path: Path) -> None:
    (tmp_path / "trip.c").write_text(FLOAT32, encoding="utf-8")
    flags = ("-std=c99", "-O2", *WARNINGS, build, "-I", str(sample / "c"))
    succeed([compiled("gcc", flags, tmp_path / "trip.c", tmp_path / "trip")])


TRIPS = program("trips")


@pytest.mark.parametrize("build", ["-DFIELDSCRIBE_FLOAT32", "-DFIELDSCRIBE_FLOAT64"])
def test_every_raw_survives_every_kind_of_rule(build: str, tmp_path: Path) -> None:
    folder = write_c(trip_device(), tmp_path)
    (tmp_path / "trips.c").write_text(TRIPS, encoding="utf-8")
    flags = ("-std=c99", "-O2", *WARNINGS, build, "-I", str(folder / "c"))
    succeed([compiled("gcc", flags, tmp_path / "trips.c", tmp_path / "trips")])


NOISE = program("modbus_noise")


@pytest.mark.parametrize("way", SANITIZING)
def test_any_bytes_are_safe_to_parse(way: str, sample: Path, tmp_path: Path) -> None:
    run_program(NOISE, way, sample / "c", tmp_path)


ECHO = program("modbus_echo")


@pytest.mark.parametrize("way", SANITIZING)
def test_an_echo_needs_no_room(way: str, sample: Path, tmp_path: Path) -> None:
    run_program(ECHO, way, sample / "c", tmp_path)


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("flag", ["-ffast-math", "-Ofast", "-ffinite-math-only"])
def test_inexact_arithmetic_is_refused(compiler: str, flag: str, sample: Path) -> None:
    header = sample / "c/sample_drive.h"
    words: list[str | Path] = [tool(compiler), "-std=c99", "-fsyntax-only", flag, "-x", "c", header]
    refused = run(words)
    assert refused.returncode != 0
    assert "Compile without -ffast-math" in refused.stderr
    assert run([*words, "-DFIELDSCRIBE_NO_FLOAT"]).returncode == 0


UNSIGNED = ("-fno-signed-zeros", "-fno-trapping-math")
"""What -fassociative-math asks for."""


@pytest.mark.parametrize("flag", ["-freciprocal-math", "-funsafe-math-optimizations", "-fassociative-math"])
def test_parts_of_fast_math_are_refused(flag: str, sample: Path) -> None:
    """gcc tells which of them it was given."""
    words = ["-std=c99", "-fsyntax-only", flag, *UNSIGNED, "-x", "c"]
    assert "Compile without -ffast-math" in run([tool("gcc"), *words, sample / "c/sample_drive.h"]).stderr


@pytest.mark.full(seconds=4)
def test_parts_of_fast_math_are_kept_off(sample: Path, tmp_path: Path) -> None:
    """clang does not tell, and takes them back for the functions that compute.

    With -funsafe-math-optimizations its start-up file makes the whole program flush subnormal numbers: no header can
    see or undo that.
    """
    source = sample / "c/conformance/sample_drive_conformance.c"
    words = (
        "-std=c99",
        "-O2",
        *WARNINGS,
        "-freciprocal-math",
        "-fassociative-math",
        *UNSIGNED,
        "-I",
        str(sample / "c"),
    )
    succeed([compiled("clang", words, source, tmp_path / "run"), sample / "vectors/sample_drive.txt"])


def test_a_runtime_of_another_version_is_refused(sample: Path, tmp_path: Path) -> None:
    for path in (sample / "c").glob("*.h"):
        text = re.sub(r"(MODBUS_INTERFACE) \d+\n", r"\1 99\n", path.read_text("utf-8"))
        (tmp_path / path.name).write_text(text, encoding="utf-8")
    done = run([tool("gcc"), "-std=c99", "-fsyntax-only", "-x", "c", tmp_path / "sample_drive_modbus.h"])
    assert done.returncode != 0
    assert "of another version" in done.stderr


FIRMWARE = program("modbus_firmware")


def test_cortex_m0_image_is_small_and_without_float(sample: Path, tmp_path: Path) -> None:
    (tmp_path / "firmware.c").write_text(FIRMWARE, encoding="utf-8")
    flags = ("-mcpu=cortex-m0", "-mthumb", "-Os", "-std=c99", "-nostdlib", "-Wl,-e,start", "-I", str(sample / "c"))
    image = compiled("arm-none-eabi-gcc", (*flags, *WARNINGS), tmp_path / "firmware.c", tmp_path / "firmware.elf")
    symbols = succeed([tool("arm-none-eabi-nm"), image])
    calls = succeed([tool("arm-none-eabi-objdump"), "-d", image])
    assert "start" in symbols
    assert not re.search(r"__aeabi_|__[a-z]*[sd]f[0-9]", symbols + calls)
    text = int(succeed([tool("arm-none-eabi-size"), image]).splitlines()[1].split()[0])
    print(f"Cortex-M0, -Os, one encode_count and one decode_count: .text {text} bytes")
    assert text <= 40


INTEGER_FIRMWARE = program("integer_firmware")


def test_cortex_m0_image_of_all_mechanisms_is_without_float(sink: Path, tmp_path: Path) -> None:
    """Run-time factors, floating-point patterns, bit groups and frames: 64-bit integers at most."""
    (tmp_path / "firmware.c").write_text(INTEGER_FIRMWARE, encoding="utf-8")
    flags = ("-mcpu=cortex-m0", "-mthumb", "-Os", "-std=c99", "-nostartfiles", "-Wl,-e,start", "-I", str(sink / "c"))
    image = compiled("arm-none-eabi-gcc", (*flags, *WARNINGS), tmp_path / "firmware.c", tmp_path / "firmware.elf")
    symbols = succeed([tool("arm-none-eabi-nm"), image])
    assert "start" in symbols
    assert not re.search(r"__aeabi_[df]|__[a-z]*[sd]f[0-9]", symbols)
