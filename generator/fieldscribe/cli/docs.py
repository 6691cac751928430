"""`fieldscribe docs`: the documentation of devices as a workbook, as CSV, in Markdown, and an index of it as pages."""

from argparse import ArgumentParser, Namespace
from functools import partial
from itertools import chain
from pathlib import Path

from fieldscribe.cli import FINDINGS, FINE
from fieldscribe.cli.common import StopError, add_descriptions, open_device, report_findings, some_path
from fieldscribe.cli.vendor import deliver_all, print_deliveries
from fieldscribe.diagnostics import Report
from fieldscribe.model import Device
from fieldscribe.pages.site import NAME, load_pages
from fieldscribe.pipeline import find_devices
from fieldscribe.vendoring.deliveries import Order
from fieldscribe.vendoring.requests import FORMATS, DocumentRequest, IndexRequest

EXAMPLE = """examples:
  fieldscribe docs hitachi_l200 --format xlsx --out tables
  fieldscribe docs siemens_mm4 jumo_controller --format csv --out tables
  fieldscribe docs nord_sk5xxe --format markdown --out manuals
  fieldscribe docs woodward_mpu2s --format html --out pages
  fieldscribe docs hitachi_l200 nord_sk5xxe --pages --format html --out site
  fieldscribe docs descriptions --format html --out all          (each device of a folder)
  fieldscribe docs hitachi_l200 --format xlsx --out tables --check

a workbook has the points, their meanings (names of numbers, flags, special codes), the errata, and what its columns say
several devices as html have an index.html, which lists and searches all that the command names
--check writes nothing, says what is missing, stale or edited by hand, and ends with 1 if anything is
also ends with 1 when a device has errors or a foreign file is in the way; nothing of that device is written then"""


_DEVICES = "ids of devices, or paths: of a device.yaml, its folder, or a folder of such folders"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of the command."""
    add = parser.add_argument
    add("devices", nargs="*", metavar="DEVICE", help=_DEVICES)
    add_descriptions(parser)
    forms = "; ".join(f"{form}: {what}" for form, what in FORMATS.items())
    add("--format", choices=tuple(FORMATS), required=True, help=forms)
    add("--pages", action="store_true", help="html: the pages of fieldscribe itself, too: language, keys, using")
    add("--out", type=some_path, required=True, metavar="DIR", help="the folder that they go to")
    add("--check", action="store_true", help="write nothing; list what is missing, stale or edited")
    add("--force", action="store_true", help="replace files in the way that fieldscribe did not make")


def run(arguments: Namespace) -> int:
    """Write or compare the files; return the exit code."""
    if arguments.pages and arguments.format != "html":
        raise StopError("--pages is for --format html")
    if not arguments.devices and not arguments.pages:
        raise StopError("DEVICE is missing", "name devices, or say --pages for the pages of fieldscribe itself")
    devices: list[Device] = []
    code = FINE
    for name in chain.from_iterable(map(_named, arguments.devices)):
        try:
            device = open_device(Namespace(device=name, descriptions=arguments.descriptions))
        except StopError as stop:
            code = max(code, stop.report())
            continue
        if device not in devices:  # it may be named by its id, and in its folder
            devices.append(device)
    has_index = arguments.format == "html" and (arguments.pages or len(devices) > 1)
    request = DocumentRequest(arguments.format, index=f"{NAME}.html" if has_index else "")
    orders = [Order(device.id, request, arguments.out, partial(request.contents, device)) for device in devices]
    if has_index:
        orders.append(_index(arguments, devices))
    deliveries = deliver_all(orders, "text", check=arguments.check, force=arguments.force)
    return max(code, print_deliveries(deliveries, "text", check=arguments.check))


def _named(name: str) -> list[str]:
    """Return the devices of a name: all devices of a folder, or the one with this name."""
    is_folder = bool(name) and Path(name).is_dir()  # an empty name would be the working folder
    files = find_devices([Path(name)], Report()) if is_folder else []
    return list(map(str, files)) if len(files) > 1 else [name]


def _index(arguments: Namespace, devices: list[Device]) -> Order:
    """Return the order of the index. Raises StopError."""
    report, names = Report(), [device.id for device in devices]
    try:
        shelves = load_pages(names, report) if arguments.pages else ()
    except ModuleNotFoundError as error:
        raise StopError("--pages needs markdown-it-py", 'pip install "fieldscribe[html]"') from error
    if report.has_errors:
        report_findings(report, "text")
        raise StopError("", code=FINDINGS)
    index = IndexRequest(tuple(devices), shelves)
    return Order(index.name, index, arguments.out, index.contents)
