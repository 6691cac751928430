"""Bus families: addressing and framing rules that many devices share.

A family is one folder here and one line in `FAMILIES`. No code outside the folder names the family; the stages ask
`family(name)` for its facts and for the parts of its folder. What a folder holds:

- `__init__.py` defines `FAMILY`, a `Family`, and the numbers of the protocol: functions, spaces, limits.
- `description.py`: the keys that only this family has (`KEYS`), and the text of a new description.
- `reading.py`: `READING` turns these keys into facts of the model.
- `checks.py`: `CHECKS` report what only this family can get wrong; `read` reads a worked example.
- `frames.py` (USS: `telegrams.py`) builds and parses bytes; pure functions.
- `frame_decoder.py`: `decoder_of(device, options)` decodes pasted frames; `remarks.py` has longer lists of sentences.
- `frame_builder.py`: `frames_for`, `read_text` and `way_to_write` build the frames that read and write a point.
- `lines.py`: the kinds of lines as `SCHEMES` with their settings, the functions that open them, and the cutter that
  divides what is received into frames, as `listening/__init__.py` describes it.
- `simulation.py`: `core_of(devices)` answers requests as the devices on one line would.
- `bus_facts.py`: the facts of the bus for documentation and exports.
- `targets/<target>.py`: what the generated code of one target needs: profile, requests, tables, test vectors.

To add a function of a bus:

1. Add a row to the table of the protocol: `FUNCTIONS` in `modbus/__init__.py`, or `_WRITE_TASKS` and `RESPONSE_WIDTHS`
   in `uss/telegrams.py`. Checks, profiles, generated tables and the vectors of all devices follow from it.
2. If its bytes have a new form, add that to `frames.py` (USS: `telegrams.py`), to `frame_decoder.py`, and to the
   reply in `simulation.py`. The runtimes in `templates/<target>/runtime` have the same form once more, each in its
   language. In C, each function of Modbus is an argument of `FIELDSCRIBE_MODBUS_PROFILE` in
   `fieldscribe_modbus_facts.h`: add one, and raise `FIELDSCRIBE_MODBUS_INTERFACE` there and in
   `templates/c/modbus.h.j2`; a number above all others also raises `FIELDSCRIBE_MODBUS_FUNCTIONS`.
3. Add its requests and replies to the vectors, which show where a language differs: in `targets/wire.py` of Modbus,
   `targets/vectors.py` of USS. `tests/families` compares Modbus with pymodbus: add the request to its table.

A family leaves out the parts that it does not need; the caller of a part documents its interface.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import import_module
from types import MappingProxyType
from typing import Any

FAMILIES: dict[str, str] = {
    "modbus": "fieldscribe.families.modbus",
    "can": "fieldscribe.families.can",
    "uss": "fieldscribe.families.uss",
}
"""The package of each family, by the name of the family."""

_OF_ALL = frozenset(
    {"units", "exceptions", "timing", "serial", "note", "source", "line", "lines", "words", "bytes", "gaps"}
    | {"broadcast"}
)


@dataclass(frozen=True, slots=True)
class BusKeys:
    """The keys of a family under `bus` (required ones, and those shared with some other families), and its limits.

    `codes` is the range of its numbered codes. `broadcast` is the unit number that addresses all units, if the protocol
    fixes it.
    """

    needed: tuple[str, ...] = ()
    shared: frozenset[str] = frozenset()
    codes: tuple[int, int] = (0, 255)
    last_exception: int = 255
    last_unit: int = 255
    broadcast: int | None = None

    def __contains__(self, key: object) -> bool:
        """Return True if the family accepts this key under `bus`; the keys of its own `description` do not count."""
        return key in self.needed or key in self.shared or key in _OF_ALL


@dataclass(frozen=True, slots=True)
class Codes:
    """One list of numbered codes: its key under `bus`, the word that errata use for a code, and the word for people."""

    section: str
    key: str
    kind: str
    belongs_to: str | None = None
    """The section whose codes these codes refer to."""
    emitted: bool = True
    """True if generated code defines names for these codes."""


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
    """The facts of a family that every stage may read; behaviour is in the modules of its folder, its parts."""

    name: str
    folder: str
    """The name of the package."""
    spaces: Mapping[str, str]
    """What one address of a space holds: `bit` or `word`; `signal` if points are bits of a message."""
    last_address: int
    bus: BusKeys
    framings: tuple[str, ...]
    """The framings of worked examples, the usual one first."""
    codes: tuple[Codes, ...] = ()
    indexed: frozenset[str] = frozenset()
    """The spaces in which an index travels with the address."""
    words: Mapping[str, int] = field(default_factory=lambda: MappingProxyType({}))
    """The spaces whose numbers travel one at a time, each with the most words of a number."""
    frame_keys: tuple[str, ...] = ()
    """The keys of a worked example that only this family knows."""
    lays_out_messages: bool = False
    """True if descriptions lay out the messages of the device byte by byte."""
    commands_in: str | None = None
    """The space of commands that do not name one; None if the family has no commands."""
    writes_elsewhere: bool = False
    """True if a point may have different addresses for reading and writing."""
    has_bases: bool = False
    """True if addresses may count from a base that is given or found."""
    chooses_memory: bool = False
    """True if a request chooses the memory in which the device keeps the value."""
    options: tuple[Option, ...] = ()
    exports: tuple[str, ...] = ()
    """Forms of export that only this family has."""

    def widest(self, space: str) -> int:
        """Return the number of bits of the widest number in the space."""
        return 16 * self.words.get(space, 4)

    def numbers(self, space: str, address: int) -> Mapping[str, int]:
        """Return the usual numbers for an address, by numbering, for manuals that print none."""
        numbers: Mapping[str, int] = getattr(self.part("bus_facts"), "numbers", lambda _space, _: {})(space, address)
        return numbers

    def part(self, name: str) -> Any:
        """Return a module of the folder, imported on first use; None if the family does not have it."""
        return _part(f"{self.folder}.{name}")


def family(name: str) -> Family:
    """Return the family of that name; its package is imported on first use."""
    return _load(FAMILIES[name])


def families() -> tuple[Family, ...]:
    """Return all families in the order of the registry."""
    return tuple(family(name) for name in FAMILIES)


def sections_of_codes() -> dict[str, str]:
    """Return the sections of numbered codes under `bus`, by the word that errata use for such a code."""
    return {codes.key: codes.section for each_family in families() for codes in each_family.codes}


@cache
def _part(path: str) -> Any:
    try:
        return import_module(path)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{path}.".startswith(f"{error.name}."):
            raise
        return None


@cache
def _load(package: str) -> Family:
    module: Any = import_module(package)
    loaded: Family = module.FAMILY
    return loaded
