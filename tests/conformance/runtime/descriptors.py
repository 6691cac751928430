"""Points as attributes: on the class codecs, on a device handles; variants, old names, and what cannot be done."""

from __future__ import annotations

import inspect
import warnings
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import AsyncMemory, Memory, devices, refusal, refuses, table
from conformance.scripts import now


def _made(package: Package) -> tuple[Any, Any]:
    """A device with points of each access, one by variant, one that only some variants have, and commands."""
    runtime = package.runtime
    word = runtime.Integer(runtime.U16)

    points: dict[str, Any] = {
        "PROFILE": runtime.Profile(functions={3: 8, 6: 1, 16: 8, 5: 1}),
        "VARIANTS": {"model": ("a", "b", "c"), "size": ("x", "y")},
        "DOCUMENTED": {"odd": runtime.Documented("nobody knows")},
        "read": runtime.ReadOnly(word, at=runtime.holding(1), code="R1"),
        "write": runtime.WriteOnly(word, at=runtime.holding(2)),
        "both": runtime.ReadWrite(word, at=runtime.holding(3)),
        "class_": runtime.ReadWrite(word, at=runtime.holding(4)),
        "one_a": runtime.ReadOnly(word, at=runtime.holding(5), variant=("model", "a"), name="one", group="g"),
        "one_b": runtime.ReadOnly(word, at=runtime.holding(6), variant=("model", "b"), name="one", group="g"),
        "some": runtime.ReadOnly(word, at=runtime.holding(7), only_for=("model", ("a", "c")), group="g"),
        "any": runtime.Command(at=runtime.holding(9)),
        "fixed": runtime.Command(at=runtime.coil(10), value=1),
    }
    points["one"] = runtime.ByVariant("model", {"a": points["one_a"], "b": points["one_b"]})
    points["old"] = runtime.renamed(points["both"], "both")
    points["old_one"] = runtime.renamed(points["one"], "one")
    points["old_class"] = runtime.renamed(points["class_"], "class_")
    blocking, awaiting = devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    return blocking, awaiting


def check_access(package: Package) -> None:
    """A device reads what can be read and writes what can be written; nothing is assigned to."""
    for kind, line in zip(_made(package), (Memory, AsyncMemory), strict=True):
        memory = line({1: 5, 2: 6, 3: 7})
        device = kind(memory, 1)
        assert (now(device.read.read()), now(device.read.read_raw()), now(device.both.read())) == (5, 5, 7)
        now(device.write.write(8))
        now(device.write.write_raw(9))
        now(device.both.write(4))
        now(device.both.write_raw(3))
        now(device.class_.write(2))
        assert memory.asked[3:] == [(6, 2, 8), (6, 2, 9), (6, 3, 4), (6, 3, 3), (6, 4, 2)]
        assert [hasattr(device.read, name) for name in ("write", "write_raw", "encode")] == [False] * 3
        assert [hasattr(device.write, name) for name in ("read", "read_raw", "decode")] == [False] * 3
        refuses(AttributeError, "a point is not assigned to: use its write method", setattr, device, "both", 1)
        refuses(AttributeError, "a point is not assigned to: use its write method", setattr, device, "one", 1)
        refuses(AttributeError, "a command is not assigned to: use its send method", setattr, device, "any", 1)
        refuses(package.runtime.AbsentError, "odd is documented only: nobody knows", getattr, device, "odd")
        refuses(package.runtime.AbsentError, "'Made' object has no attribute 'zzz'", getattr, device, "zzz")
        missing = refusal(getattr, device, "zzz")
        assert (missing.name, missing.obj) == ("zzz", device)
        assert (device.read.facts, device.class_.facts.item) == (kind.read.facts, "class")


