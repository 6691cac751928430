"""Turns the channels and parameters of a template into draft points."""

import re
from collections.abc import Iterator, Mapping
from fractions import Fraction
from math import ceil, floor, inf
from typing import Any

from fieldscribe.conditions import TESTS
from fieldscribe.importing.cells import unit_in
from fieldscribe.importing.draft_text import DraftPoint, scalar, titles_text
from fieldscribe.importing.wb.templates import Labels, Texts, number_of, objects
from fieldscribe.text import line
from fieldscribe.wording.numbers import number_text

_SPACES = {"holding": "holding", "holding_single": "holding", "holding_multi": "holding", "input": "input",
           "press_counter": "input", "coil": "coil", "discrete": "discrete"}  # fmt: skip
_TYPES = {"float": "f32", "double": "f64", "char8": "u8"}
_UNITS = {
    "Ohm": "ohm", "kOhm": "kohm", "MOhm": "Mohm", "day": "d", "Па": "Pa", "lux": "lx", "%, RH": "%", "%RH": "%",
}  # fmt: skip
_UNITS_OF_CONTROLS = {
    "temperature": "°C", "rel_humidity": "%", "voltage": "V", "current": "A", "power": "W", "power_consumption": "kWh",
    "atmospheric_pressure": "mbar", "pressure": "bar", "lux": "lx", "sound_level": "dB", "concentration": "ppm",
    "resistance": "ohm", "wind_speed": "m/s", "water_flow": "m³/h", "water_consumption": "m³",
}  # fmt: skip
"""The units of control types in the conventions of Wiren Board."""
_SHOWN = {
    *("name", "title", "id", "group", "order", "type", "original_name", "vrf", "enabled", "required", "hidden"),
    *("sporadic", "semi-sporadic", "ui_options", "read_period_ms", "read_rate_limit_ms", "poll_interval"),
}
"""Keys about showing and polling in the gateway, which are not facts of the device."""
_READ = {
    *("reg_type", "address", "write_address", "format", "word_order", "byte_order", "string_data_size", "scale"),
    *("offset", "round_to", "units", "enum", "enum_titles", "on_value", "off_value", "min", "max", "default", "fw"),
    *("error_value", "unsupported_value", "description", "readonly", "consists_of", "device_type", "oneOf", "shift"),
    *("stride", "condition"),
}
"""The keys that the gateway reads as facts of a register."""
_MOST_NAMED = 500


