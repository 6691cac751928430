"""Hints for values that people write as in other tools and languages."""

from __future__ import annotations

import re
from decimal import Decimal
from typing import TYPE_CHECKING, Any

from fieldscribe.language.meant_words import ALSO, ENDIAN, TYPE_WORDS, WORDS
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import NumberError, parse_number

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Mapping

_LONGEST = 60
_NUMBER = r"[-+]?[0-9][0-9A-Fa-fxX]*(?:\.[0-9]+)?[hH]?"
_BETWEEN = r"(?:\.\.|-|\u2013|\u2014|~|:|;|\.\.\.|\u2026|\u00f7|to|bis|through)"
_INTERVAL = re.compile(rf"[\[(]?\s*({_NUMBER})\s*{_BETWEEN}\s*({_NUMBER})\s*[\])]?\s*[^\s\d]{{0,4}}")
_CODE = r"-?[0-9]+|0x[0-9A-Fa-f]+|[0-9A-Fa-f]+h|[Hh]'[0-9A-Fa-f]+"
_PAIRS = re.compile(r"([-+]?[0-9]+)\s*[=:]\s*([A-Za-z][A-Za-z0-9_ ]*)")


def value_hint(key: Any, value: Any) -> str | None:
    """The hint what to write under this key instead of the value; None if there is no guess."""
    if not isinstance(key, str):
        return None
    making = _MAKERS.get(key)
    hint = None if making is None else making(key, value)
    return hint or _word_hint(key, value)


def space_hint(space: str, known: Collection[str]) -> str | None:
    """The hint for a space under a name of other tools; None if there is no guess."""
    word = WORDS["space"].get(space.strip().lower()[:_LONGEST])
    return f"write `space: {word}`" if word in known else None


def reversed_hint(key: str, value: Any) -> str | None:
    """The hint for `off: 0` where the number belongs first; None if the value is no number."""
    if isinstance(value, int) and not isinstance(value, bool) and len(key) <= _LONGEST:
        return f"the number stands first: `{value}: {key.lower().replace(' ', '_')}`"
    return None


def _word_hint(key: str, value: Any) -> str | None:
    known = WORDS.get(key)
    if known is None or not isinstance(value, str | int | Decimal):
        return None
    word = str(value).strip().lower()[:_LONGEST]
    bare = ENDIAN.sub("", word)
    spelled = word if word in known else word.replace(" ", "_")
    meant = known.get(spelled) or ((bare if bare in TYPE_WORDS else known.get(bare)) if key == "type" else None)
    if meant is None:
        return None
    order = "" if key != "type" or spelled in known else "; the order of words goes under `words`"
    return f"write `{key}: {meant}`{order}{ALSO.get(meant, '') if key == 'type' else ''}"


def _type(_: str, value: Any) -> str | None:
    """A type in another spelling, or of a width that does not exist."""
    if not isinstance(value, str):
        return None
    word = value.strip().lower()
    if word in TYPE_WORDS:
        return f"write `type: {word}`"
    if re.fullmatch(r"[usi]?(int)?(24|40|48|56|128)(_t)?", word) or re.search("(^|[^a])bcd", word):
        words = '`untyped: "48-bit counter"` with `length: 3`'
        return f"no type here is like this: leave `type` out and say it in words, as {words}"
    return None


def interval_meant(text: str) -> str | None:
    """`0-100`, `0 to 100`, `[0:100]` in our notation; None if it is no interval."""
    ends = _INTERVAL.fullmatch(text.strip()) if len(text) <= _LONGEST else None
    return f"{ends[1]}..{ends[2]}" if ends is not None and _numbers(ends[1], ends[2]) else None


def _numbers(*texts: str) -> bool:
    try:
        return all(parse_number(text) is not None for text in texts)
    except NumberError:
        return False


