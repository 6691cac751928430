"""Renders the files of devices for a target: here, or in a child process for all devices."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import NamedTuple

from fieldscribe.diagnostics import show_traceback
from fieldscribe.output.children import results_of_child
from fieldscribe.output.contents import Contents, Spool
from fieldscribe.pipeline import Models, TargetError, outputs


class Failure(NamedTuple):
    """An internal error with a device: where it happened, and what it is."""

    where: str
    bug: str


Rendered = dict[str, Contents] | Failure
"""The files of a device for a target by their paths, or why there are none."""


class ChildTarget:
    """A child process that renders a target of all devices; large files come through a spool."""

    def __init__(self, devices: list[Models], target: str, spool: Spool) -> None:
        self._spool = spool.share()
        self._results = results_of_child(lambda: _all_rendered(devices, target, spool))

    def next(self) -> Rendered:
        """Return the files of the next device. Raises ChildProcessError."""
        result = next(self._results)
        return (
            result
            if isinstance(result, Failure)
            else {path: self._spool.joined(contents) for path, contents in result.items()}
        )


def rendered(models: Models, target: str, keep: Callable[[str], Contents]) -> Rendered:
    """Return the files of a device for a target."""
    try:
        return {path: keep(text) for _, path, text in outputs(models.whole, [target], models.plain)}
    except TargetError as error:
        return failure(f"target {error}", error.__cause__ or error)
    except UnicodeEncodeError as error:
        return failure("a text", error)


def failure(where: str, error: BaseException) -> Failure:
    """Return the failure of an error, which is shown if the user wants to see it."""
    show_traceback(error)
    return Failure(where, f"{type(error).__name__}: {str(error)[:120]}")


def _all_rendered(devices: list[Models], target: str, spool: Spool) -> Iterator[Rendered]:
    """Yield the files of each device, as a child does."""
    for models in devices:
        yield rendered(models, target, spool.keep_apart)
    spool.share()
