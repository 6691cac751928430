"""Sentences about Modbus frames: names of functions and exceptions, faults, findings and notes."""

from collections.abc import Iterator, Mapping
from dataclasses import asdict

from fieldscribe.families.modbus import BROADCAST, FAMILY, FUNCTIONS, READS, profile_of
from fieldscribe.families.modbus.frames import Flaw, Request, Unwrapped
from fieldscribe.model import Device
from fieldscribe.text import counted, line
from fieldscribe.wording.numbers import check_text, hex_text, numbered, spaced, span_text, strange_unit, too_short

EXCEPTIONS: Mapping[int, str] = {
    0x01: "illegal function",
    0x02: "illegal data address",
    0x03: "illegal data value",
    0x04: "device failure",
    0x05: "acknowledged, still working",
    0x06: "device busy",
    0x08: "memory parity error",
    0x0A: "gateway path unavailable",
    0x0B: "gateway target did not answer",
}
_FLAWS: Mapping[str, str] = {
    "bad_crc": "the checksum is wrong",
    "no_crc": "the checksum is missing",
    "bad_protocol": "the header does not say Modbus",
    "bad_length": "the length in the header is wrong",
    "bad_function": "function {of:02X}h is not one of the Modbus functions known here",
    "short_request": "a request of function {of:02X}h has at least {due} bytes from the function on, here are {here}",
    "long_request": "a request of function {of:02X}h has {due} bytes from the function on, here are {here}",
    "bad_count": "a count of {here} is outside 1 to {due}",
    "bad_coil": "a coil is written with FF00h or 0000h, here is {here:04X}h",
    "no_byte_count": "the byte count is missing, here are 0 bytes of data",
    "bad_byte_count": "the byte count says {due}, here are {here} bytes of data",
    "bad_words": "{of} words are {due} bytes, here are {here}",
    "bad_coils": "{of} coils are {due} bytes (or padded to an even number), here are {here}",
    "long_exception": "an exception has {due} bytes from the function on, here are {here}",
}
_MOST_BYTES = {"rtu": 256, "tcp": 260}
_LEAST = {4: "an RTU frame", 8: "a TCP frame"}
NO_REQUEST = "only the request says which addresses these are: give it before this frame, or with --request"
BROADCAST_NOTE = "broadcast: no unit answers"
UNKNOWN_REQUEST = "which request it refuses is not in the frame"


def flaw_text(flaw: Flaw) -> str:
    """Return why bytes are not a frame, or not a request."""
    if flaw.status == "short_frame":
        return too_short(_LEAST[flaw.due], flaw.due, flaw.here)
    return "the bytes of the checksum are swapped" if flaw.swapped else _FLAWS[flaw.status].format(**asdict(flaw))


def frame_faults(unwrapped: Unwrapped) -> tuple[str, ...]:
    """Return what is wrong with the frame around the PDU."""
    if unwrapped.flaw is not None:
        return (flaw_text(unwrapped.flaw),)
    size, most = len(unwrapped.data), _MOST_BYTES[unwrapped.framing]
    return (f"the frame has {size} bytes, at most {most} are allowed",) if size > most else ()


def frame_checks(unwrapped: Unwrapped) -> str:
    """Return whether the checksum or the header of a frame is right."""
    flaw, here = unwrapped.flaw, unwrapped.data[-2:]
    if flaw is None:
        return check_text(here, here) if unwrapped.framing == "rtu" else f"ok (transaction {unwrapped.transaction})"
    right = flaw.due.to_bytes(2, "little")
    if flaw.swapped:
        return f"its two bytes are swapped: {spaced(here)}, the low byte {spaced(right)} travels first"
    if flaw.status in ("bad_crc", "no_crc"):
        return check_text(here if flaw.status == "bad_crc" else b"", right)
    if flaw.status == "bad_protocol":
        return f"wrong: protocol number {spaced(unwrapped.data[2:4])} in place of 00 00"
    return f"wrong: it says {flaw.due} bytes follow, {flaw.here} do" if flaw.status == "bad_length" else "none"


def summary(framing: str, unit: int | None, function: int | None, text: str) -> str:
    """Return a frame in one line: `RTU, unit 1, 03h read holding registers: request, ...`."""
    unit_text = "no unit" if unit is None else f"unit {unit}"
    named = ""
    if function is not None:
        name = FUNCTIONS[function].name if function in FUNCTIONS else "(not a function known here)"
        named = f", {hex_text(function, 2)} {name}"
    return f"{framing.upper()}, {unit_text}{named}: {text}"


def reply_text(framing: str, unit: int | None, request: Request) -> str:
    """Return the summary of the reply to a request."""
    done = "" if request.function in READS else ", the device has taken the request"
    return summary(framing, unit, request.function, f"reply{done}, {span_of_request(request)}")


def unreadable_text(pdu: bytes, flaw: Flaw) -> str:
    """Return why a PDU is not a request, and for a read also why it is not a reply."""
    problem = flaw_text(flaw)
    if pdu[0] not in READS or len(pdu) < 2:
        return problem
    here = "is" if len(pdu) == 3 else "are"
    follow = f"{counted(pdu[1], 'byte')} of data {'follows' if pdu[1] == 1 else 'follow'}"
    return f"as a request: {problem}; as a reply: it says that {follow}, here {here} {len(pdu) - 2}"


def exception_text(device: Device, code: int) -> str:
    """Return the meaning of an exception from the manual, or else from the protocol."""
    known = numbered(device.bus.exceptions, code)
    if known is not None:
        return line(f"{hex_text(code, 2)} {known.name}: {known.title['en']}")
    common = EXCEPTIONS.get(code)
    meaning = (
        f"{common} (the protocol's meaning; the manual does not list it)" if common else "the manual does not list it"
    )
    return f"{hex_text(code, 2)}: {meaning}"


def span_of_request(request: Request) -> str:
    """Return the addresses of a request in words: `holding 1013h to 1014h (4115 to 4116), 2 words`."""
    if request.function == 0x08:
        return f"sub-function {hex_text(request.address)}"
    space = FUNCTIONS[request.function].space
    where = span_text(request.address, request.address + max(request.count, 1) - 1)
    return f"{space} {where}, {counted(request.count, FAMILY.spaces[space])}"


def request_findings(device: Device, request: Request) -> Iterator[str]:
    """Yield why the device refuses a request."""
    profile = profile_of(device.bus)
    most = profile.most.get(request.function)
    if most is None:
        yield f"the device does not know function {hex_text(request.function, 2)}"
    elif request.count > most:
        yield f"the device takes at most {most} of them in one request"
    if request.unit != profile.broadcast:
        if strange := strange_unit(device.bus, request.unit):
            yield strange
    elif request.function not in BROADCAST:
        yield "broadcast: only writes may be sent to all units"
    elif request.function not in profile.broadcasts:
        yield f"broadcast: the device does not accept function {hex_text(request.function, 2)} as a broadcast"
    if request.address + request.count > 0x10000:
        yield "it reaches beyond the last address"
