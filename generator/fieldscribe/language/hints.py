"""What the findings about a file's shape say: what stands there, what belongs there, what may have been meant."""

from __future__ import annotations

import re
from decimal import Decimal
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from fieldscribe.language.meant_keys import meant_key
from fieldscribe.language.nodes import Map, Seq

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

KEYS_PAGE = "see the key in descriptions/KEYS.md"
_MOST_COMPARED = 500
_LONGEST_COMPARED = 80
_TYPING_SLIP = 0.7
"""How alike keys must be: below that `precision` would be taken for `section`."""
_WHOLE = "(0x[0-9A-Fa-f]{1,16}|[0-9A-Fa-f]{1,16}[hH]|[Hh]'[0-9A-Fa-f]{1,16}|0b[01]{1,64}|[0-9]{1,5})"

NAME = "^[a-z][a-z0-9]*(_[a-z0-9]+)*$"
NUMBER_KEY = "^([-+0-9]|[A-Fa-f][0-9A-Fa-f]*[hH](\\.\\.|$)|[Hh]').*$"
BITS_KEY = f"^{_WHOLE}(\\.\\.{_WHOLE})?$"
ONE_KEY = f"^{_WHOLE}$"
ELEMENT_KEY = f"^{_WHOLE}(/{_WHOLE})?$"

_FORMS = {
    NAME: ("a name in snake_case", "names are English words such as `base_frequency`: a to z, digits, single _"),
    NUMBER_KEY: ("a number", "keys here are numbers such as 3, -1, 1Fh or 0x1F"),
    BITS_KEY: ("a number, or two", "bits and bytes are numbers: 3; several bits have the high one first: 5..4"),
    ONE_KEY: ("the number of a set", "keys here are the numbers of the further sets, from 2 on"),
    ELEMENT_KEY: ("an element", "keys here are indices (sets where there are none), or set/index: 0, 3, 2/1"),
    "^[0-9]{1,9}(\\.\\.[0-9]{1,9})?$": ("a line or lines", "lines are written 780, several lines 780..790"),
    "^[a-z]{2}$": ("a language", "languages have two letters: en, de, fr"),
    "^x-": ("a private key", "keys of your own start with x-"),
    "^[0-9]+\\.[0-9]+\\.[0-9]+$": ("a version", "write three numbers: 1.0.0"),
    "^[0-9A-Fa-f\\s]+$": ("bytes in hexadecimal", "write two digits for each byte: 05 06 10 28"),
    "^[0-9a-f]{64}$": ("a SHA-256 checksum", "64 hexadecimal digits in small letters, as sha256sum prints them"),
    "^(high|low) first$": ("an order of words", "write `high first` or `low first`"),
    "^[A-Za-z0-9]+(_[A-Za-z0-9]+)*$": ("the name of a variant", "letters, digits and single _: 400V, model_b"),
    "^[a-z][a-z0-9_]*=[A-Za-z0-9_]+$": ("a variant", "keys here are written axis=value, such as voltage_class=400V"),
    "^[a-z][a-z0-9_]*$": ("an id", "ids are written a to z, digits and _"),
    "^[A-Za-z0-9][A-Za-z0-9_.-]*\\.ya?ml$": (
        "the name of a part",
        "parts stand beside device.yaml and end with .yaml; a part has no folder in its name",
    ),
}
"""What the patterns of the schema mean, in words."""

_GERMAN = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue", "ß": "ss"})


def quoted(text: str) -> str:
    """A stranger's text as messages repeat it: short."""
    return f"`{text}`" if len(text) <= 60 else f"`{text[:57]}…`"


def shown(value: Any) -> str:
    """What stands there, in words."""
    if isinstance(value, Map | Seq):
        return "a mapping" if isinstance(value, Map) else "a list"
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return f"`{str(value).lower()}` (true or false)"
    return f"the {'text' if isinstance(value, str) else 'number'} {quoted(str(value))}"


def type_hint(value: Any, accepted: Collection[type], example: Any, pattern: str | None) -> str:
    """What to do about a value of the wrong type."""
    if value is None:
        return "fill it in, or leave the key out"
    said = None
    if isinstance(value, int | Decimal):
        said = _about_number(value, accepted, example, pattern)
    elif isinstance(value, str) and (int in accepted or Decimal in accepted):
        said = _number_hint(value, Decimal in accepted)
    elif bool in accepted:
        said = "write true or false"
    if said is None and Seq in accepted and not isinstance(value, Map):
        said = f"write a list: [{value}]" if len(str(value)) < 40 else "write a list: […]"
    return said or (f"for example {_example(example)}" if example is not None else KEYS_PAGE)


