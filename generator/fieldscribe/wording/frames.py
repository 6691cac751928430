"""Texts that all families use: about units, addresses, bytes and words, and replies that do not fit."""

from collections.abc import Mapping, Sequence

from fieldscribe.model import Bus, Code, Frame
from fieldscribe.text import line
from fieldscribe.wording.exact import hex_text

ALL_ELEMENTS = 255
_NO_ANSWER: Mapping[str, str] = {
    "wrong_unit": "it comes from another unit than was asked",
    "wrong_transaction": "its transaction number is not that of the request",
    "wrong_function": "its function is not that of the request",
    "bad_byte_count": "it brings another number of bytes than was asked for",
    "echo_mismatch": "it does not repeat the request",
    "short_frame": "it is shorter than it says",
    "long_frame": "it is longer than it says",
    "wrong_parameter": "it is about another parameter or element",
    "wrong_response": "its response does not belong to the task",
    "wrong_length": "it has too few words for its response",
}


def units_text(bus: Bus) -> str:
    """Return the unit numbers that the device may have: `units are 1 to 32`."""
    low, high = bus.units
    return f"units are {low} to {high}"


def strange_unit(bus: Bus, unit: int) -> str:
    """Return a text if the device cannot have a unit number; empty if it can."""
    low, high = bus.units
    return "" if low <= unit <= high else f"the device cannot have unit {unit}: {units_text(bus)}"


def hex_words(words: Sequence[int]) -> str:
    """Return words as manuals print them: `0001h FFFFh`."""
    return " ".join(f"{word:04X}h" for word in words)


def too_short(what: str, least: int, here: int) -> str:
    """Return a text about bytes that are too few for any frame."""
    return f"{what} has at least {least} bytes, here {'is' if here == 1 else 'are'} {here}"


def spaced(data: bytes) -> str:
    """Return bytes as manuals print them: `05 06 10 28`."""
    return data.hex(" ").upper()


def check_text(there: bytes, right: bytes) -> str:
    """Return the result of comparing a checksum (`there`) with the computed one (`right`)."""
    if not there:
        return f"missing; it would be {spaced(right)}"
    return f"ok ({spaced(there)})" if there == right else f"wrong: {spaced(there)}; these bytes give {spaced(right)}"


def no_answer_text(status: str, request: str = "request") -> str:
    """Return why a frame does not answer the open request."""
    return f"it does not answer the {request}: {_NO_ANSWER.get(status, status)}"


def span_text(low: int, high: int) -> str:
    """Return addresses in both notations: `1028h (4136)`, `1013h to 1014h (4115 to 4116)`."""
    return f"{hex_text(low)} ({low})" if low == high else f"{hex_text(low)} to {hex_text(high)} ({low} to {high})"


def element_text(parameter: int, index: int, *, alone: bool) -> str:
    """Return `parameter 1082`, or `parameter 2010, index 1`. `alone`: the parameter has a single element."""
    element = f", all elements (index {index})" if index == ALL_ELEMENTS else f", index {index}"
    return f"parameter {parameter}" + ("" if index == 0 and alone else element)


def numbered(codes: Sequence[Code], number: int) -> Code | None:
    """Return the code with that number."""
    return next((code for code in codes if code.number == number), None)


def word_text(addresses: tuple[int, ...], address: int, *, text: bool = False) -> str:
    """Return the word of a point at an address: `low word (2 of 2)`; empty for a point of one word."""
    count = len(addresses)
    if count < 2 or address not in addresses:
        return ""
    place = addresses.index(address)
    if text:
        return f"word {place + 1} of {count}, the first characters first"
    name = {0: "high word", count - 1: "low word"}.get(place, "word")
    return f"{name} ({place + 1} of {count}, the high part first)"


def misprint_text(frame: Frame) -> str:
    """Return the note for a frame that the manual prints with exactly this error."""
    known = f" (errata: {', '.join(frame.errata)})" if frame.errata else ""
    return line(f"the manual prints exactly these bytes as {frame.name}{known}; right is {spaced(frame.corrected)}")
