"""Bus families: addressing and framing rules that many devices share. Each family is one folder and one line below.

The `facts.py` of a folder defines `FAMILY`, a `contract.Family`. No code outside the folders names a family.
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
"""The package of each family, by the name of the family."""


def family(name: str) -> Family:
    """The family of that name; its package is imported when it is first asked for."""
    return _offered(FAMILIES[name])


def families() -> tuple[Family, ...]:
    """All families, in the order of the registry."""
    return tuple(family(name) for name in FAMILIES)


def sections_of_codes() -> dict[str, str]:
    """The sections of numbered codes under `bus`, by what errata call such a code."""
    return {codes.key: codes.section for each_family in families() for codes in each_family.codes}


@cache
def _offered(package: str) -> Family:
    module: Any = import_module(f"{package}.facts")
    offered: Family = module.FAMILY
    return offered
