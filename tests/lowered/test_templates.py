"""Text templates: points with the same key have the same text but for their fields, in C, Python and Rust."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import count
from typing import Any

import pytest
from fieldscribe import lowered
from fieldscribe.code_view import for_code
from fieldscribe.conditions import Comparison, Condition
from fieldscribe.lowered import TemplateKeys
from fieldscribe.model import Device, Enum, Erratum, Limit, Place, Point, Special, Variant
from fieldscribe.resources import render
from fieldscribe.targets import c, python, rust, typescript
from fieldscribe.targets.c import point_views
from fieldscribe.targets.placeholders import MOST_FIELDS, TextTemplate, TextTemplates, placeholders
from fieldscribe.text import c_comment, line
from support.described import SHIPPED, made, shipped
from support.models import (
    CELSIUS,
    HERTZ,
    SOURCE,
    allowed,
    changed,
    device_of,
    entry,
    linear,
    point,
    sample_device,
    scaled,
    titles,
    trip_device,
    units,
    value_of,
)
from support.rust_crates import can_device, odd_device, rare_device, uss_device

FIELDS = [("base_frequency", "BASE_FREQUENCY", "0x0010"), ("jump_frequency", "JUMP_FREQUENCY", "0x0A3F")]


def laid_out(fields: tuple[str, ...]) -> str:
    name, macro, address = fields
    return f"100 % of {name}\n" + textwrap.fill(f"#define {macro}_ADDRESS {address} /* {name}: {{}} %s */ " * 4, 60)


def test_a_filled_template_is_the_text_with_the_fields() -> None:
    template = TextTemplate(laid_out(placeholders(FIELDS[0])))
    assert [template.fill(fields) for fields in FIELDS] == [laid_out(fields) for fields in FIELDS]


@pytest.mark.parametrize(("text", "filled"), [("", ""), ("100 %", "100 %"), ("[{}]", "[word]")])
def test_a_template_may_hold_one_placeholder_or_none(text: str, filled: str) -> None:
    assert TextTemplate(text.format(*placeholders(["word"]))).fill(["word"]) == filled


def test_an_empty_field_has_no_placeholder() -> None:
    assert placeholders(["", "x"])[0] == ""
    assert TextTemplate("<{}{}>".format(*placeholders(["", "x"]))).fill(["", "y"]) == "<y>"


def test_no_text_of_a_description_can_hold_a_placeholder() -> None:
    for placeholder in placeholders(["x"] * MOST_FIELDS):
        assert line(placeholder) == c_comment(placeholder) == ""


def test_other_rare_signs_of_a_text_are_no_placeholders() -> None:
    """What an emoji in a title or a wide digit is made of."""
    name, code = placeholders(["name", "A1"])
    text = "\U0001f600\U0001f600{0}\uff11\uff11\uff1a{1}\ufffd"
    assert TextTemplate(text.format(name, code)).fill(["speed", "B2"]) == text.format("speed", "B2")


LANGUAGES = (c, python, rust, typescript)

QUICK = ("kitchen_sink", "kitchen_uss", "kitchen_can")
DEVICES: dict[str, Callable[[], Device]] = {
    **{name: partial(shipped, name) for name in SHIPPED},
    **{
        name: partial(made, name)
        for name in ("kitchen_sink", "kitchen_codes", "kitchen_can", "kitchen_uss", "odd_names")
    },
    "sample": sample_device,
    "trips": trip_device,
    "rare": rare_device,
    "odd": odd_device,
    "odd_can": can_device,
    "odd_uss": uss_device,
}


def texts(device: Device) -> dict[str, str]:
    """Return the generated files of a device in the compiled languages."""
    for module in (lowered, typescript):
        module._last.kept.clear()
    return {path: text for language in LANGUAGES for path, text in language.outputs(for_code(device), render)}


def unshared(device: Device, monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    """Return the same files with a text for each point, laid out with its own fields."""
    numbers = count()
    with monkeypatch.context() as patch:
        patch.setattr(TemplateKeys, "of", lambda *_: next(numbers))
        patch.setattr(point_views, "placeholders", tuple)
        patch.setattr(TextTemplates, "fill", lambda _, _key, fields, lay_out: lay_out(fields))
        return texts(device)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in QUICK else pytest.mark.full) for name in DEVICES]
)
def test_sharing_templates_changes_no_text(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    device = DEVICES[name]()
    assert texts(device) == unshared(device, monkeypatch)


Facts = dict[str, Any]
LONG = "a_name_so_long_that_lines_break_where_they_do_not_break_for_its_neighbour"
MODES = Enum("mode", (entry(0, "off"), entry(1, "slow")), False)
FAULT = (Special(65535, 65535, "fault", titles("Fault"), True, shared=True),)
OFF = Erratum("E1", ("two",), "", SOURCE, "1", "2", "", "sure", (("scale", "1"),))
SEVENTHS = {"scale": scaled("3/7"), "decimals": 1}
LOWEST = Limit(linear(1, 0, value_of("other")), (), 0, 4000)
LATER = Condition(((Comparison("other", ">", (3,)),),))
PAIRS: dict[str, tuple[Facts, Facts]] = {
    "type": ({"allowed": allowed((0, 9))}, {"type": "s16", "allowed": allowed((0, 9))}),
    "access": ({}, {"access": "r"}),
    "space": ({}, {"space": "input"}),
    "unit": ({"unit": HERTZ}, {"unit": CELSIUS}),
    "bits": ({"type": "u8", "bits": (7, 0)}, {"type": "u8", "bits": (15, 8)}),
    "steps": ({"scale": scaled(10), "decimals": 1}, {"scale": scaled(10), "decimals": 1, "steps": ((0, 5),)}),
    "telegram": ({}, {"telegram": "actual"}),
    "condition": ({}, {"when": LATER}),
    "conditions to write": ({}, {"conditions": ("when_stopped",)}),
    "changes": ({}, {"changes": "never"}),
    "an element": ({}, {"index": 2}),
    "elements": ({"index": 1}, {"index": 1000}),
    "numberings": ({}, {"references": {"manual": 4}}),
    "numbers and texts": ({"references": {"manual": 1234}}, {"references": {"manual": "12"}}),
    "written elsewhere": ({}, {"write_place": Place((7,), {})}),
    "order of words": ({"type": "u32", "order": (3, 4)}, {"type": "u32", "order": (4, 3)}),
    "addresses": ({"place": Place((10000,), {})}, {"place": Place((9,), {})}),
    "variant": ({}, {"variant": Variant("voltage_class", "200V")}),
    "errata": ({}, {"errata": ("E1",)}),
    "old names": ({"was": ("former",)}, {"was": ("earlier",)}),
    "an old name": ({}, {"was": ("former",)}),
    "code": ({}, {"code": "A1"}),
    "codes that nobody searches": ({"code": "A1"}, {"code": "A?"}),
    "default": ({}, {"default": 5}),
    "long names": ({}, {"name": LONG}),
    "reserved names": ({"name": "none"}, {"name": "some"}),
    "names of numbers": ({"enum": MODES}, {"enum": MODES}),
    "closed": ({"enum": MODES}, {"enum": replace(MODES, closed=True)}),
    "shared codes": ({"specials": FAULT, "specials_of": "u16"}, {"specials": FAULT, "specials_of": "u16"}),
    "all of the type": ({"allowed": allowed((0, 65534))}, {"allowed": allowed((0, 65535))}),
    "several ranges": ({"allowed": allowed((0, 40))}, {"allowed": allowed((0, 9), (20, 40))}),
    "other ranges": ({"allowed": allowed((0, 8), (20, 40))}, {"allowed": allowed((0, 9), (20, 40))}),
    "ranges in a table": ({"allowed": allowed((0, 1), (3, 4), (6, 7))}, {"allowed": allowed((0, 1), (3, 4), (6, 8))}),
    "computed limits": ({"allowed": allowed((0, 9))}, {"allowed": allowed((LOWEST, 9))}),
    "units as limits": ({"type": "f32", "allowed": units(0, 9)}, {"type": "f32", "allowed": units(0, 8)}),
    "the way from a count": ({**SEVENTHS, "allowed": allowed((0, 7300))}, {**SEVENTHS, "allowed": allowed((0, 8000))}),
    "what is only read": (
        {**SEVENTHS, "allowed": allowed((0, 7300)), "access": "r"},
        {**SEVENTHS, "allowed": allowed((0, 8000)), "access": "r"},
    ),
    "counts": (
        {"scale": scaled(1), "decimals": 0, "allowed": allowed((10, 40))},
        {"scale": scaled(1), "decimals": 0, "allowed": allowed((10, 99))},
    ),
    "digits of limits": ({"allowed": allowed((0, 99))}, {"allowed": allowed((0, 100))}),
    "codes in limits": (
        {"specials": FAULT, "allowed": allowed((0, 9))},
        {"specials": FAULT, "allowed": allowed((0, 65535))},
    ),
}
"""Facts of a first and a second point that are alike in all else, by what the difference is."""


def device_with(*facts: Facts) -> Device:
    """Return a device of points with these facts, and one that they may need."""
    listed: list[Point] = []
    for number, each in enumerate(facts):
        rest = {"name": f"point_{number}", "type": "u16", **each}
        place = {key: rest.pop(key) for key in ("place", "references") if key in rest}
        order = {"order": tuple(at + 4 * number for at in rest["order"])} if "order" in rest else {}
        listed.append(changed(point(rest.pop("name"), 3 + 4 * number, rest.pop("type"), **{**rest, **order}), **place))
    return device_of("pair", (*listed, point("other", 90)), errata=(OFF,))


@pytest.mark.parametrize("difference", PAIRS)
def test_points_that_differ_read_as_each_would_alone(difference: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for first, second in (PAIRS[difference], PAIRS[difference][::-1]):
        device = device_with(first, second)
        assert texts(device) == unshared(device, monkeypatch)


@pytest.mark.parametrize("names", [("zero", "mode", "made"), ("mode", "zero", "made"), ("zero", "made", "mode")])
def test_the_enum_of_a_point_moves_with_its_name(names: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    device = device_of("pair", tuple(point(name, at, enum=MODES) for at, name in enumerate(names)))
    assert texts(device) == unshared(device, monkeypatch)


def test_equal_points_share_a_key() -> None:
    """Names, codes, addresses, the numbers of references and the ends of a range make no difference."""
    first = {"code": "A1", "allowed": allowed((0, 9)), "references": {"manual": 1}}
    second = {"code": "A123", "allowed": allowed((5, 999)), "references": {"manual": 2000}}
    device = for_code(device_with(first, second, {**second, "access": "r"}))
    keys = TemplateKeys()
    one, two, three, _ = map(keys.of, device.points)
    assert one == two != three
