"""What all tests of live devices have alike."""

from __future__ import annotations

import pytest
from fieldscribe.cli.live_options import Progress


@pytest.fixture(autouse=True)
def _quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing takes so long that its progress is shown: a busy machine prints no more than an idle one."""
    monkeypatch.setattr(Progress, "show", lambda *_: None)
