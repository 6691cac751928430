"""The table of all keys, as Markdown, from the schema: what descriptions/KEYS.md holds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fieldscribe.language.hints import BITS_KEY, ELEMENT_KEY, NAME, NUMBER_KEY, ONE_KEY
from fieldscribe.language.shape import schema

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_TITLES = {
    "device_file": "device.yaml",
    "part_file": "A part",
    "group": "A group",
    "point": "A point",
    "set": "A point in a further set, under `sets`",
    "element": "A point in one element of an array, under `each`",
    "variant_facts": "A point in a variant, under `variants`",
    "member": "A member of a record, under `members`",
    "format": "A format, under `formats`",
    "at": "An address by rule, under `at`",
    "fixed": "Fixed bits, under `fixed`",
    "digits": "Decimal digits, under `digits`",
    "record": "A record, under `records`",
    "scale_case": "A case of a scale",
    "entry": "An entry of an enum, or a special code",
    "flag": "A flag",
    "printed": "What is printed twice, under `printed`",
    "source": "A source",
    "lines": "Where single facts stand, under `lines`",
    "looked_through": "Lines that hold nothing, under `looked_through`",
    "bus": "The bus",
    "code_entry": "A function, a response or an exception",
    "telegram": "A telegram",
    "message": "A message",
    "command": "A command",
    "frame": "A frame",
    "erratum": "An erratum",
}
_FORMS = {
    NAME: "<name>",
    NUMBER_KEY: "<number>",
    "^[a-z]{2}$": "<language>",
    "^x-": "x-<anything>",
    BITS_KEY: "<number or high..low>",
    ONE_KEY: "<set>",
    ELEMENT_KEY: "<index>",
    "^[a-z][a-z0-9_]*=[A-Za-z0-9_]+$": "<axis=value>",
    "^[A-Za-z0-9]+(_[A-Za-z0-9]+)*$": "<value>",
}
_TYPES = {"object": "mapping", "array": "list", "string": "text", "integer": "whole number", "null": "`~`"}


def keys_markdown() -> str:
    """The page, in the order of the schema: one table for each kind of mapping."""
    definitions = schema()["definitions"]
    lines = ["# All keys of the description language", ""]
    lines += [
        "Made from `generator/fieldscribe/language/schema.json`; `README.md` beside this page shows them at work.",
        "",
    ]
    for name, title in _TITLES.items():
        lines += [f"## {title}", "", definitions[name]["description"], ""]
        lines += ["| key | type | meaning | example |", "|---|---|---|---|"]
        lines += [f"| {' | '.join(row)} |" for row in _rows(definitions[name], definitions)]
        lines.append("")
    return "\n".join(lines)


def _rows(node: Mapping[str, Any], definitions: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, ...]]:
    """The keys of a mapping; of mappings without a table of their own also what is inside."""
    required = node.get("required", ())
    keys = dict(node.get("properties", {}))
    keys |= {_FORMS[key]: value for key, value in node.get("patternProperties", {}).items()}
    if isinstance(node.get("additionalProperties"), dict):
        keys["<any>"] = node["additionalProperties"]
    for key, value in keys.items():
        reference = value.get("$ref", "").rpartition("/")[2]
        meant = definitions[reference] if reference else value
        if not meant:
            yield f"`{prefix}{key}`", "any", "Yours: nothing reads it.", ""
            continue
        needed = " **Required.**" if key in required else ""
        yield f"`{prefix}{key}`", _type(meant), meant["description"].replace("|", "\\|") + needed, _example(meant)
        if not reference:
            yield from _rows(meant, definitions, f"{prefix}{key}.")


def _type(node: Mapping[str, Any]) -> str:
    if "enum" in node:
        return ", ".join("`~`" if one is None else f"`{one}`" for one in node["enum"])
    types = node.get("type", [])
    named = [_TYPES.get(one, one) for one in ([types] if isinstance(types, str) else types)]
    return ", ".join(one for one in named if one != "whole number" or "number" not in named)


def _example(node: Mapping[str, Any]) -> str:
    examples = node.get("examples", ())
    return f"`{shown(examples[0])}`".replace("|", "\\|") if examples else ""


def shown(value: Any) -> str:
    """An example as it stands in YAML."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {shown(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(shown, value)) + "]"
    return str(value).lower() if isinstance(value, bool) else "~" if value is None else str(value)
