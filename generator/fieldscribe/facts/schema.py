"""JSON Schemas of the values of facts."""

from collections.abc import Mapping
from typing import Any, TypeAlias

Schema: TypeAlias = Mapping[str, Any]
"""A JSON Schema."""

BOOLEAN: Schema = {"type": "boolean"}
INTEGER: Schema = {"type": "integer"}
COUNT: Schema = {"type": "integer", "minimum": 1}
ADDRESS: Schema = {"type": "integer", "minimum": 0}
STRING: Schema = {"type": "string"}
TITLES: Schema = {"type": "object", "$ref": "#/$defs/titles"}
DIRECTION: Schema = {"type": "string", "enum": ["request", "response", "cyclic"]}
_BY_NUMBER: Schema = {"propertyNames": {"pattern": "^-?[0-9]+$"}}
_CONSTANT: Schema = {"type": ["integer", "string"]}
_FRACTION = "^-?[0-9]+(/[0-9]+)?$"


def ref(name: str) -> Schema:
    """Return the schema of that name among the definitions."""
    return {"$ref": f"#/$defs/{name}"}


def one_of(*values: str | int) -> Schema:
    """Return the schema of one of these texts or numbers."""
    return {"type": "string" if isinstance(values[0], str) else "integer", "enum": list(values)}


def null_or(schema: Schema) -> Schema:
    """Return a schema that also allows null."""
    if "type" not in schema or schema["type"] == "object":
        return {"anyOf": [schema, {"type": "null"}]}
    values = {"enum": [*schema["enum"], None]} if "enum" in schema else {}
    return {**schema, "type": [schema["type"], "null"], **values}


TEXT_OR_NULL: Schema = null_or(STRING)
INTEGER_OR_NULL: Schema = null_or(INTEGER)


def list_of(schema: Schema, least: int = 0, most: int | None = None) -> Schema:
    """Return the schema of a list."""
    ends = {"minItems": least, "maxItems": most}
    return {"type": "array", "items": schema, **{word: end for word, end in ends.items() if end}}


TEXTS: Schema = list_of(STRING)


def map_of(schema: Schema) -> Schema:
    """Return the schema of an object with any keys."""
    return {"type": "object", "additionalProperties": schema}


def by_number(schema: Schema) -> Schema:
    """Return the schema of an object whose keys are numbers as decimal text."""
    return {**map_of(schema), **_BY_NUMBER}


def record(*properties: tuple[str, str, Schema]) -> Schema:
    """Return the schema of an object with exactly these keys, each with its description and its schema."""
    described = {key: {"description": description, **schema} for key, description, schema in properties}
    return {"type": "object", "properties": described, "required": list(described), "additionalProperties": False}


def _uses() -> list[Schema]:
    point = "point", "The point that the factor is read from.", STRING
    number = [("part", "Which number of the point: the raw number, or the value.", one_of("raw", "value"))]
    linear = [
        ("part", "The raw number.", one_of("raw")),
        ("times", "The factor of the raw number.", INTEGER),
        ("plus", "The number added to the product.", INTEGER),
    ]
    sign = "1: multiply raw by it; -1: divide.", one_of(1, -1)
    return [record(point, *part, (kind, *sign)) for part in (number, linear) for kind in ("power", "ten_to")]


_NUMBER_OF_ROLE = (
    "Of a constant the byte; of unit, address and raw the distance from bit 0; of a word twice its place in the frame, "
    "plus 1 for its low byte; of xor a mask of the combined bytes."
)

_SCALE_CONDITION = record(
    ("point", "The point that decides.", STRING), ("raw", "The raw number that it must have.", INTEGER)
)

DEFINITIONS: Mapping[str, Schema] = {
    "titles": {"description": "Text for people by language code; `en` is always there.", **map_of(STRING)},
    "integer_text": {"description": "An integer as decimal text.", **STRING, "pattern": "^-?[0-9]+$"},
    "fraction_text": {
        "description": "An exact integer or fraction as text: `5`, `5/2`.",
        **STRING,
        "pattern": _FRACTION,
    },
    "number_text": {
        "description": "An exact number as text: `5`, `0.1`, or `7/3` if the decimals never end.",
        **STRING,
        "pattern": r"^-?[0-9]+(\.[0-9]+|/[0-9]+)?$",
    },
    "bits": {
        "description": "The highest and the lowest bit, both included; bit 0 is the lowest.",
        **list_of({**ADDRESS, "maximum": 63}, 2, 2),
    },
    "source": {
        "description": "The place of a fact in the manual.",
        **record(
            ("document", "The id of the document.", STRING),
            ("section", "The section, as printed.", null_or(STRING)),
            ("page", "The page, as printed.", null_or(STRING)),
            ("line", "The line of the manual's text.", null_or(ADDRESS)),
        ),
    },
    "place": {
        "description": "Where a point is, for one purpose.",
        **record(
            ("for", "The purpose: `read`, `write`, `ram` (written, but not kept), ...", STRING),
            ("space", "The space in which the address counts.", STRING),
            ("address", "The lowest address, which a request names.", null_or(ADDRESS)),
            ("function", "The function to use; null for the usual one of the space.", null_or(INTEGER)),
        ),
    },
    "scale_case": {
        "description": "raw = value * num / den * (the factors of `uses`) + offset.",
        **record(
            ("when", "When this case holds; null for always.", null_or(_SCALE_CONDITION)),
            ("num", "The numerator.", ref("integer_text")),
            ("den", "The denominator.", ref("integer_text")),
            ("offset", "What is added to raw, after the factors.", ref("fraction_text")),
            ("uses", "Factors read from other points at run time.", list_of(ref("use"))),
        ),
    },
    "use": {
        "description": "A run-time factor on the raw side: the number of a point, or `raw * times + plus`; `power` "
        "takes that number itself, `ten_to` takes ten to that number.",
        "oneOf": _uses(),
    },
    "range_end": {
        "description": "The end of a range: a raw number; for f32 and f64 a value as text; or an expression in the raw "
        "numbers of other points (`max(5, start_frequency.raw)`, `4000 if upper_limit.raw == 0 else upper_limit.raw`) "
        "in exact arithmetic, rounded to the nearest raw number, halves away from zero.",
        "anyOf": [INTEGER, {**STRING, "minLength": 1}],
    },
    "condition": {
        "description": "The point exists if all comparisons of one of these are true.",
        **record(("any", "One of these.", list_of(record(("all", "All of these.", list_of(ref("comparison"), 1))), 1))),
    },
    "comparison": {
        "description": "A variant axis or a point against constants.",
        **record(
            (
                "of",
                "The variant axis, compared with names of its values; or the point, compared by its raw number.",
                STRING,
            ),
            ("is", "How they are compared; `in` takes a list.", one_of("==", "!=", "<", "<=", ">", ">=", "in")),
            (
                "than",
                "The constant, or for `in` all of them.",
                {"anyOf": [_CONSTANT, {"type": "array", "minItems": 1, "items": _CONSTANT}]},
            ),
        ),
    },
    "role": {
        "description": "What a byte of a message holds.",
        **record(
            ("holds", "The kind of byte.", one_of("constant", "unit", "address", "raw", "multiplexer", "word", "xor")),
            ("number", _NUMBER_OF_ROLE, ADDRESS),
        ),
    },
}
