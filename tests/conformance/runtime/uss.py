"""USS devices: parameters of one word and two, RAM and EEPROM, tasks that are repeated, and process data."""

from __future__ import annotations

from conformance.package import Package
from conformance.runtime.bench import refusal, refuses
from conformance.runtime.uss_line import Line, kinds_of, on_lines, profile_of
from conformance.scripts import now


def check_parameters(package: Package) -> None:
    """Parameters of one word and two, elements, and the tasks that keep them."""
    zeros = (0, 0, 0)
    for device, line in on_lines(package):
        line.values = {(5, 0): (50,), (6, 0): (1, 2)}
        assert (now(device.ramp.read()), now(device.wide.read())) == (50, 0x10002)
        assert line.since() == [(9, 0x1005, 0, 0, 0, *zeros), (9, 0x1006, 0, 0, 0, *zeros)]
        for keep, tasks in ((False, (2, 3, 7, 8, 2)), (True, (14, 13, 12, 11, 14))):
            for name in ("write", "write_raw"):
                for point in (device.ramp, device.wide, device.first, device.second, device.silent):
                    now(getattr(point, name)(7, keep=keep))
                asked = line.since()
                assert [telegram[1] >> 12 for telegram in asked] == list(tasks)
                assert [telegram[3:5] for telegram in asked] == [(7, 0), (0, 7), (7, 0), (0, 7), (7, 0)]
                assert [telegram[2] for telegram in asked] == [0, 0, 1, 2, 0]
        now(device.ramp.write(8))
        assert line.since()[0][1] == 0x2005
        now(device.bits.write(3))
        assert [telegram[1] >> 12 for telegram in line.since()] == [1, 2]


def check_by_number(package: Package) -> None:
    """Parameters by number, and words of process data by place."""
    for device, line in on_lines(package):
        now(device.write_at("parameter", 20, 1, 2))
        now(device.write_at("parameter", 21, 3, index=4))
        assert (now(device.read_at("parameter", 20)), now(device.read_at("parameter", 21, 4))) == ((1, 2), (3,))
        assert [telegram[1:5] for telegram in line.since()] == [
            (0x3014, 0, 1, 2), (0x7015, 4, 3, 0), (0x1014, 0, 0, 0), (0x1015, 4, 0, 0),
        ]  # fmt: skip
        now(device.write_at("task", 1, 5, 6))
        assert (now(device.read_at("task", 2)), now(device.read_at("answer", 1))) == ((6,), (0x2222,))
        assert [telegram[5:] for telegram in line.since()] == [(0, 5, 6), (0, 5, 6)]
        request = package.runtime.RequestError
        refuses(request, "the words of answer come from the device", device.write_at, "answer", 0, 1)
        refuses(request, "there is no space 'none', only parameter, task, answer", device.read_at, "none", 1)
        refuses(request, "a parameter has one word or two, not 3", device.write_at, "parameter", 1, 1, 2, 3)
        refuses(request, "takes 1 to 65536 words or bits, not 0", device.write_at, "task", 1)
        outside = "the link carries 3 words of process data, and this is word 4"
        refuses(request, outside, device.write_at, "task", 2, 1, 1)
        refuses(request, outside, device.read_at, "answer", 3)
        refuses(request, outside, device.read_at, "task", 3)
        statuses = [("answer", 0, 1), ("none", 0, 1), ("parameter", 1, 1, 2, 3), ("task", 1), ("task", 3, 1)]
        found = [refusal(device.write_at, *one).status for one in statuses]
        assert found == ["bad_space", "bad_space", "bad_value", "bad_count", "bad_link"]
        assert line.since() == []


def check_process_data(package: Package) -> None:
    """Words are sent until they are written anew; constant bits come with the first bit that is written."""
    for device, line in on_lines(package):
        assert now(device.state.read()) == 0x1111
        now(device.setpoint.write(0x4000))
        assert [telegram[5:] for telegram in line.since()] == [(0, 0, 0), (0, 0x4000, 0)]
        now(device.on.write(True))
        assert [telegram[5:] for telegram in line.since()] == [(0x0C01, 0x4000, 0)]
        now(device.left.write(True))
        now(device.on.write(False))
        assert [telegram[5:] for telegram in line.since()] == [(0x0C03, 0x4000, 0), (0x0C02, 0x4000, 0)]
        assert (now(device.on.read()), now(device.left.read()), now(device.setpoint.read())) == (False, True, 0x4000)
        assert line.since() == []
        assert (now(device.ramp.read()), line.since()[0][5:]) == (0, (0x0C02, 0x4000, 0))
        device.drop_process_data()
        assert (now(device.ramp.read()), line.since()[0][5:]) == (0, (0, 0, 0))
        now(device.setpoint.write(5))
        line.fails = TimeoutError()
        refused = refusal(device.setpoint.write, 6)
        assert (type(refused), str(refused)) == (package.runtime.NoReplyError, "HSW setpoint: unit 9 did not reply")
        assert refused.__cause__ is line.fails
        line.fails = None
        line.since()
        assert (now(device.ramp.read()), line.since()[0][5:]) == (0, (0, 0, 0))
        now(device.setpoint.write(5))
        line.fails = TimeoutError()
        assert str(refusal(device.ramp.read)) == "P5 ramp: unit 9 did not reply to task 1 for 5"
        line.fails = None
        line.since()
        assert (now(device.ramp.read()), line.since()[0][5:]) == (0, (0, 5, 0))
        assert str(refusal(device.write_at, "task", 0, 0x10000)) == "a word 65536 is outside 0..65535"
        assert (now(device.ramp.read()), line.since()[0][5:]) == (0, (0, 5, 0))