def _interval(key: str, value: Any) -> str | None:
    """Intervals of raw numbers, of units or of words."""
    if isinstance(value, Map):
        low, high = (next((value[name] for name in names if name in value), None) for names in _ENDS)
        whole = isinstance(low, int | Decimal | str) and isinstance(high, int | Decimal | str)
        return f"write `{key}: {low}..{high}`" if whole else "an interval is written low..high: `0..100`"
    if isinstance(value, Seq) and len(value) == 2 and not any(isinstance(end, Map | Seq) for end in value):
        return f"write `{key}: {value[0]}..{value[1]}`"
    meant = interval_meant(value) if isinstance(value, str) else None
    return None if meant is None else f"write `{key}: {meant}`"


_ENDS = (("min", "low", "from", "minimum"), ("max", "high", "to", "maximum"))


def _bits(key: str, value: Any) -> str | None:
    """Bits as pairs, with the low one first, or with a word in front."""
    if isinstance(value, Seq) and len(value) == 2 and all(isinstance(bit, int) for bit in value):
        low, high = sorted(value)
        return f"write `{key}: {high}..{low}`"
    return None


def bits_meant(text: str) -> str | None:
    """`15:8`, `b3`, `bit 3` in our notation; None if it is something else, or right already."""
    match = re.fullmatch(r"[^\W\d]{0,5}[ .]?([0-9]{1,2})(?:(?:-|:|,|/| to )([0-9]{1,2}))?", text.strip())
    if match is None or text.strip().isdecimal():
        return None
    ends = sorted((int(bit) for bit in match.groups() if bit), reverse=True)
    return "..".join(map(str, ends))


def _rule(_: str, value: Any) -> str | None:
    """A rule in a case of a scale, written like a scale elsewhere."""
    hint = _scale("", value)
    return None if hint is None else hint.replace("`scale: ", "`rule: ")


def _scale(_: str, value: Any) -> str | None:
    """A bare factor, or an offset and a factor."""
    if isinstance(value, bool) or not isinstance(value, int | Decimal | Map):
        return None
    if isinstance(value, Map):
        factor = next((value[name] for name in ("factor", "gain", "slope", "multiplier") if name in value), None)
        return "a scale is one formula, as in `scale: value = raw * 0.1 - 40`" if factor is None else _scale(_, factor)
    return factor_hint(value)


def factor_hint(number: int | Decimal) -> str:
    """The scale that a bare factor stands for; both scales if it may multiply or divide."""
    from fieldscribe.language.formula.lint import exact_scale

    if number == 0:
        return "a factor of zero makes every value 0: write the rule, as in `scale: value = raw * 0.1`"
    if number == 1:
        return "the raw number is the value: leave `scale` out"
    plain = f"{number:f}" if isinstance(number, Decimal) else str(number)
    line = exact_scale(f"value = raw * {plain}")
    if number < 1 or number % 1:
        return f"write the rule: `scale: {line}`"
    return f"write the rule: `scale: {line}`, or `scale: value = raw / {plain}` if the raw number is the larger one"


def _names(key: str, value: Any) -> str | None:
    """Names for numbers as a list, or as one text."""
    if isinstance(value, Seq) and 0 < len(value) <= 8 and all(isinstance(name, str) for name in value):
        return f"write `{key}: {{{', '.join(f'{place}: {_snake(name)}' for place, name in enumerate(value))}}}`"
    pairs = _PAIRS.findall(value) if isinstance(value, str) and len(value) < 200 else []
    if pairs:
        return f"write `{key}: {{{', '.join(f'{number}: {_snake(name)}' for number, name in pairs)}}}`"
    return None


def _snake(text: str) -> str:
    return re.sub(r"[^a-z0-9]+", "_", text.strip().lower()).strip("_") or "name"


def _steps(_: str, value: Any) -> str | None:
    return f"write `steps: {{0: {value}}}`: from raw 0 on" if isinstance(value, int | Decimal) else None


