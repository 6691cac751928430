"""Holds a file against the JSON Schema, with positions and suggestions.

The schema is the one statement of the shape. This reads the part of draft 7 that it uses; a test holds the two against
`jsonschema` on every description and every bad input.
"""

from __future__ import annotations

import json
from decimal import Decimal
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fieldscribe.families import FAMILIES
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.shape_checks import (
    Check,
    ObjectCheck,
    any_value,
    array,
    by_type,
    compiled_pattern,
    number,
    string,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from fieldscribe.diagnostics import Report

_PYTHON_TYPES: Mapping[str, tuple[type, ...]] = {
    "object": (Map,),
    "array": (Seq,),
    "string": (str,),
    "integer": (int,),
    "number": (int, Decimal),
    "boolean": (bool,),
    "null": (type(None),),
}
_WORDS = {
    "object": "a mapping",
    "array": "a list",
    "string": "text",
    "integer": "a whole number",
    "number": "a number",
    "boolean": "true or false",
    "null": "~",
}
_KNOWN = frozenset(
    {"$ref", "type", "enum", "pattern", "maxLength", "minimum", "maximum", "properties", "patternProperties"}
    | {"additionalProperties", "required", "minProperties", "items", "minItems", "dependencies"}
    | {"description", "examples"}
)


@lru_cache(maxsize=1)
def schema() -> dict[str, Any]:
    """The JSON Schema of a description file."""
    loaded: dict[str, Any] = json.loads(Path(__file__).with_name("schema.json").read_bytes())
    loaded["definitions"]["device_file"]["properties"]["family"]["enum"] = list(FAMILIES)  # the registry decides
    return loaded


@lru_cache(maxsize=1)
def _checks() -> _Compiler:
    return _Compiler(schema()["definitions"])


def check_shape(value: Map, kind: str, report: Report) -> bool:
    """Whether the file has the shape of a definition (`device_file` or `part_file`); findings go to the report."""
    return _checks().definition(kind)(value, value, None, report)


class _Compiler:
    """Turns schema nodes into checks, each once."""

    def __init__(self, definitions: Mapping[str, Any]) -> None:
        self.definitions = definitions
        self.compiled: dict[str, Check] = {}

    def definition(self, name: str) -> Check:
        """The check of a definition; recursive definitions look themselves up when they run."""
        if name not in self.compiled:
            self.compiled[name] = self._later(name)
            self.compiled[name] = self.compile(self.definitions[name])
        return self.compiled[name]

    def _later(self, name: str) -> Check:
        """The check of a definition that is being compiled."""

        def check(value: Any, holder: Map | Seq, at: Any, report: Report) -> bool:
            return self.compiled[name](value, holder, at, report)

        return check

    def compile(self, node: Mapping[str, Any]) -> Check:
        """The check of one schema node."""
        unknown = node.keys() - _KNOWN
        if unknown:
            raise ValueError(f"the schema uses {sorted(unknown)}, which shape.py does not read")
        if "$ref" in node:
            return self.definition(node["$ref"].rpartition("/")[2])
        types = node.get("type", [])
        types = [types] if isinstance(types, str) else types
        checks: dict[type, Check] = {}
        for name in types:
            for python_type in _PYTHON_TYPES[name]:
                checks.setdefault(python_type, self._typed(name, node))
        wanted = " or ".join(_WORDS[name] for name in types if name != "integer" or "number" not in types)
        example = next(iter(node.get("examples", ())), None)
        return by_type(checks, wanted, example, node.get("pattern")) if types else any_value

    def _typed(self, name: str, node: Mapping[str, Any]) -> Check:
        if name == "object":
            return self._object(node)
        if name == "array":
            item = self.compile(node["items"]) if "items" in node else any_value
            return array(item, node.get("minItems", 0))
        if name == "string":
            choices = [one for one in node["enum"] if isinstance(one, str)] if "enum" in node else None
            return string(choices, node.get("pattern"), node.get("maxLength", 0))
        if name in ("integer", "number"):
            return number(node.get("enum"), node.get("minimum"), node.get("maximum"))
        return any_value

    def _object(self, node: Mapping[str, Any]) -> Check:
        more = node.get("additionalProperties", True)
        return ObjectCheck(
            {key: self.compile(value) for key, value in node.get("properties", {}).items()},
            [(key, compiled_pattern(key), self.compile(one)) for key, one in node.get("patternProperties", {}).items()],
            self.compile(more) if isinstance(more, dict) else (any_value if more else None),
            node,
        )