def check_identification(package: Package) -> None:
    """What identifies a device is read in order, each point once; another device is told by what it holds."""
    runtime = package.runtime
    text = runtime.ReadOnly(runtime.Text(4), at=runtime.holding(1, 2))
    maker, kind, size = (runtime.ReadOnly(runtime.Integer(runtime.U16), at=runtime.holding(at)) for at in (3, 4, 5))
    identifications = (
        runtime.Identification("maker", (7,)),
        runtime.Identification("kind", (1, 2)),
        runtime.Identification("text", ("AB",), ("model", "a")),
        runtime.Identification("text", ("AC", "AD"), ("model", "b")),
        runtime.Identification("kind", (2,), ("model", "b")),
        runtime.Identification("size", (1,), ("size", "x")),
        runtime.Identification("size", (2,), ("size", "y")),
    )
    points = {
        "PROFILE": runtime.Profile(functions={3: 8}),
        "VARIANTS": {"model": ("a", "b", "c"), "size": ("x", "y")},
        "IDENTIFICATIONS": identifications,
        "text": text,
        "maker": maker,
        "kind": kind,
        "size": size,
    }
    text_of = {"AB  ": (0x4142, 0x2020), "AD  ": (0x4144, 0x2020)}
    for made, line in zip(
        devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice), (Memory, AsyncMemory), strict=True
    ):

        def held(text: str, kind: int, size: int, *, maker: int = 7) -> Any:
            first, second = text_of[text]
            return made(line({1: first, 2: second, 3: maker, 4: kind, 5: size}), 1)  # noqa: B023  # called at once

        assert now(held("AB  ", 1, 1).identify()) == {"model": "a", "size": "x"}
        assert now(held("AD  ", 2, 2).identify()) == {"model": "b", "size": "y"}
        assert now(held("AD  ", 1, 3).identify()) == {}
        other = refusal(lambda device: now(device.identify()), held("AB  ", 1, 1, maker=8))
        assert (type(other), str(other)) == (runtime.OtherDeviceError, "maker is 8, not 7")
        other = refusal(lambda device: now(device.identify()), held("AB  ", 3, 1))
        assert str(other) == "kind is 3, not 1 or 2"
        refused = line({})
        refused.errors = [runtime.ExceptionReplyError(2)]
        other = refusal(lambda device: now(device.identify()), made(refused, 1))
        assert "exception 02h" in str(other)


def check_commands(package: Package) -> None:
    """A command has its number, or any."""
    for kind, line in zip(_made(package), (Memory, AsyncMemory), strict=True):
        memory = line({})
        device = kind(memory, 1)
        for value in (None, 1, 7):
            now(device.any.send(value))
        now(device.fixed.send())
        now(device.fixed.send(1))
        refuses(package.runtime.AccessError, "fixed is the number 1, not 2", device.fixed.send, 2)
        assert memory.asked == [(6, 9, 1), (6, 9, 1), (6, 9, 7), (5, 10, 0xFF00), (5, 10, 0xFF00)]
        assert (kind.any.value, kind.any.name, kind.fixed.value) == (None, "any", 1)


def check_variants(package: Package) -> None:
    """A name that variants share is the point of the device's variant."""
    absent = package.runtime.AbsentError
    for kind, line in zip(_made(package), (Memory, AsyncMemory), strict=True):
        devices = {value: kind(line({5: 1, 6: 2, 7: 3}), 1, {"model": value}) for value in ("a", "b", "c", None)}
        assert [now(devices[value].one.read()) for value in ("a", "b")] == [1, 2]
        assert (devices["b"].point("one"), devices["a"].point("one")) == (devices["b"].one, devices["a"].one_a)
        assert kind.one.points == {"a": kind.one_a, "b": kind.one_b}
        refuses(absent, "one does not exist for model c", getattr, devices["c"], "one")
        refuses(absent, "one depends on model: pass it when the device is made", getattr, devices[None], "one")
        refuses(absent, "one does not exist for model c", devices["c"].point, "one")
        refuses(absent, "one depends on model: pass it when the device is made", devices[None].point, "one")
        refuses(
            absent, "nothing is no point of this device: its `POINTS` lists their names", devices["a"].point, "nothing"
        )
        refuses(absent, "one_a exists only for model a", getattr, devices["b"], "one_a")
        refuses(absent, "some exists only for model a or c", getattr, devices["b"], "some")
        assert [now(devices[value].some.read()) for value in ("a", "c", None)] == [3, 3, 3]
        assert now(devices[None].one_a.read()) == 1
        assert [now(devices[value].read_many("g")) for value in ("a", "b", "c", None)] == [
            {"one": 1, "some": 3}, {"one": 2}, {"some": 3}, {"some": 3},
        ]  # fmt: skip
        refuses(absent, "some exists only for model a or c", devices["b"].read_many, ["some"])
        wrong = package.runtime.RequestError
        refuses(wrong, "the device has no variants by 'shape', only by model, size", kind, line({}), 1, {"shape": "x"})
        refuses(wrong, "model is one of a, b, c, not 'd'", kind, line({}), 1, {"model": "d"})
        assert (kind(line({}), 1).variants, devices["a"].variants) == ({}, {"model": "a"})
        assert (kind.read.label, kind.both.label, kind.one_a.facts.name) == ("R1 read", "both", "one")
        assert sorted(kind.POINTS) == ["both", "class", "one_a", "one_b", "read", "some", "write"]


