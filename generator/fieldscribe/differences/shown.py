"""The values of an exported model for people."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.wording.exact import hex_text

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

_ADDRESSES = frozenset({"address", "number", "identifier"})


_NOTHING = {"order of words": "as usual", "range": "all that the type holds"}


def shown(fact: str, value: Any) -> str:
    """A value in one line; mostly `none` where there is nothing."""
    if value is None or value in ([], {}, ""):
        return _NOTHING.get(fact, "none")
    return _WORDS.get(fact, _plain)(value)


def _plain(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        return "; ".join(f"{key} {_plain(inner)}" for key, inner in value.items() if inner is not None)
    if isinstance(value, list):
        return ", ".join(map(_plain, value))
    return "none" if value is None else str(value)


def _number(value: Any) -> str:
    return f"{value} ({hex_text(value)})" if isinstance(value, int) and value > 9 else _plain(value)


def _ranges(ranges: Any) -> str:
    return " | ".join(f"{low}..{high}" if low != high else str(low) for low, high in ranges)


def _interval(ends: Any) -> str:
    return _ranges([ends])


def _bits(bits: Any) -> str:
    return str(bits[0]) if bits[0] == bits[1] else f"{bits[0]}..{bits[1]}"


def _raw(value: Any) -> str:
    return str(value) if isinstance(value, int) else _interval(value)


def _titles(titles: Any) -> str:
    if isinstance(titles, str):  # of a document, which is in one language
        return titles
    return "; ".join(f"{language}: {text}" for language, text in titles.items())


def _scale(cases: Any) -> str:
    return "; ".join(map(_case, cases))


def _case(case: Mapping[str, Any]) -> str:
    """One rule: `raw = value * 10 / 3 * factor + 5`."""
    rule = "raw = value"
    rule += "" if case["num"] == "1" else f" * {case['num']}"
    rule += "" if case["den"] == "1" else f" / {case['den']}"
    rule += "".join(map(_use, case["uses"]))
    rule += "" if case["offset"] == "0" else f" + {case['offset']}".replace("+ -", "- ")
    when = case["when"]
    return rule if when is None else f"when {when['point']} == {when['raw']}: {rule}"


def _use(use: Mapping[str, Any]) -> str:
    number = use["point"] if use["part"] == "value" else f"{use['point']}.raw"
    if "times" in use:
        number = f"({number} * {use['times']} + {use['plus']})"
    sign = use.get("power", use.get("ten_to"))
    return f" {'*' if sign == 1 else '/'} {'10 ** ' if 'ten_to' in use else ''}{number}"


def _condition(condition: Any) -> str:
    return " or ".join(
        " and ".join(f"{test['of']} {test['is']} {_plain(test['than'])}" for test in clause["all"])
        for clause in condition["any"]
    )


def _settings(serial: Mapping[str, Mapping[str, str]]) -> str:
    """Settings of a line: each text with the code that chooses it, if it has another."""
    texts = {
        setting: ", ".join(text if code == text else f"{code} {text}" for code, text in codes.items())
        for setting, codes in serial.items()
    }
    return "; ".join(f"{setting} {text}" for setting, text in texts.items())


_WORDS: Mapping[str, Callable[[Any], str]] = {
    **dict.fromkeys(_ADDRESSES, _number),
    "range": _ranges,
    "gaps": lambda gaps: "; ".join(f"{space} {_ranges(spans)}" for space, spans in gaps.items()),
    "units": _interval,
    "bits": _bits,
    "raw": _raw,
    "serial": _settings,
    "title": _titles,
    "note": _titles,
    "note of the bus": _titles,
    "scale": _scale,
    "when": _condition,
}
