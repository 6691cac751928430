"""`fieldscribe audit`: hold everything that a description cites against the text of its manual."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.audit import Audit
    from fieldscribe.model import Document
    from fieldscribe.resolve.analysis import Analysis

EXAMPLE = """examples:
  fieldscribe audit hitachi_l200 --manual hitachi_l200_modbus.txt
  fieldscribe audit hitachi_l200 --manual new.txt --report html > audit.html
  fieldscribe audit hitachi_l200 --manual new.txt --old hitachi_l200_modbus.txt
  fieldscribe audit hitachi_l200 --manual new.txt --old hitachi_l200_modbus.txt --renumber --accept --file new.txt

ends with 1 when a cited fact is not where it is cited, or is printed otherwise; when a cited place has a number that no
fact uses, such as that of an added entry; for rows that nothing cites among rows that are cited; and with --old while a
changed line is not explained or an erratum about one is not looked at"""


_MOST_BYTES = 256 << 20
"""The largest manual text that is read: a hundred times the longest known one."""

_LONGEST_LINE = 20_000
"""Characters of a line: a text without its line breaks tells no places."""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    from fieldscribe.cli.common import add_device, some_path

    add_device(parser, variants=False)
    parser.add_argument(
        "--manual", type=some_path, required=True, metavar="FILE", help="the manual's text, or the folder that holds it"
    )
    parser.add_argument(
        "--report", "--format", dest="format", choices=("text", "json", "html"), default="text", help="how to report"
    )
    parser.add_argument(
        "--old",
        type=some_path,
        metavar="FILE",
        help="the text of the edition before: say what changed, and what is open",
    )
    parser.add_argument(
        "--renumber", action="store_true", help="with --old: write the new numbers of cited lines into the description"
    )
    parser.add_argument(
        "--accept", action="store_true", help="with --old: record the new text, if every change in it is explained"
    )
    parser.add_argument(
        "--fingerprint",
        action="store_true",
        help="keep the fingerprint of the text that was transcribed: a new edition in another layout is read by it",
    )
    parser.add_argument(
        "--holds",
        action="append",
        default=[],
        metavar="ERRATA",
        help="with --old: errata, with commas between, that were looked at and hold though lines they cite changed",
    )
    for key in ("file", "edition"):
        parser.add_argument(f"--{key}", metavar="TEXT", help=f"with --accept: what `{key}` of the document says then")
    parser.add_argument(
        "--all", action="store_true", help="in text, list everything: also what nothing cites or what is explained"
    )


def run(arguments: Namespace) -> int:
    """Audit; the exit code."""
    from fieldscribe.audit.report import as_html, as_lines
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import StopError, print_json
    from fieldscribe.cli.terminal import print_lines

    if not arguments.accept and (arguments.file is not None or arguments.edition is not None):
        raise StopError("--file and --edition say what --accept records", "give them with --accept")
    if arguments.fingerprint and arguments.old is not None:
        raise StopError(
            "--fingerprint is of the text that was transcribed", "with --old say --accept: it keeps the new one's"
        )
    if arguments.old is not None:
        from fieldscribe.cli.audit_editions import run as run_editions

        return run_editions(arguments)
    if arguments.renumber or arguments.accept or arguments.holds:
        raise StopError("--renumber, --accept and --holds need the old text", "give it with --old")
    outcome = _audit(arguments)
    if arguments.format == "json":
        print_json(outcome.as_data())
    elif arguments.format == "html":
        print(as_html(outcome))
    else:
        print_lines(as_lines(outcome, everything=arguments.all))
    if arguments.fingerprint:
        _keep(arguments)
    return FINE if outcome.clean else FINDINGS


def _audit(arguments: Namespace) -> Audit:
    from fieldscribe.audit import audit
    from fieldscribe.cli.fingerprints import kept_of

    subject = opened(arguments)
    path, document = manual_of(subject, arguments.manual)
    name, text, digest = text_of(path)
    same = None if document.sha256 is None else digest == document.sha256
    return audit(subject, name, text, same_text=same, kept=None if same else kept_of(subject, document))


def _keep(arguments: Namespace) -> None:
    """Keep the fingerprint of the text that was transcribed. Raises StopError."""
    from fieldscribe.cli.common import StopError
    from fieldscribe.cli.fingerprints import keeping, place_of
    from fieldscribe.cli.rewriting import rewrite
    from fieldscribe.safe_files import shown_path

    subject = opened(arguments)
    path, document = manual_of(subject, arguments.manual)
    name, text, digest = text_of(path)
    if document.sha256 is None:
        raise StopError(f"documents.{document.id} records no text", f"add `sha256: {digest}` there")
    if digest != document.sha256:
        raise StopError(f"`{name}` is not the text that documents.{document.id} records", "give that one as --manual")
    changes = keeping(subject, document, text, digest)
    rewrite(changes)
    if arguments.format == "text":
        print(f"{'kept' if changes else 'kept before'}: {shown_path(place_of(subject, document))}")


def opened(arguments: Namespace) -> Analysis:
    """The description that is meant, with its places. Raises StopError."""
    from fieldscribe.cli.common import StopError, device_file, report_findings
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import load_analysis

    report = Report()
    subject = load_analysis(device_file(arguments), report)
    if subject is None:
        report_findings(report, "json" if arguments.format == "json" else "text")
        raise StopError("", code=1)
    return subject


def text_of(path: Path) -> tuple[str, str, str]:
    """Name, text and checksum of a manual. Raises StopError."""
    from hashlib import sha256

    from fieldscribe.cli.common import StopError
    from fieldscribe.safe_files import read_regular

    data = read_regular(path, _MOST_BYTES).data
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise StopError(f"`{path}` is no text in UTF-8", "extract the manual's text first") from error
    for number, line in enumerate(text.splitlines(), 1):
        if len(line) > _LONGEST_LINE:
            hint = "extract the manual's text with its line breaks"
            raise StopError(f"`{path}`:{number} has more than {_LONGEST_LINE} characters in a line", hint)
    return path.name, text, sha256(data).hexdigest()


def manual_of(subject: Analysis, place: Path) -> tuple[Path, Document]:
    """The file to read, and the document of the description whose text it is. Raises StopError."""
    from fieldscribe.cli.common import StopError

    documents = list(subject.scope.documents.values())
    if not place.exists():
        raise StopError(f"there is no file `{place}`", "name the text that was extracted from the manual")
    # only plain names, so that a description cannot lead out of the given folder
    known = {
        document.file: document for document in documents if document.file and Path(document.file).name == document.file
    }
    if place.is_dir():
        present = [name for name in known if (place / name).is_file()]
        if not present:
            raise StopError(f"`{place}` holds no manual of this device", f"it would be {' or '.join(known)}")
        return place / present[0], known[present[0]]
    return place, known.get(place.name, next(iter((*known.values(), *documents))))
