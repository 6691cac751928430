"""`fieldscribe import dbc`: draft a description from a CAN database."""

from argparse import Namespace
from hashlib import sha256
from typing import Any

from fieldscribe.cli.common import Parser, StopError
from fieldscribe.cli.terminal import FINDINGS
from fieldscribe.importing import compilable
from fieldscribe.importing.dbc import DbcDraft
from fieldscribe.importing.draft_text import Document, Head
from fieldscribe.importing.readers import MOST_BYTES, UnreadableError
from fieldscribe.safe_files import read_regular
from fieldscribe.text import line


def add_arguments(parser: Parser) -> None:
    """Add the options of this kind."""
    parser.add_argument("--node", metavar="NAME", help="the device: it sends its messages, and receives all others")


def from_database(arguments: Namespace) -> tuple[str, list[str]]:
    """Return the draft of a CAN database, and a report of it. Raises UnreadableError and StopError."""
    data = read_regular(arguments.file, MOST_BYTES).data
    text = text_of(data)
    drafted = DbcDraft(database_of(text), text, arguments.node)
    if not drafted.groups:
        raise StopError(f"`{arguments.file}` holds no signals", "a CAN database has messages with signals", FINDINGS)
    document = Document(arguments.file.name, sha256(data).hexdigest(), "database")
    head = Head(
        arguments.device or "draft", [document], "can", facts=drafted.head(), kind="a CAN database", bus=drafted.bus()
    )
    return compilable(drafted.groups, head, with_head=arguments.device is not None), list(drafted.report())


def text_of(data: bytes) -> str:
    """Return the text of a database: UTF-8 if valid, else Windows-1252."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace")


def database_of(text: str) -> Any:
    """Return the database that cantools reads. Raises UnreadableError and StopError."""
    try:
        from cantools.database import load_string
    except ModuleNotFoundError as error:
        message = "CAN databases need the extra `dbc`, which is not installed"
        raise StopError(message, 'pip install "fieldscribe[dbc]"') from error
    try:
        return load_string(text, "dbc", strict=False)
    except Exception as error:  # cantools raises whatever its parsers do
        reason = line(str(error))[:200] or type(error).__name__
        raise UnreadableError(f"this is no CAN database: {reason}", hint="cantools must be able to read it") from error
