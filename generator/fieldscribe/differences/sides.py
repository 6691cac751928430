"""What the two arguments of a comparison mean: descriptions, exported models, or one of these as git has it."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from fieldscribe.diagnostics import Report
from fieldscribe.differences.described import Described
from fieldscribe.differences.revisions import copied
from fieldscribe.differences.table import Exported, UnfitError
from fieldscribe.export import export_model
from fieldscribe.export.contract import ContractError, model_from
from fieldscribe.pipeline import find_devices, is_new, load_analysis
from fieldscribe.safe_files import read_regular, shown_path

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from fieldscribe.diagnostics import Span

_MOST_BYTES = 256 << 20
"""The largest exported model that is read."""


@dataclass(frozen=True, slots=True)
class Side:
    """One device of one side. `described` is its description, None for an exported model; `file` is where it is.

    `name_of` gives a file the name that people know it by; a side from git is `copied`.
    """

    exported: Exported
    described: Described | None
    file: str
    name_of: Callable[[str], str] = str
    copied: bool = False

    @property
    def device(self) -> str:
        """The id of the device."""
        return str(self.exported["device"])

    @property
    def version(self) -> str:
        """The version of its description."""
        return str(self.exported["version"])

    def place(self, names: tuple[tuple[str, str], ...], fact: str) -> str | None:
        """Where a fact of a thing stands, as `file:line`; of an exported model the file alone."""
        if self.described is None:
            return self.name_of(self.file)
        span: Span | None = self.described.span(names, fact)
        return None if span is None else f"{self.name_of(span.file)}:{span.line}"


@contextmanager
def opened(argument: str, report: Report) -> Iterator[dict[str, Side]]:
    """The devices of one side by id; the files are there as long as this is open. Raises UnfitError."""
    revision, colon, inside = argument.partition(":")
    if Path(argument).exists() or not colon:
        yield _sides(Path(argument), report, str)
        return
    with TemporaryDirectory(prefix="fieldscribe-") as name:
        folder = Path(name).resolve()
        copy = copied(revision, inside, folder)
        cut = len(argument) if copy == folder else max(argument.rfind("/"), argument.find(":")) + 1
        shown = argument[:cut] if argument[:cut].endswith((":", "/")) else f"{argument[:cut]}/"
        own, name_of = Report(), _renaming(f"{shown_path(folder)}/", shown)
        sides = _sides(copy, own, name_of)
        report.extend(own.in_files(name_of))
        yield sides


def _renaming(copy: str, shown: str) -> Callable[[str], str]:
    """What names files in the copy as people know them: `HEAD~1:descriptions/hitachi_l200/bus.yaml`."""
    return lambda file: shown + f"{file}/".removeprefix(copy).rstrip("/") if f"{file}/".startswith(copy) else file


def _sides(path: Path, report: Report, name_of: Callable[[str], str]) -> dict[str, Side]:
    if path.suffix == ".json" and not path.is_dir():
        model = _model(path, name_of)
        return {str(model["device"]): Side(model, None, shown_path(path), name_of, copied=name_of is not str)}
    known: dict[str, Path] = {}
    sides = {}
    for device_file in find_devices([path], report):
        subject = load_analysis(device_file, report, with_errors=True)
        if subject is not None and is_new(subject.device, device_file, known, report):
            described = Described(subject)
            side = Side(
                export_model(described.device), described, shown_path(device_file), name_of, copied=name_of is not str
            )
            sides[side.device] = side
    return sides


def _model(path: Path, name_of: Callable[[str], str]) -> Exported:
    try:
        return model_from(read_regular(path, _MOST_BYTES).data)
    except ContractError as error:
        raise UnfitError(f"{name_of(shown_path(path))}: {error.message}", error.hint) from None
