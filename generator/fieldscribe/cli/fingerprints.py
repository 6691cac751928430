"""The fingerprint of a document's text, in a file beside the description: `manual.fingerprint` for `manual`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fieldscribe.audit.layout import Fingerprint
    from fieldscribe.model import Document
    from fieldscribe.resolve.analysis import Analysis

_MOST_BYTES = 64 << 20


def place_of(subject: Analysis, document: Document) -> Path:
    """Where it is kept; a description that is one file gives its own name in front."""
    head = Path(subject.scope.header.file.name)
    own = "" if head.stem == "device" else f"{head.stem}."
    return head.with_name(f"{own}{document.id}.fingerprint")


def kept_of(subject: Analysis, document: Document) -> Fingerprint | None:
    """What is kept of the recorded text; None if nothing is, or only of another one. Raises StopError."""
    kept = _read(place_of(subject, document))[1]
    return kept if kept is not None and kept.sha256 == document.sha256 else None


def keeping(subject: Analysis, document: Document, text: str, sha256: str) -> dict[str, tuple[str | None, str]]:
    """What `rewrite` has to write so that the fingerprint of a text is kept; nothing if it is. Raises StopError."""
    from fieldscribe.audit.layout import Fingerprint

    place = place_of(subject, document)
    before, after = _read(place)[0], Fingerprint.of(text, sha256).written()
    return {} if before == after else {str(place): (before, after)}


def _read(place: Path) -> tuple[str | None, Fingerprint | None]:
    """The text of a file that is no link, and what it keeps; None if there is none. Raises StopError."""
    from fieldscribe.audit.layout import Fingerprint, FingerprintError
    from fieldscribe.cli import FINDINGS
    from fieldscribe.cli.common import StopError
    from fieldscribe.safe_files import read_regular, shown_path

    shown = shown_path(place)
    if place.is_symlink():
        raise StopError(f"`{shown}` is a link", "a fingerprint is a file beside the description: remove the link")
    if not place.exists():
        return None, None
    text = read_regular(place, _MOST_BYTES).data.decode("utf-8-sig", "replace").replace("\r\n", "\n")
    try:
        return text, Fingerprint.read(text)
    except FingerprintError as error:
        hint = "remove the file, and keep a new one: audit the text that was transcribed with --fingerprint"
        raise StopError(f"{shown}:{error.line}: {error}", hint, FINDINGS) from error
