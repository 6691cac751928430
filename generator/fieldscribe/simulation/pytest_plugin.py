"""A fixture for pytest: `simulated_device("hitachi_l200")` runs a device until the end of the test."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from fieldscribe.simulation.servers import Simulated


@pytest.fixture
def simulated_device() -> Iterator[Callable[..., Simulated]]:
    """Return a function with the arguments of `fieldscribe.simulation.simulated`; each call runs another device."""
    from fieldscribe.simulation.servers import simulated  # every run of pytest imports this module

    with ExitStack() as running:

        def run(device: str, **settings: Any) -> Simulated:
            return running.enter_context(simulated(device, **settings))

        yield run
