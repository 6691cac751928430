"""Vectors are written once for all points that have them alike; whoever shares more than that changes them."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import pytest
from fieldscribe import code_view
from fieldscribe.code_view import for_code
from fieldscribe.model import Device, Digits, Enum, Fixed, Flag, Interner, Place, Shape, Special, Text
from fieldscribe.targets.vectors.collection import SharedVectors, collect
from fieldscribe.targets.vectors.samples import PointEncodings
from support.described import KITCHENS, SHIPPED, made, shipped
from support.models import HERTZ, VOLT, allowed, entry, point, sample_device, scaled, titles, value_of

ENUM = Enum("mode", (entry(0, "off"), entry(1, "on")), closed=True)


def twins() -> Device:
    """Points that differ in little.

    In the unit that is shown, in where they are written, in what changes them, in whether their enum is closed, in
    whether the manual prints an address, in their type.
    """
    same: dict[str, Any] = {"display": 1, "allowed": allowed((0, 9))}
    shown = [point(f"shown_in_{unit.name}", at, unit=unit, **same) for at, unit in enumerate((HERTZ, VOLT), 10)]
    written = [point(f"written_at_{at}", at, write_place=Place((at + 100,), {})) for at in (20, 21)]
    changing = [point(f"after_{name}", at, changes_with=(name,)) for at, name in enumerate(("one", "other"), 30)]
    modes = [ENUM, replace(ENUM, name="other"), replace(ENUM, name="open", closed=False)]
    naming = [point(enum.name, at, enum=enum) for at, enum in enumerate(modes, 40)]
    placed = [point(f"placed_{len(at)}", 50, place=Place(at, {})) for at in ((50,), ())]
    word, signed = point("word", 60), point("signed", 61, "s16")
    return sample_device((*shown, *written, *changing, *naming, *placed, word, replace(signed, terms=word.terms)))


ALL = [
    *map(made, KITCHENS),
    *map(shipped, SHIPPED),
    twins(),
]


def text_of(device: Device) -> str:
    """The vectors of a device, made anew: the target keeps those of the last device."""
    device = for_code(device)
    return collect(device).text(device.id, device.version, device.digest)


SOUND: dict[str, str] = {}


@pytest.fixture(scope="module", autouse=True)
def _sound_texts() -> None:
    """What the vectors of all devices are before a test makes anything forget."""
    SOUND.update({device.id: text_of(device) for device in ALL})


# Each point by itself


def forgetting(monkeypatch: pytest.MonkeyPatch, owner: type, method: str, memory: str) -> None:
    """Before each call the memory of what is shared is emptied."""
    remembering = getattr(owner, method)

    def anew(self: Any, *arguments: Any, **named: Any) -> Any:
        getattr(self, memory).clear()
        return remembering(self, *arguments, **named)

    monkeypatch.setattr(owner, method, anew)


@pytest.mark.full
@pytest.mark.parametrize("device", ALL, ids=lambda device: device.id)
def test_each_point_by_itself_has_the_same_vectors(device: Device, monkeypatch: pytest.MonkeyPatch) -> None:
    forgetting(monkeypatch, PointEncodings, "of", "_known")
    forgetting(monkeypatch, SharedVectors, "near_limits", "_near_limits")
    forgetting(monkeypatch, SharedVectors, "_convert", "_conversions")
    assert text_of(device) == SOUND[device.id]


# Keys that forget something


class Forgetful(dict[Any, Any]):
    """Memory whose keys are told apart by all but one of their parts."""

    def __init__(self, part: int) -> None:
        super().__init__()
        self.part = part

    def _key(self, key: tuple[object, ...]) -> tuple[object, ...]:
        return (*key[: self.part], *key[self.part + 1 :])

    def get(self, key: tuple[object, ...], default: object = None) -> Any:
        return super().get(self._key(key), default)

    def __setitem__(self, key: tuple[object, ...], value: object) -> None:
        super().__setitem__(self._key(key), value)


def sharing_more(monkeypatch: pytest.MonkeyPatch, owner: type, memory: str, part: int) -> None:
    """Makes the owner forget one part of its keys."""
    begin = owner.__init__  # type: ignore[misc]  # the constructor of whichever class

    def forgetful(self: Any, *arguments: Any) -> None:
        begin(self, *arguments)
        setattr(self, memory, Forgetful(part))

    monkeypatch.setattr(owner, "__init__", forgetful)


def caught() -> bool:
    """Whether the vectors of some device are others now."""
    return any(differs(device, SOUND[device.id]) for device in reversed(ALL))


def differs(device: Device, sound: str) -> bool:
    """Whether the vectors are others, or cannot be made at all."""
    try:
        return text_of(device) != sound
    except (ValueError, TypeError, KeyError, IndexError, AttributeError):
        return True


@pytest.mark.full(seconds=0.5)
@pytest.mark.parametrize("part", range(5), ids=["shape", "allowed", "bits", "order", "symbol"])
def test_a_forgotten_part_of_an_encoding_is_caught(part: int, monkeypatch: pytest.MonkeyPatch) -> None:
    sharing_more(monkeypatch, PointEncodings, "_known", part)
    assert caught()


# The key by which the model interns shapes

OTHER_ENUM = Enum("mode", (entry(0, "off"), entry(2, "on")), closed=True)
DEPENDENT = scaled(1, 0, value_of("ratio"))
PAIRS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "type": ({"type": "u16"}, {"type": "s16", "width": 16}),
    "width": ({"bits": (7, 4)}, {"bits": (8, 4)}),
    "access": ({"access": "r"}, {"access": "rw"}),
    "scale": ({"scale": scaled(10), "decimals": 1}, {"scale": scaled(20), "decimals": 1}),
    "decimals": ({"scale": scaled(10), "decimals": 1}, {"scale": scaled(10), "decimals": 2}),
    "enum": ({"enum": ENUM}, {"enum": OTHER_ENUM}),
    "flags": (
        {"flags": (Flag(0, 1, "ready", titles("x"), 1, ()),)},
        {"flags": (Flag(1, 1, "ready", titles("x"), 1, ()),)},
    ),
    "specials": ({"specials": (Special(9, 9, "off", titles("x"), no_value=True),)}, {}),
    "text": ({"text": Text(4, "ascii"), "type": "text"}, {"text": Text(4, "latin-1"), "type": "text"}),
    "digits": ({"digits": Digits(3, ENUM)}, {"digits": Digits(4, ENUM)}),
    "fixed": ({"fixed": Fixed(1, 1)}, {"fixed": Fixed(1, 0)}),
    "encodes_values": (
        {"scale": DEPENDENT, "decimals": 1},
        {"scale": DEPENDENT, "decimals": 1, "encodes_values": False},
    ),
    "most_raw": (
        {"scale": DEPENDENT, "decimals": 1, "type": "u32", "most_raw": 1000},
        {"scale": DEPENDENT, "decimals": 1, "type": "u32"},
    ),
    "epoch": ({"type": "u32", "epoch": "1970-01-01"}, {"type": "u32", "epoch": "2000-01-01"}),
    "coding": ({"type": "u16"}, {"type": "u16", "coding": "bcd"}),
    "swapped": ({"type": "u16"}, {"type": "u16", "swapped": True}),
    "patterns": ({"type": "u32", "enum": ENUM}, {"type": "u32", "enum": ENUM, "patterns": True}),
    "display": ({"scale": scaled(10), "decimals": 1, "display": 1}, {"scale": scaled(10), "decimals": 1, "display": 0}),
}
"""Two points that differ in one fact of their shape."""


def interned(self: Interner, shape: Shape, *, without: str) -> Shape:
    """The first shape that is equal but for one fact."""
    key: Any = tuple(repr(getattr(shape, one.name)) for one in fields(Shape) if one.name != without)
    return self._shapes.setdefault(key, shape)


@pytest.mark.parametrize("fact", PAIRS)
def test_a_shape_that_the_model_shares_wrongly_is_caught(fact: str, monkeypatch: pytest.MonkeyPatch) -> None:
    one, other = PAIRS[fact]
    order: dict[str, Any] = {"order": (10, 11)} if "text" in one else {}
    other_order: dict[str, Any] = {"order": (20, 21)} if "text" in one else {}
    first, second = point("first", 10, **one, **order), point("second", 20, **other, **other_order)
    device = sample_device((first, second, point("ratio", 30, allowed=allowed((1, 9)))))
    sound = text_of(device)
    monkeypatch.setattr(Interner, "shape", lambda self, shape: interned(self, shape, without=fact))
    monkeypatch.setattr(code_view._last, "kept", [])
    assert differs(device, sound)


def test_every_fact_of_a_shape_is_tried() -> None:
    assert {one.name for one in fields(Shape)} - set(PAIRS) == {
        "specials_of"
    }  # the name of codes, of which each is told


@pytest.mark.parametrize("low", [True, False])
def test_limits_that_the_model_shares_wrongly_are_caught(low: bool) -> None:
    ends = ((3, 90), (4, 90)) if low else ((3, 90), (3, 91))
    first, second = (point(name, at, allowed=allowed(end)) for name, at, end in zip("ab", (1, 2), ends, strict=True))
    sound = text_of(sample_device((first, second)))
    assert text_of(sample_device((first, replace(second, allowed=first.allowed)))) != sound
