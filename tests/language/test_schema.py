"""The JSON Schema, and that our own reading of it agrees with jsonschema's on everything we have."""

from __future__ import annotations

import json
import random
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from textwrap import indent
from typing import Any

import pytest
from fieldscribe.cli import main
from fieldscribe.diagnostics import Diagnostic, Report
from fieldscribe.families.modbus.frames import crc16
from fieldscribe.language.key_tables import json_schema, keys_markdown, schema_text
from fieldscribe.language.keys import TABLE, keys_of
from fieldscribe.language.keys.places import BEHAVIOUR, DEVICE, PART
from fieldscribe.language.load import load
from fieldscribe.language.nodes import Map, Seq, SourceFile, Value, read_source
from fieldscribe.language.shape import check_of, check_shape, compiled_pattern
from jsonschema import Draft7Validator, validators
from support.descriptions_as_values import WHOLES, as_yaml, changed, nodes
from support.places import ROOT

SCHEMA = json_schema()
GLOSSARY = ROOT / "descriptions/glossary.yaml"
FILES = sorted(
    file
    for folder in ("descriptions", "tests/devices", "tests/bad")
    for file in (ROOT / folder).rglob("*.yaml")
    if file != GLOSSARY
)


def _matches(_: Any, pattern: str, value: Any, __: Any) -> Iterator[Any]:
    """`pattern` as ECMAScript means it: Python's own `$` also matches before a last line break."""
    from jsonschema.exceptions import ValidationError

    if isinstance(value, str) and not compiled_pattern(pattern).search(value):
        yield ValidationError(f"{value!r} does not match {pattern!r}")


def _number_only(_: Any, value: Any) -> bool:
    """A whole number: stricter than JSON Schema, which takes 1.0 for one."""
    return isinstance(value, int) and not isinstance(value, bool)


_extend: Any = validators.extend
STRICT = _extend(
    Draft7Validator,
    validators={"pattern": _matches},
    type_checker=Draft7Validator.TYPE_CHECKER.redefine("integer", _number_only),
)


def plain(value: Value) -> Any:
    """What jsonschema reads."""
    if isinstance(value, Map):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, Seq):
        return [plain(one) for one in value]
    return float(value) if isinstance(value, Decimal) else value


def agree(root: Map) -> bool:
    """Whether the file is valid; the two readings must say the same."""
    document = plain(root)
    validator = STRICT(SCHEMA)
    errors = [error.message for error in validator.iter_errors(document)]
    report = Report()
    place = DEVICE if "device" in root else BEHAVIOUR if "behaviour" in root else PART
    check_shape(root, place, report)
    assert bool(report.findings) == bool(errors), (errors[:3], report.findings[:3])
    return not errors


def test_the_schema_is_valid() -> None:
    """By the rules of draft 7."""
    Draft7Validator.check_schema(SCHEMA)


def _properties(node: Any, path: str = "") -> Iterator[tuple[str, Mapping[str, Any]]]:
    """All schemas of keys, with their path."""
    if not isinstance(node, dict):
        return
    for word in ("properties", "patternProperties"):
        for key, value in node.get(word, {}).items():
            if isinstance(value, dict) and value:
                yield f"{path}/{key}", value
    for key, value in node.items():
        yield from _properties(value, f"{path}/{key}")


def read_block(block: str) -> list[Any]:
    """The value of an example in YAML, a mapping or a list."""
    (root,) = load(SourceFile("example.yaml", "held:\n" + indent(block, "  ")), Report())
    assert root is not None
    return [root["held"]]


def test_every_key_is_explained_and_shown() -> None:
    """Editors show the description and an example at every key, and the example is valid there."""
    definitions = SCHEMA["definitions"]
    checked = 0
    everything = [*_properties(SCHEMA), *definitions.items()]
    for path, node in everything:
        meant = definitions[node["$ref"].rpartition("/")[2]] if "$ref" in node else node
        assert meant["description"][0].isupper(), path
        blocks = re.findall("```yaml\n(.*?)```", meant.get("markdownDescription", ""), re.DOTALL)
        examples = meant.get("examples", []) + [plain(value) for block in blocks for value in read_block(block)]
        assert examples, path
        validator = STRICT({**meant, "definitions": definitions})
        for example in examples:
            problems = [error.message for error in validator.iter_errors(example)]
            missing = [one for one in problems if "is a required property" not in one]
            assert not missing, (path, missing)
            checked += 1
    assert checked > 200


