"""`fieldscribe schema`: the keys of descriptions for editors and for people, and those of exported models."""

import sys
from argparse import ArgumentParser, Namespace

from fieldscribe.cli.terminal import FINE
from fieldscribe.export import schema_text as export_schema_text
from fieldscribe.language.key_tables import keys_markdown, schema_text

EXAMPLE = """examples:
  fieldscribe schema > schema.json
  fieldscribe schema --page > KEYS.md
  fieldscribe schema --export > exported-model.json

An editor with yaml-language-server completes and checks keys when a description starts with the line
# yaml-language-server: $schema=schema.json
(`fieldscribe init` writes both; `fieldscribe fmt` keeps the schema up to date)

ends with 0: it reads no description"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--page", action="store_true", help="as a page of Markdown, with a table for each place")
    form.add_argument("--export", action="store_true", help="the JSON Schema of what `fieldscribe export json` prints")


def run(arguments: Namespace) -> int:
    """Print the keys and return the exit code."""
    text = export_schema_text if arguments.export else keys_markdown if arguments.page else schema_text
    sys.stdout.write(text())
    return FINE
