"""What commands ask about the link and about single frames: their options, which each family checks."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from fieldscribe.dialogue.options import Options
    from fieldscribe.model import Device

_FRAMINGS = ("rtu", "tcp", "uss", "pkw", "pzd", "broadcast")


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
    parser.add_argument(
        "--framing",
        choices=_FRAMINGS,
        help="how frames are wrapped: rtu, tcp (modbus); uss, or the words of pkw, pzd, broadcast alone (uss) "
        f"({default})",
    )


def add_uss(parser: ArgumentParser) -> None:
    """How a USS link is set."""
    parser.add_argument("--pkw", type=int, metavar="N", help="uss: words of the parameter part (P2013; default: 127)")
    parser.add_argument("--pzd", type=int, metavar="N", help="uss: words of process data (P2012; default: 2)")
    parser.add_argument(
        "--single-first",
        action="store_true",
        help="uss: single words stand in the first value word although --pkw is 4 (some firmware)",
    )


def options_of(device: Device, arguments: Namespace) -> Options:
    """What was asked for, if the device's family has a use for it. Raises StopError."""
    from dataclasses import fields

    from fieldscribe.cli.common import StopError
    from fieldscribe.dialogue.options import Options, refuse_foreign
    from fieldscribe.dialogue.selection import UnclearError

    given = {one.name: getattr(arguments, one.name) for one in fields(Options) if hasattr(arguments, one.name)}
    options = Options(**given)
    try:
        refuse_foreign(device, options)
    except UnclearError as error:
        raise StopError(error.message, error.hint) from error
    return options
