"""`fieldscribe vendor` and `docs`: exactly the files that a project needs of a device, and its documentation."""

import re
from argparse import SUPPRESS, ArgumentParser, Namespace
from collections.abc import Sequence
from functools import partial
from itertools import chain
from pathlib import Path

from fieldscribe.checks.device_name_is_free import reasons
from fieldscribe.cli.common import (
    StopError,
    add_descriptions,
    add_format,
    open_device,
    print_json,
    report_findings,
    some_path,
    usage_error,
)
from fieldscribe.cli.generate import print_waiting
from fieldscribe.cli.terminal import FINDINGS, FINE
from fieldscribe.diagnostics import Report, UnclearError, visible
from fieldscribe.language.keys.forms import ID
from fieldscribe.model import Device
from fieldscribe.output.writing import update_depfile
from fieldscribe.pages.site import INDEX, load_pages
from fieldscribe.pipeline import find_devices
from fieldscribe.safe_files import Inputs, read_regular
from fieldscribe.vendoring.deliveries import Delivery, Order, compare, deliver, leftovers, refuse_duplicates
from fieldscribe.vendoring.project_file import NAME, read_project
from fieldscribe.vendoring.requests import FORMATS, LANGUAGE_OF, LANGUAGES, CodeRequest, DocumentRequest, IndexRequest
from fieldscribe.vendoring.selection import address_only_messages, select

VENDOR_EXAMPLE = """examples:
  fieldscribe vendor c hitachi_l200 --out firmware/drivers
  fieldscribe vendor c hitachi_l200 --out firmware/drivers --points A001,D001,run_command
  fieldscribe vendor c hitachi_l200 --out firmware/drivers --points @points.txt --single-file
  fieldscribe vendor python woodward_mpu2s --out tools
  fieldscribe vendor rust siemens_mm4 --out crates --points "P10*,status_word"
  fieldscribe vendor typescript nord_sk5xxe --out drivers
  fieldscribe vendor --check          (what fieldscribe.toml asks for; for CI)

a point is named by its code or its name (a code with a comma in it by its name), several by their group or by a
pattern; what they need comes with them
--check writes nothing, says what is missing, stale or edited by hand, and ends with 1 if anything is
also ends with 1 when a device has errors or a foreign file is in the way; nothing of that device is written then"""

_VENDOR_USAGE = "`fieldscribe vendor c hitachi_l200 --out drivers`"


def add_vendor_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    add("language", nargs="?", metavar="LANGUAGE", help=f"one of {', '.join(LANGUAGES)}")
    add("device", nargs="?", metavar="DEVICE", help="a device's id, or the path of its folder or device.yaml")
    add("more", nargs="*", help=SUPPRESS)
    add_descriptions(parser)
    add("--out", type=some_path, metavar="DIR", help="the folder of the project that they go to")
    points = "codes, names, groups or patterns, with commas between, or @FILE (# begins a comment there)"
    add("--points", metavar="LIST", help=points)
    add("--as", dest="name", metavar="NAME", help="the name of the device in code (default: its id)")
    add("--single-file", action="store_true", default=SUPPRESS, help="c: all in one header")
    add("--wheel", action="store_true", default=SUPPRESS, help="python: wheels of the device and of the runtime")
    add(
        "--rows",
        action="store_true",
        default=SUPPRESS,
        help="c: Modbus points as rows of tables, in a header of their own",
    )
    without = "c: points and constants, without the code that builds frames"
    add("--no-frames", dest="frames", action="store_false", default=SUPPRESS, help=without)
    add("--project", type=some_path, metavar="FILE", help="the project file (default: fieldscribe.toml)")
    add("--check", action="store_true", help="write nothing; list what is missing, stale or edited")
    add("--depfile", type=some_path, metavar="FILE", help="write a make rule from outputs to inputs")
    add("--list-outputs", action="store_true", help="write nothing; print the paths of all outputs")
    add("--force", action="store_true", help="replace files in the way that fieldscribe did not make")
    add_format(parser)


def run_vendor(arguments: Namespace) -> int:
    """Deliver or compare, and return the exit code."""
    if arguments.more:
        each = f"call it once for each, or name them in {NAME}"
        hint = each if arguments.points is None else "put commas between points, as in --points A001,A002"
        raise StopError(f"one DEVICE is taken, and `{' '.join(arguments.more)}` is one more", hint)
    report, inputs = Report(), Inputs()
    orders = _orders(arguments, report, inputs)
    if report.has_errors:
        report_findings(report, arguments.format)
        return FINDINGS
    looks = arguments.check or arguments.list_outputs
    deliveries = deliver_all(orders, arguments.format, check=looks, force=arguments.force)
    if arguments.list_outputs:
        paths = (visible(str(delivery.order.out / path)) for delivery in deliveries for path in delivery.files)
        print(*paths, sep="\n")
        return FINE
    if not looks and arguments.depfile and all(delivery.is_current for delivery in deliveries):
        outputs = [delivery.order.out / path for delivery in deliveries for path in delivery.files]
        update_depfile(arguments.depfile, outputs, inputs.digests)
    left = leftovers(orders) if arguments.language is None else []
    return print_deliveries(deliveries, arguments.format, check=arguments.check, left=left)


