"""Every point cites its section or page, and its line too if the document has a text file."""

from fieldscribe.language.nodes import Map
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.point_facts import PointFacts

_KEYS = {"source", "section", "page", "line"}


def check(analysis: Analysis) -> None:
    """Report points without a source; if a whole group lacks the same, report the group once."""
    lacking: dict[int, list[tuple[PointFacts, str | None]]] = {}
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
        if not _KEYS & {*facts.failed, *_broken(facts)}:
            lacking.setdefault(id(facts.group), []).append((facts, document.file if cited else None))
    for key, lacks in lacking.items():
        if len(lacks) == members[key] > 1 and len({file for _, file in lacks}) == 1:
            _report_group(analysis, lacks[0][0].group, lacks[0][1])
        else:
            for facts, file in lacks:
                _report_point(analysis, facts, file)


def _broken(facts: PointFacts) -> tuple[str, ...]:
    """Return the keys of group and source that were left out because of an earlier finding."""
    source = facts.get("source")
    return (*facts.group.broken, *(source.broken if isinstance(source, Map) else ()))


def _report_point(analysis: Analysis, facts: PointFacts, file: str | None) -> None:
    """Report a point that cites no section and no page, or, with a `file`, no line of it."""
    message, hint = f"`{facts.name}` cites no line of the manual's text", f"add `line: …`, its line in {file}"
    if file is None:
        message = f"`{facts.name}` cites no section and no page"
        hint = "give `source: {document: …, section: …}` for the group, or `section` for the point"
    analysis.report.error("missing-source", message, facts.span(), hint)


def _report_group(analysis: Analysis, group: Map, file: str | None) -> None:
    what, hint = "line of the manual's text", f"add `line: …` to each point: its line in {file}"
    if file is None:
        what, hint = "section or a page", "add `source: {document: …, section: …}` to the group"
    message = f"no point of the group `{group['group']}` cites a {what}"
    analysis.report.error("missing-source", message, group.span("group"), hint)
