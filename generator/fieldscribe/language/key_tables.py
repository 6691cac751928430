"""Writes the table of keys as JSON Schema (draft 7) for editors, and as a page, descriptions/KEYS.md."""

import json
import re
from collections.abc import Iterator
from typing import Any

from fieldscribe.language.keys import forms, keys_of, needs, required
from fieldscribe.language.keys.places import BEHAVIOUR, DEVICE, PART, PLACES
from fieldscribe.language.load import flow_text
from fieldscribe.schema_types import BOOLEAN, NOTHING, Items, Key, Kind, Place, Text, ValueShape, Whole, says_yes_or_no

SCHEMA_ID = "https://fieldscribe.invalid/description-1.json"
_MARKUP = re.compile(r"[\\*_{}\[\]<>#]")
_REFERENCE = "#/definitions/"


def json_schema() -> dict[str, Any]:
    """Return the schema of a file: of device.yaml, of a part, or of a behaviour."""
    definitions = _Definitions()
    device, part, behaviour = (definitions.shape(place.shape) for place in (DEVICE, PART, BEHAVIOUR))
    return {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "$id": SCHEMA_ID,
        "description": "A device as its manual describes it, version 1 of the language.",
        "type": "object",
        "if": {"required": ["device"]},
        "then": device,
        "else": {"if": {"required": ["behaviour"]}, "then": behaviour, "else": part},
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

    def shape(self, shape: ValueShape) -> dict[str, Any]:
        """Return the schema of a shape, or a reference to it if the shape is a named place."""
        place = _place(shape)
        if place is None or not place.name:
            return self._written(shape)
        return self._named(place.name, shape)

    def _named(self, name: str, shape: ValueShape) -> dict[str, Any]:
        if name not in self.by_name:
            self.by_name[name] = {}  # reserves the position before inner definitions are added
            self.by_name[name] = self._written(shape)
        return {"$ref": _REFERENCE + name}

    def _written(self, shape: ValueShape) -> dict[str, Any]:
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


def _documentation(shape: ValueShape) -> dict[str, Any]:
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


def _place(shape: ValueShape) -> Place | None:
    """Return the place that this shape belongs to; None for any other shape."""
    return next((kind for kind in shape.kinds if isinstance(kind, Place) and kind.shape is shape), None)


_FEW = 2


def keys_markdown() -> str:
    """Return the page, with a table for each kind of mapping."""
    lines = ["# All keys of the description language", ""]
    lines += ["Made by `make keys` from the table of keys; `README.md` beside this page shows them at work.", ""]
    lines += ["Whole numbers are written as manuals write them: `4136`, `0x1028`, `1028h`, `H'33F`, `0b0101`.", ""]
    lines += ["`true` and `false` mean the same as `yes` and `no`.", ""]
    for place in PLACES:
        lines += [f"## {place.heading}", "", place.shape.meaning, ""]
        lines += ["| key | type | meaning | example |", "|---|---|---|---|"]
        lines += [f"| {' | '.join(row)} |" for row in _rows(place)]
        lines.append("")
    return "\n".join(lines)


def _rows(place: Place, prefix: str = "") -> Iterator[tuple[str, ...]]:
    """Yield the rows of the keys of a place, and of the keys inside of places that have no table."""
    for name, key in keys_of(place).items():
        if place not in key.places:
            continue  # the key of a place with its own table
        needed = " **Required.**" if place in key.required else ""
        yield f"`{prefix}{name}`", _type(key.shape), _meaning(key.shape) + needed, _example(key.shape)
        if len(key.places) <= _FEW or not _leads_to_a_table(key.shape):
            yield from _inside(key.shape, f"{prefix}{name}.")
    for form, shape in place.by_form.items():
        yield f"`{prefix}{form.sign}`", _type(shape), _meaning(shape), _example(shape)
        yield from _inside(shape, f"{prefix}{form.sign}.")


def _inside(shape: ValueShape, prefix: str) -> Iterator[tuple[str, ...]]:
    for kind in shape.kinds:
        if isinstance(kind, Place) and not kind.heading and forms.LANGUAGE not in kind.by_form:
            yield from _rows(kind, prefix)


def _leads_to_a_table(shape: ValueShape) -> bool:
    """Return True if the values inside have a table, so that their keys need not be repeated."""
    inner = [
        kind
        for outer in shape.kinds
        if isinstance(outer, Place)
        for inner in outer.by_form.values()
        for kind in inner.kinds
    ]
    return any(isinstance(kind, Place) and kind.heading for kind in inner)


def _meaning(shape: ValueShape) -> str:
    return shape.meaning.replace("|", "\\|")


def _type(shape: ValueShape) -> str:
    kinds = [kind for kind in shape.kinds if kind is not BOOLEAN or not says_yes_or_no(shape)]
    return ", ".join(map(_kind_in_words, kinds)) or "any"


def _kind_in_words(kind: Kind) -> str:
    if isinstance(kind, Text | Whole) and kind.choices:
        return ", ".join(f"`{choice}`" for choice in kind.choices)
    return "`~`" if kind is NOTHING else kind.words.removeprefix("a ")


def _example(shape: ValueShape) -> str:
    return f"`{flow_text(shape.examples[0])}`".replace("|", "\\|") if shape.examples else ""
