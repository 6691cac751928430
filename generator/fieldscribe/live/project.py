"""Reads the lines and stations that `fieldscribe.toml` names, for commands that talk to devices.

[lines]
bench = "rtu:///dev/ttyUSB0?baud=19200&parity=even"

[stations.pump]
description = "hitachi_l200"  # an id, or a path from the folder of the file
line = "bench"                # a name from above, or a line itself
unit = 3
variant = {voltage_class = "400V"}
with = {slot = 3}             # numbers that addresses depend on
"""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path
from typing import Any, NamedTuple

from fieldscribe.safe_files import read_regular
from fieldscribe.text import shortened
from fieldscribe.user_errors import UnclearError, did_you_mean

NAME = "fieldscribe.toml"
_MOST_BYTES = 1 << 20
_KEYS = {"description": str, "line": str, "unit": int, "variant": dict, "with": dict}


class Station(NamedTuple):
    """A device on a line, by what it is, where, and which."""

    description: str
    line: str | None = None
    unit: int | None = None
    variants: tuple[str, ...] = ()
    settings: tuple[str, ...] = ()
    """What `--with` gives: numbers that addresses depend on."""


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
