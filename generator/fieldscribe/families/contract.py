"""What a family says of itself: its spaces, its keys under `bus`, its framings, and the parts of its folder."""

from __future__ import annotations

from dataclasses import dataclass, field
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

_OF_ALL = frozenset({"units", "exceptions", "timing", "serial", "note", "source", "line", "words", "gaps", "broadcast"})


@dataclass(frozen=True, slots=True)
class BusKeys:
    """The keys that a family needs under `bus`, those that it shares with some others, and how far its numbers go.

    `broadcast` is the one number that goes to all units, where the family has only one.
    """

    needed: tuple[str, ...] = ()
    shared: frozenset[str] = frozenset()
    codes: tuple[int, int] = (0, 255)
    last_exception: int = 255
    last_unit: int = 255
    broadcast: int | None = None

    def __contains__(self, key: object) -> bool:
        """Whether the family has a key that others have, too, or needs it."""
        return key in self.needed or key in self.shared or key in _OF_ALL


@dataclass(frozen=True, slots=True)
class Codes:
    """One list of numbered codes: its key under `bus`, what an erratum calls such a code, and what people call it."""

    section: str
    key: str
    kind: str
    belongs_to: str | None = None
    """The section with the codes that these name as theirs."""
    emitted: bool = True
    """Whether generated code has names for them."""


@dataclass(frozen=True, slots=True)
class Option:
    """An option of the command line that only this family has a use for; without a type it is a switch."""

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
    """The rules of a family, as far as every stage may ask for them; what takes code is a part of its folder.

    The parts are modules: `keys` (those that it alone has), `reading` (its own facts, out of the text), `checks`,
    `speech`, `sending` and `explaining` (frames taken apart, built, and shown), `export`, and `targets.<target>`; each
    room says what it asks of its part.
    """

    name: str
    folder: str
    """The package."""
    spaces: Mapping[str, str]
    """What one address of a space holds: `bit` or `word`."""
    last_address: int
    bus: BusKeys
    framings: tuple[str, ...]
    """How worked examples are wrapped, the usual way first."""
    codes: tuple[Codes, ...] = ()
    indexed: frozenset[str] = frozenset()
    """The spaces where an address has an index beside it."""
    words: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    """The spaces whose numbers travel one by one, with the most words of one."""
    frame_keys: tuple[str, ...] = ()
    """The keys of a worked example that only this family knows."""
    lays_out_messages: bool = False
    """Whether descriptions lay out the messages of the device byte by byte."""
    commands_in: str | None = None
    """The space that commands are written to where they do not say another; None where there are no commands."""
    chooses_memory: bool = False
    """Whether a request says where the device keeps the value."""
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
