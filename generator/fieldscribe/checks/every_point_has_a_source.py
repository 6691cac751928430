"""Every point cites its section or page, and its line too where the document names the file of its text."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from fieldscribe.resolve.drafts import Draft
    from fieldscribe.resolve.subject import Subject


@dataclass(frozen=True, slots=True)
class _Lacks:
    """A point that cites no section and no page, or, where `file` is given, no line of that file."""

    draft: Draft
    file: str | None


_SAID = {"source", "section", "page", "line"}


def check(subject: Subject) -> None:
    """Points without a source; where no point of a group has one, that is one finding about the group."""
    lacking: dict[int, list[_Lacks]] = {}
    members: dict[int, int] = {}
    documents = subject.scope.documents
    for resolved in subject.resolved:
        draft, source = resolved.draft, resolved.point.source
        members[id(draft.group)] = members.get(id(draft.group), 0) + 1
        document = documents.get(source.document)
        if document is None:
            subject.scope.unknown("document", source.document, draft.span("source"), documents)
            continue
        cited = source.section is not None or source.page is not None
        if cited and (document.file is None or source.line is not None):
            continue
        if not _SAID & {*draft.failed, *_broken(draft)}:
            lacking.setdefault(id(draft.group), []).append(_Lacks(draft, document.file if cited else None))
    for key, lacks in lacking.items():
        if len(lacks) == members[key] > 1 and len({lack.file for lack in lacks}) == 1:
            _report_group(subject, lacks[0])
        else:
            _report_points(subject, lacks)


def _broken(draft: Draft) -> tuple[str, ...]:
    """The keys of group and source that were left out because of their shape: they have a finding already."""
    source = draft.get("source")
    return (*draft.group.broken, *(source.broken if isinstance(source, Map) else ()))


def _report_points(subject: Subject, lacks: list[_Lacks]) -> None:
    for lack in lacks:
        message, hint = (
            f"`{lack.draft.name}` cites no line of the manual's text",
            f"add `line: …`, its line in {lack.file}",
        )
        if lack.file is None:
            message = f"`{lack.draft.name}` cites no section and no page"
            hint = "give `source: {document: …, section: …}` for the group, or `section` for the point"
        subject.report.error("missing-source", message, lack.draft.span(), hint)


def _report_group(subject: Subject, lack: _Lacks) -> None:
    group = lack.draft.group
    what, hint = "line of the manual's text", f"add `line: …` to each point: its line in {lack.file}"
    if lack.file is None:
        what, hint = "section and no page", "add `source: {document: …, section: …}` to the group"
    message = f"no point of the group `{group['group']}` cites a {what.replace(' and no', ' or a')}"
    subject.report.error("missing-source", message, group.span("group"), hint)
