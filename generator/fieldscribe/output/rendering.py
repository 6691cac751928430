"""Renders the files of devices for a target: in this process, or in a child process for all devices."""

from collections.abc import Callable, Collection, Iterator
from itertools import starmap
from typing import NamedTuple

from fieldscribe.diagnostics import show_traceback
from fieldscribe.output.children import results_of_child
from fieldscribe.output.contents import Contents, Spool
from fieldscribe.pipeline import Models, TargetError, outputs
from fieldscribe.targets import TARGETS, target


class Failure(NamedTuple):
    """An internal error with a device: its place and its text."""

    where: str
    bug: str


Rendered = dict[str, Contents] | Failure
"""The files of a device for a target by path, or the failure."""


class ChildTargets:
    """A child process that renders some targets of all devices; large files come through a spool."""

    def __init__(self, devices: list[Models], targets: tuple[str, ...], spool: Spool) -> None:
        self._spool, self._targets = spool.share(), targets
        self._results = results_of_child(lambda: _all_rendered(devices, targets, spool))

    def next(self) -> dict[str, Rendered]:
        """Return the files of the next device by target. Raises ChildProcessError."""
        made = {target: next(self._results) for target in self._targets}
        return {target: part if isinstance(part, Failure) else self._joined(part) for target, part in made.items()}

    def _joined(self, files: dict[str, Contents]) -> dict[str, Contents]:
        return {path: self._spool.joined(contents) for path, contents in files.items()}


def halves(targets: Collection[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the targets of a run in two parts of about equal time; the second is empty if there is one target.

    Neighbours in the list of all targets stay together, because the page of a device shares the scripts of its package.
    """
    ordered = tuple(name for name in TARGETS if name in targets)
    weights = [target(name).WEIGHT for name in ordered]
    cut = min(range(1, len(ordered) + 1), key=lambda at: max(sum(weights[:at]), sum(weights[at:])))
    return ordered[:cut], ordered[cut:]


def rendered(models: Models, target: str, keep: Callable[[str], Contents]) -> Rendered:
    """Return the files of a device for a target."""
    try:
        found = outputs(models.whole, [target], models.plain)
        return dict(starmap(lambda _, path, text: (path, keep(text)), found))  # no text is kept longer than needed
    except TargetError as error:
        return failure(f"target {error}", error.__cause__ or error)
    except UnicodeEncodeError as error:
        return failure("a text", error)


def failure(where: str, error: BaseException) -> Failure:
    """Return the failure of an error; print its traceback if the user asked for it."""
    show_traceback(error)
    return Failure(where, f"{type(error).__name__}: {str(error)[:120]}")


def _all_rendered(devices: list[Models], targets: tuple[str, ...], spool: Spool) -> Iterator[Rendered]:
    """Yield the files of each device for each target, in the child process."""
    for models in devices:
        for name in targets:
            yield rendered(models, name, spool.keep_apart)
    spool.share()
