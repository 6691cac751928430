"""What the Python target asks of a bus family."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

from fieldscribe.families import family
from fieldscribe.model import Device, Point, Telegram
from fieldscribe.targets.python.identifiers import PackageScope
from fieldscribe.targets.python.layout import Node, call
from fieldscribe.text import python_string

RUNTIME = "fieldscribe_runtime"
"""The package that all generated devices share."""

_MAKERS = {"r": "ReadOnly", "w": "WriteOnly", "rw": "ReadWrite"}


def usual_maker(point: Point) -> str:
    """Return the function for the attribute of a point; only its access decides."""
    return _MAKERS["".join(letter for letter in "rw" if letter in point.access)]


class Line(NamedTuple):
    """A transport of the runtime for examples: its module, and expressions that open it, for both kinds of devices."""

    module: str
    blocking: str
    awaiting: str
    first: tuple[str, ...] = ()
    """Lines of import that the expressions need besides."""
    settings: tuple[str, ...] = ()
    """What the device is made with beside the line and the unit."""

    def imports(self, wait: str) -> tuple[str, ...]:
        """Return the classes that the expression names, in order."""
        classes = [part.partition("(")[0] for part in (self.blocking, self.awaiting)]
        if not wait:
            return (classes[0],)
        return (classes[1], classes[0]) if f"({classes[0]}(" in self.awaiting else (classes[1],)


class PythonFamily(NamedTuple):
    """What generated modules import for a family, and the facts about the bus of a device.

    `module` of the runtime has the names in `exports`, the class `device` and its `transport`, and both with `Async`
    before their names. `line` gives the transport that most people have, `maker` the function that makes a point's
    attribute. `settings` are further parameters of a device's constructor (name, class). `blocks` plans reads of
    groups.
    """

    module: str
    exports: frozenset[str]
    device: str
    transport: str
    profile: Callable[[Device, PackageScope], Node]
    line: Callable[[Device], Line]
    maker: Callable[[Point], str] = usual_maker
    blocks: Callable[[Device, PackageScope], Node | None] = lambda _device, _scope: None
    settings: tuple[tuple[str, str], ...] = ()


def in_python(device: Device) -> PythonFamily:
    """Return the part `targets.python` of the device's family."""
    part: PythonFamily = family(device.family).part("targets.python").IN_PYTHON
    return part


def telegrams(named_telegrams: Iterable[Telegram], scope: PackageScope) -> tuple[Node, ...]:
    """Return the telegrams of a device."""
    nodes = []
    for telegram in named_telegrams:
        message = () if telegram.message is None else (python_string(telegram.message),)
        facts = (python_string(telegram.name), python_string(telegram.direction), str(telegram.words), *message)
        nodes.append(call(scope.runtime("Telegram"), facts))
    return tuple(nodes)