def check_groups(package: Package) -> None:
    """Process data comes out of one telegram; what the link does not carry is left out of a group."""
    for device, line in on_lines(package):
        line.values = {(6, 0): (0, 9)}
        found = now(device.read_many("g"))
        assert found == {"ramp": 0, "wide": 9, "state": 0x1111, "actual": 0x22223333}
        assert [telegram[1] for telegram in line.since()] == [0, 0x1005, 0x1006]
        assert (now(device.read_many(["ramp"])), len(line.since())) == ({"ramp": 0}, 1)
        assert (now(device.read_many(["setpoint"])), line.since()) == ({"setpoint": 0}, [])
    for (pkw, pzd), names in {(3, 3): "ramp state actual", (0, 2): "state", (4, 0): "ramp wide"}.items():
        for device, line in on_lines(package, pkw, pzd):
            line.values = {(6, 0): (0, 0)}
            line.most = pkw
            assert list(now(device.read_many("g"))) == [
                name for name in ("ramp", "wide", "state", "actual") if name in names.split()
            ]


def check_repeats(package: Package) -> None:
    """A task that the device has not answered yet is sent again, but not for ever."""
    for device, line in on_lines(package):
        line.busy = 20
        assert (now(device.ramp.read()), len(line.since())) == (0, 21)
        line.busy = 21
        refused = refusal(device.ramp.read)
        assert (refused.status, refused.point, refused.words, len(line.since())) == (
            "no_answer",
            "P5 ramp",
            line.heard,
            21,
        )
        device.repeats, line.busy = 1, 5
        assert (refusal(device.ramp.read).status, len(line.since())) == ("no_answer", 2)
        line.busy, line.refuses = 0, 2
        refused = refusal(device.ramp.write, 4)
        assert (refused.code, refused.name, refused.words, len(line.since())) == (2, "limit_exceeded", line.heard, 1)
        line.refuses = 3
        assert refusal(device.ramp.write, 4).name is None


def check_echoes(package: Package) -> None:
    """A change is confirmed with the value that the device has, or one that means the same."""
    for device, line in on_lines(package):
        line.turns = 2
        error = refusal(device.ramp.write, 4)
        assert (type(error), error.written, error.answered) == (package.runtime.EchoError, (4,), (6,))
        assert str(error) == "P5 ramp: 4 was written, but the device answered 6"
        error = refusal(device.wide.write, 0x10004)
        assert (error.written, error.answered) == ((1, 4), (1, 6))
        assert str(error) == "wide: 65540 was written, but the device answered 65542"
        error = refusal(device.write_at, "parameter", 5, 4)
        assert str(error) == "4 was written to 5, but the device answered 6"
        error = refusal(device.bits.write, 4)
        assert str(error) == "bits: 4 was written to 11, but the device answered 6"
        line._answer = lambda part: (0x2000 | part[0] & 0xFFF, 0, 0x8000, 0)  # type: ignore[method-assign]  # minus 0
        now(device.number.write(0.0))
        assert str(refusal(device.number.write, 1.0)) == "number: 1 was written, but the device answered -0"


def check_broadcasts(package: Package) -> None:
    """Process data for all units, which nobody answers."""
    for device, line in on_lines(package):
        line.fails = TimeoutError()
        now(device.broadcast((6, 0xFFFF, 0, 0), (0x0C00, 5, 0)))
        assert line.since() == [(32, 6, 0xFFFF, 0, 0, 0x0C00, 5, 0)]
        line.fails = None
        now(device.on.write(True))
        line.since()
        now(device.broadcast((2, 0x0C00, 0, 0)))
        assert line.since() == [(32, 2, 0x0C00, 0, 0, 0x0C01, 0, 0)]
        assert (now(device.ramp.read()), line.since()[0][5:]) == (0, (0, 0, 0))
        request = package.runtime.RequestError
        wrong = "word 1 is 0400h and has not 0C00h in 0C00h"
        refuses(request, wrong, device.broadcast, (2, 0xFFFF, 0, 0), (0x0400, 0, 0))
        now(device.broadcast((4, 0xFFFF, 0, 0), (0x0400, 0, 0)))
        left = "the mask leaves out 0800h of the first word, which has to count"
        refuses(request, left, device.broadcast, (2, 0x0400, 0, 0), (0x0C00, 0, 0))
        for mask, words in (((2, 0xFFFF, 0, 0), (0x0400, 0, 0)), ((2, 0x0400, 0, 0), (0x0C00, 0, 0))):
            assert refusal(device.broadcast, mask, words).status == "bad_value"
        assert refusal(device.broadcast, (2, 0xFFFF, 0, 0), (0x0C00, 0)).status == "bad_link"


