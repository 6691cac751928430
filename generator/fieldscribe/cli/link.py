"""What commands ask about the link and about single frames: their options, which each family checks."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.asked import Options
    from fieldscribe.model import Device


def add_with(parser: ArgumentParser) -> None:
    """What other points hold."""
    parser.add_argument(
        "--with",
        dest="given",
        action="append",
        default=[],
        metavar="POINT=VALUE",
        help="what another point holds, where a scale or range depends on it; may be repeated",
    )


def add_framing(parser: ArgumentParser, default: str) -> None:
    """How frames are wrapped."""
    from fieldscribe.conversation.options import framings
    from fieldscribe.families import families

    known = {one.name: framings(one) for one in families() if framings(one)}
    said = "; ".join(f"{', '.join(ways)} ({name})" for name, ways in known.items())
    parser.add_argument(
        "--framing",
        choices=tuple(way for ways in known.values() for way in ways),
        help=f"how frames are wrapped: {said} ({default})",
    )


def add_own(parser: ArgumentParser, command: str) -> None:
    """The options that only some families have a use for."""
    from fieldscribe.families import families

    for one in families():
        for option in one.options:
            if command not in option.commands:
                continue
            said = f"{one.name}: {option.help}"
            if option.type is None:
                parser.add_argument(option.flag, action="store_true", help=said)
            else:
                parser.add_argument(
                    option.flag, type=option.type, metavar=option.metavar, choices=option.choices, help=said
                )


def options_of(device: Device, arguments: Namespace) -> Options:
    """What was asked for, if the device's family has a use for it. Raises StopError."""
    from dataclasses import fields

    from fieldscribe.asked import Options, UnclearError
    from fieldscribe.cli.common import StopError
    from fieldscribe.conversation.options import refuse_foreign
    from fieldscribe.families import families

    given = {one.name: getattr(arguments, one.name) for one in fields(Options) if hasattr(arguments, one.name)}
    names = dict.fromkeys(option.name for one in families() for option in one.options)
    said = {name: getattr(arguments, name, None) for name in names}
    options = Options(
        **given, own={name: value for name, value in said.items() if value is not None and value is not False}
    )
    try:
        refuse_foreign(device, options)
    except UnclearError as error:
        raise StopError(error.message, error.hint) from error
    return options
