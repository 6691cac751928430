"""`fieldscribe audit --old`: what a new edition of a manual means for a description, and taking it over."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import Namespace

    from fieldscribe.audit.editions import Citations, Comparison, Edition
    from fieldscribe.model import Document
    from fieldscribe.resolve.subject import Subject


def run(arguments: Namespace) -> int:
    """Compare both editions; with --renumber and --accept, write. The exit code."""
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import StopError

    if arguments.format == "html":
        raise StopError("the report of two editions has no HTML form", "use --report text or json")
    outcome, citations, subject, document = _compared(arguments)
    written: list[str] = []
    if arguments.renumber:
        written.append(_renumber(subject, document, citations))
        outcome, citations, subject, document = _compared(arguments)
    refused = _refusal(outcome, citations, subject, document) if arguments.accept else None
    if arguments.accept and refused is None:
        written.append(_accept(subject, document, _sha256(arguments)))
    _report(arguments, outcome, written, refused)
    return FINE if outcome.explained and refused is None else FINDINGS


def _compared(arguments: Namespace) -> tuple[Comparison, Citations, Subject, Document]:
    from fieldscribe.audit.editions import compare
    from fieldscribe.cli.audit import manual_of, opened, text_of

    subject = opened(arguments)
    path, document = manual_of(subject, arguments.manual)
    old_path, _ = manual_of(subject, arguments.old)
    old, new = (_edition(*text_of(place), document) for place in (old_path, path))
    return *compare(subject, old, new), subject, document


def _edition(name: str, text: str, digest: str, document: Document) -> Edition:
    from fieldscribe.audit.editions import Edition

    return Edition(name, text, None if document.sha256 is None else digest == document.sha256)


def _sha256(arguments: Namespace) -> str:
    from fieldscribe.cli.audit import manual_of, opened, text_of

    return text_of(manual_of(opened(arguments), arguments.manual)[0])[2]


def _renumber(subject: Subject, document: Document, citations: Citations) -> str:
    """Write the lines of the new edition; what was done. Raises StopError."""
    from fieldscribe.audit.editions import renumber
    from fieldscribe.cli import FINDINGS
    from fieldscribe.cli.common import StopError
    from fieldscribe.cli.rewriting import rewrite

    result = renumber(subject.scope.files, document.id, citations)
    if result.hindrances:
        more = f"; and {len(result.hindrances) - 1} more" if len(result.hindrances) > 1 else ""
        raise StopError(f"not renumbered: {result.hindrances[0]}{more}", "nothing was changed", FINDINGS)
    before = {file.file.name: file.file.text for file in subject.scope.files}
    rewrite({name: (before[name], text) for name, text in result.texts.items()})
    by_hand = "".join(f"\n  {note}" for note in result.by_hand)
    return f"renumbered: {_counted(result.count, 'line')} in {_counted(len(result.texts), 'file')}{by_hand}"


def _refusal(outcome: Comparison, citations: Citations, subject: Subject, document: Document) -> str | None:
    """Why the new edition cannot be accepted; None if it can."""
    from fieldscribe.audit.editions import renumber

    if not outcome.explained:
        return "not everything in the new edition is explained"
    left = renumber(subject.scope.files, document.id, citations)
    if left.count or left.hindrances:
        return f"{_counted(left.count, 'cited line')} count the old edition: --renumber comes first"
    if document.sha256 is None:
        return f"documents.{document.id} records no text: add `sha256: <checksum>` there"
    return None


def _accept(subject: Subject, document: Document, digest: str) -> str:
    """Record the digest of the new edition; what was done. Raises StopError."""
    from fieldscribe.cli.rewriting import rewrite

    source = subject.scope.header.file
    said = subject.scope.header["documents"][document.id]
    at = source.offset(said.span("sha256").at)
    old = str(said["sha256"])
    start = source.text.index(old, at)
    rewrite({source.name: (source.text, source.text[:start] + digest + source.text[start + len(old) :])})
    return f"accepted: {source.name}:{said.span('sha256').line} records the new edition"


def _report(arguments: Namespace, outcome: Comparison, written: list[str], refused: str | None) -> None:
    from fieldscribe.audit.editions.report import as_lines, figures
    from fieldscribe.cli.common import print_json
    from fieldscribe.cli.terminal import print_lines
    from fieldscribe.report import visible

    if arguments.format == "json":
        print_json({**outcome.as_data(), "written": written, "refused": refused})
        return
    taken_over = written and refused is None and outcome.explained
    print_lines(figures(outcome) if taken_over else as_lines(outcome, everything=arguments.all))
    print_lines([[("", visible(line))] for note in written for line in note.splitlines()])
    if refused is not None:
        print_lines([[("error", "not accepted"), ("", visible(f": {refused}"))]])


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