def deliver_all(orders: list[Order], form: str, *, check: bool, force: bool) -> list[Delivery]:
    """Deliver or compare the files of all orders. Raises UnclearError."""
    deliveries: list[Delivery] = []
    refuse_duplicates(orders)
    for order in orders:
        try:
            deliveries.append(_deliver(order, check=check, force=force))
        except UnclearError:
            if deliveries:
                print_deliveries(deliveries, form, check=check)  # report what is already done
            raise
    return deliveries


def _deliver(order: Order, *, check: bool, force: bool) -> Delivery:
    try:
        return compare(order) if check else deliver(order, print_waiting, force=force)
    except ModuleNotFoundError as error:
        raise StopError(*order.request.extra) from error
    except OSError as error:
        where = error.filename or order.out
        hint = "move it away" if Path(where).is_dir() else "choose another folder, or a shorter name"
        if isinstance(error, NotADirectoryError):
            hint = "name a folder with --out"
        raise StopError(f"cannot write to {where}: {error.strerror or error}", hint) from error


def _orders(arguments: Namespace, report: Report, inputs: Inputs) -> list[Order]:
    """Return the orders of the command line or of the project file. Raises StopError."""
    if arguments.language is not None:
        if arguments.project is not None:
            raise StopError("--project is for `fieldscribe vendor` without LANGUAGE", "leave out one of them")
        return [_order(arguments, _request(arguments, inputs), arguments.device, arguments.out, inputs)]
    of_one = (arguments.out, arguments.points, arguments.name)
    if any(option is not None for option in of_one) or _switches(arguments):
        raise StopError("LANGUAGE and DEVICE are missing", "as in `fieldscribe vendor c hitachi_l200 --out drivers`")
    file = arguments.project or Path(NAME)
    try:
        project = read_project(file, report, inputs)
    except OSError as error:
        missing = isinstance(error, FileNotFoundError)
        hint = "write one, or say `fieldscribe vendor LANGUAGE DEVICE --out DIR`"
        raise StopError(f"there is no project file {file}" if missing else f"{file}: {error.strerror}", hint) from error
    orders: list[Order] = []
    for wanted in project:
        try:
            orders.append(_order(arguments, wanted.request, wanted.device, wanted.out, inputs))
        except UnclearError as error:
            if not error.message:
                raise  # the findings of the description are printed already
            report.error("bad-project", error.message, wanted.place, error.hint or None)
    return orders


def _order(arguments: Namespace, request: CodeRequest, device: str, out: Path | None, inputs: Inputs) -> Order:
    """Return an order, with its device loaded and its points checked. Raises UnclearError."""
    if device is None or out is None:
        raise StopError(f"{'DEVICE' if device is None else '--out DIR'} is missing", f"as in {_VENDOR_USAGE}")
    if request.name is not None:
        bad = None if re.fullmatch(ID.pattern, request.name) else "is no name: small letters, digits and _ make one"
        taken = bad or next(reasons(request.name), None)
        if taken:
            raise StopError(f"`{request.name}` {taken}")
    named = Namespace(device=device, descriptions=arguments.descriptions, format=arguments.format)
    opened = open_device(named, inputs)
    select(opened, request.chosen)
    for message in address_only_messages(opened, request.chosen):
        usage_error(message)
    return Order(opened.id, request, out, partial(request.contents, opened))


def _request(arguments: Namespace, inputs: Inputs) -> CodeRequest:
    """Return the request of the command line. Raises StopError."""
    language = arguments.language
    if language not in LANGUAGES:
        hint = f"there are {', '.join(LANGUAGES)}, as in {_VENDOR_USAGE}"
        raise StopError(f"`{language}` is not a language for code", hint)
    switches = _switches(arguments)
    for switch, of_language in LANGUAGE_OF.items():
        if switch in switches and language != of_language:
            option = "no-frames" if switch == "frames" else switch.replace("_", "-")
            raise StopError(f"--{option} is for {of_language}")
    points = _points(arguments.points, inputs)
    if arguments.points is not None and not points:
        raise StopError("--points names no point", "leave it out for all of them")
    return CodeRequest(language, points, arguments.name, **switches)


