"""Every point says where in the manual it stands: section or page, and the line where the manual's text is at hand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject
    from fieldscribe.resolve.drafts import Draft


@dataclass(frozen=True, slots=True)
class _Lacks:
    """A point that cites no section, or no line of that file."""

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
        elif not _SAID & {*draft.failed, *_broken(draft)}:
            if source.section is None and source.page is None:
                lacking.setdefault(id(draft.group), []).append(_Lacks(draft, None))
            elif document.file is not None and source.line is None:
                lacking.setdefault(id(draft.group), []).append(_Lacks(draft, document.file))
    for key, found in lacking.items():
        if len(found) == members[key] > 1 and len({one.file for one in found}) == 1:
            _tell_of_all(subject, found[0])
        else:
            _tell_of_each(subject, found)


def _broken(draft: Draft) -> tuple[str, ...]:
    """The keys of the group and of the source that had the wrong shape, and so a finding of their own."""
    source = draft.get("source")
    return (*draft.group.broken, *(source.broken if isinstance(source, Map) else ()))


def _tell_of_each(subject: Subject, found: list[_Lacks]) -> None:
    for one in found:
        message, hint = (
            f"`{one.draft.name}` cites no line of the manual's text",
            f"add `line: …`, its line in {one.file}",
        )
        if one.file is None:
            message = f"`{one.draft.name}` cites no section and no page"
            hint = "give `source: {document: …, section: …}` for the group, or `section` for the point"
        subject.report.error("missing-source", message, one.draft.span(), hint)


def _tell_of_all(subject: Subject, one: _Lacks) -> None:
    group = one.draft.group
    what, hint = "line of the manual's text", f"add `line: …` to each point: its line in {one.file}"
    if one.file is None:
        what, hint = "section and no page", "add `source: {document: …, section: …}` to the group"
    message = f"no point of the group `{group['group']}` cites a {what.replace(' and no', ' or a')}"
    subject.report.error("missing-source", message, group.span("group"), hint)
