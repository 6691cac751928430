"""Many mutants in one program: a changed function holds its variants, and the environment chooses one when it runs."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from os.path import normpath
from typing import NamedTuple

from mutants.sources import Mutant, changed

CHOICE = "FIELDSCRIBE_MUTANT"
"""The variable of the environment: the number of a mutant, 0 for none."""

_BODIES = {
    "c": re.compile(r"^(?P<body>\{\n.*?^\})", re.MULTILINE | re.DOTALL),
    "rust": re.compile(
        r"^(?P<indent> *)(?:pub(?:\([\w:]+\))? )?(?:async )?fn (?:[^{;]|;(?!\n))*(?P<body>\{\n.*?^(?P=indent)\})",
        re.MULTILINE | re.DOTALL,
    ),
}
"""The functions whose body may choose when it runs: a `const fn` may not."""

CHOOSES = {
    "c": f"""\
extern char *getenv(const char *);
extern int atoi(const char *);
static int fieldscribe_mutant;
__attribute__((constructor)) static void fieldscribe_choose(void)
{{
    const char *number = getenv("{CHOICE}");
    fieldscribe_mutant = number ? atoi(number) : 0;
}}
""",
    "rust": f"""
#[doc(hidden)]
pub fn mutant() -> u32 {{
    extern crate std;
    static NUMBER: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    *NUMBER.get_or_init(|| std::env::var("{CHOICE}").ok().and_then(|text| text.parse().ok()).unwrap_or(0))
}}
""",
}
"""What reads the number, once a run."""


class Variant(NamedTuple):
    """The lines of a switched file in which a mutant stands."""

    first: int
    last: int
    number: int


def body_around(language: str, sound: str, mutant: Mutant) -> tuple[int, int] | None:
    """Where the body of the function stands that a mutant changes; None if it changes something else."""
    start, end = changed(sound, mutant.text)
    for found in _BODIES[language].finditer(sound) if language in _BODIES else ():
        if found.start("body") < start and end < found.end("body"):
            return found.span("body")
    return None


def switched(language: str, sound: str, path: str, mutants: Mapping[int, Mutant]) -> tuple[str, list[Variant]]:
    """Return a file that behaves as one of the mutants or as before, by the number; each changes a function's body."""
    by_body: dict[tuple[int, int], list[int]] = {}
    for number, mutant in mutants.items():
        body = body_around(language, sound, mutant)
        assert body is not None
        by_body.setdefault(body, []).append(number)
    made, variants, at = "", [], 0
    for (start, end), numbers in sorted(by_body.items()):
        made += sound[at:start] + "{\n"
        for number in numbers:
            first = made.count("\n") + 1
            text = mutants[number].text
            made += f"if {_chosen(language, path, number)} {text[start : end + len(text) - len(sound)]}\nelse "
            variants.append(Variant(first, made.count("\n"), number))
        made, at = f"{made}{sound[start:end]}\n}}", end
    return made + sound[at:], variants


def _chosen(language: str, path: str, number: int) -> str:
    if language == "c":
        return f"(fieldscribe_mutant == {number})"
    crate = "crate" if "fieldscribe_runtime/" in path else "::fieldscribe_runtime"
    return f"{crate}::transports::mutant() == {number}"


_ERRORS = {
    "c": re.compile(r"^([\w./-]+):(\d+):\d+: error:", re.MULTILINE),
    "rust": re.compile(r"^error.*\n +--> ([\w./-]+):(\d+):\d+$", re.MULTILINE),
}


def blamed(language: str, messages: str, variants: Mapping[str, list[Variant]]) -> Iterator[int]:
    """The numbers of the mutants in whose lines a compiler finds errors; in C the first may cause all others."""
    errors = _ERRORS[language].findall(messages)
    for path, line in errors[:1] if language == "c" else errors:
        found = normpath(path)
        for file, inside in variants.items():
            if file.endswith(found) or found.endswith(file):
                yield from (one.number for one in inside if one.first <= int(line) <= one.last)
