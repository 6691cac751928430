"""`fieldscribe read`: read points of a device."""

from argparse import ArgumentParser, Namespace

from fieldscribe.cli.common import add_format, print_json
from fieldscribe.cli.live_options import LINES, add_live, add_points, add_unit, opened
from fieldscribe.cli.terminal import FINDINGS, FINE, print_lines
from fieldscribe.diagnostics import visible
from fieldscribe.live.readings import GOOD, Reader, Reading, chosen

EXAMPLE = f"""examples:
  fieldscribe read hitachi_l200 A020 F002 --line tcp://192.168.0.20
  fieldscribe read hitachi_l200 status --line "rtu:///dev/ttyUSB0?baud=19200" --unit 3
  fieldscribe read siemens_mm4 P1082 --line "uss:///dev/ttyUSB0?pkw=4&pzd=2" -v
  fieldscribe read woodward_mpu2s generator_frequency --line can://socketcan/can0 --format json
  fieldscribe read pump output_frequency   (a station of fieldscribe.toml)

{LINES}
fieldscribe.toml names lines and stations: [lines] bench = "tcp://192.168.0.20",
[stations.pump] description = "hitachi_l200", line = "bench", unit = 3

ends with 1 when a point has no value or the device refuses it, with 2 when the line or the device does not answer"""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_live(parser)
    add_points(parser)
    add_unit(parser)
    add_format(parser)


def run(arguments: Namespace) -> int:
    """Read points and print their values; return the exit code."""
    with opened(arguments) as live:
        what = chosen(live.model, arguments.points)
        with live.progress():
            readings = Reader(live.model, live.device).read(what)
        if arguments.format == "json":
            print_json({**live.head, "values": [reading.as_data() for reading in readings]})
        else:
            print_readings(readings)
    return FINE if all(reading.status in GOOD for reading in readings) else FINDINGS


def print_readings(readings: list[Reading]) -> None:
    """Print readings as a table of names and values."""
    width = max([len(reading.label) for reading in readings], default=0)
    print_lines(
        [
            [("", f"{visible(reading.label):<{width}}  "), (style_of(reading), visible(reading.text))]
            for reading in readings
        ]
    )


def style_of(reading: Reading) -> str:
    """Return the style in which a reading stands out."""
    return "" if reading.status == "ok" else "warning" if reading.status == "special" else "error"
