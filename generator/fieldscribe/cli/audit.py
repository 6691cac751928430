"""`fieldscribe audit`: compare a description with the text of its manual, or compare two editions of it."""

import re
from argparse import ArgumentParser, Namespace
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from fieldscribe.audit import Citations, Comparison, Editions, audit, audit_of
from fieldscribe.audit.renumbering import LONGEST, hindrances, renumber, with_recorded
from fieldscribe.audit.report import audit_lines, audit_page, comparison_lines
from fieldscribe.authoring.formatting import rewrite
from fieldscribe.cli.common import StopError, add_device, load, print_json, some_path, usage_error
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.diagnostics import visible
from fieldscribe.model import Document
from fieldscribe.pipeline import load_analysis
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.safe_files import read_regular
from fieldscribe.text import counted

AUDIT_EXAMPLE = """examples:
  fieldscribe audit hitachi_l200 --manual hitachi_l200_modbus.txt
  fieldscribe audit hitachi_l200 --manual new.txt --report html > audit.html
  fieldscribe audit hitachi_l200 --old hitachi_l200_modbus.txt --manual new.txt
  fieldscribe audit hitachi_l200 --old hitachi_l200_modbus.txt --manual new.txt --renumber --accept --file new.txt

ends with 1 when a cited fact is not printed where it is cited; without --old also for numbers in cited places that no
fact uses, for rows that nothing cites among rows that are cited, and when no fact cites a line"""

_MOST_BYTES = 16 << 20
_MOST_LINES, _LONGEST_LINE = 100_000, 20_000
_MOST_NUMBERS = 200_000
"""Limits of a manual's text: more than ten times the longest known one."""


class _Text(NamedTuple):
    """The text of a manual, and the document of the description that it is the text of."""

    name: str
    text: str
    sha256: str
    document: Document

    @property
    def is_recorded(self) -> bool | None:
        """True if it is the text that the description records; None if that is unknown."""
        return None if self.document.sha256 is None else self.sha256 == self.document.sha256


def add_audit_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add_device(parser, variants=False)
    add(
        "--manual", type=some_path, required=True, metavar="FILE", help="the manual's text, or the folder that holds it"
    )
    add("--report", "--format", dest="format", choices=("text", "json", "html"), default="text", help="how to report")
    add("--old", type=some_path, metavar="FILE", help="the text of the edition before: list every line that differs")
    add("--renumber", action="store_true", help="with --old: write the new numbers of cited lines into the description")
    add("--accept", action="store_true", help="with --old: record the new text, if every cited fact stands in it")
    for key in ("file", "edition"):
        add(f"--{key}", metavar="TEXT", help=f"with --accept: the `{key}` of the document to record")
    add("--all", action="store_true", help="list also sections and rows that nothing cites")


def run_audit(arguments: Namespace) -> int:
    """Audit, or compare two editions; return the exit code."""
    if not arguments.accept and (arguments.file is not None or arguments.edition is not None):
        raise StopError("--file and --edition are what --accept records", "give them with --accept")
    if arguments.old is not None:
        return _compare(arguments)
    if arguments.renumber or arguments.accept:
        raise StopError("--renumber and --accept need the old text", "give it with --old")
    return _audit(arguments)


def _audit(arguments: Namespace) -> int:
    subject = load(load_analysis, arguments)
    text, citations = _text(subject, arguments.manual), Citations(subject)
    last = max((max(cited.lines) for claim in citations.claims for cited in claim.cited), default=0)
    if (lines := len(text.text.splitlines())) < last:
        hint = "is it the text that the description cites? For another edition give that text with --old"
        usage_error(f"`{text.name}` has {counted(lines, 'line')}, and facts cite line {last}", hint)
    outcome = audit(citations, text.name, text.text, same_text=text.is_recorded)
    if arguments.format == "json":
        print_json(outcome.as_data())
    elif arguments.format == "html":
        print(audit_page(outcome))
    else:
        print_lines(audit_lines(outcome, everything=arguments.all))
    return FINE if outcome.is_clean else FINDINGS


def _compare(arguments: Namespace) -> int:
    """Compare both editions; with --renumber and --accept, write."""
    if arguments.format == "html":
        raise StopError("two editions have no HTML report", "use --report text or json")
    written: list[str] = []
    refused: str | None = None
    while True:
        subject = load(load_analysis, arguments)
        old, new = _text(subject, arguments.old), _text(subject, arguments.manual)
        editions = Editions(Citations(subject), old.text, new.text)
        outcome = editions.compare(old.name, new.name)
        if not arguments.renumber or written:
            break
        written.append(_renumber(subject, new.document, editions))
    if arguments.accept:
        refused = _refusal(arguments, outcome, subject, new)
        if refused is None:
            written += _accept(arguments, outcome, editions, subject, new)
    if new.is_recorded and old.is_recorded is False:
        written.append(f"hint: {new.name} is the text that the description records: is it the old one?")
    _report(arguments, outcome, written, refused)
    return FINE if outcome.stands and refused is None else FINDINGS


