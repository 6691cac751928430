"""What the documentation says of a bell's line."""

from __future__ import annotations

from collections.abc import Iterator

from fieldscribe.model import Bus

from toy_family import of_bus


def facts(bus: Bus) -> Iterator[tuple[str, str]]:
    """How often it may be struck."""
    yield "Strikes in a minute", str(of_bus(bus).strikes)
