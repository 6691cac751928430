"""What a family declares about itself: its spaces, its keys under `bus`, its framings, and the parts of its folder."""

from __future__ import annotations

from dataclasses import dataclass, field
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

_OF_ALL = frozenset(
    {"units", "exceptions", "timing", "serial", "note", "source", "line", "lines", "words", "gaps", "broadcast"}
)


@dataclass(frozen=True, slots=True)
class BusKeys:
    """The keys of a family under `bus` (`needed` ones, and those `shared` with some other families), and its limits.

    `codes` is the range of its numbered codes. `broadcast` is the unit number that addresses all units, if it is fixed.
    """

    needed: tuple[str, ...] = ()
    shared: frozenset[str] = frozenset()
    codes: tuple[int, int] = (0, 255)
    last_exception: int = 255
    last_unit: int = 255
    broadcast: int | None = None

    def __contains__(self, key: object) -> bool:
        """Whether the family accepts this key under `bus`; the keys of its own part `keys` do not count."""
        return key in self.needed or key in self.shared or key in _OF_ALL


@dataclass(frozen=True, slots=True)
class Codes:
    """One list of numbered codes: its key under `bus`, what an erratum calls such a code, and what people call it."""

    section: str
    key: str
    kind: str
    belongs_to: str | None = None
    """The section whose codes these codes refer to."""
    emitted: bool = True
    """Whether generated code defines names for these codes."""


@dataclass(frozen=True, slots=True)
class Option:
    """A command-line option that only this family uses; without a type it is a switch."""

    name: str
    help: str
    commands: tuple[str, ...]
    type: type | None = None
    metavar: str | None = None
    choices: tuple[str, ...] | None = None

    @property
    def flag(self) -> str:
        """The option as it is typed."""
        return f"--{self.name.replace('_', '-')}"


@dataclass(frozen=True, slots=True)
class Family:
    """The facts of a family that every stage may read; whatever needs code is a module of its folder (a part).

    The parts: `keys` (keys that only this family has), `reading` (reads the family's facts from the description),
    `checks`, `speech` (decodes frames), `sending` (builds frames), `explaining` (shows example frames), `starting`
    (what a new description starts with), `export`, and `targets.<target>`. Whoever uses a part defines what it must
    offer.
    """

    name: str
    folder: str
    """The name of the package."""
    spaces: Mapping[str, str]
    """What one address of a space holds: `bit` or `word`."""
    last_address: int
    bus: BusKeys
    framings: tuple[str, ...]
    """The framings of worked examples, the usual one first."""
    codes: tuple[Codes, ...] = ()
    indexed: frozenset[str] = frozenset()
    """The spaces where an index travels with the address."""
    words: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    """The spaces whose numbers travel one at a time, with the most words that a number may have."""
    frame_keys: tuple[str, ...] = ()
    """The keys of a worked example that only this family knows."""
    lays_out_messages: bool = False
    """Whether descriptions lay out the messages of the device byte by byte."""
    commands_in: str | None = None
    """The space of commands that do not name one; None where the family has no commands."""
    writes_elsewhere: bool = False
    """Whether a point may be written at another address than it is read at."""
    chooses_memory: bool = False
    """Whether a request chooses the memory that the device keeps the value in."""
    options: tuple[Option, ...] = ()
    exports: tuple[str, ...] = ()
    """Forms of export that only this family has."""

    def widest(self, space: str) -> int:
        """The most bits of a number in the space."""
        return 16 * self.words.get(space, 4)

    def part(self, name: str) -> Any:
        """A part of the folder, imported when it is first asked for; None where the family has none."""
        path = f"{self.folder}.{name}"
        try:
            return import_module(path)
        except ModuleNotFoundError as error:
            if error.name is None or not f"{path}.".startswith(f"{error.name}."):
                raise
            return None
