"""Recording a new edition of a document: its checksum, file and edition."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from fieldscribe.audit.renumbering import scalars_in
from fieldscribe.language.load import as_yaml
from fieldscribe.language.nodes import Map

LONGEST = {"file": 200, "edition": 80}
"""What is recorded of a document beside its checksum, with the most characters of each."""


def hindrances(document: str, recorded: Map, given: Mapping[str, str], name: str, sha256: str) -> Iterator[str]:
    """Yield why the text of this name and checksum cannot be recorded with what is given: nothing is guessed."""
    if "sha256" not in recorded:
        yield f"documents.{document} records no text: add `sha256: {sha256}` there"
    yield from (f"documents.{document} has no `{key}`: add it there" for key in given if key not in recorded)
    if recorded.get("sha256") == sha256:
        return
    was = recorded.get("file", name)
    if was != name and "file" not in given:
        ways = f"give --file {name}, or --file {was} if it takes that name"
        yield f"documents.{document}.file is `{was}`, the new text is `{name}`: {ways}"
    if "edition" in recorded and "edition" not in given:
        yield f"documents.{document}.edition is `{recorded['edition']}`: give --edition and what the new manual prints"


def with_recorded(recorded: Map, facts: Mapping[str, str]) -> str | None:
    """Return the text of the file with these facts of a document; None if one of them is an alias there."""
    text = recorded.file.text
    scalars = list(scalars_in(text))
    changes: list[tuple[int, int, str]] = []
    for key, value in facts.items():
        at = recorded.file.offset(recorded.span(key).at)
        ends = next((ends for ends in scalars if ends[0] <= at < ends[1]), None)
        if ends is None:
            return None
        if recorded[key] != value:
            changes.append((*ends, as_yaml(value)))
    for start, end, written in sorted(changes, reverse=True):
        text = text[:start] + written + text[end:]
    return text
