"""Writes the table of keys as JSON Schema (draft 7) for editors: the output of `fieldscribe schema`."""

from __future__ import annotations

import json
import re
from typing import Any

from fieldscribe.language.keys import forms, keys_of, needs, required
from fieldscribe.language.keys.places import DEVICE, PART
from fieldscribe.language.load import flow_text
from fieldscribe.schema_types import BOOLEAN, NOTHING, Items, Key, Kind, Place, Shape, Text, Whole

SCHEMA_ID = "https://fieldscribe.invalid/description-1.json"
_MARKUP = re.compile(r"[\\*_{}\[\]<>#]")
_REFERENCE = "#/definitions/"


def json_schema() -> dict[str, Any]:
    """Return the schema of a file: of device.yaml, or of a part."""
    definitions = _Definitions()
    device, part = (definitions.shape(place.shape) for place in (DEVICE, PART))
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "$id": SCHEMA_ID,
        "description": "A device as its manual describes it, version 1 of the language.",
        "type": "object",
        "if": {"required": ["device"]},
        "then": device,
        "else": part,
        "definitions": definitions.by_name,
    }


def schema_text() -> str:
    """Return the schema as text, in lines, so that a diff shows what changed."""
    return json.dumps(json_schema(), ensure_ascii=False, indent=1) + "\n"


class _Definitions:
    """Builds schemas and the definitions that they share: named places, and values of keys with several places."""

    def __init__(self) -> None:
        self.by_name: dict[str, Any] = {}

    def key(self, key: Key) -> dict[str, Any]:
        """Return the schema of the value of a key, or a reference to it."""
        place = _place(key.shape)
        if len(key.places) == 1 or (place is not None and place.name):
            return self.shape(key.shape)
        return self._named(f"at_{key.name}", key.shape)

    def shape(self, shape: Shape) -> dict[str, Any]:
        """Return the schema of a shape, or a reference to it if the shape is a named place."""
        place = _place(shape)
        if place is None or not place.name:
            return self._written(shape)
        return self._named(place.name, shape)

    def _named(self, name: str, shape: Shape) -> dict[str, Any]:
        if name not in self.by_name:
            self.by_name[name] = {}  # reserves the position before inner definitions are added
            self.by_name[name] = self._written(shape)
        return {"$ref": _REFERENCE + name}

    def _written(self, shape: Shape) -> dict[str, Any]:
        if not shape.kinds:
            return {}
        types: list[str] = []
        keywords: dict[str, Any] = {}
        for kind in shape.kinds:
            types.append(kind.schema_type)
            keywords |= self._kind(kind)
        if "enum" in keywords:
            keywords["enum"] += [True, False] if BOOLEAN in shape.kinds else []
            keywords["enum"] += [None] if NOTHING in shape.kinds else []
        if "integer" in types and "string" not in types:
            types.append("string")
            keywords = _in_every_notation(keywords)
        return {**_documentation(shape), "type": types[0] if len(types) == 1 else types, **keywords}

    def _kind(self, kind: Kind) -> dict[str, Any]:
        if isinstance(kind, Place):
            return self._mapping(kind)
        if isinstance(kind, Items):
            return {"items": self.shape(kind.item), **({"minItems": kind.least} if kind.least else {})}
        if isinstance(kind, Text):
            form = {} if kind.form is None else {"pattern": kind.form.pattern}
            return _not_empty(maxLength=kind.longest, enum=list(kind.choices)) | form
        if isinstance(kind, Whole):
            bounds = {"minimum": kind.least, "maximum": kind.greatest}
            return _not_empty(enum=list(kind.choices)) | {
                word: bound for word, bound in bounds.items() if bound is not None
            }
        return {}

    def _mapping(self, place: Place) -> dict[str, Any]:
        keys = keys_of(place)
        by_pattern = {form.pattern: self.shape(shape) for form, shape in place.by_form.items() if form is not forms.ANY}
        other = place.by_form.get(forms.ANY)
        return {
            **_not_empty(properties={name: self.key(key) for name, key in keys.items()}, patternProperties=by_pattern),
            "additionalProperties": False if other is None else self.shape(other),
            **_not_empty(required=list(required(place)), minProperties=place.least, dependencies=needs(place)),
        }


def _documentation(shape: Shape) -> dict[str, Any]:
    """Return what editors show: the meaning, and examples.

    Editors also offer `examples` as values, but only those without keys. The others are shown below the meaning, as
    YAML.
    """
    examples = [example for example in shape.examples if not _holds_keys(example)]
    blocks = [_block(example) for example in shape.examples if _holds_keys(example)]
    marked = bool(blocks) or "`" in shape.meaning
    markdown = "\n\n".join([_markdown(shape.meaning), *(f"```yaml\n{block}\n```" for block in blocks)])
    return _not_empty(description=shape.meaning, markdownDescription=markdown if marked else "", examples=examples)


def _holds_keys(example: Any) -> bool:
    return isinstance(example, dict) or (isinstance(example, list) and any(map(_holds_keys, example)))


def _block(example: Any) -> str:
    if isinstance(example, dict):
        return "\n".join(f"{key}: {flow_text(value)}" for key, value in example.items())
    return "\n".join(f"- {flow_text(item)}" for item in example)


def _markdown(text: str) -> str:
    """Return the text for Markdown: code stays, other markup is escaped."""
    parts = text.split("`")
    parts[::2] = [_MARKUP.sub(r"\\\g<0>", part) for part in parts[::2]]
    return "`".join(parts)


def _in_every_notation(keywords: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of a whole number with its notations that YAML takes for text, such as 1028h."""
    if "enum" not in keywords:
        return keywords | {"pattern": forms.WHOLE.pattern}
    choices = keywords.pop("enum")
    return keywords | {"anyOf": [{"enum": choices}, {"type": "string", "pattern": forms.WHOLE.pattern}]}


def _not_empty(**words: Any) -> dict[str, Any]:
    """Return the keywords whose values are not empty."""
    return {word: value for word, value in words.items() if value}


def _place(shape: Shape) -> Place | None:
    """Return the place that this shape belongs to; None for any other shape."""
    return next((kind for kind in shape.kinds if isinstance(kind, Place) and kind.shape is shape), None)