def _decimals(_: str, value: Any) -> str | None:
    """A resolution such as 0.1 where a number of decimals belongs."""
    if not isinstance(value, Decimal):
        return None
    digits = max(0, -int(value.normalize().as_tuple().exponent))
    return f"it counts the digits behind the point: write `decimals: {digits}`"


def _default(_: str, value: Any) -> str | None:
    """A value where a raw number belongs."""
    fraction = isinstance(value, Decimal) and "." in str(value)
    return f"it is a raw number; a value in the unit is `default_in_units: {value}`" if fraction else None


def _source(_: str, value: Any) -> str | None:
    if isinstance(value, str | int | Decimal) and len(str(value)) <= _LONGEST:
        return f'write `source: {{document: …, section: "{value}"}}`'
    return None


def _at(_: str, value: Any) -> str | None:
    if isinstance(value, Seq) and value:
        return f"a point of several words stands once, at its first: write `at: {value[0]}`"
    if isinstance(value, Map) and value.keys() <= {"number", "sets", "indices", "set", "index"}:
        beside = ", ".join(f"{key}: {part}" for key, part in value.items() if key != "number")
        return f"write `at: {value.get('number', '…')}`" + (f", and `{beside}` beside it" if beside else "")
    return None


def _unit(_: str, value: Any) -> str | None:
    """A number, or several symbols, in place of a unit."""
    if isinstance(value, int | Decimal):
        return "a unit is a symbol such as `Hz`: `fieldscribe units` lists them; a factor belongs to `scale`"
    alone = isinstance(value, Seq) and len(value) == 1 and isinstance(value[0], str)
    return f"write `unit: {value[0]}`" if alone else None


def _when(_: str, value: Any) -> str | None:
    """A mapping of points to numbers."""
    plain = (
        isinstance(value, Map)
        and 0 < len(value) < 5
        and all(isinstance(wanted, int | str) for wanted in value.values())
    )
    return f"write `when: {' and '.join(f'{key} == {wanted}' for key, wanted in value.items())}`" if plain else None


def _printed(_: str, value: Any) -> str | None:
    """A printed number without its numbering."""
    plain = isinstance(value, int | str) and not isinstance(value, bool) and len(str(value)) < _LONGEST
    return f"say which number it is: `printed: {{wire: {value}}}`, or a name of `numbering`" if plain else None


def _line(key: str, value: Any) -> str | None:
    """Several lines where one is meant."""
    lines = re.fullmatch(r"([0-9]{1,9})\s*(?:-|\.\.|,|to).*", value) if isinstance(value, str) else None
    return None if lines is None else f"write the line where it begins: `{key}: {lines[1]}`"


def _index(key: str, value: Any) -> str | None:
    many = {"index": "indices", "set": "sets"}[key]
    return f"several are `{many}: {value}`" if isinstance(value, str) and ".." in value else None


def _sets(key: str, value: Any) -> str | None:
    """Sets as a list."""
    if isinstance(value, Seq):
        return f"write a count, or each with its row: `{key}: 4`, `{key}: {{2: {{at: …}}}}`"
    return None


def _digits(key: str, value: Any) -> str | None:
    return f"write `{key}: {{count: {value}, enum: …}}`" if isinstance(value, int) else None


def _special(key: str, value: Any) -> str | None:
    """Special codes without names."""
    codes = value if isinstance(value, Seq) else [value]
    if 0 < len(codes) <= 8 and all(isinstance(code, int | str) and re.fullmatch(_CODE, str(code)) for code in codes):
        named = ("name_of_it", *(f"name_of_it_{number}" for number in range(2, 9)))
        return f"write `{key}: {{{', '.join(f'{code}: {name}' for code, name in zip(codes, named, strict=False))}}}`"
    return None if isinstance(value, Seq) else _names(key, value)