def check_old_names(package: Package) -> None:
    """An old name works and warns where it is used."""
    kind, _ = _made(package)
    device = kind(Memory({3: 7, 5: 1}), 1, {"model": "a"})
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert (device.old.read(), device.old_one.read(), device.both.read()) == (7, 1, 7)
        assert (kind.old.facts, kind.old_one.points) == (kind.both.facts, kind.one.points)
        assert package.runtime.renamed_classes("m", Old=int)("Old") is int
    told = [(str(one.message), one.category, one.filename) for one in caught]
    names = [*["old is now called both", "old_one is now called one"] * 2, "Old is now called int"]
    assert told == [(name, DeprecationWarning, __file__) for name in names]


def check_old_names_as_text(package: Package) -> None:
    """An old name as text warns where it is used, too."""
    for kind, line in zip(_made(package), (Memory, AsyncMemory), strict=True):
        device = kind(line({3: 7, 5: 1}), 1, {"model": "a"})
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            assert (device.point("old"), device.point("old_one")) == (device.both, device.one_a)
            assert device.point("old_class") is device.class_
        told = [(str(one.message), one.filename) for one in caught]
        names = ("old is now called both", "old_one is now called one", "old_class is now called class_")
        assert told == [(name, __file__) for name in names]


def check_points_by_text(package: Package) -> None:
    """Points by name or code, an element by its index, and near names for what is none."""
    runtime = package.runtime
    word = runtime.Integer(runtime.U16)
    points: dict[str, Any] = {
        "PROFILE": runtime.Profile(functions={3: 8}),
        "VARIANTS": {"model": ("a", "b")},
        "speed": runtime.ReadWrite(word, at=runtime.holding(1), code="A020"),
        "class_": runtime.ReadOnly(word, at=runtime.holding(2), code="A021"),
        "first": runtime.ReadOnly(word, at=runtime.holding(3, index=0), code="P1"),
        "second": runtime.ReadOnly(word, at=runtime.holding(4, index=1), code="P1"),
        "level_a": runtime.ReadOnly(word, at=runtime.holding(5), code="L", variant=("model", "a"), name="level"),
        "level_b": runtime.ReadOnly(word, at=runtime.holding(6), code="L", variant=("model", "b"), name="level"),
        "nameless": runtime.ReadOnly(word, at=runtime.holding(7)),
    }
    access, absent = runtime.AccessError, runtime.AbsentError
    kinds = devices(package, points, runtime.ModbusDevice, runtime.AsyncModbusDevice)
    for kind, line in zip(kinds, (Memory, AsyncMemory), strict=True):
        device, undecided = kind(line({}), 1, {"model": "b"}), kind(line({}), 1)
        for what, item in (
            *(("speed", "speed"), ("A020", "speed"), ("a020", "speed"), ("class", "class"), ("A021", "class")),
            *(("P1[1]", "second"), ("p1[0]", "first"), ("L", "level_b"), ("level", "level_b"), ("level_b", "level_b")),
        ):
            assert device.point(what).facts.item == item, what
        assert device.point("A020") is device.speed
        refuses(access, "P1 means several points: first, second", device.point, "P1")
        refuses(absent, "P1[2] is no point of this device; did you mean P1?", device.point, "P1[2]")
        refuses(absent, "A02 is no point of this device; did you mean A020 or A021?", device.point, "A02")
        refuses(absent, "zzz is no point of this device: its `POINTS` lists their names", device.point, "zzz")
        refuses(access, "a point is named by a text, not ''", device.point, "")
        refuses(access, "a point is named by a text, not None", device.point, None)
        refuses(absent, "level depends on model: pass it when the device is made", undecided.point, "L")
        refuses(runtime.AbsentError, "L level_a exists only for model a", device.point, "level_a")
        assert now(device.read_many(["A020", "P1[1]"])) == {"speed": 0, "second": 0}


