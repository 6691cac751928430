"""The options of `decode` and `encode` about frames and other points; families declare their own."""

from argparse import ArgumentParser, Namespace
from fractions import Fraction

from fieldscribe.cli.common import StopError, add_repeated, open_device
from fieldscribe.conversation.encoding import read_settings
from fieldscribe.conversation.selection import at_bases, base_options
from fieldscribe.diagnostics import RefusedError, UnclearError
from fieldscribe.families import Family, families, family
from fieldscribe.families.frame_results import Options
from fieldscribe.model import Device
from fieldscribe.text import shortened


def add_with(parser: ArgumentParser) -> None:
    """Add `--with`, the values of other points; `settings_of` reads it."""
    what = "the value of another point on which a scale or range depends; a number that an address depends on: slot=3"
    add_repeated(parser, "--with", "POINT=VALUE", what, dest="settings")


def placed(device: Device, arguments: Namespace) -> Device:
    """Return the device with points at the bases that `--with` gives; these leave the settings. Raises StopError."""
    try:
        device, arguments.settings = at_bases(device, arguments.settings)
    except UnclearError as error:
        raise StopError(f"--with: {error.message}", error.hint) from error
    return device


def model_of(arguments: Namespace) -> Device:
    """Return the device of the command line, at its bases. Raises StopError, also for numbers that are no bases."""
    device = placed(open_device(arguments), arguments)
    if arguments.settings:
        message = f"--with: {device.id} has nothing that is given or found as `{shortened(arguments.settings[0])}`"
        raise StopError(message, base_options(device.bases) or "leave it out")
    return device


def add_framing(parser: ArgumentParser, default: str) -> None:
    """Add `--framing`, with the framings of all families that have a choice."""
    known = {family.name: framings for family in families() if (framings := _framings(family))}
    of_families = "; ".join(f"{', '.join(framings)} ({name})" for name, framings in known.items())
    parser.add_argument(
        "--framing",
        choices=tuple(framing for framings in known.values() for framing in framings),
        help=f"how frames are wrapped: {of_families} (default: {default})",
    )


def add_family_options(parser: ArgumentParser, command: str) -> None:
    """Add the options of this command that only some families take."""
    add = parser.add_argument
    for bus_family in families():
        for option in bus_family.options:
            help_text = f"{bus_family.name}: {option.help}"
            if command not in option.commands:
                continue
            if option.type is None:
                add(option.flag, action="store_true", help=help_text)
            else:
                add(option.flag, type=option.type, metavar=option.metavar, choices=option.choices, help=help_text)


def settings_of(device: Device, arguments: Namespace) -> dict[str, int | Fraction]:
    """Return the values of other points that `--with` gives. Raises StopError."""
    try:
        return read_settings(device, arguments.settings)
    except (UnclearError, RefusedError) as error:
        raise StopError(f"--with: {error.message}", error.hint) from error


def options_of(device: Device, arguments: Namespace) -> Options:
    """Return the options that were given. Raises StopError for one that the device's family does not take."""
    shared = {name: getattr(arguments, name, None) for name in ("framing", "unit", "request", "index")}
    names = [option.name for bus_family in families() for option in bus_family.options]
    values = {name: getattr(arguments, name, None) for name in names}
    others = {name: value for name, value in values.items() if value is not None and value is not False}  # 0 is a value
    options = Options(**shared, of_family=others)
    given = [name for name in ("framing", "index") if getattr(options, name) is not None]
    for name in (*given, *options.of_family):
        takers = [bus_family.name for bus_family in families() if name in _names(bus_family)]
        if device.family not in takers:
            flag = f"--{name.replace('_', '-')}"
            raise StopError(f"{flag} is for {' and '.join(takers)} devices; {device.id} is a {device.family} device")
    known = _framings(family(device.family))
    if options.framing is not None and options.framing not in known:
        message = f"--framing {options.framing} is not for {device.family} devices such as {device.id}"
        raise StopError(message, f"it takes {', '.join(known)}")
    return options


def _framings(bus_family: Family) -> tuple[str, ...]:
    """Return the framings of a family; none if there is no choice."""
    return bus_family.framings if len(bus_family.framings) > 1 else ()


def _names(bus_family: Family) -> list[str]:
    """Return the names of the options that a family takes and others may not."""
    shared = {"framing": _framings(bus_family), "index": bus_family.indexed}
    return [name for name, takes in shared.items() if takes] + [option.name for option in bus_family.options]
