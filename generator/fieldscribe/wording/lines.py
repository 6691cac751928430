"""Lines of a manual that sentences name: `the replies at lines 246 and 297`."""

from __future__ import annotations

import re
from typing import Any

LINES_NAMED = re.compile(r"\b[Ll]ine\s+[0-9]+|\b[Ll]ines\s+[0-9]+(?:(?:,|\s+and|\s+to|\.\.)\s*[0-9]+)*")


def without_lines(said: Any) -> Any:
    """What is said, also in several languages, whichever lines it names."""
    if isinstance(said, dict):
        return {key: without_lines(text) for key, text in said.items()}
    return LINES_NAMED.sub("lines", said) if isinstance(said, str) else said