def _about_number(value: int | Decimal, accepted: Collection[type], example: Any, pattern: str | None) -> str | None:
    """What to do about a number, or true or false, where something else belongs."""
    if int in accepted and isinstance(value, Decimal | bool):
        return _whole_hint(value, example)
    typed = str(value).lower() if isinstance(value, bool) else str(value)
    if pattern is not None and not re.search(pattern, typed):
        return form_hint(typed, pattern)
    if isinstance(example, str) and "wire" in example:
        return f"write a formula: {example}"
    if isinstance(value, bool) and isinstance(example, str) and " " in example:
        return f"for example {example}"
    if str in accepted:
        return f'quote it: "{typed}"'
    return None


def _whole_hint(value: Decimal | bool, example: Any) -> str:
    digits, power = str(value).partition("E")[::2]
    if power and "." not in digits:
        return f"write {digits}E{power.lstrip('+')}h if hexadecimal is meant, the digits in full if not"
    return f"for example {_example(example)}" if isinstance(value, bool) else "write it without a decimal point"


def _number_hint(value: str, fractions: bool) -> str:
    if re.fullmatch(r"[-+]?[0-9]+,[0-9]+", value) and fractions:
        return f"write a decimal point: {value.replace(',', '.')}"
    if re.fullmatch(r"[-+]?[0-9]{1,18}", value):
        return f"leave out the quotes: {value}"
    return "write a plain decimal number"


def _example(example: Any) -> str:
    if isinstance(example, dict):
        return "{" + ", ".join(f"{key}: {_example(one)}" for key, one in example.items()) + "}"
    if isinstance(example, list):
        return "[" + ", ".join(map(_example, example)) + "]"
    return {True: "true", False: "false"}.get(example, str(example)) if isinstance(example, bool) else str(example)


def form(pattern: str) -> str:
    """What a text of this pattern is, in words."""
    return _FORMS[pattern][0] if pattern in _FORMS else f"of the form {pattern}"


def form_hint(value: str, pattern: str) -> str:
    """How a text of this pattern is written."""
    hint = _FORMS[pattern][1] if pattern in _FORMS else KEYS_PAGE
    if pattern != NAME:
        return hint
    import unicodedata

    spelled = value[:60].translate(_GERMAN)
    plain = unicodedata.normalize("NFKD", spelled).encode("ascii", "ignore").decode()
    suggestion = re.sub(r"[^a-z0-9]+", "_", re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", plain).lower()).strip("_")
    if value[:1].isdigit():
        return "a name starts with a letter: `speed_2`, not `2nd_speed`"
    return f"write `{suggestion}`" if re.fullmatch(NAME, suggestion) else hint


def named_otherwise(key: str, patterns: Collection[str]) -> str | None:
    """A key of bits or of a language that is only written in another way; None if it is not."""
    from fieldscribe.language.meant import bits_meant
    from fieldscribe.language.meant_words import LANGUAGES

    if BITS_KEY in patterns:
        return bits_meant(key)
    return LANGUAGES.get(key.lower()) if "^[a-z]{2}$" in patterns else None


def key_hint(key: str, known: Collection[str], patterns: Iterable[str], value: Any = None) -> str:
    """What an unknown key with that value may have meant."""
    if key == "<<":
        return "merge keys are not part of YAML 1.2: write the keys out, or share them under `formats`"
    meant = meant_key(key, value, known)
    if meant is not None:
        return meant
    forms = [pattern for pattern in patterns if pattern != "^x-"]
    named = named_otherwise(key, forms)
    if named is not None:
        return f"write `{named}`"
    near = nearest(key, tuple(known), _TYPING_SLIP)
    if near is not None:
        return f"did you mean `{near}`?"
    said = [form_hint(key, pattern) for pattern in forms]
    if known:
        said.append("known here: " + ", ".join(sorted(known)))
    return "; ".join(said) or "remove it"


@lru_cache(maxsize=4096)
def nearest(word: str, known: tuple[str, ...], likeness: float = 0.6) -> str | None:
    """The known word that is most like this one, or None."""
    import difflib

    if len(word) > _LONGEST_COMPARED:
        return None
    by_folded = {one.lower(): one for one in reversed(known[:_MOST_COMPARED])}
    near = difflib.get_close_matches(word.lower(), by_folded, 1, likeness)
    return by_folded[near[0]] if near else None
