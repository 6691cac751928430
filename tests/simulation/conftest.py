"""The fixture that the package ships, as tests of its users find it."""

from __future__ import annotations

from fieldscribe.simulation.pytest_plugin import simulated_device

__all__ = ["simulated_device"]
