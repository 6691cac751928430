"""Frames of a CAN protocol of its own."""

from __future__ import annotations

from collections.abc import Mapping

from support.vector_file import Vector

from conformance.package import Check, Package


def can_build(package: Package, vector: Vector) -> bool:
    """The frame of a message."""
    profile = package.device.PROFILE
    arguments = profile.message(vector["message"]), profile, vector["unit"], vector["address"], vector["raw"]
    status, frame = package.outcome(package.can.build, *arguments)
    sent = (frame.id, frame.data) if status == "ok" else ()
    return bool(status == vector["status"] and (not sent or sent == (vector["id"], vector["bytes"])))


def can_reply(package: Package, vector: Vector) -> bool:
    """What a frame carries."""
    frame = package.can.Frame(vector["id"], vector["bytes"])
    message = package.device.PROFILE.message(vector["message"])
    status, found = package.outcome(package.can.parse, message, vector["unit"], frame)
    return bool(status == vector["status"] and (status != "ok" or found == (vector["address"], vector["raw"])))


def can_taken(package: Package, vector: Vector) -> bool:
    """Which frames belong to a telegram."""
    receiver = package.can.Receiver(package.device.PROFILE, vector["telegram"], vector["unit"])
    return bool([int(receiver.take(package.can.Frame(*frame))) for frame in vector["frames"]] == vector["taken"])


def can_telegram(package: Package, vector: Vector) -> bool:
    """A point of a telegram."""
    receiver = package.can.Receiver(package.device.PROFILE, vector["telegram"], vector["unit"])
    taken = [int(receiver.take(package.can.Frame(*frame))) for frame in vector["frames"]]
    point = package.point(vector)
    addresses = point.facts.at.addresses
    status, words = package.outcome(receiver.words, addresses)
    if status != vector["status"] or taken != vector["taken"] or point.facts.at.telegram != vector["telegram"]:
        return False
    by_address = dict(zip(addresses, words, strict=True)) if status == "ok" else {}
    return status != "ok" or point.from_words([by_address[one] for one in sorted(by_address)]) == vector["raw"]


def can_signal(package: Package, vector: Vector) -> bool:
    """A signal of a message, out of a frame and into one."""
    profile, point = package.device.PROFILE, package.point(vector)
    message, addresses = profile.message(vector["telegram"]), point.facts.at.addresses
    frame = package.can.Frame(vector["id"], vector["bytes"] or b"")
    status, _ = package.outcome(package.can.parse, message, vector["unit"], frame)
    receiver = package.can.Receiver(profile, vector["telegram"], vector["unit"])
    if receiver.take(frame) != (status == "ok"):
        return False
    if status == "ok":
        status, words = package.outcome(receiver.words, addresses)
    if status != vector["status"] or status != "ok":
        return bool(status == vector["status"])
    number = [sum(one.words for one in message.signals[:at]) for at in range(len(message.signals))].index(addresses[0])
    raw = vector["raw"]
    selecting = {place: raws[-1] for place, raws in message.signals[number].when}
    packed = package.can.Packing(message.signals, message.length).data({**selecting, number: raw})
    return bool(point.from_words(words) == raw and packed == vector["packed"])


CHECKS: Mapping[str, Check] = {
    "can_build": can_build,
    "can_reply": can_reply,
    "can_signal": can_signal,
    "can_taken": can_taken,
    "can_telegram": can_telegram,
}
"""The checks of this theme by the kind of vector."""
