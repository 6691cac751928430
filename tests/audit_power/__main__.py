"""`make audit-power`: how many changed facts the audit reports, for each manual, and what it misses, by kind."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from fieldscribe.resources import descriptions_dir
from support.places import has_text

from audit_power.measure import measure

REPORTED, WITH_FACT = 0.95, 0.97
"""The marks: of 100 changes the plain audit reports 95, and `--old` shows 97 with the fact that cites them."""


def main() -> int:
    """Measure each manual that is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--manuals", type=Path, required=True, help="the folder with the manuals' texts")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200, help="the most facts to change of each manual")
    parser.add_argument("devices", nargs="*")
    arguments = parser.parse_args()
    known = sorted(path.parent.name for path in descriptions_dir().glob("*/device.yaml"))
    devices = arguments.devices or [device for device in known if has_text(device, arguments.manuals)]
    print(f"{'device':<18}{'facts':>7}{'changed':>9}{'reported':>10}{'listed':>9}{'with fact':>11}{'seconds':>9}")
    enough = True
    for device in devices:
        start = time.monotonic()
        power = measure(device, arguments.manuals, arguments.seed, arguments.count)
        reported, listed = power.share(power.missed), power.share(power.unlisted)
        with_fact = power.share(power.unlisted + power.without_fact)
        enough = enough and reported >= REPORTED and listed == 1 and with_fact >= WITH_FACT
        figures = f"{power.facts:>7}{len(power.changes):>9}{reported:>10.1%}{listed:>9.0%}{with_fact:>11.1%}"
        print(f"{device:<18}{figures}{time.monotonic() - start:>9.0f}", flush=True)
        for title, failed in (("missed", power.missed), ("without its fact", power.without_fact)):
            for kind, count in power.kinds(failed).most_common():
                print(f"    {title}: {count} x {kind}")
                for change in [change for change in failed if f"{change.fact.kind} of {change.fact.key}" == kind][:3]:
                    print(f"        {change.fact.subject}, line {change.line}: {change.was} > {change.now}")
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())