def check_links(package: Package) -> None:
    """How the link may be set, also for variants, and which units there are."""
    uss, request = package.uss, package.runtime.RequestError
    for kind in kinds_of(package):
        sizes = "the parameter part is 0, 3, 4, 127 words long, not 5"
        refuses(request, sizes, kind, Line(), 9, uss.Link(5, 2))
        refuses(request, "the device takes 0..4 words of process data, not 5", kind, Line(), 9, uss.Link(4, 5))
        small = "model small takes 0..2 words of process data, not 3"
        refuses(request, small, kind, Line(), 9, uss.Link(4, 3), {"model": "small"})
        for value in ("large", None):
            assert kind(Line(), 9, uss.Link(4, 3), {"model": value}).variants == {"model": value}
        assert kind(Line(), 9, uss.Link(4, 2), {"model": "small"}).link == uss.Link(4, 2)
        refuses(request, "the device can be unit 0 to 30, not 31", kind, Line(), 31, uss.Link(4, 3))
        assert kind(Line(), 9, uss.Link(4, 3)).variants == {}
    assert (uss.Link(127, 2).sent, uss.Link(3, 2).sent, uss.Link(0, 2).sent) == (4, 3, 0)
    singles = [uss.Link(4, 2).single_last, uss.Link(4, 2, True).single_last, uss.Link(127, 2).single_last]
    assert singles == [True, False, False]
    assert (uss.reply_size(b"\2\x0c"), uss.reply_size(b"\2")) == (14, None)


def check_requests(package: Package) -> None:
    """What may not be asked, and what is wrong with an answer, each with the reason."""
    uss, profile, link = package.uss, profile_of(package), package.uss.Link(4, 0, True)
    reasons = {
        uss.Request(31, 1): "unit 31 is outside 0..30",
        uss.Request(9, 4): "the device has no task 4",
        uss.Request(9, 1, 32000): "parameter 32000 is outside 0..31999",
        uss.Request(9, 1, 1, 256): "index 256 is outside 0..255",
        uss.Request(9, 2, 1, 0, 1, 65536): "a value does not fit: 65536 into 1 words, or a word",
        uss.Request(9, 1, words=(1,)): "the link carries 0 words of process data, not 1",
    }
    for one, reason in reasons.items():
        refuses(package.runtime.RequestError, reason, uss.build, one, profile, link)
    no_room = "the link has no room for double words"
    refuses(package.runtime.RequestError, no_room, uss.build, uss.Request(9, 3, 1, 0, 2), profile, uss.Link(3, 0))
    none = "the link carries no parameters"
    refuses(package.runtime.RequestError, none, uss.build, uss.Request(9, 1), profile, uss.Link(0, 0))
    asked, line = uss.Request(9, 1, 5), Line(0)
    wrong = {
        "the reply does not begin with 02h": b"\3",
        "3 bytes are no whole reply": b"\2\1\t",
        "the check of the reply is wrong": line._closed(b"\t", (0x1005, 0, 1, 0))[:-1] + b"\0",
        "unit 8 answered instead of 9": line._closed(b"\x08", (0x1005, 0, 1, 0)),
        "the device has not answered the task yet": line._closed(b"\t", (0, 0, 0, 0)),
        "the reply is for another parameter": line._closed(b"\t", (0x1006, 0, 1, 0)),
        "the device does not let this master change parameters": line._closed(b"\t", (0x8005, 0, 1, 0)),
        "response 3 does not belong to task 1": line._closed(b"\t", (0x3005, 0, 1, 0)),
    }
    for reason, reply in wrong.items():
        refuses(package.runtime.FrameError, reason, uss.parse, asked, reply, profile, link)


def check_layouts_of_telegrams(package: Package) -> None:
    """The process data of a telegram, all of it or what the link carries."""
    for kind in kinds_of(package):
        (answer,), (short,) = kind.layouts("answer"), kind.layouts("answer", words=2)
        assert answer.decode(bytes((0, 1, 0, 2, 0, 3))) == {"state": 1, "actual": 0x20003}
        assert (answer.size, short.size, short.decode(bytes((0, 1, 0, 2)))) == (6, 4, {"state": 1})
        refuses(package.runtime.AccessError, "the device has no telegram none, only task, answer", kind.layouts, "none")
