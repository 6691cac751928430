"""Compares the files of a request with the folder of a project, or writes them to it."""

import os
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from fieldscribe.diagnostics import UnclearError
from fieldscribe.output.files import VENDORED, Contents, Manifests, contents_of, manifest_text
from fieldscribe.output.lock import only_run
from fieldscribe.output.writing import Plan, TargetFiles, carry_out, plan_of
from fieldscribe.safe_files import read_regular
from fieldscribe.vendoring.requests import LANGUAGES, CodeRequest, DocumentRequest, IndexRequest

_MOST_BYTES = 512 << 20
"""The largest file that is compared."""


class Order(NamedTuple):
    """A request, with the id of its device, the folder of the project, and the function that makes the files.

    `contents` takes the texts of other devices in the folder, by path.
    """

    device: str
    request: CodeRequest | DocumentRequest | IndexRequest
    out: Path
    contents: Callable[[Mapping[str, str]], Iterable[tuple[str, bytes]]]

    @property
    def name(self) -> str:
        """The device's name in the project."""
        return self.request.name or self.device


@dataclass(slots=True)
class Delivery:
    """The result of an order: paths below its folder. `stale` files are out of date, `edited` were changed by hand."""

    order: Order
    plan: Plan
    files: list[str]
    written: list[str] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    edited: list[str] = field(default_factory=list)
    stale: list[str] = field(default_factory=list)
    kept: list[str] = field(default_factory=list)
    refused: dict[str, str] = field(default_factory=dict)

    @property
    def is_current(self) -> bool:
        """True if no file is missing or wrong."""
        return not (self.missing or self.edited or self.stale or self.refused)

    def as_data(self) -> dict[str, object]:
        """Return the delivery as JSON data."""
        order = self.order
        names = ("files", "written", "removed", "missing", "edited", "stale", "kept", "refused")
        head = {"device": order.device, "name": order.name, "language": order.request.language, "out": str(order.out)}
        return head | {name: getattr(self, name) for name in names}


def refuse_duplicates(orders: Iterable[Order]) -> None:
    """Raise UnclearError if two orders are for the same files."""
    known: set[tuple[str, str, str]] = set()
    for order in orders:
        key = os.path.realpath(order.out), order.request.language, order.name
        if key in known:
            raise UnclearError(
                f"`{order.name}` is requested twice in {order.out}", "give one of them another folder, or another name"
            )
        known.add(key)


def compare(order: Order) -> Delivery:
    """Return the differences, and write nothing. Raises UnclearError."""
    manifests = Manifests(order.out, VENDORED)
    made = _files(order, manifests)
    plan, delivery = _planned(order, manifests, made, force=False)
    delivery.kept = sorted(plan.kept)
    for path in plan.stale:
        if path not in plan.refused:
            _list_of(order, manifests, delivery, path).append(path)
    return delivery


def deliver(order: Order, waiting: Callable[[Path], None], *, force: bool = False) -> Delivery:
    """Write the differences, under the lock of the folder; write nothing if a foreign file is in the way.

    Raises UnclearError, ModuleNotFoundError and OSError.
    """
    with only_run(order.out, lambda: waiting(order.out)):
        manifests = Manifests(order.out, VENDORED)
        made = _files(order, manifests)
        plan, delivery = _planned(order, manifests, made, force=force)
        if not plan.refused:
            plan.write |= _manifests_of_others(order, manifests, made[order.request.language])
            carry_out(order.out, manifests, plan)
            delivery.written, delivery.removed, delivery.kept = sorted(plan.write), plan.remove, plan.kept
    return delivery


def leftovers(orders: Collection[Order]) -> list[Path]:
    """Return the files of earlier orders in the folders of these orders that none of these needs."""
    folders = {os.path.realpath(order.out): order.out for order in orders}
    wanted = {(os.path.realpath(order.out), order.name, order.request.language) for order in orders}
    paths: list[Path] = []
    for folder, out in folders.items():
        manifests = Manifests(out, VENDORED)
        for name, language in ((name, language) for name, of in manifests.requests.items() for language in of):
            if language in LANGUAGES and (folder, name, language) not in wanted:
                files = manifests.of(name).get(language, {})
                unshared = [path for path in files if not manifests.is_shared(path, name, [language])]
                paths += [out / path for path in unshared if os.path.lexists(out / path)]
    return sorted(paths)


def _files(order: Order, manifests: Manifests) -> TargetFiles:
    contents = order.contents(dict(_others(order, manifests)))
    return {order.request.language: {path: contents_of(data) for path, data in contents}}


def _others(order: Order, manifests: Manifests) -> Iterator[tuple[str, str]]:
    """Yield the points of other devices in the folder that use the C runtime, and path and text of their headers."""
    for name, requests in manifests.requests.items():
        if name != order.name and "c" in requests and os.path.isfile(order.out / f"{name}.h"):
            yield name, " ".join(requests["c"].get("points") or ["fieldscribe_*"])
            for path in manifests.of(name).get("c", ()):
                if path.endswith(".h") and os.path.isfile(order.out / path):
                    yield path, read_regular(order.out / path, _MOST_BYTES).data.decode("utf-8", "replace")


def _manifests_of_others(order: Order, manifests: Manifests, made: Mapping[str, Contents]) -> dict[str, Contents]:
    """Return the manifests with another checksum of a file that these devices share with the order."""
    changed: dict[str, Contents] = {}
    for name in manifests.requests.keys() - {order.name}:
        targets, language = manifests.of(name), order.request.language
        files = targets.get(language, {})
        shared = {path: (made[path].digest,) for path in files.keys() & made.keys()}
        if files != files | shared:
            text = manifest_text(name, {**targets, language: files | shared}, manifests.further_keys(name))
            changed[manifests.layout.manifest(name)] = contents_of(text.encode())
    return changed


def _planned(order: Order, manifests: Manifests, made: TargetFiles, *, force: bool) -> tuple[Plan, Delivery]:
    """Return the plan, and the delivery before anything is written, with the files in its way."""
    requests = manifests.requests.setdefault(order.name, {})
    requests[order.request.language] = order.request.as_data(order.device)
    plan = plan_of(order.out, manifests, order.name, made, force=force)
    return plan, Delivery(order, plan, sorted(plan.digests), refused=dict(sorted(plan.refused.items())))


def _list_of(order: Order, manifests: Manifests, delivery: Delivery, path: str) -> list[str]:
    """Return the list of the delivery that a path with a difference belongs to."""
    place = order.out / path
    if not os.path.lexists(place):
        return delivery.missing
    of_all = (manifests.of(name).get(order.request.language, {}) for name in manifests.requests)
    recorded = [digest for files in of_all for digest in files.get(path, ())]  # another device may have written it
    digest = sha256(read_regular(place, _MOST_BYTES).data).hexdigest()
    return delivery.edited if recorded and digest not in recorded else delivery.stale