def _renumber(subject: Analysis, document: Document, editions: Editions) -> str:
    """Write the line numbers of the new edition; return a report. Raises StopError."""
    result = renumber(subject.scope.files, document.id, editions)
    if result.hindrances:
        raise StopError(f"not renumbered: {'; '.join(result.hindrances)}", "nothing was changed", FINDINGS)
    before = {file.file.name: file.file.text for file in subject.scope.files}
    rewrite({name: (before[name], text) for name, text in result.texts.items()})
    by_hand = "".join(f"\n  {note}" for note in result.by_hand)
    return f"renumbered: {counted(result.count, 'line')} in {counted(len(result.texts), 'file')}{by_hand}"


def _refusal(arguments: Namespace, outcome: Comparison, subject: Analysis, new: _Text) -> str | None:
    """Return why the new edition cannot be accepted; None if it can. Raises StopError."""
    if not outcome.stands:
        return "not every cited fact stands in the new edition"
    if outcome.left_to_renumber:
        return f"{counted(outcome.left_to_renumber, 'cited place')} have the lines of the old edition: add --renumber"
    recorded = subject.scope.header["documents"][new.document.id]
    return "; ".join(hindrances(new.document.id, recorded, _given(arguments), new.name, new.sha256)) or None


def _given(arguments: Namespace) -> dict[str, str]:
    """Return the facts to record beside the checksum. Raises StopError."""
    given = {key: str(value) for key in LONGEST if (value := getattr(arguments, key)) is not None}
    for key, value in given.items():
        if not value.strip() or not value.isprintable() or len(value) > LONGEST[key]:
            raise StopError(f"--{key}: give a text of 1 to {LONGEST[key]} printable characters")
    if "/" in given.get("file", "") or "\\" in given.get("file", ""):
        raise StopError("--file: give the name alone, without folders", "nothing was changed")
    return given


def _accept(arguments: Namespace, outcome: Comparison, editions: Editions, subject: Analysis, new: _Text) -> list[str]:
    """Record the new edition; return a report, with what is left to look at. Raises StopError."""
    recorded = subject.scope.header["documents"][new.document.id]
    text = with_recorded(recorded, {"sha256": new.sha256, **_given(arguments)})
    if text is None:
        raise StopError(f"not accepted: documents.{new.document.id} has an alias: write it out", code=FINDINGS)
    rewrite({recorded.file.name: (recorded.file.text, text)})
    done = [f"accepted: {recorded.file.name}:{recorded.span('sha256').line} records the new edition"]
    if outcome.uncited:
        differ = "differs" if outcome.uncited == 1 else "differ"
        done.append(f"look at them: {counted(outcome.uncited, 'line')} that {differ}, which no fact cites")
    if findings := audit_of(editions.in_new, new.name, same_text=True).findings:
        done.append(f"look at them: {counted(findings, 'finding')} of `fieldscribe audit` in the new text alone")
    return done


def _report(arguments: Namespace, outcome: Comparison, written: list[str], refused: str | None) -> None:
    if arguments.format == "json":
        print_json({**outcome.as_data(), "written": written, "refused": refused})
        return
    print_lines(comparison_lines(outcome, with_lines=not (arguments.renumber or arguments.accept)))
    print_lines([[("", visible(line))] for note in written for line in note.splitlines()])
    if refused is not None:
        print_lines([[("error", "not accepted"), ("", visible(f": {refused}"))]])


def _text(subject: Analysis, place: Path) -> _Text:
    """Return the text of a manual. Raises StopError."""
    path, document = _manual_of(subject, place)
    data = read_regular(path, _MOST_BYTES).data
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise StopError(f"`{path}` is no text in UTF-8", "extract the manual's text first") from error
    lines = text.count("\n") + text.count("\r")
    numbers = sum(1 for _ in re.finditer("[0-9]+", text))
    for what, count, most in (("lines", lines, _MOST_LINES), ("numbers", numbers, _MOST_NUMBERS)):
        if count > most:
            raise StopError(f"`{path}` has more than {most} {what}", "give the text of one manual")
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > _LONGEST_LINE:
            hint = "extract the manual's text with its line breaks"
            raise StopError(f"`{path}`:{number} has more than {_LONGEST_LINE} characters in a line", hint)
    return _Text(path.name, text, sha256(data).hexdigest(), document)


def _manual_of(subject: Analysis, place: Path) -> tuple[Path, Document]:
    """Return the file to read, and the document of the description whose text it is. Raises StopError."""
    documents = list(subject.scope.documents.values())
    if not place.exists():
        raise StopError(f"there is no file `{place}`", "name the text that was extracted from the manual")
    # only plain names, so that a description cannot leave the given folder
    known = {
        document.file: document for document in documents if document.file and Path(document.file).name == document.file
    }
    if place.is_dir():
        present = [name for name in known if (place / name).is_file()]
        if not present:
            names = " or ".join(f"`{name}`" for name in known)
            hint = f"the description names {names}" if known else "name the file itself: the description names none"
            raise StopError(f"`{place}` holds no manual of this device", hint)
        return place / present[0], known[present[0]]
    return place, known.get(place.name, next(iter((*known.values(), *documents))))
