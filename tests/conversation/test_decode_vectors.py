"""`decode` and the generated parsers judge the same bytes alike: each wrong byte of the vectors is a fault here too."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from fieldscribe.conversation.decoder import decode
from fieldscribe.families.frame_results import FrameResult
from fieldscribe.families.modbus import frames as modbus
from fieldscribe.families.modbus import profile_of
from fieldscribe.families.uss import telegrams as uss
from fieldscribe.families.uss.telegrams import Link
from fieldscribe.model import Device
from fieldscribe.targets.vectors.collection import collect
from support.asked import asked as chosen
from support.described import made, shipped
from support.vector_file import File, Vector


def vectors(device: Device, kind: str) -> Iterator[Vector]:
    """The vectors of one kind that have bytes at all."""
    text = collect(device).text(device.id, device.version, device.digest)
    return (one for one in File(text) if one["kind"] == kind and one["bytes"])


def holds(vector: Vector, heard: FrameResult, sound: bool) -> None:
    """The frame is whole, and answers what was asked, where the parsers say so, and not elsewhere."""
    assert sound == (not heard.faults and heard.kind not in ("other", "unreadable")), (vector, heard)


@pytest.mark.full(seconds=1)
@pytest.mark.parametrize("device", [made("kitchen_sink"), shipped("jumo_controller")], ids=lambda one: one.id)
def test_replies_of_modbus(device: Device) -> None:
    """Whole replies and exceptions are sound; a changed byte, unit, function, transaction or echo is a fault."""
    judged = set()
    for one in vectors(device, "reply"):
        values = tuple(one["values"])
        request = modbus.Request(
            one["unit"], one["function"], one["address"], one["count"], values, one["transaction"] or 0
        )
        _, sent = modbus.build(profile_of(device.bus), one["framing"], request)
        options = chosen(framing=one["framing"], request=sent.hex())
        holds(one, decode(device, {}, [one["bytes"].hex()], options)[-1], one["status"] in ("ok", "exception"))
        judged.add(one["status"])
    assert {"ok", "exception", "bad_crc", "wrong_unit", "wrong_function", "echo_mismatch", "short_frame"} <= judged


@pytest.mark.parametrize(
    ("sent", "name"), [("01060c80047e0992", "make_ready_to_switch_on"), ("01060c80047fc852", "switch_on")]
)
def test_commands_at_one_address_are_told_apart_by_their_values(sent: str, name: str) -> None:
    [heard] = decode(shipped("nord_sk5xxe"), {}, [sent], chosen())
    assert [(item.subject, item.findings) for item in heard.items if item.point is None] == [(f"command {name}", ())]


@pytest.mark.parametrize("device", [made("kitchen_can"), shipped("woodward_mpu2s")], ids=lambda one: one.id)
def test_messages_of_a_makers_protocol(device: Device) -> None:
    """A frame is the message of the unit that was asked for, or it is damaged, or it is another's."""
    judged = set()
    for one in vectors(device, "can_reply"):
        [heard] = decode(device, {}, [f"{one['id']:X}#{one['bytes'].hex()}"], chosen())
        if one["status"] in ("wrong_id", "wrong_unit") and not heard.faults:
            assert heard.kind == "other" or heard.unit != one["unit"], (one, heard)
        else:
            holds(one, heard, one["status"] == "ok")
        answers = heard.kind == "reply" and not heard.faults
        assert not answers or not any(item.findings for item in heard.items), (one, heard)
        judged.add(one["status"])
    assert {"ok", "wrong_check", "wrong_constant", "wrong_length", "wrong_id", "wrong_unit"} <= judged


@pytest.mark.full
@pytest.mark.parametrize("device", [made("kitchen_uss"), shipped("siemens_mm4")], ids=lambda one: one.id)
def test_answers_of_uss(device: Device) -> None:
    """Refusals are answers; a telegram of another unit, parameter or task, or with a wrong byte, is a fault."""
    judged = set()
    for one in vectors(device, "uss_reply"):
        link = Link(one["pkw"], one["pzd"], bool(one["single_first"]))
        asked = one["unit"], one["task"], one["parameter"], one["index"]
        request = uss.Request(*asked, words=(0,) * link.pzd)  # the values that are sent have no part in the answer
        status, sent = uss.build(device.bus, link, request)
        if status != "ok":
            continue
        options = chosen(request=sent.hex(), pkw=link.pkw, pzd=link.pzd, single_first=link.single_first)
        replies = decode(device, {}, [one["bytes"].hex()], options)[1:]
        if len(replies) > 1:  # sound telegrams one behind the other are told apart
            assert one["status"] == "wrong_length"
            continue
        holds(one, replies[-1], one["status"] in ("ok", "refused", "no_rights", "no_answer"))
        judged.add(one["status"])
    assert {"ok", "refused", "no_rights", "wrong_check", "wrong_response", "wrong_parameter", "wrong_unit"} <= judged
