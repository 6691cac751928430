"""CAN devices: parameters asked and answered among other frames, late answers, and telegrams that are heard."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import devices, refusal, refuses
from conformance.runtime.can_bus import Bus, answers_of, beat_of, bus_frame, kinds_of, on_lines, profile_of, roles_of
from conformance.scripts import now


def check_parameters(package: Package) -> None:
    """Words are asked for one by one, in ascending order."""
    for waiting in (False, True):
        for device, bus, words in on_lines(package, waiting):
            assert (now(device.speed.read()), now(device.long.read())) == (50, 0x88887777)
            assert [(frame.id, frame.data[3]) for frame in bus.sent] == [(0x109, 5), (0x109, 7), (0x109, 8)]
            now(device.long.write(0x00010002))
            assert (words[7], words[8], now(device.read_at("parameter", 7, 2))) == (2, 1, (2, 1))
            now(device.write_at("parameter", 6, 3, 4))
            assert (words[6], words[7], now(device.read_at("parameter", 6))) == (3, 4, (3,))
            bus.sent.clear()
            found = now(device.read_many("g"))
            assert (found, len(bus.sent)) == ({"long": 0x10004, "again": 4, "same": 0x10004}, 3)
            for function in (device.read_at, device.write_at):
                assert refusal(function, "holding", 1, 1).status == "bad_space"
    message = "the space 'holding' cannot be read by address, only parameter"
    refuses(package.runtime.RequestError, message, device.read_at, "holding", 1)


def check_among_others(package: Package) -> None:
    """Other frames that come meanwhile are no answer; words of a telegram among them are kept."""
    for device, bus, words in on_lines(package, waiting=True):
        answer, bus.waits = answers_of(package, words), 0.1
        frames = [beat_of(package, 0, 1, 2, 3), package.can.Frame(0x209, b"\4"), answer(bus_frame(package, 6))[0]]
        bus.answer = _followed(frames, answer)
        assert now(device.speed.read()) == 50
        assert now(device.beat.read()) == 2
        assert not bus.queue
        bus.answer = _followed(frames)
        refused = refusal(device.speed.read)
        told = f"P5 speed: unit {device.unit} did not send told for 5"
        assert (type(refused), str(refused)) == (package.runtime.NoReplyError, told)
        assert isinstance(refused.__cause__, TimeoutError)
        spoiled = answer(bus_frame(package, 5))[0]
        spoiled = package.can.Frame(spoiled.id, spoiled.data[:7] + bytes((spoiled.data[7] ^ 1,)))
        bus.answer = _followed([spoiled, package.can.Frame(1, b"")])
        refused = refusal(device.speed.read)
        wrong = f"a byte that told has as its check is {spoiled.data[7]:02X}h"
        assert str(refused) == f"P5 speed: unit {device.unit} did not send told for 5 ({wrong})"
        assert refused.__cause__.status == "wrong_check"


def _followed(frames: list[Any], answer: Callable[[Any], list[Any]] = lambda _: []) -> Callable[[Any], list[Any]]:
    """What comes where these frames come before the answer."""
    return lambda frame: [*frames, *answer(frame)]


def check_patience(package: Package) -> None:
    """A wait among frames that never answer ends."""
    for device, bus, _ in on_lines(package, waiting=False):
        bus.answer = lambda frame: [package.can.Frame(1, b"")] * 100
        refused = refusal(device.speed.read)
        assert str(refused) == f"P5 speed: unit {device.unit} did not send told for 5 within 10 s"
        assert (len(bus.queue), bus.clock) == (89, 1011.0)
        device.patience = 2.5
        bus.queue.clear()
        bus.answer = lambda frame: [package.can.Frame(1, b"")] * 100
        assert str(refusal(device.speed.read)) == f"P5 speed: unit {device.unit} did not send told for 5 within 2.5 s"
        assert len(bus.queue) == 97


def check_late_answers(package: Package) -> None:
    """An answer that came too late is no answer to the next question for the same parameter."""
    for waiting in (False, True):
        for device, bus, words in on_lines(package, waiting):
            answer = bus.answer
            bus.waits = 0.01
            bus.answer = lambda frame: []
            assert refusal(device.speed.read).status == "timeout"
            bus.queue = [*answer(bus_frame(package, 5)), beat_of(package, 0, 1, 2, 3)]
            words[5], bus.answer = 51, answer
            begun = bus.clock
            assert (now(device.speed.read()), bus.queue, now(device.beat.read())) == (51, [], 2)
            assert round(bus.clock - begun, 3) == (0.02 if waiting else 0.04)  # a silent bus is settled
            bus.queue = answer(bus_frame(package, 5))
            words[5] = 52
            assert (now(device.speed.read()), len(bus.queue)) == ((52, 0) if waiting else (51, 1))
            bus.queue.clear()
            bus.answer = lambda frame: []
            assert refusal(device.speed.read).status == "timeout"
            bus.answer, bus.waits = answer, 1.0
            bus.queue = [package.can.Frame(1, b"")] * 3
            assert now(device.speed.read()) == 52


def check_echoes(package: Package) -> None:
    """A write is confirmed with the number that was written, or one that means the same."""
    for device, bus, words in on_lines(package, waiting=True):
        answer = answers_of(package, words)

        def other(frame: Any, answer: Any = answer) -> list[Any]:
            data = bytearray(frame.data)
            if data[0] == 6:
                data[5] ^= 2
                data[7] ^= 2
            return list(answer(package.can.Frame(frame.id, bytes(data))))

        bus.answer = other
        error = refusal(device.speed.write, 4)
        assert type(error) is package.runtime.EchoError
        assert (error.written, error.answered, error.point) == ((4,), (6,), "P5 speed")
        assert str(error) == "P5 speed: 4 was written, but the device answered 6"
        error = refusal(device.write_at, "parameter", 5, 4)
        assert (str(error), error.point) == ("4 was written to 5, but the device answered 6", None)
        error = refusal(device.long.write, 4)
        assert str(error) == "long: 4 was written to 7, but the device answered 6"


def check_telegrams(package: Package) -> None:
    """Words of a telegram are those that came a moment ago, or that come."""
    for waiting in (False, True):
        for device, bus, _ in on_lines(package, waiting):
            bus.waits = 0.3
            assert not device.take(package.can.Frame(1, b""))
            assert device.take(beat_of(package, 0, 1, 2, 3))
            bus.clock += 1.0
            assert now(device.beat.read()) == 2
            bus.clock += 0.5
            bus.queue = [beat_of(package, 0, 4, 5, 6), beat_of(package, 1, 7, 8, 9), beat_of(package, 0, 4, 5, 6)]
            assert (now(device.beat.read()), len(bus.queue)) == (5, 2)
            assert (now(device.late.read()), bus.queue) == (0x00060007, [])
            assert now(device.read_at("beat", 0, 2)) == (4, 5)
            assert now(device.read_many("heard")) == {"beat": 5, "late": 0x00060007}
            bus.clock += 5
            bus.queue = [beat_of(package, 1, 1, 1, 1), beat_of(package, 0, 4, 5, 7)]
            refused = refusal(device.late.read)
            torn = "words (2, 3) of beat may belong to different values"
            assert str(refused) == f"late: unit {device.unit} did not send beat with words 2, 3 ({torn})"
            assert refused.__cause__.status == "torn"
            bus.clock += 5
            refused = refusal(device.beat.read)
            assert (str(refused), refused.status) == (
                f"B1 beat: unit {device.unit} did not send beat with words 1",
                "timeout",
            )
            assert refusal(device.read_at, "beat", 5).status == "bad_address"
            assert refusal(device.write_at, "beat", 0, 1).status == "bad_space"
            device.fresh_for = 0.0
            device.take(beat_of(package, 0, 1, 2, 3))
            bus.clock += 0.1
            assert refusal(device.beat.read).status == "timeout"


def check_receiver(package: Package) -> None:
    """A receiver by itself."""
    profile = profile_of(package)
    receiver = package.can.Receiver(profile, "beat", 9)
    assert (receiver.telegram, receiver.unit) == ("beat", 9)
    refuses(package.runtime.TelegramError, "not all frames of beat with words (0,) came yet", receiver.word, 0)
    refuses(package.runtime.RequestError, "beat has 5 words, and none at 5", receiver.word, 5)
    refuses(package.runtime.RequestError, "beat has 5 words, and none at -1", receiver.word, -1)
    assert [receiver.take(beat_of(package, place, 1, 2, 3)) for place in (0, 1, 2)] == [True, True, False]
    assert ([receiver.word(at) for at in range(5)], receiver.words((0, 1, 2, 3))) == ([1, 2, 3, 1, 2], (1, 2, 3, 1))
    assert (receiver.newer((0,), 0.0), receiver.newer((0,), 0.1)) == (True, False)
    refuses(
        package.runtime.RequestError,
        "the device can be unit 1 to 30, not 31",
        package.can.Receiver,
        profile,
        "beat",
        31,
    )
    for kind in kinds_of(package):
        assert refusal(kind, Bus(package), 31).status == "bad_unit"


def check_decoder(package: Package) -> None:
    """The frames of a telegram to values, with what earlier ones brought."""
    runtime = package.runtime
    word, wide, scaled = runtime.Integer(runtime.U16), runtime.Integer(runtime.U32), runtime.Scaled
    rule = runtime.Rule(factors=(runtime.Factor("factor"),))
    by_both = runtime.Rule(factors=(runtime.Factor("factor"), runtime.Factor("elsewhere")))
    at = runtime.telegram
    points = {
        "speed": runtime.ReadOnly(scaled(runtime.U16, rule, decimals=0), at=at("beat", 0)),
        "inside": runtime.ReadOnly(wide, at=at("beat", 1, 2)),
        "factor": runtime.ReadOnly(word, at=at("beat", 3)),
        "count": runtime.ReadOnly(wide, at=at("beat", 4, 6)),
        "sign": runtime.ReadOnly(runtime.Text(6), at=at("beat", 5, 7, 8)),
        "both": runtime.ReadOnly(scaled(runtime.U16, by_both, decimals=0), at=at("beat", 7)),
        "elsewhere": runtime.ReadOnly(word, at=runtime.parameter(7)),
        "only_a": runtime.ReadOnly(word, at=at("beat", 8), variant=("model", "a"), name="only"),
    }
    head, low_first = "c221 m w0 w1 w2 w3 w4 w5", "m w1 w0 w3 w2 w5 w4 c221"
    for layout in (head, low_first):
        message = package.can.Message("cyclic", "cyclic", 0x300, roles_of(package, layout), True)
        telegrams = (package.can.Telegram("beat", "cyclic", 9, "cyclic"),)
        table = {
            "PROFILE": package.can.Profile((1, 30), 11, (message,), telegrams),
            "VARIANTS": {"model": ("a",)},
            **points,
        }
        for kind in devices(package, table, package.can.CanDevice, package.can.AsyncCanDevice):
            decoder = package.can.Decoder(kind, "beat", 9)

            def told(place: int, *words: int, layout: str = layout, decoder: Any = decoder, **more: Any) -> Any:
                data = b"".join(one.to_bytes(2, "big" if layout == head else "little") for one in words)
                whole = bytes((221, place)) + data if layout == head else bytes((place,)) + data + bytes((221,))
                return decoder.decode(package.can.Frame(0x309, whole), **more)

            assert told(0, 12, 1, 2) == {"inside": 0x10002}
            assert told(1, 4, 5, 0x4142) == {"factor": 4}
            assert told(0, 12, 1, 2) == {"inside": 0x10002, "speed": 3.0}
            assert told(2, 6, 0x4344, 0x4520) == {"sign": "ABCDE"}
            assert told(2, 6, 0x3000, 0x2020, raws={"elsewhere": 2})["both"] == 0x3000 / 8
            assert told(1, 2, 5, 0x4142, raws={"factor": 9}) == {"factor": 2, "count": 0x50006}
            assert told(0, 12, 1, 2, raws={"factor": 9})["speed"] == 6.0
            assert told(1, 2, 6, 0x4142) == {"factor": 2}
            assert (decoder.newer((0,), 0.0), told(0, 12, 1, 2, moment=5.0)["speed"], decoder.newer((0,), 5.0)) == (
                True, 6.0, True,
            )  # fmt: skip
            assert (told(3, 1, 2, 3), decoder.decode(package.can.Frame(0x308, bytes(8)))) == ({}, {})
            chosen = package.can.Decoder(kind, "beat", 9, model="a")
            assert list(told(2, 6, 0x3000, 7, decoder=chosen)) == ["only"]
            layouts = kind.layouts("beat")
            assert [(list(one.words), one.size) for one in layouts] == [
                ([0, 1, 2], 6), ([3, 4, 5], 6), ([6, 7, 8], 6),
            ]  # fmt: skip
            assert layouts[1].decode(bytes((0, 4, 0, 0, 0, 0))) == {"factor": 4}
            refuses(runtime.AccessError, "the device has no telegram none, only beat", kind.layouts, "none")


def check_recognized(package: Package) -> None:
    """Receivers and parsers take the same frames, whatever bytes a message knows beforehand."""
    message = package.can.Message("m", "cyclic", 0x300, roles_of(package, "c7 u m w0 w1 a0 x13 x48"), True)
    telegrams = (package.can.Telegram("beat", "cyclic", 1, "m"),)
    receiver = package.can.Receiver(package.can.Profile((1, 30), 11, (message,), telegrams), "beat", 9)
    good = bytearray((7, 9, 0, 1, 2, 3, 0, 0))
    good[6] = good[0] ^ good[2] ^ good[3]
    good[7] = good[4] ^ good[5]
    frame = package.can.Frame
    assert (receiver.take(frame(0x309, bytes(good))), receiver.word(0)) == (True, 0x102)
    for at in (0, 1, 3, 4, 5, 6, 7):
        bad = bytearray(good)
        bad[at] ^= 1
        assert not receiver.take(frame(0x309, bytes(bad))), at
    for one in (frame(0x308, bytes(good)), frame(0x309, bytes(good[:7])), frame(0x309, bytes(good) + b"\0")):
        assert not receiver.take(one)


def check_messages(package: Package) -> None:
    """Messages by name and by what they do, and what is wrong with a frame."""
    profile, access = profile_of(package), package.runtime.AccessError
    refuses(access, "the device has no message none", profile.message, "none")
    refuses(access, "the device has no telegram none, only beat", profile.telegram, "none")
    assert [profile.request(writes=writes).name for writes in (False, True)] == ["ask", "put"]
    empty = package.can.Profile((1, 2), 11, ())
    for writes, what in ((False, "reads"), (True, "writes")):
        try:
            empty.request(writes=writes)
        except access as error:
            assert str(error) == f"the device has no message that {what} a parameter"
    ask = profile.message("ask")
    assert (profile.answer(ask).name, profile.answer(profile.message("told")), ask.carries("raw")) == (
        "told",
        None,
        False,
    )
    plain = package.can.Message("plain", "request", 0x10, ask.roles)
    assert (plain.identifier(5), ask.identifier(5), plain.answers, plain.adds_unit) == (0x10, 0x105, None, False)
    assert package.can.build(profile.message("put"), profile, 9).data == bytes((6, 9, 0, 0, 0, 0, 0, 15))
    good = bus_frame(package, 5)
    wrong = {
        "identifier 108h is not that of ask": (0x108, good.data),
        "ask has 8 bytes, not 7": (good.id, good.data[:7]),
        "a byte that ask has as its constant is 02h": (good.id, b"\2" + good.data[1:]),
        "a byte that ask has as its unit is 08h": (good.id, good.data[:1] + b"\x08" + good.data[2:]),
        "a byte that ask has as its check is FFh": (good.id, good.data[:7] + b"\xff"),
    }
    for reason, frame in wrong.items():
        refuses(package.runtime.FrameError, reason, package.can.parse, ask, 9, package.can.Frame(*frame))
    for number, reason in ((31, "unit 31 is outside 1..30"), (0, "unit 0 is outside 1..30")):
        refuses(package.runtime.RequestError, reason, package.can.build, ask, profile, number)
    assert str(refusal(package.can.build, ask, profile, 1, 65536)) == "address 65536 is outside 0..65535"
    assert str(refusal(package.can.build, ask, profile, 1, 0, -1)) == "raw number -1 is outside 0..65535"
