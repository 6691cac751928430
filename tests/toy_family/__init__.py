"""A family for one test: bells that answer each letter with a number. It is a folder, and one line in the registry."""

from __future__ import annotations

from dataclasses import dataclass

from fieldscribe.families import BusKeys, Family
from fieldscribe.model import Bus, FamilyFacts

FAMILY = Family(
    name="bell",
    folder=__package__,
    spaces={"tone": "word"},
    last_address=25,
    bus=BusKeys(last_unit=9),
    framings=("strike",),
)


@dataclass(frozen=True, slots=True)
class BellBus(FamilyFacts):
    """How often a bell may be struck in a minute."""

    strikes: int = 60


def of_bus(bus: Bus) -> BellBus:
    """What bells alone have on a bus."""
    return bus.family_facts if isinstance(bus.family_facts, BellBus) else BellBus()
