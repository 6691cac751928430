"""Every example in the pages of the language compiles, and every command there prints what the page says."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from fieldscribe.cli import main
from fieldscribe.pipeline import outputs
from fieldscribe.targets import TARGETS
from support.described import compiled, head, together
from support.places import ROOT

DESCRIPTIONS = ROOT / "descriptions"
PAGES = [DESCRIPTIONS / "README.md", *sorted((DESCRIPTIONS / "language").glob("*.md"))]
BLOCK = re.compile(r"^(## [^\n]*)$|^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"# (\w+\.yaml)\n")
COMMAND = re.compile(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", re.MULTILINE)
BUS = """
  framings: [rtu]
  units: 1..247
  functions:
    03h: {name: read_holding_registers, max: 125}
    06h: write_register
    10h: {name: write_registers, max: 123}"""
GROUP = {"group": "{name}", "space": "holding", "access": "rw", "source": '{{document: manual, section: "1"}}'}
"""What the group of a fragment says, unless the page says it."""


@dataclass
class Device:
    """The files of one device of a page, in the order in which the page shows them."""

    page: str
    heading: str
    files: dict[str, str] = field(default_factory=dict)
    commands: list[tuple[str, str]] = field(default_factory=list)

    @property
    def id(self) -> str:
        """The folder's name, too."""
        return re.search(r"^device: (\w+)", self.files["device.yaml"], re.MULTILINE)[1]  # type: ignore[index]  # each has it

    def write(self, folder: Path) -> Path:
        """The folder of the device, below another one."""
        made = folder / self.id
        made.mkdir()
        for name, text in self.files.items():
            (made / name).write_text(text, "utf-8")
        return made


def devices(page: Path) -> Iterator[Device]:
    """The devices that a page shows: whole files (`# device.yaml`), or the fragments of a section."""
    heading, whole, fragments = "", None, list[str]()
    for title, kind, text in BLOCK.findall(page.read_text("utf-8")):
        if title:
            yield from _of_fragments(page, heading, fragments)
            heading, fragments = title, []
        elif kind == "console" and whole:
            whole.commands += COMMAND.findall(text)
        elif kind == "yaml" and (named := FILE.match(text)):
            if named[1] == "device.yaml":
                if whole:
                    yield whole
                whole = Device(page.stem, heading)
            assert whole, f"{page.name}: {named[1]} belongs to no device.yaml"
            whole.files[named[1]] = text
        elif kind == "yaml":
            fragments.append(text)
    yield from _of_fragments(page, heading, fragments)
    if whole:
        yield whole


def _of_fragments(page: Path, heading: str, fragments: list[str]) -> Iterator[Device]:
    """Lists are points, mappings stand in the head: each `group` opens a document of its own."""
    if not fragments:
        return
    shared, parts = "", list[tuple[str, str]]()
    for text in fragments:
        if text.startswith("group:"):
            parts.append((text, ""))
        elif text.startswith("-"):
            group, points = parts.pop() if parts else ("", "")
            parts.append((group, points + text))
        else:
            shared += text
    documents = [head(device="example", bus=BUS) + shared]
    for number, (group, points) in enumerate(parts, 1):
        given = {line.partition(":")[0] for line in group.splitlines()}
        ours = "".join(
            f"{key}: {value.format(name=f'group_{number}')}\n" for key, value in GROUP.items() if key not in given
        )
        documents.append(f"{ours}{group}points:\n{points}" if points else f"{ours}{group}points: []\n")
    yield Device(page.stem, heading, {"device.yaml": together(*documents)})


def _all() -> Iterator[Device]:
    for page in PAGES:
        yield from devices(page)


@pytest.mark.parametrize("device", list(_all()), ids=lambda device: f"{device.page}-{device.heading or device.id}")
def test_every_example_compiles(
    device: Device, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    device.write(tmp_path)
    compiled_device, findings = compiled(tmp_path / device.id / "device.yaml")
    assert findings == ()
    assert compiled_device is not None
    assert list(outputs(compiled_device, TARGETS))
    for command, printed in device.commands:
        assert main(shlex.split(command)[1:]) == 0
        assert not printed or capsys.readouterr().out == printed


def test_every_page_is_named_on_the_first() -> None:
    first = PAGES[0].read_text("utf-8")
    assert [page.name for page in PAGES[1:] if f"language/{page.name}" not in first] == []
