"""Chooses what pasted bytes are: their framing, and whether their checksum is missing."""

from __future__ import annotations

from fieldscribe.families.modbus.frames import Unwrapped, reply_length, request_length, unwrap, without_crc
from fieldscribe.families.modbus.functions import FRAMINGS


def recognise(data: bytes, framings: tuple[str, ...], forced: str | None = None) -> Unwrapped:
    """The bytes in the forced framing; else in the one that checksum or header fit, else in that of the device."""
    usual = forced or (framings or FRAMINGS)[0]
    tried = [unwrap(framing, data) for framing in ((forced,) if forced else FRAMINGS)]
    sound = next((unwrapped for unwrapped in tried if unwrapped.flaw is None), None)
    unwrapped = sound or unwrap(usual, data)
    flaw = unwrapped.flaw
    if flaw is None or flaw.swapped or unwrapped.framing == "tcp" or _is_whole(unwrapped.pdu):
        return unwrapped
    return without_crc(data) if _is_whole(data[1:]) else unwrapped


def _is_whole(pdu: bytes) -> bool:
    """Whether a PDU is as long as its function says, as a request or as a reply."""
    return bool(pdu) and len(pdu) in (request_length(pdu), reply_length(pdu))