def check_shown(package: Package) -> None:
    """Points, commands and devices say what they are, and where."""
    runtime = package.runtime
    kind, _ = _made(package)
    device = kind(Memory({}), 5, {"model": "b", "size": None})
    own = "<Made unit 5, model b>"
    assert (repr(device), repr(kind(Memory({}), 1))) == (own, "<Made unit 1>")
    assert (repr(kind.read), repr(device.read)) == (
        "<ReadOnly R1 read: holding 0x0001>",
        f"<ReadHandle R1 read: holding 0x0001 of {own}>",
    )
    assert (repr(kind.one), repr(kind.any)) == (
        "<ByVariant one: one_a or one_b, by model>",
        "<Command any: holding 0x0009>",
    )
    facts = {"references": {"modicon": 4138, "manual": "M7"}, "bits": (7, 4)}
    point = table(package, one=runtime.ReadOnly(runtime.Integer(runtime.U8), at=runtime.holding(4137), **facts)).one
    assert repr(point) == "<ReadOnly one: holding 0x1029 bits 7..4 (modicon 4138, manual M7)>"
    places = (runtime.parameter(10, index=2), runtime.telegram("status", 1, 2), runtime.coil(10, 11))
    assert [str(place) for place in places] == ["parameter 10 index 2", "status word 1, 2", "coil 0x000A, 0x000B"]


def check_looked_at(package: Package) -> None:
    """`inspect`, `hasattr` and `getattr` work on devices of every variant."""
    for kind, line in zip(_made(package), (Memory, AsyncMemory), strict=True):
        for variants in ({}, {"model": "b"}, {"model": "c"}):
            device = kind(line({}), 1, variants)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                members, static = dict(inspect.getmembers(device)), dict(inspect.getmembers(kind))
            assert (members["read"], static["one"]) == (device.read, kind.one)
            has = [hasattr(device, name) for name in ("one", "one_b", "some", "odd", "none", "read")]
            model = variants.get("model")
            assert has == [model == "b", True if model is None else model == "b", model != "b", False, False, True]
            assert getattr(device, "odd", None) is None
        assert (hasattr(kind, "odd"), hasattr(kind, "one")) == (False, True)


def check_records(package: Package) -> None:
    """Facts are equal where their fields are, and do not change."""
    runtime = package.runtime
    place = runtime.Place("holding", (1, 2), index=3)
    assert (place, hash(place)) == (runtime.Place("holding", (1, 2), None, 3), hash(place.replaced(index=3)))
    assert (place != place.replaced(index=4), place == ("holding", (1, 2), None, 3, None, None)) == (True, False)
    assert runtime.Special("a", 1) != runtime.Case("a", 1, None)
    assert repr(place) == "Place(space='holding', addresses=(1, 2), function=None, index=3, telegram=None, base=None)"
    refuses(AttributeError, "index cannot be changed: Place is a fact", setattr, place, "index", 4)
    fields = "Place takes space, addresses, function, index, telegram, base, not"
    wrong: tuple[tuple[tuple[Any, ...], dict[str, Any]], ...] = (
        (("holding",), {}), ((), {"addresses": (1,)}), (("holding", (1,)), {"space": "coil"}),
        (("holding", (1,)), {"place": 1}), (("holding", (1,), 1, 2, "x", "y", 5), {}),
    )  # fmt: skip
    for values, named in wrong:
        refuses(TypeError, f"{fields} {values} and {named}", runtime.Place, *values, **named)
