"""What all sources of frames have in common: bytes with their time, and frames that are cut out of them."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

BYTES, STREAM, MESSAGE, SILENT = "bytes", "stream", "message", ""
"""How bytes travel: on a serial line, in a connection of a network, as messages with an identifier; or nothing came."""


@dataclass(frozen=True, slots=True)
class Chunk:
    """Bytes that came together; without any, nothing came for a while.

    `place` tells lines and connections apart. `fresh`: bytes before these are lost. `sent`: whether they go to the
    device, if that is known. `identifier` is that of a message; `remote` messages only ask for data.
    """

    time: float | None
    kind: str
    data: bytes
    place: str = ""
    sent: bool | None = None
    fresh: bool = False
    identifier: int = 0
    remote: bool = False


@dataclass(frozen=True, slots=True)
class Cut:
    """A frame that was cut out: as its family's decoder takes it, and as bytes.

    `unit` is the unit that it is for or from, if the bytes alone tell it. Requests and answers with another `exchange`
    do not belong together. `damaged`: the bytes are no sound frame, so all that they say may be wrong.
    """

    time: float | None
    frame: Any
    data: bytes
    framing: str | None
    unit: int | None = None
    place: str = ""
    exchange: Hashable = None
    sent: bool | None = None
    damaged: bool = False
