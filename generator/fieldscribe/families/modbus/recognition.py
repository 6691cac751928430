"""Chooses what pasted bytes are: their framing, and whether their checksum is missing."""

from __future__ import annotations

from fieldscribe.families.decoded_frame import cut_apart
from fieldscribe.families.modbus.frames import LEAST, Unwrapped, reply_length, request_length, unwrap, without_crc
from fieldscribe.families.modbus.functions import FRAMINGS


def recognise(data: bytes, framings: tuple[str, ...], forced: str | None = None) -> Unwrapped:
    """The bytes in the forced framing; else in the one that checksum or header fit, else in that of the device."""
    usual = forced or (framings or FRAMINGS)[0]
    tried = (unwrap(framing, data) for framing in ((forced,) if forced else FRAMINGS))
    sound = next((unwrapped for unwrapped in tried if unwrapped.flaw is None), None)
    unwrapped = sound or unwrap(usual, data)
    flaw = unwrapped.flaw
    if flaw is None or flaw.swapped or unwrapped.framing == "tcp" or _is_whole(unwrapped.pdu):
        return unwrapped
    return without_crc(data) if _is_whole(data[1:]) else unwrapped


def frames_in(data: bytes, forced: str | None = None) -> list[bytes]:
    """The frames in pasted bytes: several if these are whole frames behind each other, by length and checksum."""
    framings = (forced,) if forced else FRAMINGS
    if any(unwrap(framing, data).flaw is None for framing in framings):
        return [data]
    cut = cut_apart(data, _sound_rtu, LEAST["rtu"]) if "rtu" in framings else [data]
    if len(cut) == 1 and "tcp" in framings:
        cut = cut_apart(data, _sound_tcp, LEAST["tcp"])
        cut = cut if all(unwrap("tcp", frame).flaw is None for frame in cut) else [data]
    return cut


def _sound_rtu(data: bytes) -> int:
    """The size of the RTU frame that the bytes begin with; 0 where the checksum of none is right."""
    pdu = data[1:]
    sizes = {request_length(pdu), reply_length(pdu)} if pdu else set()
    whole = (size + 3 for size in sorted(sizes) if 0 < size <= len(data) - 3)
    return next((size for size in whole if unwrap("rtu", data[:size]).flaw is None), 0)


def _sound_tcp(data: bytes) -> int:
    """The size of the TCP frame that the bytes begin with, as its header says; 0 where that cannot be."""
    size = 6 + int.from_bytes(data[4:6], "big")
    return size if unwrap("tcp", data[:size]).flaw is None else 0


def _is_whole(pdu: bytes) -> bool:
    """Whether a PDU is as long as its function says, as a request or as a reply."""
    return bool(pdu) and len(pdu) in (request_length(pdu), reply_length(pdu))
