"""What the comments of generated code say of a point, in the same words in each language."""

from __future__ import annotations

import re

import pytest
from fieldscribe.pipeline import outputs
from support.described import described, loaded_in

POINTS = """\
- {name: mode, at: 1, access: r, enum: {3: remote}}
- {name: limit, at: 2, access: r, scale: raw = value * 10, unit: Hz}
- {name: exponent, at: 3, access: r, type: s16, range: -10..10}
- {name: voltage, at: 4, access: rw, type: f32, unit: V}
- {name: ratio, at: 6, access: rw, type: f32}
- {name: current, at: 8, access: r, scale: value = raw * 10 ** exponent, unit: A}
- {name: remote_only, at: 9, access: rw, when: mode == remote}
- {name: fast_only, at: 10, access: rw, when: limit > 60.5}
"""


@pytest.fixture(scope="module")
def comments(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The text of each language, each comment on one line."""
    device = loaded_in(tmp_path_factory.mktemp("drive"), described(POINTS))
    texts = {path: text for _, path, text in outputs(device, ("c", "python", "rust", "typescript"))}
    main = {"c": "c/made_up.h", "python": "python/made_up/points.py", "rust": "rust/made_up/src/points.rs"}
    main["typescript"] = "typescript/made_up/points.d.ts"
    return {language: re.sub(r"\n *(///|\*)? *", " ", texts[path]) for language, path in main.items()}


@pytest.mark.parametrize(
    ("language", "text"),
    [
        ("c", "voltage: any number in V; rw"),
        ("c", "ratio: any number; rw"),
        ("c", "current: raw 0..65535; values in A;"),
        ("c", "limit: 0..6553.5 Hz; 0.1 Hz a count; r"),
        ("python", "Voltage: any number in V."),
        ("python", "Ratio: any number."),
        *[("c", f"exists only when {text}") for text in ("mode == remote", "limit > 60.5")],
        *[("python", f"Exists only when {text}.") for text in ("mode == remote", "limit > 60.5")],
        ("typescript", "Voltage: any number in V."),
        *[("typescript", f"Exists only when {text}.") for text in ("mode == remote", "limit > 60.5")],
        *[("rust", f"exists only when `{text}`.") for text in ("mode == remote", "limit > 60.5")],
    ],
)
def test_comments_name_units_and_conditions(language: str, text: str, comments: dict[str, str]) -> None:
    assert text in comments[language]
