"""The text that names a line: `tcp://192.168.0.20:502`, `rtu:///dev/ttyUSB0?baud=9600&parity=even`.

A family's `lines.py` says which schemes it has, and opens them. `fieldscribe.toml` names lines and stations:

[lines]
bench = "rtu:///dev/ttyUSB0?baud=19200&parity=even"

[stations.pump]
description = "hitachi_l200"  # an id, or a path from the folder of the file
line = "bench"                # a name from above, or a line itself
unit = 3
variant = {voltage_class = "400V"}
with = {slot = 3}             # numbers that addresses depend on
"""

from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from fieldscribe.diagnostics import UnclearError, did_you_mean
from fieldscribe.families import Family, families, family
from fieldscribe.model import Device
from fieldscribe.safe_files import read_regular
from fieldscribe.text import shortened

_PARITIES = {"none": "N", "even": "E", "odd": "O"}
SERIAL_KEYS = ("baud", "parity", "stop", "bits", "echo")
"""The settings after `?` of a serial line."""


@dataclass(frozen=True, slots=True)
class LineAddress:
    """A parsed line: the text, its scheme, the part after `://`, and the settings after `?`."""

    text: str
    scheme: str
    place: str
    settings: dict[str, str]

    def number(self, key: str, default: int, ends: tuple[int, int]) -> int:
        """Return a setting that is a whole number; `default` if it is not there. Raises UnclearError."""
        text = self.settings.get(key)
        if text is None:
            return default
        if not (text.isascii() and text.isdigit() and len(text) < 10 and ends[0] <= int(text) <= ends[1]):
            raise self.wrong(f"`{key}` is a number from {ends[0]} to {ends[1]}, not `{shortened(text)}`")
        return int(text)

    def choice(self, key: str, default: str, choices: Iterable[str]) -> str:
        """Return a setting that is one of several words. Raises UnclearError."""
        text = self.settings.get(key, default)
        if text not in (known := list(choices)):
            raise self.wrong(f"`{key}` is one of {', '.join(known)}, not `{shortened(text)}`")
        return text

    def host_and_port(self, default: int | None) -> tuple[str, int]:
        """Return a host and its port; the host may be an IPv6 address in brackets. Raises UnclearError."""
        host, colon, port = self.place.rpartition(":")
        if not colon or port.endswith("]"):
            host, port = self.place, "" if default is None else str(default)
        if not host or not (port.isascii() and port.isdigit() and 0 < int(port[:6]) <= 0xFFFF):
            raise self.wrong("it takes a host and a port, as in 192.168.0.20:502")
        return host.removeprefix("[").removesuffix("]"), int(port)

    def serial(self, usual_mode: str) -> dict[str, Any]:
        """Return the settings of a serial line, named as the runtime takes them. Raises UnclearError."""
        if not self.place:
            raise self.wrong("it takes a port, as in rtu:///dev/ttyUSB0 or rtu://COM3")
        parity = self.choice("parity", {sign: name for name, sign in _PARITIES.items()}[usual_mode[1]], _PARITIES)
        bits, stop = self.choice("bits", usual_mode[0], "78"), self.choice("stop", usual_mode[2], "12")
        return {
            "port": self.place,
            "baudrate": self.number("baud", 9600, (1, 10_000_000)),
            "mode": f"{bits}{_PARITIES[parity]}{stop}",
            "echo": self.choice("echo", "no", ("no", "yes")) == "yes",
        }

    def wrong(self, why: str) -> UnclearError:
        """Return the error for an invalid line."""
        return UnclearError(f"the line `{shortened(self.text)}`: {why}", f"lines are {', '.join(examples())}")


class Closable(Protocol):
    """The part of a runtime transport that the line needs."""

    def close(self) -> None:
        """Close the line."""


@dataclass(frozen=True, slots=True)
class OpenLine:
    """A line with its runtime transport, and the seconds to wait for an answer (None: the default)."""

    address: LineAddress
    transport: Closable
    timeout: float | None