class Row:
    """One channel or parameter while its facts are read; facts that are taken give no question."""

    def __init__(self, item: Mapping[str, Any], texts: Texts, *, is_parameter: bool) -> None:
        self.item, self._texts, self._left = item, texts, dict(item)
        self.key = str(item.get("id" if is_parameter else "name", ""))
        title = str(item.get("title" if is_parameter else "name") or self.key)
        self.point = DraftPoint(
            0, "holding", texts.english(title), facts={"at": "~"}, titles=texts.others(title), views=True
        )
        self.is_parameter, self.labels, self.words = is_parameter, Labels(), 1
        self.unit = ""
        """A unit that is not shipped."""
        self._ends: tuple[Fraction | float, Fraction | float] = (-inf, inf)
        self._ratio, self._offset = Fraction(1), Fraction(0)

    def take(self, key: str) -> Any:
        """Return the value of a key, and mark it as carried."""
        return self._left.pop(key, None)

    def take_number(self, key: str) -> Fraction | None:
        """Return a number; one that cannot be read remains and counts as not carried."""
        number = number_of(self._left.get(key))
        if number is not None:
            del self._left[key]
        return number

    def lose(self, key: str, value: Any) -> None:
        """Record a fact that is not carried."""
        self.point.questions.append(f"not carried: {key}: {value}")

    def raw(self, value: Fraction) -> Fraction:
        """Return the raw number of a value."""
        return (value - self._offset) / self._ratio

    @property
    def is_choice(self) -> bool:
        """True if the item is not a register but a choice in the gateway."""
        return self.is_parameter and (bool(self.item.get("readonly")) or "address" not in self.item)

    @property
    def choices(self) -> range:
        """The numbers that can be chosen, if they have no names."""
        low, high = number_of(self.item.get("min", 0)) or 0, number_of(self.item.get("max", 1)) or 0
        return range(int(low), int(high) + 1)

    def compares(self, sign: str, value: int) -> bool:
        """Return False if the comparison with a value is false for all numbers of the point."""
        raw = self.raw(Fraction(value))
        return not self.labels or any(TESTS[sign](number, raw) for number in self.labels)

    def read(self) -> DraftPoint:
        """Return the draft point without its condition and its names of numbers."""
        self._read_place()
        self._read_type()
        self._read_scale()
        self._read_labels()
        self._read_range()
        self._read_rest()
        for key in self._left.keys() - _SHOWN - {"condition"}:
            if key in _READ:
                self.lose(key, self._left[key])
            else:
                self.point.remarks.append(f"the template has {key}: {self._left[key]}, which the gateway does not read")
        return self.point

    def _read_place(self) -> None:
        facts, space = self.point.facts, str(self.take("reg_type") or "holding")
        self.point.space = _SPACES.get(space, "holding")
        if space not in ("holding", "input", "coil", "discrete", "press_counter"):
            self.lose("reg_type", space)
        place, written = self.take("address"), self.take("write_address")
        is_read_only = bool(self.take("readonly")) | bool(self.take("read_only"))
        read_only = is_read_only or self.point.space in ("input", "discrete")
        facts["access"] = "r" if read_only else "w" if place is None else "rw"
        self._set_place("at", place if place is not None else written)
        if None not in (place, written) and number_of(written) != number_of(place):
            self._set_place("write_at", written)

    def _set_place(self, key: str, place: Any) -> None:
        """Set an address: a number, or `109:1:2` for two bits of 109 from bit 1 on."""
        number, _, bits = str(place).partition(":")
        wire = number_of(number)
        match = re.fullmatch(r"([0-9]{1,2}):([0-9]{1,2})", bits)
        if wire is None or wire.denominator != 1 or wire < 0 or (bits and (match is None or key != "at")):
            self.lose(key, place)
            return
        self.point.facts[key] = str(wire)
        if key == "at":
            self.point.wire = int(wire)
        if match and int(match[2]) < 16:
            low = int(match[1])
            high = low + int(match[2]) - 1 if int(match[2]) else 15
            self.point.facts["bits"] = str(low) if low == high else f"{high}..{low}"

    def _read_type(self) -> None:
        facts, form = self.point.facts, str(self.take("format") or "u16")
        words, swapped = self.take("word_order"), self.take("byte_order")
        size = self.take_number("string_data_size")
        if self.point.space in ("coil", "discrete"):
            return
        if swapped == "little_endian":
            facts["bytes"] = "low first"
        if form in ("string", "string8") and size is not None and 0 < size <= 1000:
            self._set_text(int(size), 1 if form == "string" else 2)
            return
        if form.startswith("bcd"):
            facts["coding"] = "bcd"
        kind = _TYPES.get(form, form.replace("bcd", "u"))
        match = re.fullmatch("[usf](8|16|24|32|48|64)", kind)
        if match is None:
            self.lose("format", form)
            kind = "~"
        self.words = -(-int(match[1] if match else 16) // 16)
        if kind in ("u8", "s8") and "bits" not in facts:
            facts |= {"bits": "7..0"} | ({} if facts["access"] == "r" else {"fixed": "{15..8: 0}"})
        if kind != "u16":
            facts["type"] = kind
        if self.item.get("type") == "unixtime" and kind[0] in "us":
            facts["notation"] = "time since 1970-01-01"
        if words == "little_endian" and self.words > 1:
            facts["words"] = "low first"

    def _set_text(self, words: int, per_word: int) -> None:
        """Set the type of a text; the gateway reads it up to its first 00h."""
        facts, self.words = self.point.facts, words
        facts |= {"type": "text", "characters": str(words * per_word), "padding": "00h"}
        if per_word == 1:
            facts["per_word"] = "1"
        if self.point.wire is not None and words > 1:
            facts["at"] = f"{self.point.wire}..{self.point.wire + words - 1}"

    def _read_scale(self) -> None:
        facts = self.point.facts
        self._ratio = self.take_number("scale") or Fraction(1)
        self._offset = self.take_number("offset") or Fraction(0)
        times = "" if self._ratio == 1 else f" * {number_text(self._ratio)}"
        plus = f" {'-' if self._offset < 0 else '+'} {number_text(abs(self._offset))}" if self._offset else ""
        if times or plus:
            facts["scale"] = f"value = raw{times}{plus}"
        step = self.take_number("round_to")
        if step is not None and 0 < step < 1 and step != self._ratio:
            facts["display"] = f"{{decimals: {len(number_text(step).partition('.')[2])}}}"
        unit = str(self.take("units") or self.take("unit") or "")
        symbol = _UNITS.get(unit) or unit_in(unit) if unit else _UNITS_OF_CONTROLS.get(str(self.item.get("type")), "")
        if self.is_number and (unit or symbol):
            self.unit = "" if symbol else line(unit)
            facts["unit"] = scalar(symbol or self.unit)

    @property
    def is_number(self) -> bool:
        """True if the point is a register and not a text."""
        return self.point.space in ("holding", "input") and self.point.facts.get("type") != "text"

    def _read_labels(self) -> None:
        """Read the names of numbers; they are raw, so they replace a scale."""
        numbers, titles = self.take("enum"), self.take("enum_titles")
        on, off, control = self.take_number("on_value"), self.take_number("off_value"), self.item.get("type")
        if numbers is not None:
            self._read_enum(numbers, titles)
        elif control == "pushbutton" and on not in (None, 1):
            self.labels, self.point.facts["open"] = {int(on or 0): "Press"}, "yes"
        elif control in ("switch", "alarm") and on is None and off is None:
            ends = self.raw(Fraction(0)), self.raw(Fraction(1))  # scale -1 and offset 1: 0 is on
            if (self.is_number or self._offset) and ends[0].denominator == ends[1].denominator == 1:
                self.labels = {int(ends[0]): "Off", int(ends[1]): "On"}
        elif control in ("switch", "alarm"):
            self.labels = {int(on == 0 if off is None else off): "Off", int(off != 1 if on is None else on): "On"}
        elif on not in (None, 1) or off not in (None, 0):
            self.lose("on_value", f"{on}, off_value: {off}")
        if self.labels:
            for key in ("scale", "unit", "display"):
                self.point.facts.pop(key, None)

    def _read_enum(self, numbers: Any, titles: Any) -> None:
        """Read listed numbers with their titles."""
        listed = numbers if isinstance(numbers, list) and len(numbers) <= _MOST_NAMED else []
        raws = [None if (value := number_of(number)) is None else self.raw(value) for number in listed]
        words = titles if isinstance(titles, list) and len(titles) == len(listed) else listed
        self.labels = {int(raw): str(word) for raw, word in zip(raws, words, strict=True) if raw is not None}
        are_whole = all(raw is not None and raw.denominator == 1 for raw in raws)
        if not listed or len(self.labels) < len(listed) or not are_whole:
            self.lose("enum", numbers)

    def _read_range(self) -> None:
        """Read the range, limited to what the type can hold."""
        low, high, ends = self.take_number("min"), self.take_number("max"), self._limits()
        if self.labels or not self.is_number or (low is None and high is None):
            return
        if ends:
            low = ends[0] if low is None else min(max(low, ends[0]), ends[1])
            high = ends[1] if high is None else max(min(high, ends[1]), ends[0])
        if low is None or high is None:
            self.lose("range", f"{low}..{high}")
            return
        self._ends = low, high
        first, last = sorted((self.raw(low), self.raw(high)))
        if not ends or (first.denominator, last.denominator) == (1, 1):
            self.point.facts["range_in_units"] = f"{number_text(low)}..{number_text(high)}"
        else:
            self.point.facts["range"] = f"{ceil(first)}..{floor(last)}"
        stated = [number_of(self.item.get(key)) for key in ("min", "max")]
        if any(each not in (None, end) for each, end in zip(stated, (low, high), strict=True)):
            bounds = " and ".join(f"{key} {self.item[key]}" for key in ("min", "max") if key in self.item)
            self.point.remarks.append(f"the template has {bounds}, beyond what the type holds")

    def _limits(self) -> list[Fraction] | None:
        """Return the least and the greatest value that the type can hold; None unless it is a whole number."""
        kind, bits = self.point.facts.get("type", "u16"), self.point.facts.get("bits")
        if kind[0] not in "us":
            return None
        high, _, low = (bits or f"{int(kind[1:]) - 1}..0").partition("..")
        width = int(high) - int(low or high) + 1
        least = -(1 << width - 1) if kind[0] == "s" else 0
        return sorted(number * self._ratio + self._offset for number in (least, least + (1 << width) - 1))

    def _read_rest(self) -> None:
        facts, kind = self.point.facts, self.point.facts.get("type", "u16")
        default = self.take_number("default")
        if default is not None:
            key = "default_in_units" if not self.labels and ("scale" in facts or kind[0] == "f") else "default"
            low, high = self._ends
            if (self.labels and self.raw(default) not in self.labels) or not low <= default <= high:
                self.point.remarks.append(
                    f"the template has the default {number_text(default)}, which cannot be written"
                )
            else:
                facts[key] = number_text(default if key == "default_in_units" else self.raw(default))
        codes: dict[int, str] = {}
        for key, name in (("error_value", "error"), ("unsupported_value", "unsupported")):
            code = self.take_number(key)
            if code is not None and self.is_number:
                bits = int(kind[1:]) if re.fullmatch("s[0-9]+", kind) else 0
                signed = code - 2**bits if bits and 2 ** (bits - 1) <= code < 2**bits else code
                codes.setdefault(int(signed), name)
        if codes:
            facts["special"] = f"{{{', '.join(f'{code}: {name}' for code, name in codes.items())}}}"
        version = self.take("fw")
        if version:
            facts["since"] = scalar(f"firmware {version}")
        note = str(self.take("description") or "")
        if note:
            facts["note"] = titles_text(self._texts.english(note), self._texts.others(note))


def components_of(item: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """Yield a channel, or a channel for each register that it consists of."""
    parts = objects(item.get("consists_of"))
    if not parts:
        yield item
    shared = {key: value for key, value in item.items() if key not in ("consists_of", "type")}
    for number, part in enumerate(parts, 1):
        yield shared | part | {"name": f"{item.get('name', '')} {number}"}
