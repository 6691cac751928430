"""`fieldscribe audit`: hold everything that a description cites against the text of its manual."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.audit import Audit
    from fieldscribe.resolve.subject import Subject

HELP = "hold everything that a description cites against the text of its manual"
EXAMPLE = """examples:
  fieldscribe audit hitachi_l200 --manual hitachi_l200_modbus.txt
  fieldscribe audit hitachi_l200 --manual new_edition.txt --report html > audit.html

ends with 1 when a cited fact is not where it is cited, or is printed otherwise; when a cited place has a number that no
fact uses, such as that of an added entry; and for rows that nothing cites among rows that are cited"""


_MOST_BYTES = 256 << 20
"""The largest manual text that is read: a hundred times the longest known one."""


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
    parser.add_argument("--all", action="store_true", help="in text, list sections and rows too that nothing cites")


def run(arguments: Namespace) -> int:
    """Audit; the exit code."""
    from fieldscribe.audit.report import as_html, as_lines
    from fieldscribe.cli import FINDINGS, FINE
    from fieldscribe.cli.common import print_json
    from fieldscribe.cli.terminal import print_lines

    outcome = _audit(arguments)
    if arguments.format == "json":
        print_json(outcome.as_data())
    elif arguments.format == "html":
        print(as_html(outcome))
    else:
        print_lines(as_lines(outcome, everything=arguments.all))
    return FINE if outcome.clean else FINDINGS


def _audit(arguments: Namespace) -> Audit:
    from hashlib import sha256

    from fieldscribe.audit import audit
    from fieldscribe.cli.common import StopError, device_file, report_findings
    from fieldscribe.diagnostics import Report
    from fieldscribe.pipeline import load_subject
    from fieldscribe.reading import read_regular

    report = Report()
    subject = load_subject(device_file(arguments), report)
    if subject is None:
        report_findings(report, "json" if arguments.format == "json" else "text")
        raise StopError("", code=1)
    path, expected = _manual(subject, arguments.manual)
    data = read_regular(path, _MOST_BYTES).data
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise StopError(f"`{path}` is no text in UTF-8", "extract the manual's text first") from error
    same = None if expected is None else sha256(data).hexdigest() == expected
    return audit(subject, str(subject.scope.header["device"]), path.name, text, same_text=same)


def _manual(subject: Subject, place: Path) -> tuple[Path, str | None]:
    """The file to read, and the checksum of the text that was transcribed, if known. Raises StopError."""
    from fieldscribe.cli.common import StopError

    documents = list(subject.scope.documents.values())
    if not place.exists():
        raise StopError(f"there is no file `{place}`", "name the text that was extracted from the manual")
    # only plain names, so that a description cannot lead out of the given folder
    known = {
        document.file: document.sha256
        for document in documents
        if document.file and Path(document.file).name == document.file
    }
    if place.is_dir():
        present = [name for name in known if (place / name).is_file()]
        if not present:
            raise StopError(f"`{place}` holds no manual of this device", f"it would be {' or '.join(known)}")
        return place / present[0], known[present[0]]
    expected = known.get(place.name, next(iter(known.values()), None))
    return place, expected
