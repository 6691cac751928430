"""Texts for findings about the shape of a file: how a value is named, and what to write instead."""

import re
from collections.abc import Collection, Iterable
from decimal import Decimal
from functools import lru_cache
from typing import Any

from fieldscribe.language.keys import forms, keys_of
from fieldscribe.language.keys.places import DEVICE, GROUP
from fieldscribe.language.load import flow_text
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.suggestions import LANGUAGES, key_suggestion, suggest_bits
from fieldscribe.schema_types import Form, Text, ValueShape
from fieldscribe.text import ascii_text

KEYS_PAGE = "see the key in descriptions/KEYS.md"
_GROUP = "a group is a part: `group: …`, `space: …` and `points: […]`, below a line `---` or in a file under `parts`"
_MOST_COMPARED = 500
_LONGEST_COMPARED = 80
_TYPING_SLIP = 0.7
"""How similar keys must be; at 0.6 `precision` would be taken for `section`."""


def quoted(text: str) -> str:
    """Return a text from a description in backquotes, shortened; blanks stay, because they may be the mistake."""
    return f"`{text}`" if len(text) <= 60 else f"`{text[:57]}…`"


def value_text(value: Any) -> str:
    """Return a value from a description in words."""
    if isinstance(value, Map | Seq):
        return "a mapping" if isinstance(value, Map) else "a list"
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return f"`{str(value).lower()}` (true or false)"
    return f"the {'text' if isinstance(value, str) else 'number'} {quoted(str(value))}"


def type_hint(value: Any, accepted: Collection[type], shape: ValueShape) -> str:
    """Return the hint for a value whose type is not one of the accepted types of its shape."""
    example = next(iter(shape.examples), None)
    if value is None:
        return "fill it in, or leave the key out"
    hint = None
    if isinstance(value, int | Decimal):
        form = next((kind.form for kind in shape.kinds if isinstance(kind, Text)), None)
        choices = next((kind.choices for kind in shape.kinds if isinstance(kind, Text)), ())
        one_of = f"write one of {', '.join(choices)}" if choices and not isinstance(value, bool) else None
        hint = one_of or _about_number(value, accepted, example, form)
    elif isinstance(value, str) and (int in accepted or Decimal in accepted):
        hint = _number_hint(value, Decimal in accepted)
    elif bool in accepted:
        hint = "write yes or no"
    if hint is None and Seq in accepted and not isinstance(value, Map):
        hint = f"write a list: [{value}]" if len(str(value)) < 40 else "write a list: […]"
    return hint or (f"for example {flow_text(example)}" if example is not None else KEYS_PAGE)


def _about_number(value: int | Decimal, accepted: Collection[type], example: Any, form: Form | None) -> str | None:
    """Return the hint for a number, true or false where something else belongs."""
    if int in accepted and isinstance(value, Decimal | bool):
        return _whole_hint(value, example)
    typed = str(value).lower()
    if form is not None and not re.search(form.pattern, typed):
        return form_hint(typed, form)
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
    return f"for example {flow_text(example)}" if isinstance(value, bool) else "write it without a decimal point"


def _number_hint(value: str, fractions: bool) -> str:
    if re.fullmatch(r"[-+]?[0-9]+,[0-9]+", value) and fractions:
        return f"write a decimal point: {value.replace(',', '.')}"
    if re.fullmatch(r"[-+]?[0-9]{1,18}", value):
        return f"leave out the quotes: {value}"
    return "write a plain decimal number" if fractions else forms.WHOLE.hint


def form_hint(value: str, form: Form) -> str:
    """Return how a text of this form is written."""
    if form is not forms.NAME:
        return form.hint
    parted = re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", ascii_text(value[:60]))
    suggestion = re.sub(r"[^a-z0-9]+", "_", parted.lower()).strip("_")
    if value[:1].isdigit():
        return "a name starts with a letter: `speed_2`, not `2nd_speed`"
    return f"write `{suggestion}`" if re.fullmatch(form.pattern, suggestion) else form.hint


def key_hint(key: str, known: Collection[str], written: Iterable[Form], value: Any = None) -> str:
    """Return the hint for an unknown key with this value."""
    if key == "<<":
        return "merge keys are not part of YAML 1.2: write the keys out, or share them under `formats`"
    if "documents" in known and (key == "groups" or key in keys_of(GROUP)):
        return _GROUP
    if "bits" in known and "name" in known and key in keys_of(GROUP):
        return f"write `{key}` at the group, above its `points`"
    if "group" in known and key in keys_of(DEVICE):
        return "this key belongs in the head of device.yaml, its first document"
    suggestion = key_suggestion(key, value, known)
    return _spelling_hint(key, known, written) if suggestion is None else suggestion


def _spelling_hint(key: str, known: Collection[str], written: Iterable[Form]) -> str:
    """Return the hint for a key that is misspelled or not known at all."""
    written = [form for form in written if form is not forms.PRIVATE]
    language = LANGUAGES.get(key.lower()) if forms.LANGUAGE in written else None
    if named := suggest_bits(key) if forms.BITS in written else language:
        return f"write `{named}`"
    near = nearest(key, tuple(known), _TYPING_SLIP)
    if near is not None:
        return f"did you mean `{near}`?"
    hints = [form_hint(key, form) for form in written]
    if known:
        hints.append("known here: " + ", ".join(sorted(known)))
    return "; ".join(hints) or "remove it"


@lru_cache(maxsize=4096)
def nearest(word: str, known: tuple[str, ...], likeness: float = 0.6) -> str | None:
    """Return the known word that is most similar to this one, or None."""
    import difflib

    if len(word) > _LONGEST_COMPARED:
        return None
    by_folded = {candidate.lower(): candidate for candidate in reversed(known[:_MOST_COMPARED])}
    near = difflib.get_close_matches(word.lower(), by_folded, 1, likeness)
    return by_folded[near[0]] if near else None