def read_line(text: str) -> LineAddress:
    """Return a line from its text. Raises UnclearError for an unknown scheme or setting."""
    scheme, separator, rest = text.strip().partition("://")
    known = {name: keys for family in families() for name, keys in schemes_of(family).items()}
    if not separator or scheme not in known:
        near = did_you_mean([f"{name}://" for name in get_close_matches(scheme, known, 1)]) if separator else ""
        what = f"no line begins with `{shortened(scheme)}://`" if separator else f"`{shortened(text)}` is no line"
        raise UnclearError(what, near or f"lines are {', '.join(examples())}")
    place, _, query = rest.partition("?")
    pairs = [pair.partition("=") for pair in query.split("&") if pair]
    line = LineAddress(text, scheme, place, {key: value for key, _, value in pairs})
    for key in line.settings:
        if key not in known[scheme]:
            takes = f"it takes {', '.join(known[scheme])}" if known[scheme] else "it takes no settings"
            raise line.wrong(f"there is no setting `{shortened(key)}`; {takes}")
    return line


def require_line(line: LineAddress, device: Device) -> None:
    """Raises UnclearError if the device cannot be on this kind of line."""
    known = schemes_of(family(device.family))
    if line.scheme not in known:
        message = f"{device.id} is a {device.family} device, and none is on a line {line.scheme}://"
        raise UnclearError(message, f"its lines are {', '.join(f'{scheme}://' for scheme in known)}" if known else "")


def families_of(line: LineAddress) -> list[Family]:
    """Return the families whose devices such a line can have."""
    return [family for family in families() if line.scheme in schemes_of(family)]


def examples() -> list[str]:
    """Return an example of each line."""
    return [example for family in families() for example in getattr(family.part("lines"), "EXAMPLES", ())]


def schemes_of(family: Family) -> dict[str, tuple[str, ...]]:
    """Return the settings of each scheme of a family."""
    schemes: dict[str, tuple[str, ...]] = getattr(family.part("lines"), "SCHEMES", {})
    return schemes


NAME = "fieldscribe.toml"
_MOST_BYTES = 1 << 20
_KEYS = {"description": str, "line": str, "unit": int, "variant": dict, "with": dict}


class Station(NamedTuple):
    """A device on a line: its description, line, unit and variant."""

    description: str
    line: str | None = None
    unit: int | None = None
    variants: tuple[str, ...] = ()
    settings: tuple[str, ...] = ()
    """The numbers of `--with`, which addresses depend on."""


class Project(NamedTuple):
    """The named lines and stations."""

    lines: dict[str, str]
    stations: dict[str, Station]


def read_project(file: Path) -> Project:
    """Return the lines and stations of a project file; none if there is no file. Raises UnclearError, OSError."""
    if not file.exists():
        return Project({}, {})
    import tomllib

    try:
        document = tomllib.loads(read_regular(file, _MOST_BYTES).data.decode("utf-8-sig"))
    except (ValueError, RecursionError) as error:
        raise UnclearError(f"{file}: this is no TOML: {shortened(str(error))}") from error
    lines = _table(file, document, "lines")
    for name, line in lines.items():
        if not isinstance(line, str):
            raise UnclearError(f"{file}: lines.{name} is no text", f'write `{name} = "tcp://192.168.0.20:502"`')
    stations = {name: _station(file, name, facts) for name, facts in _table(file, document, "stations").items()}
    return Project(lines, stations)


def _table(file: Path, document: dict[str, Any], key: str) -> dict[str, Any]:
    table = document.get(key, {})
    if not isinstance(table, dict):
        raise UnclearError(f"{file}: `{key}` is no table", f"write `[{key}]`, and a name below it")
    return table


def _station(file: Path, name: str, facts: Any) -> Station:
    if not isinstance(facts, dict):
        raise UnclearError(f"{file}: stations.{name} is no table", f"write `[stations.{name}]`")
    for key, value in facts.items():
        if key not in _KEYS:
            near = did_you_mean(get_close_matches(key, _KEYS, 1)) or f"it has {', '.join(_KEYS)}"
            raise UnclearError(f"{file}: stations.{name} has no key `{shortened(key)}`", near)
        if type(value) is not _KEYS[key]:
            raise UnclearError(f"{file}: stations.{name}.{key} is no {_KINDS[_KEYS[key]]}", _EXAMPLE)
    if "description" not in facts:
        raise UnclearError(f"{file}: stations.{name} has no `description`", _EXAMPLE)
    pairs = [tuple(f"{name}={value}" for name, value in facts.get(key, {}).items()) for key in ("variant", "with")]
    return Station(facts["description"], facts.get("line"), facts.get("unit"), *pairs)


_KINDS = {str: "text", int: "whole number", dict: "table"}
_EXAMPLE = 'as in `description = "hitachi_l200"`, `line = "bench"`, `unit = 3`, `variant = {voltage_class = "400V"}`'
