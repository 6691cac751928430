"""`fieldscribe audit --old`: what a new edition of a manual means for a description, and taking it over."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from argparse import Namespace

    from fieldscribe.audit.editions import Citations, Comparison, Edition
    from fieldscribe.model import Document
    from fieldscribe.resolve.analysis import Analysis

_MOST_OPEN: Final = 5
"""So many findings of the new text alone are shown when it is accepted."""


def run(arguments: Namespace) -> int:
    """Compare both editions; with --renumber and --accept, write. The exit code."""
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import StopError

    if arguments.format == "html":
        raise StopError("the report of two editions has no HTML form", "use --report text or json")
    outcome, citations, subject, document = _compared(arguments)
    written: list[str] = []
    left_open: list[str] = []
    refused = _refusal(arguments, outcome, subject, document) if arguments.accept else None
    if arguments.renumber and refused is None:
        written.append(_renumber(subject, document, citations))
        outcome, citations, subject, document = _compared(arguments)
    if arguments.accept and refused is None:
        refused = _left(citations, subject, document)
    if arguments.accept and refused is None:
        left_open = _not_clean(arguments, subject)
        written += [_accept(arguments, subject, document), *left_open]
    _report(arguments, outcome, written, refused)
    return FINE if outcome.settled and refused is None and not left_open else FINDINGS


def _compared(arguments: Namespace) -> tuple[Comparison, Citations, Analysis, Document]:
    from fieldscribe.audit.editions import compare
    from fieldscribe.cli.audit import manual_of, opened, text_of

    subject = opened(arguments)
    path, document = manual_of(subject, arguments.manual)
    old_path, _ = manual_of(subject, arguments.old)
    old, new = (_edition(*text_of(place), document) for place in (old_path, path))
    return *compare(subject, old, new, _glossary(subject), _held(arguments, subject)), subject, document


def _held(arguments: Namespace, subject: Analysis) -> frozenset[str]:
    """The errata that are said to hold. Raises StopError."""
    from fieldscribe.cli.common import StopError

    held = [name.strip() for given in arguments.holds for name in given.split(",") if name.strip()]
    known = {erratum.erratum.id for erratum in subject.errata}
    for name in held:
        if name not in known:
            raise StopError(f"--holds: the description has no erratum `{name}`", "give the ids that the audit names")
    return frozenset(held)


def _glossary(subject: Analysis) -> dict[str, str]:
    """English by the manual's words: the glossary beside the description's folder, or else the shipped one."""
    from pathlib import Path

    from fieldscribe.diagnostics import Report
    from fieldscribe.language.load import load
    from fieldscribe.language.source import read_source
    from fieldscribe.resources import descriptions_dir

    own = Path(subject.scope.header.file.name).resolve().parent.parent / "glossary.yaml"
    source = read_source(own if own.is_file() else descriptions_dir() / "glossary.yaml", Report())
    file = next(iter(load(source, Report())), None) if source is not None else None
    terms = file.get("terms") if file is not None else None
    said = {word: [texts] if isinstance(texts, str) else texts for word, texts in (terms or {}).items()}
    return {word.casefold(): str(texts[0])[:1].upper() + str(texts[0])[1:] for word, texts in said.items() if texts}


def _edition(name: str, text: str, digest: str, document: Document) -> Edition:
    from fieldscribe.audit.editions import Edition

    return Edition(name, text, None if document.sha256 is None else digest == document.sha256)


def _name_and_digest(arguments: Namespace, subject: Analysis) -> tuple[str, str]:
    from fieldscribe.cli.audit import manual_of, text_of

    name, _, digest = text_of(manual_of(subject, arguments.manual)[0])
    return name, digest


def _renumber(subject: Analysis, document: Document, citations: Citations) -> str:
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


def _refusal(arguments: Namespace, outcome: Comparison, subject: Analysis, document: Document) -> str | None:
    """Why the new edition cannot be accepted, known before anything is written; None if it can."""
    from fieldscribe.audit.editions.accepting import unrecordable

    if not outcome.explained:
        return "not everything in the new edition is explained"
    if outcome.doubts:
        return "errata about changed lines are not looked at: mend or remove them, or say --holds and their ids"
    said = subject.scope.header["documents"][document.id]
    given = _given(arguments)
    return "; ".join(unrecordable(document.id, said, given, *_name_and_digest(arguments, subject))) or None


def _left(citations: Citations, subject: Analysis, document: Document) -> str | None:
    """Whether lines still count the old edition."""
    from fieldscribe.audit.editions import renumber

    left = renumber(subject.scope.files, document.id, citations)
    if left.count or left.hindrances:
        return f"{_counted(left.count, 'cited line')} count the old edition: --renumber comes first"
    return None


def _given(arguments: Namespace) -> dict[str, str]:
    """What shall be recorded beside the checksum. Raises StopError."""
    from fieldscribe.audit.editions.accepting import LONGEST
    from fieldscribe.cli.common import StopError

    given = {key: str(value) for key in LONGEST if (value := getattr(arguments, key)) is not None}
    for key, value in given.items():
        if not value.strip() or not value.isprintable() or len(value) > LONGEST[key]:
            raise StopError(f"--{key}: give a text of 1 to {LONGEST[key]} printable characters")
    if "/" in given.get("file", "") or "\\" in given.get("file", ""):
        raise StopError("--file: give the name alone, without folders", "nothing was changed")
    return given


def _accept(arguments: Namespace, subject: Analysis, document: Document) -> str:
    """Record the new edition; what was done. Raises StopError."""
    from fieldscribe.audit.editions.accepting import with_recorded
    from fieldscribe.cli import FINDINGS
    from fieldscribe.cli.audit import manual_of, text_of
    from fieldscribe.cli.common import StopError
    from fieldscribe.cli.fingerprints import keeping
    from fieldscribe.cli.rewriting import rewrite

    said = subject.scope.header["documents"][document.id]
    _, digest = _name_and_digest(arguments, subject)
    text = with_recorded(said, {"sha256": digest, **_given(arguments)})
    if text is None:
        raise StopError(f"not accepted: documents.{document.id} has an alias: write it out", code=FINDINGS)
    path, _ = manual_of(subject, arguments.manual)
    rewrite({said.file.name: (said.file.text, text), **keeping(subject, document, text_of(path)[1], digest)})
    return f"accepted: {said.file.name}:{said.span('sha256').line} records the new edition"


def _not_clean(arguments: Namespace, subject: Analysis) -> list[str]:
    """Whether the new text alone has more to look at: what a removed erratum said, say, though its line is the same."""
    from fieldscribe.audit import audit
    from fieldscribe.audit.report import as_lines
    from fieldscribe.cli.audit import manual_of, text_of

    name, text, _ = text_of(manual_of(subject, arguments.manual)[0])
    outcome = audit(subject, name, text, same_text=True)
    if outcome.clean:
        return []
    lines = (line for line in as_lines(outcome, everything=False) if {kind for kind, _ in line} & {"error", "warning"})
    findings = ["".join(part for _, part in line) for line in lines]
    more = [f"  and {len(findings) - _MOST_OPEN} more"] if len(findings) > _MOST_OPEN else []
    head = f"the audit of the new text alone has {_counted(len(findings), 'finding')}:"
    return ["\n".join([head, *(f"  {line}" for line in findings[:_MOST_OPEN]), *more])]


def _report(arguments: Namespace, outcome: Comparison, written: list[str], refused: str | None) -> None:
    from fieldscribe.audit.editions.report import as_lines, figures, stale_notes
    from fieldscribe.cli.common import print_json
    from fieldscribe.cli.terminal import print_lines
    from fieldscribe.report import visible

    if arguments.format == "json":
        print_json({**outcome.as_data(), "written": written, "refused": refused})
        return
    taken_over = written and refused is None and outcome.settled
    if taken_over:
        print_lines(stale_notes(outcome))
    print_lines(figures(outcome) if taken_over else as_lines(outcome, everything=arguments.all))
    print_lines([[("", visible(line))] for note in written for line in note.splitlines()])
    if refused is not None:
        print_lines([[("error", "not accepted"), ("", visible(f": {refused}"))]])


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
