"""The listener of all families: what a made-up speech says is open, learned and answered, and nothing of a family."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import pytest
from fieldscribe.conversation.listener import Listener
from fieldscribe.families.answers import Heard, Item
from fieldscribe.families.spoken import Course, Span, Spoken
from support.models import sample_device

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.families.directory import Directory

DEVICE = sample_device()
QUIET = Heard(b"", "rtu", "request", 1, None, "said")


@dataclass
class Script:
    """A speech whose frames are what they say; the summary tells which request was open."""

    def frames(self, texts: Sequence[str]) -> Sequence[Spoken]:
        """None: nobody pastes anything here."""
        return [Spoken(replace(QUIET, summary=text)) for text in texts]

    def hear(self, frame: Spoken, course: Course, directory: Directory, *, expecting: bool = False) -> Spoken:
        """The frame, and what was open before it."""
        del directory
        heard = replace(frame.heard, summary=f"{course.asked(frame.party, frame.exchange)}")
        return replace(frame, heard=heard, binds=expecting)


def summaries(*frames: Spoken, expected: Spoken | None = None) -> list[str]:
    """Which request was open at each frame."""
    listening = Listener(DEVICE, {}, Script())
    if expected is not None:
        listening.expect_reply_to(expected)
    return [listening.hear(frame).summary for frame in frames]


ASKS, ANSWERS = Spoken(QUIET, asks="first"), Spoken(QUIET, answers=True)


@pytest.mark.parametrize(
    ("frames", "expected", "open_"),
    [
        ([ASKS, ANSWERS, ANSWERS], None, ["None", "first", "None"]),
        ([ASKS, replace(ANSWERS, answers=False), ANSWERS], None, ["None", "first", "first"]),
        ([ASKS, replace(ASKS, asks="all", silent=True), ANSWERS], None, ["None", "first", "None"]),
        ([ASKS, replace(ANSWERS, party=2), ANSWERS], None, ["None", "None", "first"]),
        ([ASKS, replace(ANSWERS, exchange="other"), ANSWERS], None, ["None", "None", "first"]),
        ([ANSWERS, ANSWERS], ASKS, ["first", "first"]),
        ([ANSWERS, ANSWERS], replace(ASKS, silent=True), ["first", "first"]),
    ],
)
def test_which_request_is_open(frames: list[Spoken], expected: Spoken | None, open_: list[str]) -> None:
    assert summaries(*frames, expected=expected) == open_


def carrying(*words: int) -> Spoken:
    """The words of one span, the first of them a power factor."""
    return Spoken(QUIET, (Span("holding", 0x2002, len(words), words),))


def test_what_a_frame_carries_is_said_in_its_order() -> None:
    told = Item("", 0, 1, "as it is")
    heard = Listener(DEVICE, {}, Script()).hear(replace(carrying(7), carried=(told, told)))
    assert heard.items == (told, told)
    assert [item.raw for item in Listener(DEVICE, {}, Script()).hear(carrying(7)).items] == [7]
