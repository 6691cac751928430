"""Reads an exported model from a file and holds it against `schema.json`: strangers may have written it."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fieldscribe.facts.devices import FORMAT
from fieldscribe.families import FAMILIES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

_LONGEST = 1000
"""The most digits of a number that is text."""


class ContractError(ValueError):
    """No exported model: what is wrong, and what to do about it."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.hint = message, hint


def model_from(data: bytes) -> Mapping[str, Any]:
    """The exported model that these bytes are. Raises ContractError."""
    try:
        model = json.loads(data, parse_constant=_no_number)
    except RecursionError:
        raise ContractError("the JSON is nested too deep") from None
    except ValueError as error:
        raise ContractError(f"it is no JSON: {str(error)[:120]}") from None
    hint = "write it with `fieldscribe export json DEVICE`"
    if not isinstance(model, dict) or not {"format", "device"} <= model.keys():
        raise ContractError("it is no exported model", hint)
    if model["format"] != FORMAT:
        raise ContractError(f"its format is not {FORMAT}, the one of this fieldscribe", f"{hint} of this version")
    wrong = next(_wrong(model, _schema(), ()), None)
    if wrong is not None:
        where = ".".join(str(part)[:60] for part in wrong)
        raise ContractError(f"it does not follow the contract at `{where}`", hint)
    if model["family"] not in FAMILIES:
        raise ContractError(f"there is no family `{str(model['family'])[:60]}`", f"known: {', '.join(FAMILIES)}")
    return model


def _no_number(text: str) -> None:
    raise ValueError(f"{text} is no number of JSON")


@cache
def _schema() -> Mapping[str, Any]:
    schema: Mapping[str, Any] = json.loads(Path(__file__).with_name("schema.json").read_text("utf-8"))
    return schema


Way = tuple[str | int, ...]


def _wrong(value: Any, shape: Mapping[str, Any], way: Way) -> Iterator[Way]:
    """The ways to all that breaks the schema; only words that `schema.json` uses are known."""
    if "$ref" in shape:
        yield from _wrong(value, _schema()["$defs"][shape["$ref"].rpartition("/")[2]], way)
        return
    ways = shape.get("anyOf") or shape.get("oneOf")
    if ways is not None and all(next(_wrong(value, other, way), None) is not None for other in ways):
        yield way
    if any(not _TESTS[word](value, said) for word, said in shape.items() if word in _TESTS):
        yield way
    elif isinstance(value, dict):
        yield from _wrong_in_object(value, shape, way)
    elif isinstance(value, list) and "items" in shape:
        for place, item in enumerate(value):
            yield from _wrong(item, shape["items"], (*way, place))


def _wrong_in_object(value: Mapping[str, Any], shape: Mapping[str, Any], way: Way) -> Iterator[Way]:
    known, others = shape.get("properties", {}), shape.get("additionalProperties", {})
    names = shape.get("propertyNames", {})
    for key, inner in value.items():
        if next(_wrong(key, names, way), None) is not None or (key not in known and others is False):
            yield (*way, key)
        else:
            yield from _wrong(inner, known.get(key, others), (*way, key))


def _is_of_type(value: Any, said: str | list[str]) -> bool:
    kinds = {
        "string": isinstance(value, str),
        "integer": isinstance(value, int) and not isinstance(value, bool),
        "boolean": isinstance(value, bool),
        "object": isinstance(value, dict),
        "array": isinstance(value, list),
        "null": value is None,
    }
    return any(kinds[kind] for kind in ([said] if isinstance(said, str) else said))


def _matches(value: Any, pattern: str) -> bool:
    if not isinstance(value, str):
        return True
    return (len(value) <= _LONGEST or "[0-9]" not in pattern) and re.search(pattern, value) is not None


_TESTS: Mapping[str, Callable[[Any, Any], bool]] = {
    "type": _is_of_type,
    "const": lambda value, said: value == said,
    "enum": lambda value, said: value in said,
    "pattern": _matches,
    "minimum": lambda value, said: not isinstance(value, int) or value >= said,
    "maximum": lambda value, said: not isinstance(value, int) or value <= said,
    "minItems": lambda value, said: not isinstance(value, list) or len(value) >= said,
    "minLength": lambda value, said: not isinstance(value, str) or len(value) >= said,
    "maxItems": lambda value, said: not isinstance(value, list) or len(value) <= said,
    "required": lambda value, said: not isinstance(value, dict) or value.keys() >= set(said),
}
