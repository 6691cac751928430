"""The options of commands about the link and single frames; families say which of them they take."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.model import Device
    from fieldscribe.user_errors import Options


def add_with(parser: ArgumentParser) -> None:
    """The option `--with`: what other points hold."""
    parser.add_argument(
        "--with",
        dest="given",
        action="append",
        default=[],
        metavar="POINT=VALUE",
        help="what another point holds, where a scale or range depends on it; may be repeated",
    )


def add_framing(parser: ArgumentParser, default: str) -> None:
    """The option that says how frames are wrapped."""
    from fieldscribe.conversation.options import framings
    from fieldscribe.families import families

    known = {family.name: framings(family) for family in families() if framings(family)}
    ways_of_families = "; ".join(f"{', '.join(ways)} ({name})" for name, ways in known.items())
    parser.add_argument(
        "--framing",
        choices=tuple(way for ways in known.values() for way in ways),
        help=f"how frames are wrapped: {ways_of_families} ({default})",
    )


def add_own(parser: ArgumentParser, command: str) -> None:
    """The options that only some families take."""
    from fieldscribe.families import families

    for family in families():
        for option in family.options:
            if command not in option.commands:
                continue
            help_text = f"{family.name}: {option.help}"
            if option.type is None:
                parser.add_argument(option.flag, action="store_true", help=help_text)
            else:
                parser.add_argument(
                    option.flag, type=option.type, metavar=option.metavar, choices=option.choices, help=help_text
                )


def options_of(device: Device, arguments: Namespace) -> Options:
    """The options that were given. Raises StopError for one that the device's family does not take."""
    from dataclasses import fields

    from fieldscribe.cli.common import StopError
    from fieldscribe.conversation.options import refuse_foreign
    from fieldscribe.families import families
    from fieldscribe.user_errors import Options, UnclearError

    common = {each.name: getattr(arguments, each.name) for each in fields(Options) if hasattr(arguments, each.name)}
    names = dict.fromkeys(option.name for family in families() for option in family.options)
    values = {name: getattr(arguments, name, None) for name in names}
    options = Options(
        **common, own={name: value for name, value in values.items() if value is not None and value is not False}
    )
    try:
        refuse_foreign(device, options)
    except UnclearError as error:
        raise StopError(error.message, error.hint) from error
    return options
