"""The listener of all families: what a made-up decoder says is open, learned and answered, and nothing of a family."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import pytest
from fieldscribe.conversation.decoder import StreamDecoder
from fieldscribe.families.decoded_frame import AddressSpan, DecodedFrame, OpenRequests
from fieldscribe.families.frame_results import FrameResult, Item
from support.models import sample_device

DEVICE = sample_device()
QUIET = FrameResult("rtu", "request", 1, None, "texts")


class Scripted(DecodedFrame):
    """A frame that is its own meaning."""

    data = b""


@dataclass
class Script:
    """A decoder whose frames are what they say; the summary tells which request was open."""

    def frames(self, texts: Sequence[str]) -> Sequence[DecodedFrame]:
        """None: nobody pastes anything here."""
        return [Scripted(QUIET._replace(summary=text)) for text in texts]

    def decode(self, frame: DecodedFrame, requests: OpenRequests, *, expecting: bool = False) -> DecodedFrame:
        """The frame, and what was open before it."""
        decoded = frame.result._replace(summary=f"{requests.request(frame.unit, frame.exchange)}")
        return frame._replace(result=decoded, stays_open=expecting)


def summaries(*frames: DecodedFrame, expected: DecodedFrame | None = None) -> list[str]:
    """Which request was open at each frame."""
    decoder = StreamDecoder(DEVICE, {}, Script())
    if expected is not None:
        decoder.decode(expected, expecting=True)
    return [decoder.decode(frame).summary for frame in frames]


ASKS, ANSWERS = Scripted(QUIET, request="first"), Scripted(QUIET, answers=True)


@pytest.mark.parametrize(
    ("frames", "expected", "open_"),
    [
        ([ASKS, ANSWERS, ANSWERS], None, ["None", "first", "None"]),
        ([ASKS, ANSWERS._replace(answers=False), ANSWERS], None, ["None", "first", "first"]),
        ([ASKS, ASKS._replace(request="all", unanswered=True), ANSWERS], None, ["None", "first", "None"]),
        ([ASKS, ANSWERS._replace(unit=2), ANSWERS], None, ["None", "None", "first"]),
        ([ASKS, ANSWERS._replace(exchange="other"), ANSWERS], None, ["None", "None", "first"]),
        ([ANSWERS, ANSWERS], ASKS, ["first", "first"]),
        ([ANSWERS, ANSWERS], ASKS._replace(unanswered=True), ["first", "first"]),
    ],
)
def test_which_request_is_open(frames: list[DecodedFrame], expected: DecodedFrame | None, open_: list[str]) -> None:
    assert summaries(*frames, expected=expected) == open_


def carrying(*words: int) -> DecodedFrame:
    """The words of one span, the first of them a power factor."""
    return Scripted(QUIET, (AddressSpan("holding", 0x2002, len(words), words),))


def test_what_a_frame_carries_is_said_in_its_order() -> None:
    told = Item("", 0, 1, "as it is")
    decoded = StreamDecoder(DEVICE, {}, Script()).decode(carrying(7)._replace(contents=(told, told)))
    assert decoded.items == (told, told)
    assert [item.raw for item in StreamDecoder(DEVICE, {}, Script()).decode(carrying(7)).items] == [7]
