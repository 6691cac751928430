"""Pages for tests, and what the index and the pages of such a folder are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from fieldscribe.diagnostics import Report
from fieldscribe.model import Device
from fieldscribe.pages.site import load_pages, site_files
from fieldscribe.resources import render

HOSTILE = """# <script>alert(1)</script> \u202e"x" & `<b>`

<img src=x onerror=alert(1)> [run](javascript:alert(1)) ![picture](https://example.org/x.png)

<!-- a mark of ours -->
| key | what |
|---|---|
| `a.<any>` | <i>first</i> |
| `a.<any>` | the next |

## Twice
## Twice
"""


def made(root: Path, devices: Sequence[Device] = (), **files: str) -> tuple[dict[str, str], Report]:
    """The files of an index of these devices and pages, by path; links may lead to the L200, too."""
    (root / "descriptions").mkdir(parents=True)
    for name, text in files.items():
        (root / f"{name}.md").write_text(text, "utf-8")
    report = Report()
    shelves = load_pages(["hitachi_l200"], report, root)
    return dict(site_files(devices, shelves, "fieldscribe docs", render)), report
