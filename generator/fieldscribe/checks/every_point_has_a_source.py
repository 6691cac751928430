"""Every point says where in the manual it stands: section or page, and the line where the manual's text is at hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.language.nodes import Map

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject
    from fieldscribe.resolve.drafts import Draft


def _broken(draft: Draft) -> tuple[str, ...]:
    """What had the wrong shape in the source itself."""
    source = draft.get("source")
    return source.broken if isinstance(source, Map) else ()


def check(subject: Subject) -> None:
    """Points without a source."""
    documents = subject.scope.documents
    for resolved in subject.resolved:
        source, draft = resolved.point.source, resolved.draft
        document = documents.get(source.document)
        if document is None:
            span = draft.span("source")
            subject.scope.unknown("document", source.document, span, documents)
        elif {"source", "section", "page", "line"} & {*draft.failed, *_broken(draft)}:
            continue
        elif source.section is None and source.page is None:
            hint = "give `source: {document: …, section: …}` for the group, or `section` for the point"
            subject.report.error("missing-source", f"`{draft.name}` cites no section and no page", draft.span(), hint)
        elif document.file is not None and source.line is None:
            hint = f"add `line: …`, its line in {document.file}"
            subject.report.error(
                "missing-source", f"`{draft.name}` cites no line of the manual's text", draft.span(), hint
            )
