"""Options of the command line, as the commands pass them on."""

from __future__ import annotations

from typing import Any

from fieldscribe.families.frame_results import Options

_SHARED = ("framing", "unit", "request", "index")


def asked(**given: Any) -> Options:
    """Return options; those that only some families know go into `own`."""
    shared = {name: value for name, value in given.items() if name in _SHARED}
    return Options(
        **shared, of_family={name: given[name] for name in given if name not in _SHARED and given[name] is not None}
    )
