"""The build recipes of the page on C: built by their tools where these install, and what they say where not."""

from __future__ import annotations

import configparser
import os
import re
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest
import yaml
from support.places import ROOT
from support.toolchains import run, succeed, tool

PAGE = ROOT / "descriptions/using/c-builds.md"
BLOCK = re.compile(
    r"`([\w./]+)`[^\n]*:\n\n```(?:make|cmake|meson|ini|python|yaml|kconfig)\n(.*?)^```$", re.MULTILINE | re.DOTALL
)
MAIN = """
#define FIELDSCRIBE_IMPLEMENTATION
#include "hitachi_l200_modbus.h"
int main(void)
{
    return hitachi_l200_output_frequency_decode_count(500U) == 500 ? 0 : 1;
}
"""
ZEPHYR = """
cmake_minimum_required(VERSION 3.20)
project(drive C)
add_executable(main main.c)
function(zephyr_include_directories)
  target_include_directories(main PRIVATE ${ARGN})
endfunction()
set(CONFIG_HITACHI_L200 y)
add_subdirectory(zephyr)
"""


def recipes() -> Mapping[str, str]:
    """The files of the page, by name."""
    return dict(BLOCK.findall(PAGE.read_text("utf-8")))


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A project with the recipes and a program, and `fieldscribe` on the path."""
    scripts = os.path.dirname(sys.executable)
    monkeypatch.setenv("PATH", f"{scripts}:{os.environ['PATH']}")
    (tmp_path / "main.c").write_text(MAIN, "utf-8")
    for name, text in recipes().items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, "utf-8")
    return tmp_path


def test_the_page_has_all_recipes() -> None:
    names = {"Makefile", "fieldscribe.cmake", "CMakeLists.txt", "meson.build", "platformio.ini", "vendor.py"}
    assert set(recipes()) == names | {"zephyr/module.yml", "zephyr/Kconfig", "zephyr/CMakeLists.txt"}


@pytest.mark.full(seconds=2)
def test_make(project: Path) -> None:
    succeed([tool("make")], cwd=project)
    succeed([project / "main"])
    assert run([tool("make"), "--question"], cwd=project).returncode == 0
    changed = ("-W", str(ROOT / "descriptions/hitachi_l200/bus.yaml"))
    assert "fieldscribe vendor" in succeed([tool("make"), *changed, "-n"], cwd=project)
    (project / "drivers/fieldscribe_modbus.h").unlink()
    assert "fieldscribe vendor" in succeed([tool("make"), "-n"], cwd=project)
    makefile = project / "Makefile"
    makefile.write_text(makefile.read_text("utf-8").replace("D001,A020", "D001"), "utf-8")
    succeed([tool("make")], cwd=project)
    assert (project / "drivers/fieldscribe_modbus.h").is_file()
    assert "BASE_FREQUENCY" not in (project / "drivers/hitachi_l200.h").read_text("utf-8").upper()


@pytest.mark.full(seconds=3)
@pytest.mark.parametrize("generator", ["Ninja", "Unix Makefiles"])
def test_cmake(generator: str, project: Path) -> None:
    tool("ninja")
    succeed([tool("cmake"), "-G", generator, "-B", "build", "-S", "."], cwd=project)
    assert " of hitachi_l200 in " in succeed([tool("cmake"), "--build", "build"], cwd=project)
    succeed([project / "build/main"])
    assert " of hitachi_l200 in " not in succeed([tool("cmake"), "--build", "build"], cwd=project)


@pytest.mark.full(seconds=3)
def test_meson(project: Path) -> None:
    succeed([tool("meson"), "setup", "build"], cwd=project)
    succeed([tool("ninja"), "-C", "build"], cwd=project)
    succeed([project / "build/main"])
    assert "no work to do" in succeed([tool("ninja"), "-C", "build"], cwd=project)


@pytest.mark.full(seconds=2)
def test_platformio(project: Path) -> None:
    """Its script in a stand-in for its environment: the tool itself fetches compilers from a registry of its own."""
    text = 'targets = ["c"]\nout = "drivers"\n[[devices]]\ndevice = "hitachi_l200"\npoints = ["D001"]\n'
    (project / "fieldscribe.toml").write_text(text, "utf-8")
    settings = configparser.ConfigParser()
    settings.read_string((project / "platformio.ini").read_text("utf-8"))
    [section] = settings.sections()
    assert settings[section]["extra_scripts"] == "pre:vendor.py"
    flags = settings[section]["build_flags"].split()

    class Environment:
        """What the script uses of SCons."""

        def Execute(self, command: str) -> int:  # noqa: N802  # its name there
            return run(["sh", "-c", command], cwd=project).returncode

        def Exit(self, code: int) -> None:  # noqa: N802  # its name there
            raise SystemExit(code)

    script = compile((project / "vendor.py").read_text("utf-8"), "vendor.py", "exec")
    names = {"Import": lambda name: None, "env": Environment()}
    exec(script, names)
    succeed([tool("gcc"), *flags, "main.c", "-o", "main"], cwd=project)
    (project / "fieldscribe.toml").write_text(text.replace("D001", "D999"), "utf-8")
    with pytest.raises(SystemExit):
        exec(script, names)


@pytest.mark.full(seconds=2)
def test_zephyr(project: Path) -> None:
    """Its module where CMake takes it in, with a stand-in for the one function of Zephyr that it calls."""
    module = yaml.safe_load((project / "zephyr/module.yml").read_text("utf-8"))
    assert {"name", "build"} == set(module)
    assert (project / module["build"]["cmake"] / "CMakeLists.txt").is_file()
    assert re.match(r"config HITACHI_L200\n\tbool \"", (project / module["build"]["kconfig"]).read_text("utf-8"))
    succeed(["fieldscribe", "vendor", "c", "hitachi_l200", "--out", "drivers", "--points", "D001"], cwd=project)
    (project / "CMakeLists.txt").write_text(ZEPHYR, "utf-8")
    succeed([tool("cmake"), "-B", "build", "-S", "."], cwd=project)
    succeed([tool("cmake"), "--build", "build"], cwd=project)
    succeed([project / "build/main"])
