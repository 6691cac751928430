"""`make audit-power`: a table of how many changed facts the audit reports, for each manual, and what it misses."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from fieldscribe.resources import descriptions_dir

from audit_power.measure import measure


def main() -> int:
    """Measures each manual that is there."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--manuals", type=Path, required=True, help="the folder with the manuals' texts")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200, help="so many claims of each manual")
    parser.add_argument("devices", nargs="*")
    arguments = parser.parse_args()
    devices = arguments.devices or sorted(path.parent.name for path in descriptions_dir().glob("*/device.yaml"))
    print(f"{'device':<20}{'claims':>8}{'changed':>9}{'reported':>10}{'share':>8}{'seconds':>9}")
    enough = True
    for device in devices:
        start = time.monotonic()
        power = measure(device, arguments.manuals, arguments.seed, arguments.count)
        seconds = time.monotonic() - start
        share = power.reported / max(1, power.changed)
        enough = enough and share >= 0.98
        print(f"{device:<20}{power.claims:>8}{power.changed:>9}{power.reported:>10}{share:>8.1%}{seconds:>9.0f}")
        for change in power.missed:
            claim = f"{change.claim.subject}: {change.claim.fact} {change.claim.shown}"
            print(f"    missed: {change.kind}: {claim}: {change.shown}")
    return 0 if enough else 1


if __name__ == "__main__":
    sys.exit(main())
