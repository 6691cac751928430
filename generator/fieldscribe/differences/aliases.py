"""Keeps old names as deprecated aliases: writes `was: [old_name]` into the rows of renamed points."""

import os
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from fieldscribe.diagnostics import Report
from fieldscribe.differences.changes import Comparison
from fieldscribe.differences.described import Described
from fieldscribe.grouping import grouped
from fieldscribe.language.nodes import Map, Seq, SourceFile
from fieldscribe.pipeline import load_analysis
from fieldscribe.resolve.point_facts import PointFacts

_SCALAR = re.compile(r"\"[^\"\n]*\"|'[^'\n]*'|[A-Za-z0-9_]+")


class Edited(NamedTuple):
    """The old and the new texts of files, and messages for people."""

    files: Mapping[str, tuple[str, str]]
    messages: list[str]


class _Alias(NamedTuple):
    """An old name for a row of the description, and the points of the row, each with its old name."""

    row: Map
    old: str
    points: list[tuple[str, str]]


def with_aliases(comparison: Comparison) -> Edited:
    """Return the files of the new description with the old names of renamed points; this writes no file."""
    described = None if comparison.new is None else comparison.new.described
    if described is None:
        return Edited({}, [])
    aliases, by_hand = _aliases(comparison, described)
    kept, messages = _proven(described, aliases)
    lines = [f"{new}: the old name `{old}` stays as an alias" for alias in kept for new, old in alias.points]
    changed = {file: text for file, text in _texts(kept).items() if text != file.text}
    messages = lines + [_advice(*pair) for pair in by_hand] + messages
    return Edited({file.name: (file.text, text) for file, text in changed.items()}, messages)


def _advice(item: str, old: str) -> str:
    return f"{item}: write `was: [{old}]` by hand where its own facts stand"


def _aliases(comparison: Comparison, described: Described) -> tuple[list[_Alias], list[tuple[str, str]]]:
    """Return the old names by row, and the points whose old names cannot be written into their row."""
    aliases: dict[tuple[int, str], _Alias] = {}
    by_hand = []
    for difference in comparison.differences:
        if not difference.is_rename or difference.weight == "compatible" or len(difference.things) > 1:
            continue
        thing = difference.things[0]
        if thing.kind != "point" or thing.old is None or thing.new is None:
            continue
        written = described.written(thing.new)
        name, (before, _, after) = _plain(thing.old, written), written.called("\0").partition("\0")
        old = name.removeprefix(before).removesuffix(after)
        if written.called(old) != name:  # the record is used under another name
            by_hand.append((thing.new, name))
            continue
        alias = aliases.setdefault((id(written.row), old), _Alias(written.row, old, []))
        alias.points.append((thing.new, name))
    return list(aliases.values()), by_hand


def _plain(item: str, written: PointFacts) -> str:
    """Return the name of a point in generated code without its variant."""
    return item if written.variant is None else item.removesuffix(f"_{written.variant.value.lower()}")


def _proven(described: Described, aliases: list[_Alias]) -> tuple[list[_Alias], list[str]]:
    """Return the aliases that work in a copy of the description, and messages about the others."""
    left, messages = aliases, list[str]()
    while left:
        lost, finding = _lost(described, left)
        if finding:
            return [], [*messages, f"no alias was written: {finding}"]
        if not lost:
            return left, messages
        messages += [_advice(*pair) for pair in lost]
        left = [alias for alias in left if not set(lost) & set(alias.points)]
    return [], messages


def _lost(described: Described, aliases: list[_Alias]) -> tuple[list[tuple[str, str]], str]:
    """Return the points that do not get their old names in a copy, and the first finding that the aliases cause."""
    sources = _sources(described)
    texts = {file: file.text for file in sources} | dict(_texts(aliases))
    with TemporaryDirectory(prefix="fieldscribe-") as copy:
        for file, text in texts.items():
            Path(copy, os.path.basename(file.name)).write_bytes(text.encode("utf-8"))
        report = Report()
        analysis = load_analysis(Path(copy, os.path.basename(sources[0].name)), report, with_errors=True)
    before = {(finding.rule, finding.message) for finding in described.analysis.report.findings}
    new = next((each.message for each in report.findings if (each.rule, each.message) not in before), "")
    if analysis is None or new:
        return [], new or "the description could not be read again"
    known = {point.item: point.was for point in analysis.device.points}
    pairs = [pair for alias in aliases for pair in alias.points]
    return [(item, old) for item, old in pairs if old not in known.get(item, ())], ""


def _sources(described: Described) -> list[SourceFile]:
    """Return the files of a description, the one with the head first."""
    return list({id(node.file): node.file for node in described.analysis.scope.files}.values())


def _texts(aliases: Iterable[_Alias]) -> Mapping[SourceFile, str]:
    """Return the texts of the files with these aliases."""
    rows: dict[int, tuple[Map, list[str]]] = {}
    for alias in aliases:
        rows.setdefault(id(alias.row), (alias.row, []))[1].append(alias.old)
    edits = grouped((row.file, edit) for row, names in rows.values() if (edit := _edit(row, names)) is not None)
    return {file: _inserted(file.text, places) for file, places in edits.items()}


def _inserted(text: str, places: list[tuple[int, str]]) -> str:
    for offset, piece in sorted(places, reverse=True):
        text = text[:offset] + piece + text[offset:]
    return text


def _edit(row: Map, old_names: list[str]) -> tuple[int, str] | None:
    """Return the offset and the text of `was`; None if the row has no place for it."""
    was = row.get("was")
    if isinstance(was, Seq):
        return _into_list(row, was, old_names)
    return _behind_name(row, f"was: [{', '.join(old_names)}]") if "name" in row else None


def _behind_name(row: Map, key: str) -> tuple[int, str] | None:
    """Return the key on the line below the name, or after the name in braces."""
    text, column = row.file.text, row.key_span("name").column
    name = _SCALAR.match(text, row.file.offset(row.span("name").at))
    if name is None:
        return None
    if text[row.start] == "{":
        return name.end(), f", {key}"
    end, line = text.find("\n", name.end()), f"{' ' * (column - 1)}{key}{_ending(text)}"
    if end < 0:
        return len(text), f"{_ending(text)}{line}"
    return end + 1, line


def _into_list(row: Map, was: Seq, old_names: list[str]) -> tuple[int, str]:
    """Return the edit that adds old names to an existing list."""
    text, start = row.file.text, was.start
    if text[start] == "[":
        return start + 1, f"{', '.join(old_names)}{', ' if was else ''}"
    dash = text.rfind("-", 0, row.file.offset(was.span(0).at)) if was else start
    begin = text.rfind("\n", 0, dash) + 1
    return begin, "".join(f"{text[begin:dash]}- {old}{_ending(text)}" for old in old_names)


def _ending(text: str) -> str:
    """Return the line ending of a text."""
    return "\r\n" if "\r\n" in text else "\n"
