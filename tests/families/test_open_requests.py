"""Which request a frame answers: what is followed of a conversation."""

from __future__ import annotations

from fieldscribe.families.decoded_frame import DecodedFrame, OpenRequests
from fieldscribe.families.frame_results import FrameResult

HEARD = FrameResult("rtu", "request", None, None, "")


def follow(requests: OpenRequests, **said: object) -> None:
    """One more frame."""
    requests.follow(DecodedFrame(HEARD, **said), expecting=False)  # type: ignore[arg-type]  # each row says what it needs


def test_only_a_unit_that_was_sent_a_request_counts_as_addressed() -> None:
    requests = OpenRequests()
    follow(requests, unit=3, answers=True)
    assert not requests.addressed(3)
    follow(requests, unit=3, request="read")
    assert requests.addressed(3)
    assert not requests.addressed(4)


def test_a_request_is_open_until_the_answer_to_it() -> None:
    requests = OpenRequests()
    follow(requests, unit=3, exchange="a", request="first")
    follow(requests, unit=3, exchange="b", request="second")
    follow(requests, unit=4, exchange="a", answers=True)
    follow(requests, unit=3, exchange="a", answers=False)
    assert (requests.request(3, "a"), requests.request(3, "b"), requests.request(4, "a")) == ("first", "second", None)
    follow(requests, unit=3, exchange="a", answers=True)
    assert (requests.request(3, "a"), requests.request(3, "b")) == (None, "second")


def test_nobody_answers_a_broadcast_but_it_closes_what_was_open() -> None:
    requests = OpenRequests()
    follow(requests, request="read")
    follow(requests, request="write all", unanswered=True)
    assert requests.request() is None


def test_an_expected_request_stays_open_if_it_binds() -> None:
    for binds in (True, False):
        requests = OpenRequests()
        requests.follow(DecodedFrame(HEARD, request="read", stays_open=binds, unanswered=True), expecting=True)
        follow(requests, answers=True)
        assert (requests.fixed, requests.request()) == (binds, "read" if binds else None)
