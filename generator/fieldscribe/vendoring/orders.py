"""What is to be left where, and doing it: compare the files with a project's folder, or write them to it."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from hashlib import sha256
from typing import TYPE_CHECKING, NamedTuple

from fieldscribe.output.manifests import VENDORED, Manifests
from fieldscribe.output.plan import plan_of
from fieldscribe.safe_files import read_regular
from fieldscribe.user_errors import UnclearError

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
    from pathlib import Path
    from typing import Protocol

    from fieldscribe.model import Device
    from fieldscribe.output.plan import Plan, TargetFiles

    class Wanted(Protocol):
        """What a project wants of a device."""

        @property
        def language(self) -> str:
            """The language or the format of the files."""

        @property
        def name(self) -> str | None:
            """What the device is called in the project, where that is not its id."""

        def as_data(self, device: str) -> Mapping[str, object]:
            """What a manifest says of it."""

        def contents(self, device: Device) -> Iterator[tuple[str, bytes]]:
            """The files: path below the folder, and bytes."""


_MOST_BYTES = 512 << 20


class Order(NamedTuple):
    """A device in a language or a format, for a folder of a project."""

    device: Device
    wish: Wanted
    out: Path

    @property
    def name(self) -> str:
        """What the device is called in the project."""
        return self.wish.name or self.device.id


@dataclass(slots=True)
class Delivery:
    """What became of an order: paths below its folder. `stale` would be written anew, `edited` were changed by hand."""

    order: Order
    files: list[str]
    written: list[str] = field(default_factory=list)
    removed: list[str] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    edited: list[str] = field(default_factory=list)
    stale: list[str] = field(default_factory=list)
    kept: list[str] = field(default_factory=list)
    refused: dict[str, str] = field(default_factory=dict)
    advice: dict[str, str] = field(default_factory=dict)
    """What to do about each refused file."""

    @property
    def is_current(self) -> bool:
        """Whether nothing is to be done."""
        return not (self.missing or self.edited or self.stale or self.refused)

    def as_data(self) -> dict[str, object]:
        """All of it, for tools."""
        order = self.order
        names = ("files", "written", "removed", "missing", "edited", "stale", "kept", "refused")
        head = {"device": order.device.id, "name": order.name, "language": order.wish.language, "out": str(order.out)}
        return head | {name: getattr(self, name) for name in names}


def refuse_doubles(orders: Iterable[Order]) -> None:
    """Two orders for the same files cannot both be had. Raises UnclearError."""
    known: set[tuple[str, str, str]] = set()
    for order in orders:
        key = os.path.realpath(order.out), order.wish.language, order.name
        if key in known:
            raise UnclearError(
                f"`{order.name}` is asked for twice in {order.out}", "give one of them another folder, or another name"
            )
        known.add(key)


def compare(order: Order) -> Delivery:
    """Say what differs; touches nothing. Raises UnclearError."""
    manifests, made = Manifests(order.out, VENDORED), _made(order)
    plan = _plan(order, manifests, made, force=False)
    delivery = _delivery(order, plan, made)
    delivery.kept = sorted(plan.kept)
    for path in plan.stale:
        if path not in plan.refused:
            _difference(order, manifests, delivery, path).append(path)
    return delivery


def deliver(order: Order, waiting: Callable[[Path], None], *, force: bool = False) -> Delivery:
    """Write what differs, under the lock of the folder; nothing where a foreign file is in the way.

    Raises UnclearError, ModuleNotFoundError and OSError.
    """
    from fieldscribe.output.lock import only_run
    from fieldscribe.output.writing import carry_out

    made = _made(order)
    with only_run(order.out, lambda: waiting(order.out)):
        manifests = Manifests(order.out, VENDORED)
        plan = _plan(order, manifests, made, force=force)
        delivery = _delivery(order, plan, made)
        if not plan.refused:
            carry_out(order.out, manifests, plan)
            delivery.written, delivery.removed, delivery.kept = sorted(plan.write), plan.remove, plan.kept
    return delivery


def dropped(orders: Collection[Order], languages: Collection[str]) -> list[Path]:
    """Files in the folders of these orders that are there for none of them, as for one that was dropped."""
    folders = {os.path.realpath(order.out): order.out for order in orders}
    wanted = {(os.path.realpath(order.out), order.name, order.wish.language) for order in orders}
    paths: list[Path] = []
    for folder, out in folders.items():
        manifests = Manifests(out, VENDORED)
        for name, language in manifests.all_asked:
            if language in languages and (folder, name, language) not in wanted:
                files = manifests.of(name).get(language, {})
                own = [path for path in files if not manifests.is_shared(path, name, [language])]
                paths += [out / path for path in own if os.path.lexists(out / path)]
    return sorted(paths)


def _made(order: Order) -> TargetFiles:
    from fieldscribe.output.contents import contents_of

    return {order.wish.language: {path: contents_of(data) for path, data in order.wish.contents(order.device)}}


def _plan(order: Order, manifests: Manifests, made: TargetFiles, *, force: bool) -> Plan:
    manifests.ask(order.name, order.wish.language, order.wish.as_data(order.device.id))
    return plan_of(order.out, manifests, order.name, made, force=force)


def _delivery(order: Order, plan: Plan, made: TargetFiles) -> Delivery:
    """What is to be delivered, and what hinders that."""
    refused = dict(sorted(plan.refused.items()))
    return Delivery(order, _paths(plan, made), refused=refused, advice={path: plan.advice(path) for path in refused})


def _paths(plan: Plan, made: TargetFiles) -> list[str]:
    return sorted([plan.record, *(path for files in made.values() for path in files)])


def _difference(order: Order, manifests: Manifests, delivery: Delivery, path: str) -> list[str]:
    """Where a path belongs that is not as it should be."""
    place = order.out / path
    if not os.path.lexists(place):
        return delivery.missing
    recorded = manifests.of(order.name).get(order.wish.language, {}).get(path, ())
    digest = sha256(read_regular(place, _MOST_BYTES).data).hexdigest()
    return delivery.edited if recorded and digest not in recorded else delivery.stale