def test_both_readings_agree() -> None:
    """On every bad case that is YAML at all; the real devices and the test devices have the right shape, too."""
    for file in FILES:
        report, is_bad = Report(), "bad" in file.parts
        source = read_source(file, report)
        assert source is not None or is_bad, file
        for root in load(source, report) if source is not None else ():
            is_right = root is not None and not report.has_errors and agree(root)
            assert is_right or is_bad, file


@pytest.mark.parametrize("seed", [1, *(pytest.param(seed, marks=pytest.mark.full) for seed in range(2, 13))])
def test_both_readings_agree_on_mutations(seed: int) -> None:
    """Wrong values at random places of the devices that use everything."""
    dice = random.Random(seed)
    places = [(device, path) for device in WHOLES for path in sorted(nodes(device), key=str) if len(path) > 2]
    scalars: list[Any] = [None, True, 5, 5.5, -1, 10**6, "", "a b", "x\n", ...]
    wrongs = [*scalars, [], {}, ["a"], {"name": "a"}, {"en": "a"}, {"0": "a"}]
    valid = 0
    for _ in range(100):
        start, path = dice.choice(places)
        device = changed(start, path, dice.choice(wrongs))
        (root,) = load(SourceFile("mutated.yaml", as_yaml(device[path[0]][path[1]])), Report())
        assert root is not None
        valid += agree(root)
    assert 2 < valid < 85


def test_keys_page_and_schema_are_current() -> None:
    """descriptions/KEYS.md and the schema beside it are what the table of keys says; `make keys` makes them anew."""
    assert (ROOT / "descriptions/KEYS.md").read_text("utf-8") == keys_markdown()
    assert (ROOT / "descriptions/schema.json").read_text("utf-8") == schema_text()
    assert json.loads(schema_text()) == SCHEMA


def test_an_entry_takes_no_other_ones_place() -> None:
    """A key has one entry for each place where it stands, and what it needs beside it stands somewhere with it."""
    seen = [(place, key.name) for key in TABLE for place in key.places]
    assert len(seen) == len(set(seen))
    for key in TABLE:
        assert {*key.required, *key.inherited} <= {*key.places}, key.name
        assert all(any(needed in keys_of(place) for place in key.places) for needed in key.needs), key.name


def test_schema_command(capsys: pytest.CaptureFixture[str]) -> None:
    """It prints the schema, or the page."""
    assert main(["schema"]) == 0
    assert json.loads(capsys.readouterr().out) == SCHEMA
    assert main(["schema", "--page"]) == 0
    assert capsys.readouterr().out == keys_markdown()


def test_patterns_end_at_the_very_end() -> None:
    """A name cannot carry a line break at its end into generated code."""
    assert compiled_pattern("^[a-z]+$").search("abc")
    assert not compiled_pattern("^[a-z]+$").search("abc\n")
    assert re.search("^[a-z]+$", "abc\n"), "what Python alone would say"


def test_frames_in_examples_have_their_own_checksum() -> None:
    """An example is copied: it is the right frame, not the misprint of a manual."""
    texts = set(re.findall(r"\b[0-9A-F]{2}(?: [0-9A-F]{2}){7}\b", keys_markdown()))
    assert texts == {"05 06 10 28 01 F4 0C 91"}
    assert crc16(bytes.fromhex("05 06 10 28 01 F4")).to_bytes(2, "little") == bytes.fromhex("0C 91")


def test_findings_do_not_depend_on_what_was_met_before() -> None:
    """Checks are made for the keys that are met, and used again: a file has the findings of the first file of a run."""

    def findings_of(source: SourceFile) -> tuple[Diagnostic, ...]:
        report = Report()
        for root in load(source, Report()):
            if root is not None:
                check_shape(root, DEVICE if "device" in root else PART, report)
        return report.findings

    files = sorted((ROOT / "tests" / "bad").glob("*.yaml"))
    sources = [source for file in files if (source := read_source(file, Report())) is not None]
    in_turn = [findings_of(source) for source in sources]
    for source, findings in zip(sources, in_turn, strict=True):
        check_of.cache_clear()
        assert findings_of(source) == findings, source.name