def _functions(key: str, value: Any) -> str | None:
    """Numbers of functions without names."""
    if isinstance(value, Seq) and 0 < len(value) <= 16 and all(isinstance(number, int | str) for number in value):
        return f"each number has a name: write `{key}: {{{', '.join(f'{number}: name_of_it' for number in value)}}}`"
    return None


def _family(_: str, value: Any) -> str | None:
    """A family with something behind its name, such as a framing; or one that is not known yet."""
    from fieldscribe.families import families

    known, said = families(), value.lower() if isinstance(value, str) else ""
    near = next(
        (bus_family for bus_family in known if said.startswith(bus_family.name) and not bus_family.lays_out_messages),
        None,
    )
    if near is not None:
        ways = "framings" in near.bus.needed and len(said) > len(near.name)
        framings = f"; {' and '.join(near.framings)} are `framings` under `bus`" if ways else ""
        return f"write `family: {near.name}`{framings}"
    if said in ("canopen", "j1939", "nmea2000", "devicenet"):
        makers = " and ".join(bus_family.name for bus_family in known if bus_family.lays_out_messages)
        return f"the family {makers} is for a maker's own messages, laid out byte by byte; this one is not known yet"
    return None


def _bytes(key: str, value: Any) -> str | None:
    """Bytes as a list, with markers or with commas."""
    if isinstance(value, Seq):
        whole = 0 < len(value) <= 32 and all(isinstance(byte, int) and 0 <= byte < 256 for byte in value)
        return f"write `{key}: {' '.join(f'{byte:02X}' for byte in value)}`" if whole else None
    words = re.split(r"[\s,;:]+", value.strip()) if isinstance(value, str) and len(value) < 200 else []
    plain = [re.sub(r"^(0[xX]|\$)|[hH]$", "", word) for word in words]
    fine = plain and all(re.fullmatch(r"[0-9A-Fa-f]{1,2}", word) for word in plain)
    return f"write `{key}: {' '.join(word.upper().zfill(2) for word in plain)}`" if fine else None


def _words(_: str, value: Any) -> str | None:
    """A number of words where their order belongs."""
    return f"a count of words is `length: {value}`" if type(value) is int else None


def _keeps(_: str, value: Any) -> str | None:
    """The name of a command."""
    if not isinstance(value, str) or value.lower() in WORDS["keeps"] or not re.fullmatch("[a-z][a-z0-9_]*", value):
        return None
    return f"write no, yes or choice; the command that keeps what is written is named as `keep_with: {value}`"


def _group(_: str, value: Any) -> str | None:
    """The keys of a group under `group`."""
    name = value.get("name") if isinstance(value, Map) else None
    return f"write `group: {name}` and its other keys below, at the top" if isinstance(name, str) else None


def _values(_: str, value: Any) -> str | None:
    """The values of a variant as a list."""
    if isinstance(value, Seq) and 0 < len(value) <= 8 and all(isinstance(name, str | int) for name in value):
        return f"write `values: {{{', '.join(f'{name}: {{}}' for name in value)}}}`"
    return _names("values", value)


_MAKERS: Mapping[str, Callable[[str, Any], str | None]] = {
    "type": _type,
    **dict.fromkeys(("range", "range_in_units", "units", "pzd"), _interval),
    "bits": _bits,
    "bytes": _bytes,
    "unit": _unit,
    "when": _when,
    "printed": _printed,
    "line": _line,
    **dict.fromkeys(("index", "set"), _index),
    "sets": _sets,
    "digits": _digits,
    "special": _special,
    "scale": _scale,
    "rule": _rule,
    **dict.fromkeys(("enum", "flags"), _names),
    "values": _values,
    "steps": _steps,
    "decimals": _decimals,
    "default": _default,
    "source": _source,
    "at": _at,
    **dict.fromkeys(("functions", "exceptions", "responses"), _functions),
    "family": _family,
    "group": _group,
    "keeps": _keeps,
    "words": _words,
}
"""The function that makes the hint, by key; hints for single words come from `WORDS`."""
