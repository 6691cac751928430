"""The scripts of the pages as the compiler of TypeScript reads them, strictly; their types are in comments."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from fieldscribe.resources import templates_dir
from support.typescript_packages import compile_types

SOURCES = templates_dir() / "docs/page"


@pytest.mark.full(seconds=5)
def test_scripts_of_pages_have_types(tmp_path: Path) -> None:
    """All scripts together: a page joins some of them into one."""
    options: dict[str, object] = {
        "target": "ES2022",
        "lib": ["ES2022", "DOM", "DOM.Iterable"],
        "types": [],
        "moduleDetection": "legacy",
        "skipDefaultLibCheck": True,
    }
    options |= {"allowJs": True, "checkJs": True, "strict": True, "noImplicitReturns": True}
    files = [str(path) for path in sorted(SOURCES.glob("*.[jd]*s"))]
    (tmp_path / "tsconfig.json").write_text(json.dumps({"compilerOptions": options, "files": files}), "utf-8")
    assert compile_types(tmp_path) == ""
