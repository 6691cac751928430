"""`fieldscribe docs`: the documentation of devices as a workbook, as CSV or in Markdown."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from fieldscribe.cli import FINE
from fieldscribe.cli.common import StopError, add_descriptions, open_device, some_path
from fieldscribe.cli.vendor import deliver_all, print_deliveries
from fieldscribe.vendoring.deliveries import Order
from fieldscribe.vendoring.requests import FORMATS, DocumentRequest

EXAMPLE = """examples:
  fieldscribe docs hitachi_l200 --format xlsx --out tables
  fieldscribe docs siemens_mm4 jumo_controller --format csv --out tables
  fieldscribe docs nord_sk5xxe --format markdown --out manuals
  fieldscribe docs hitachi_l200 --format xlsx --out tables --check

a workbook has the points, their meanings (names of numbers, flags, special codes), the errata, and what its columns say
--check writes nothing, says what is missing, stale or edited by hand, and ends with 1 if anything is
ends with 1, too, when a device has errors or a foreign file is in the way; nothing of that device is written then"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the command."""
    add = parser.add_argument
    add("devices", nargs="+", metavar="DEVICE", help="ids of devices, or paths of their folders or device.yaml")
    add_descriptions(parser)
    forms = "; ".join(f"{form}: {what}" for form, what in FORMATS.items())
    add("--format", choices=tuple(FORMATS), required=True, help=forms)
    add("--out", type=some_path, required=True, metavar="DIR", help="the folder that they go to")
    add("--check", action="store_true", help="write nothing; say what is not as it should be")
    add("--force", action="store_true", help="replace files in the way that fieldscribe did not make")


def run(arguments: Namespace) -> int:
    """Write or compare the files; return the exit code."""
    orders, code = [], FINE
    for name in arguments.devices:
        try:
            device = open_device(Namespace(device=name, descriptions=arguments.descriptions))
        except StopError as stop:
            code = max(code, stop.tell())
        else:
            orders.append(Order(device, DocumentRequest(arguments.format), arguments.out))
    deliveries = deliver_all(orders, "text", check=arguments.check, force=arguments.force)
    return max(code, print_deliveries(deliveries, "text", check=arguments.check))
