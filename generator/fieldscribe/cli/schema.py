"""`fieldscribe schema`: the keys of descriptions for editors and for people, and those of exported models."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

HELP = "print the keys of descriptions as JSON Schema or as a page, or the JSON Schema of exported models"
EXAMPLE = """examples:
  fieldscribe schema > schema.json
  fieldscribe schema --page > KEYS.md
  fieldscribe schema --export > exported-model.json

An editor with yaml-language-server completes and checks keys when a description starts with the line
# yaml-language-server: $schema=schema.json
(`fieldscribe init` writes both; `fieldscribe fmt` keeps the schema up to date)

ends with 0, for it reads no description"""


def add_arguments(parser: ArgumentParser) -> None:
    """The command's arguments."""
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--page", action="store_true", help="as a page of Markdown, a table for each place")
    form.add_argument("--export", action="store_true", help="the JSON Schema of what `fieldscribe export json` prints")


def run(arguments: Namespace) -> int:
    """Print it; the exit code."""
    from fieldscribe.cli import FINE

    sys.stdout.write(_text(arguments))
    return FINE


def _text(arguments: Namespace) -> str:
    if arguments.export:
        from fieldscribe.export import schema_text as schema_of_export

        return schema_of_export()
    if arguments.page:
        from fieldscribe.language.keys_page import keys_markdown

        return keys_markdown()
    from fieldscribe.language.json_schema import schema_text

    return schema_text()
