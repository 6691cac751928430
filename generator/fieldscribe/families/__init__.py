"""Bus families: addressing and framing rules that many devices share. A family is a folder, and a line below.

A folder offers its `FAMILY` (`contract.py` beside this says what that is). Nothing outside the folders names a family.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fieldscribe.families.contract import Family

FAMILIES: dict[str, str] = {
    "modbus": "fieldscribe.families.modbus",
    "can": "fieldscribe.families.can",
    "uss": "fieldscribe.families.uss",
}
"""All families by name, with the package that each one is."""


def family(name: str) -> Family:
    """The family of that name; its package is imported when it is first asked for."""
    return _offered(FAMILIES[name])


def families() -> tuple[Family, ...]:
    """All families, in the order of the registry."""
    return tuple(family(name) for name in FAMILIES)


@cache
def _offered(package: str) -> Family:
    module: Any = import_module(f"{package}.facts")
    offered: Family = module.FAMILY
    return offered
