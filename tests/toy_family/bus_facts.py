"""What the documentation says of a bell's line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from toy_family import of_bus

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.model import Bus, Code


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """How often it may be struck."""
    yield "Strikes in a minute", str(of_bus(bus).strikes)


def numbers(space: str, address: int) -> Mapping[str, int]:
    """The numbers that people use for an address, whatever the manual prints."""
    del space, address
    return {}


def goes_to_all(function: Code) -> bool:
    """No strike rings all bells."""
    del function
    return False
