"""Holds a file against the JSON Schema, with positions and suggestions.

The schema is the one statement of the shape. This reads the part of draft 7 that it uses; a test holds the two against
`jsonschema` on every description and every bad input.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from decimal import Decimal
from functools import lru_cache
from pathlib import Path
from typing import Any

from fieldscribe.diagnostics import Report, Span
from fieldscribe.language.load import Map, Seq

Check = Callable[[Any, Span, Report], bool]
"""Value, its place and the report: whether the value has the shape; broken keys and items are dropped from their parent."""

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
    """$ref type enum pattern maxLength minimum maximum properties patternProperties additionalProperties required minProperties items
    minItems if then else definitions description examples title $schema $id""".split()
)


@lru_cache(maxsize=1)
def schema() -> dict[str, Any]:
    """The JSON Schema of a description file."""
    loaded: dict[str, Any] = json.loads(Path(__file__).with_name("schema.json").read_bytes())
    return loaded


@lru_cache(maxsize=1)
def _checks() -> _Compiler:
    return _Compiler(schema()["definitions"])


def check_shape(value: Map, kind: str, report: Report) -> bool:
    """Whether the file has the shape of the definition `kind` (`device_file` or `part_file`); findings go to the report."""
    return _checks().definition(kind)(value, value.span(), report)


class _Compiler:
    """Turns schema nodes into checks, each once."""

    def __init__(self, definitions: Mapping[str, Any]) -> None:
        self.definitions = definitions
        self.compiled: dict[str, Check] = {}

    def definition(self, name: str) -> Check:
        """The check of a definition; recursive definitions look themselves up when they run."""
        if name not in self.compiled:
            self.compiled[name] = lambda value, span, report: self.compiled[name](value, span, report)
            self.compiled[name] = self.compile(self.definitions[name])
        return self.compiled[name]

    def compile(self, node: Mapping[str, Any]) -> Check:
        """The check of one schema node."""
        unknown = node.keys() - _KNOWN
        if unknown:
            raise ValueError(f"the schema uses {sorted(unknown)}, which shape.py does not read")
        if "$ref" in node:
            return self.definition(node["$ref"].rpartition("/")[2])
        types = node.get("type", [])
        types = [types] if isinstance(types, str) else types
        by_type: dict[type, Check] = {}
        for name in types:
            for python_type in _PYTHON_TYPES[name]:
                by_type.setdefault(python_type, self._typed(name, node))
        wanted = " or ".join(_WORDS[name] for name in types)
        return _any if not types else _by_type(by_type, wanted)

    def _typed(self, name: str, node: Mapping[str, Any]) -> Check:
        if name == "object":
            return self._object(node)
        if name == "array":
            item = self.compile(node["items"]) if "items" in node else _any
            return _array(item, node.get("minItems", 0))
        if name == "string":
            return _string(node.get("enum"), node.get("pattern"), node.get("maxLength", 0))
        if name in ("integer", "number"):
            return _number(node.get("enum"), node.get("minimum"), node.get("maximum"))
        return _any

    def _object(self, node: Mapping[str, Any]) -> Check:
        properties = {key: self.compile(value) for key, value in node.get("properties", {}).items()}
        patterns = [(re.compile(key), self.compile(value)) for key, value in node.get("patternProperties", {}).items()]
        more = node.get("additionalProperties", True)
        additional = self.compile(more) if isinstance(more, dict) else (_any if more else None)
        return _object(properties, patterns, additional, tuple(node.get("required", ())), node.get("minProperties", 0))


def _any(value: Any, span: Span, report: Report) -> bool:
    return True


def _by_type(by_type: Mapping[type, Check], wanted: str) -> Check:
    def check(value: Any, span: Span, report: Report) -> bool:
        found = by_type.get(type(value))
        if found is not None:
            return found(value, span, report)
        report.error("wrong-type", f"{_shown(value)} stands where {wanted} belongs", span, _type_hint(value, by_type))
        return False

    return check


def _shown(value: Any) -> str:
    if isinstance(value, Map | Seq):
        return "a mapping" if isinstance(value, Map) else "a list"
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return f"`{str(value).lower()}` (true or false)"
    kind = "text" if isinstance(value, str) else "number"
    return f"the {kind} `{str(value)[:60]}`"


def _type_hint(value: Any, by_type: Mapping[type, Check]) -> str:
    if str in by_type and isinstance(value, int | Decimal | bool):
        return f'quote it: "{value}"'
    if isinstance(value, str) and (int in by_type or Decimal in by_type) and re.fullmatch(r"[-+]?[0-9]+,[0-9]+", value):
        return f"write a decimal point: {value.replace(',', '.')}"
    return "see the key in descriptions/KEYS.md"


def _string(choices: list[str] | None, pattern: str | None, longest: int) -> Check:
    compiled = re.compile(pattern) if pattern else None

    def check(value: str, span: Span, report: Report) -> bool:
        if choices is not None and value not in choices:
            report.error(
                "wrong-choice", f"`{value[:60]}` is none of {', '.join(choices)}", span, _nearest(value, choices)
            )
            return False
        if longest and len(value) > longest:
            report.error(
                "text-too-long",
                f"the text has {len(value)} characters, at most {longest} are allowed",
                span,
                "shorten it",
            )
            return False
        if compiled is not None and not compiled.search(value):
            report.error(
                "wrong-form",
                f"`{value[:60]}` does not have the form {compiled.pattern}",
                span,
                _form_hint(value, compiled.pattern),
            )
            return False
        return True

    return check


def _form_hint(value: str, pattern: str) -> str:
    if pattern.startswith("^[a-z][a-z0-9]*"):
        suggestion = re.sub(r"[^a-z0-9]+", "_", value.lower()).strip("_")
        return f"names are snake_case: `{suggestion[:60] or 'a_name'}`"
    return "see the key in descriptions/KEYS.md"


def _number(choices: list[int] | None, least: int | None, greatest: int | None) -> Check:
    def check(value: int | Decimal, span: Span, report: Report) -> bool:
        if choices is not None and value not in choices:
            report.error(
                "wrong-choice", f"{value} is none of {', '.join(map(str, choices))}", span, f"write {choices[-1]}"
            )
            return False
        if (least is not None and value < least) or (greatest is not None and value > greatest):
            bounds = f"at least {least}" if greatest is None else f"{least} to {greatest}"
            report.error("wrong-choice", f"{value} is out of bounds: {bounds}", span, "correct the number")
            return False
        return True

    return check


def _array(item: Check, least: int) -> Check:
    def check(value: Seq, span: Span, report: Report) -> bool:
        if len(value) < least:
            report.error("too-few", "the list is empty", span, "fill it or leave the key out")
            return False
        broken = [index for index, one in enumerate(value) if not item(one, value.span(index), report)]
        for index in reversed(broken):
            del value[index], value.item_at[index]
        return True

    return check


def _object(
    properties: Mapping[str, Check],
    patterns: list[tuple[re.Pattern[str], Check]],
    additional: Check | None,
    required: tuple[str, ...],
    least: int,
) -> Check:
    def key_check(key: str) -> Check | None:
        for pattern, found in patterns:
            if pattern.search(key):
                return found
        return additional

    def check(value: Map, span: Span, report: Report) -> bool:
        broken = []
        for key, one in value.items():
            found = properties.get(key) or key_check(key)
            if found is None:
                report.error(
                    "unknown-key",
                    f"the key `{key[:60]}` is not known here",
                    value.key_span(key),
                    _nearest(key, sorted(properties)),
                )
                broken.append(key)
            elif not found(one, value.span(key), report):
                broken.append(key)
        missing = [key for key in required if key not in value]
        for key in missing:
            report.error("missing-key", f"the key `{key}` is missing", span, f"add `{key}: …`")
        if len(value) < least:
            report.error("too-few", "the mapping is empty", span, "fill it or leave the key out")
        for key in broken:
            del value[key]
        return not any(key in required for key in broken) and not missing and len(value) >= least

    return check


def _nearest(word: str, known: list[str]) -> str:
    import difflib

    near = difflib.get_close_matches(word, known, 1, 0.6)
    if near:
        return f"did you mean `{near[0]}`?"
    if word == "<<":
        return "merge keys are not part of YAML 1.2: write the keys out or use `formats`"
    return "known here: " + ", ".join(known[:40]) if known else "remove it"
