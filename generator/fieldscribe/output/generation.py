"""Loads all devices of a run, then compares their files with the output folder, or writes them, device by device.

`generate` and `watch` make a `Generation`. Files are made in this process, or in a child process for half of the
targets if the system can fork. A device with an error in its description or in a target, or with a foreign file in its
way, keeps its old outputs.
"""

import os
import pickle
import threading
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import ExitStack
from dataclasses import dataclass, field
from itertools import starmap
from pathlib import Path
from tempfile import TemporaryFile
from typing import NamedTuple, TypeVar

from fieldscribe.diagnostics import Report, Span, show_traceback
from fieldscribe.model import Device
from fieldscribe.output.files import FOLDER, GENERATED, Contents, Manifests, Record, Spool
from fieldscribe.output.lock import only_run
from fieldscribe.output.memory import Memory, Result
from fieldscribe.output.writing import Plan, TargetFiles, carry_out, changed_since, plan_of
from fieldscribe.pipeline import Models, TargetError, is_new, load_models, outputs
from fieldscribe.safe_files import Inputs, path_text
from fieldscribe.targets import TARGETS, knows, target

T = TypeVar("T")


class Failure(NamedTuple):
    """An internal error with a device: its place and its text."""

    where: str
    bug: str


Rendered = dict[str, Contents] | Failure
"""The files of a device for a target by path, or the failure."""


MANY_POINTS = 1_000
"""From this many points in a run on, a second process renders half of the targets."""


