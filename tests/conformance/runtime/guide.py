"""What `help()` says of points and commands."""

from __future__ import annotations

import inspect
import pydoc
from typing import Any

from conformance.package import Package
from conformance.runtime.bench import Memory, devices
from conformance.runtime.words import _word

SPEED = """\
A1 speed, in Hz; it can be read and written.

Place: holding 0x0001, 0x0002 (modicon 2).
Group: main.
Raw numbers: 0..65535.
Special codes: off, hot (as speed.special.off).
What may be written: 1..2 or 10 Hz.
Default: 1.5 Hz.

Without a device:
    speed.decode(100) -> 10.0
    speed.encode(10.0) -> 100
On a device (with await on an async one):
    device.speed.read() -> value, device.speed.read_raw() -> raw
    device.speed.write(value), device.speed.write_raw(raw)
For programs: speed.facts"""

NEEDY = """\
needy; it can be written.

Place: holding 0x0003 bits 7..0.
Raw numbers: -128..127.
What may be written: raw 0..9.
Bits that are always written: 0300h in FF00h.
Its scale needs: ratio, which a device reads by itself.
Its limits need: least, which a device reads by itself.
Only for: model a.

Without a device:
    needy.encode(value, raws={"ratio": ..., "least": ...}) -> raw
On a device (with await on an async one):
    device.needy.write(value), device.needy.write_raw(raw)
For programs: needy.facts"""

MODE = """\
mode; it can be read.

Place: holding 0x0004.
Raw numbers: 0..65535.
Names: 0 m0, 1 m1, 2 m2, 3 m3, 4 m4, 5 m5, 6 m6, 7 m7, 8 m8, 9 m9, 10 m10, 11 m11 and 3 more in Mode.
Only for: model a or b.

Without a device:
    mode.decode(1) -> Mode.M1
On a device (with await on an async one):
    device.mode.read() -> value, device.mode.read_raw() -> raw
For programs: mode.facts"""


def _points(package: Package) -> dict[str, Any]:
    runtime = package.runtime
    rule, at = runtime.Rule(factors=(runtime.Factor("ratio"),)), runtime.holding
    limit = runtime.Limit(runtime.Rule(factors=(runtime.Factor("least"),)), 0, 9, {})
    coded = runtime.WithCodes(
        runtime.Scaled(runtime.U16, runtime.Rule(num=10), decimals=1), runtime.Codes({"off": 0, "hot": 9})
    )
    modes = runtime.NamedNumber("Mode", {f"M{number}": number for number in range(15)})
    points: dict[str, Any] = {
        "PROFILE": runtime.Profile(functions={3: 4, 6: 1}),
        "VARIANTS": {"model": ("a", "b")},
        "speed": runtime.ReadWrite(
            coded, at=at(1, 2), code="A1", group="main", unit="Hz", default=1.5, references={"modicon": 2},
            allowed=((10, 20), (100, 100)),
        ),
        "needy": runtime.WriteOnly(
            runtime.Scaled(runtime.S8, rule, decimals=0), at=at(3), bits=(7, 0), allowed=((0, limit),),
            fixed=(0xFF00, 0x0300), variant=("model", "a"),
        ),
        "mode": runtime.ReadOnly(runtime.Named(runtime.U16, modes), at=at(4), only_for=("model", ("a", "b"))),
        "word": runtime.ReadWrite(runtime.Flags(runtime.U16, _word(package)), at=at(5)),
        "number": runtime.ReadWrite(runtime.Floating(runtime.F32, units=((0.5, 2.0),)), at=at(6, 7), unit="V"),
        "free": runtime.ReadWrite(runtime.Floating(runtime.F32), at=at(8, 9)),
        "bound": runtime.ReadWrite(
            runtime.Integer(runtime.U16), at=at(10), allowed=((limit, 9),), conditions=("stopped", "access_level_2"),
            keeps="go",
        ),
        "go": runtime.Command(at=at(11)),
        "one": runtime.Command(at=at(12), value=7),
    }  # fmt: skip
    points["way"] = runtime.ByVariant("model", {"a": points["needy"], "b": points["mode"]})
    return points


def check_help(package: Package) -> None:
    """Each point tells what it is and how it is used, on the class and on a device."""
    kind, _ = devices(package, _points(package), package.runtime.ModbusDevice, package.runtime.AsyncModbusDevice)
    device = kind(Memory({}), 1, {"model": "a"})
    for point, text in ((kind.speed, SPEED), (kind.needy, NEEDY), (kind.mode, MODE)):
        assert point.__doc__ == text, point.__doc__
        assert inspect.getdoc(point) == text
    assert (device.speed.__doc__, device.way.__doc__) == (SPEED, NEEDY)
    lines = kind.word.__doc__.splitlines()
    assert "Flags: on, fault, mode, rest." in lines
    assert "    word.decode(raw) -> value" in lines
    assert "What may be written: 0.5..2 V." in kind.number.__doc__.splitlines()
    assert "What may be written" not in kind.free.__doc__
    assert "    free.encode(value) -> raw" in kind.free.__doc__.splitlines()
    assert "What may be written: 0..9, whole numbers." in kind.bound.__doc__.splitlines()
    assert "To write it takes: stopped, access level 2." in kind.bound.__doc__.splitlines()
    assert "At power-off a written value is: lost unless go.send() follows." in kind.bound.__doc__.splitlines()
    assert kind.go.__doc__ == (
        "go, a command: it writes any number (1 if none is given) to holding 0x000B.\n\nOn a device: device.go.send()"
    )
    assert "it writes the number 7 to holding 0x000C." in kind.one.__doc__
    assert kind.way.__doc__ == (
        "way: This depends on model, which is passed when the device is made; use help() on each:\n\n"
        "- model a: needy\n- model b: mode"
    )
    for told in (kind.speed, device.speed, kind):
        assert "Special codes: off, hot (as speed.special.off)." in pydoc.plain(pydoc.render_doc(told))
    assert package.runtime.ReadOnly.__doc__ == "A point that can only be read."


def check_help_of_all(package: Package) -> None:
    """Each point of the device tells its name, its place and its access."""
    for item, point in package.device.POINTS.items():
        text = point.__doc__
        assert point.label in text.splitlines()[0], item
        assert f"Place: {point.facts.where}." in text, item
        for name in ("decode", "encode"):
            assert (f"    {item}.{name}(" in text) == hasattr(point, name), (item, name)
    assert f"help({package.device.__name__}." in (package.module.__doc__ or "") or not package.device.POINTS
