"""`fieldscribe schema`: the keys of the description language, for editors and for people."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

HELP = "print the keys of descriptions: as JSON Schema for editors, or as a page to read"
EXAMPLE = """examples:
  fieldscribe schema > schema.json
  fieldscribe schema --page > KEYS.md

An editor with yaml-language-server completes and checks keys when a description starts with the line
# yaml-language-server: $schema=schema.json
(`fieldscribe init` writes both; `fieldscribe fmt` keeps the schema up to date)

ends with 0, for it reads no description"""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    parser.add_argument("--page", action="store_true", help="as a page of Markdown, a table for each place")


def run(arguments: Namespace) -> int:
    """Print it; the exit code."""
    from fieldscribe.cli import FINE
    from fieldscribe.language.json_schema import schema_text
    from fieldscribe.language.keys_page import keys_markdown

    sys.stdout.write(keys_markdown() if arguments.page else schema_text())
    return FINE
