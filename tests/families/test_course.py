"""Which request a frame answers: what is followed of a conversation."""

from __future__ import annotations

from fieldscribe.families.answers import Heard
from fieldscribe.families.spoken import Course, Spoken

HEARD = Heard(b"", "rtu", "request", None, None, "")


def follow(course: Course, **said: object) -> None:
    """One more frame."""
    course.follow(Spoken(HEARD, **said), expecting=False)  # type: ignore[arg-type]  # each row says what it needs


def test_only_who_was_asked_has_been_met() -> None:
    course = Course()
    follow(course, party=3, answers=True)
    assert not course.met(3)
    follow(course, party=3, asks="read")
    assert course.met(3)
    assert not course.met(4)


def test_a_request_is_open_until_its_own_answer() -> None:
    course = Course()
    follow(course, party=3, exchange="a", asks="first")
    follow(course, party=3, exchange="b", asks="second")
    follow(course, party=4, exchange="a", answers=True)
    follow(course, party=3, exchange="a", answers=False)
    assert (course.asked(3, "a"), course.asked(3, "b"), course.asked(4, "a")) == ("first", "second", None)
    follow(course, party=3, exchange="a", answers=True)
    assert (course.asked(3, "a"), course.asked(3, "b")) == (None, "second")


def test_nobody_answers_a_broadcast_but_it_closes_what_was_open() -> None:
    course = Course()
    follow(course, asks="read")
    follow(course, asks="write all", silent=True)
    assert course.asked() is None


def test_an_expected_request_stays_open_if_it_binds() -> None:
    for binds in (True, False):
        course = Course()
        course.follow(Spoken(HEARD, asks="read", binds=binds, silent=True), expecting=True)
        follow(course, answers=True)
        assert (course.fixed, course.asked()) == (binds, "read" if binds else None)