def _switches(arguments: Namespace) -> dict[str, bool]:
    """Return the switches that are given."""
    return {name: value for name, value in vars(arguments).items() if name in LANGUAGE_OF}


def _points(text: str | None, inputs: Inputs) -> tuple[str, ...]:
    """Return the words of `--points`, or of the file that it names. Raises StopError."""
    if text is None:
        return ()
    if text.startswith("@"):
        try:
            content = read_regular(text[1:], 1 << 20)
            inputs.note(Path(text[1:]), content)
            text = content.data.decode("utf-8-sig")
        except (OSError, ValueError) as error:
            why = getattr(error, "strerror", None) or "it is no UTF-8 text"
            raise StopError(f"cannot read {text[1:]}: {why}") from error
        text = ",".join(re.split(r"(?:^|\s)#", line)[0] for line in text.splitlines())
    return tuple(dict.fromkeys(word.strip() for word in text.split(",") if word.strip()))


def print_deliveries(deliveries: list[Delivery], form: str, *, check: bool, left: Sequence[Path] = ()) -> int:
    """Print the results, and return the exit code.

    `left` are files that the project file does not name; an earlier command may have requested them.
    """
    if form == "json":
        data: dict[str, object] = {"deliveries": [delivery.as_data() for delivery in deliveries]}
        print_json(data | ({"not_in_project": list(map(str, left))} if left else {}))
    for delivery in deliveries:
        if form == "text":
            _print_delivery(delivery, check=check)
        for path, reason in delivery.refused.items():
            usage_error(f"{delivery.order.out / path} is in the way: {reason}", delivery.plan.advice(path))
    if left and form == "text":
        print(*(f"not in the project file: {visible(str(path))}" for path in left), sep="\n")
        print("  hint: delete them if nobody needs them, or name their device and target there")
    return FINE if all(delivery.is_current for delivery in deliveries) else FINDINGS


def _print_delivery(delivery: Delivery, *, check: bool) -> None:
    out = delivery.order.out
    for what, paths in (
        ("missing", delivery.missing),
        ("edited by hand", delivery.edited),
        ("stale", delivery.stale),
        ("removed", delivery.removed),
        ("left in place, as it was edited by hand or is not ours", delivery.kept),
    ):
        for path in paths:
            print(f"{what}: {visible(str(out / path))}")
    wrong = len(delivery.missing) + len(delivery.edited) + len(delivery.stale) + len(delivery.refused)
    if check:
        print(f"{wrong} of {len(delivery.files)} files of {delivery.order.name} in {visible(str(out))} are not current")
    elif not delivery.refused:
        done = f"{len(delivery.written)} written, {len(delivery.removed)} removed"
        left = len(delivery.files) - len(delivery.written)
        print(f"{done}, {left} unchanged of {delivery.order.name} in {visible(str(out))}")


DOCS_EXAMPLE = """examples:
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


def add_docs_arguments(parser: ArgumentParser) -> None:
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


def run_docs(arguments: Namespace) -> int:
    """Write or compare the files; return the exit code."""
    if arguments.pages and arguments.format != "html":
        raise StopError("--pages is for --format html")
    if not arguments.devices and not arguments.pages:
        raise StopError("DEVICE is missing", "name devices, or say --pages for the pages of fieldscribe itself")
    devices: list[Device] = []
    code = FINE
    for name in chain.from_iterable(map(_devices_named, arguments.devices)):
        try:
            device = open_device(Namespace(device=name, descriptions=arguments.descriptions))
        except StopError as stop:
            code = max(code, stop.report())
            continue
        if device not in devices:  # it may be named by its id, and in its folder
            devices.append(device)
    has_index = arguments.format == "html" and (arguments.pages or len(devices) > 1)
    request = DocumentRequest(arguments.format, index=f"{INDEX}.html" if has_index else "")
    orders = [Order(device.id, request, arguments.out, partial(request.contents, device)) for device in devices]
    if has_index:
        orders.append(_index_order(arguments, devices))
    deliveries = deliver_all(orders, "text", check=arguments.check, force=arguments.force)
    return max(code, print_deliveries(deliveries, "text", check=arguments.check))


def _devices_named(name: str) -> list[str]:
    """Return the devices of a name: all devices of a folder, or the one with this name."""
    is_folder = bool(name) and Path(name).is_dir()  # an empty name would be the working folder
    files = find_devices([Path(name)], Report()) if is_folder else []
    return list(map(str, files)) if len(files) > 1 else [name]


def _index_order(arguments: Namespace, devices: list[Device]) -> Order:
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
