"""What a family that says little of itself is taken to be, and what the three say."""

from __future__ import annotations

import pytest
from fieldscribe.families import BusKeys, Family, family


def test_a_family_has_only_what_it_says() -> None:
    bare = Family("bare", "support", {"word": "word"}, 9, BusKeys(), ("usual",))
    assert (bare.codes, bare.indexed, dict(bare.words), bare.frame_keys) == ((), frozenset(), {}, ())
    assert (bare.lays_out_messages, bare.writes_elsewhere, bare.chooses_memory) == (False, False, False)
    assert (bare.commands_in, bare.options, bare.exports) == (None, (), ())
    assert bare.widest("word") == 64
    assert (bare.bus.codes, bare.bus.last_exception, bare.bus.last_unit, bare.bus.broadcast) == (
        (0, 255),
        255,
        255,
        None,
    )
    assert ("units" in bare.bus, "bitrate" in bare.bus) == (True, False)
    assert bare.part("bus_facts") is None


CAN_DO: dict[str, dict[str, object]] = {
    "modbus": {"commands_in": "holding", "writes_elsewhere": True},
    "can": {"lays_out_messages": True, "exports": ("dbc",)},
    "uss": {"chooses_memory": True},
}
"""As the manuals of their devices have it: only USS chooses between RAM and EEPROM by the task of a request."""
NOTHING: dict[str, object] = {
    "lays_out_messages": False,
    "commands_in": None,
    "writes_elsewhere": False,
    "chooses_memory": False,
    "exports": (),
}


@pytest.mark.parametrize("name", CAN_DO)
def test_what_the_families_can(name: str) -> None:
    assert {fact: getattr(family(name), fact) for fact in NOTHING} == {**NOTHING, **CAN_DO[name]}


@pytest.mark.parametrize(
    ("name", "space", "bits"),
    [("modbus", "holding", 64), ("can", "parameter", 16), ("uss", "parameter", 32), ("uss", "telegram", 64)],
)
def test_the_widest_number_of_a_space(name: str, space: str, bits: int) -> None:
    """A frame of CAN carries one word of a parameter, a task of USS two."""
    assert family(name).widest(space) == bits
