"""Every point cites its section or page, and its line too where the document names the file of its text."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from fieldscribe.resolve.analysis import Analysis
    from fieldscribe.resolve.point_facts import PointFacts


@dataclass(frozen=True, slots=True)
class _Lacks:
    """A point that cites no section and no page, or, where `file` is given, no line of that file."""

    facts: PointFacts
    file: str | None


_SAID = {"source", "section", "page", "line"}


def check(analysis: Analysis) -> None:
    """Points without a source; where no point of a group has one, that is one finding about the group."""
    lacking: dict[int, list[_Lacks]] = {}
    members: dict[int, int] = {}
    documents = analysis.scope.documents
    for resolved in analysis.resolved:
        facts, source = resolved.facts, resolved.point.source
        members[id(facts.group)] = members.get(id(facts.group), 0) + 1
        document = documents.get(source.document)
        if document is None:
            analysis.scope.unknown("document", source.document, facts.span("source"), documents)
            continue
        cited = source.section is not None or source.page is not None
        if cited and (document.file is None or source.line is not None):
            continue
        if not _SAID & {*facts.failed, *_broken(facts)}:
            lacking.setdefault(id(facts.group), []).append(_Lacks(facts, document.file if cited else None))
    for key, lacks in lacking.items():
        if len(lacks) == members[key] > 1 and len({lack.file for lack in lacks}) == 1:
            _report_group(analysis, lacks[0])
        else:
            _report_points(analysis, lacks)


def _broken(facts: PointFacts) -> tuple[str, ...]:
    """The keys of group and source that were left out because of their shape: they have a finding already."""
    source = facts.get("source")
    return (*facts.group.broken, *(source.broken if isinstance(source, Map) else ()))


def _report_points(analysis: Analysis, lacks: list[_Lacks]) -> None:
    for lack in lacks:
        message, hint = (
            f"`{lack.facts.name}` cites no line of the manual's text",
            f"add `line: …`, its line in {lack.file}",
        )
        if lack.file is None:
            message = f"`{lack.facts.name}` cites no section and no page"
            hint = "give `source: {document: …, section: …}` for the group, or `section` for the point"
        analysis.report.error("missing-source", message, lack.facts.span(), hint)


def _report_group(analysis: Analysis, lack: _Lacks) -> None:
    group = lack.facts.group
    what, hint = "line of the manual's text", f"add `line: …` to each point: its line in {lack.file}"
    if lack.file is None:
        what, hint = "section and no page", "add `source: {document: …, section: …}` to the group"
    message = f"no point of the group `{group['group']}` cites a {what.replace(' and no', ' or a')}"
    analysis.report.error("missing-source", message, group.span("group"), hint)
