"""Runs the conformance vectors of a device against its generated Python package.

    python tests/conformance <folder of the packages> <device> <vectors.txt>

Prints one line per kind and a total; ends with 1 if any vector failed or none passed. It uses the code as users do.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path[0] = str(Path(__file__).resolve().parents[1])


def main(arguments: list[str]) -> int:
    """The command line."""
    from conformance.running import run

    if len(arguments) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    passed, failed, shown = run(Path(arguments[0]), arguments[1], Path(arguments[2]), show=20)
    for vector in shown:
        print(vector, file=sys.stderr)
    for kind in dict.fromkeys((*passed, *failed)):
        print(f"{kind} {passed[kind]} passed, {failed[kind]} failed")
    print(f"total {passed.total()} passed, {failed.total()} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