@dataclass(slots=True)
class Generation:
    """One run: its targets, output folder and descriptions, and its results."""

    out: Path
    targets: tuple[str, ...]
    report: Report
    known: dict[str, Path] = field(default_factory=dict)
    """The device.yaml of each loaded device, by its id."""
    strict: bool = False
    """True if changed facts under the same version are an error."""
    unreleased: bool = False
    """True if nobody has the present versions yet, so that their facts may change."""
    has_changed_version: bool = False
    """True if the facts of some device changed under the same version."""
    devices: dict[str, tuple[Path, Models]] = field(default_factory=dict)
    inputs: Inputs = field(default_factory=Inputs)
    result: Result = field(default_factory=Result)

    def load(self, device_files: list[Path]) -> None:
        """Load the devices that have no errors; two descriptions of one device are an error."""
        for device_file in device_files:
            try:
                models = load_models(device_file, self.report, self.inputs)
            except Exception as error:  # a bug with one device must not stop the others
                self._report_bug(device_file, *failure("the compiler", error))
                continue
            if models is not None and is_new(models.whole, device_file, self.known, self.report):
                self.devices[models.whole.id] = device_file, models

    def list_outputs(self) -> None:
        """Collect the paths of all outputs without reading the folder."""
        for device, files in self._compiled():
            self.result.wanted.update(_paths(device, files))

    def compare(self) -> None:
        """Collect stale files. A file that changed during the comparison is stale too: somebody is writing it."""
        manifests, result = Manifests(self.out), self.result
        for device, files in self._compiled():
            self._record_version(manifests, device, files)
            plan = plan_of(self.out, manifests, device.id, files)
            result.wanted.update(_paths(device, files))
            result.stale.update(plan.stale)
            result.kept.update(plan.kept)
            result.states.update(plan.unchanged)
        result.stale.update(changed_since(self.out, result.states))

    def write(self, waiting: Callable[[], None], memory: Memory | None, *, force: bool) -> None:
        """Write changed files, under the lock of the folder. Raises OSError."""
        if not self.devices:
            return
        with only_run(self.out, waiting):
            self._write_all(force=force)
            if memory and not (self.report.has_errors or self.has_changed_version):  # the warning must come again
                memory.keep(self.inputs, self.result.states, self.result.digests)

    def _write_all(self, *, force: bool) -> None:

        manifests, result = Manifests(self.out), self.result
        for device, files in self._compiled():
            self._record_version(manifests, device, files)
            plan = plan_of(self.out, manifests, device.id, files, force=force)
            if plan.refused:
                self._report_refused(plan)
                continue
            result.states.update(carry_out(self.out, manifests, plan))
            result.digests.update(plan.digests)
            result.wanted.update(_paths(device, files))
            result.written.update(plan.write)
            result.removed.update(plan.remove)
            result.kept.update(plan.kept)

    def _compiled(self) -> Iterator[tuple[Device, TargetFiles]]:
        """Yield each device with its files; a device with a failing target is left out and gets a finding."""
        ready = [entry for entry in self.devices.values() if self._has_targets(*entry)]
        points = sum(len(models.whole.points) for _, models in ready)
        here, there = halves(self.targets) if points >= MANY_POINTS and may_have_children() else (self.targets, ())
        with ExitStack() as stack:
            devices = [models for _, models in ready]
            child = ChildTargets(devices, there, stack.enter_context(Spool())) if there else None
            for device_file, models in ready:
                with Spool() as spool:
                    made = {target: rendered(models, target, spool.keep) for target in here}
                    made |= child.next() if child else {}
                    parts = {target: made[target] for target in self.targets}
                    files = {target: part for target, part in parts.items() if isinstance(part, dict)}
                    if failures := [part for part in parts.values() if isinstance(part, Failure)]:
                        self._report_bug(device_file, *failures[0])
                    else:
                        yield models.whole, files

    def _record_version(self, manifests: Manifests, device: Device, files: TargetFiles) -> None:
        """Record the version with the digest of its facts; the same version with other facts is a finding instead."""
        from fieldscribe.facts.digest import facts_digest

        before, now = manifests.records.get(device.id), Record(device.version, facts_digest(device))
        if before is None or before.version != now.version or self.unreleased:
            manifests.records[device.id] = now
        elif before != now:
            self._report_changed_version(device)
        if FOLDER in manifests.of(device.id):
            files[FOLDER] = {}  # earlier compilers recorded the facts there: remove them

    def _report_changed_version(self, device: Device) -> None:
        """Report that the facts changed but the version did not."""
        message = f"`{device.id}` has changed since its version {device.version} was generated"
        hint = (
            f"raise the version: `fieldscribe diff` says by which step. If nobody has {device.version} yet, "
            "`generate --unreleased` records its present facts"
        )
        self.has_changed_version = True
        report = self.report.error if self.strict else self.report.warning
        report("version-not-raised", message, self.devices[device.id][1].version, hint)

    def _report_refused(self, plan: Plan) -> None:
        for path, reason in sorted(plan.refused.items()):
            place = Span(path_text(self.out / path), 1, 1)
            self.report.error("foreign-file", f"a file is in the way: {reason}", place, plan.advice(path))

    def _has_targets(self, device_file: Path, models: Models) -> bool:
        """Return True if all targets can be generated for the device's family; else there is a finding."""
        device = models.whole
        unknown = [target for target in self.targets if not knows(target, device)]
        if unknown:
            named = f"target {unknown[0]} does" if len(unknown) == 1 else f"targets {', '.join(unknown)} do"
            message = f"the {named} not know the family {device.family}; nothing of {device.id} was written"
            hint = "choose others with --target"
            self.report.error("unknown-family", message, Span(path_text(device_file), 1, 1), hint)
        return not unknown

    def _report_bug(self, device_file: Path, where: str, bug: str) -> None:
        """Report an internal error as a finding of its device."""
        message = f"internal error in {where}: {bug}; nothing of this device was written"
        hint = "this is a bug: please report it to the project with the description (FIELDSCRIBE_DEBUG=1 shows where)"
        self.report.error("internal-error", message, Span(path_text(device_file), 1, 1), hint)


def _paths(device: Device, files_of_targets: TargetFiles) -> Iterator[str]:

    yield GENERATED.manifest(device.id)
    for files in files_of_targets.values():
        yield from files


# Files of targets, made here or in a child process.


def may_have_children() -> bool:
    """Return True if there are several processors and a fork is safe for threads."""
    return hasattr(os, "sched_getaffinity") and len(os.sched_getaffinity(0)) > 1 and threading.active_count() == 1


def results_of_child(make: Callable[[], Iterable[T]]) -> Iterator[T]:
    """Start a child that makes results; return an iterator over them, which waits until all are made.

    The iterator raises ChildProcessError if the child is killed.
    """
    file = TemporaryFile()  # noqa: SIM115 - closed by the iterator
    child = os.fork()
    if not child:
        status = 1
        try:
            for result in make():
                pickle.dump(result, file)
            file.close()
            status = 0
        finally:
            os._exit(status)

    def results() -> Iterator[T]:
        with file:
            if os.waitpid(child, 0)[1]:
                raise ChildProcessError(
                    "a process that made files broke off: is there enough memory, and room for temporary files?"
                )
            size = file.seek(0, os.SEEK_END)
            file.seek(0)
            while file.tell() < size:
                yield pickle.load(file)  # noqa: S301 - written by our own child to a file without a name

    return results()


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
            yield rendered(models, name, spool.keep_for_parent)
    spool.share()
