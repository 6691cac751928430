"""Reads a template of wb-mqtt-serial (JSON with comments, or rendered from Jinja), and the values in it."""

import json
import re
import subprocess
import sys
from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any, TypeAlias

from fieldscribe.importing.draft_text import named_numbers, titles_text
from fieldscribe.importing.readers import UnreadableError
from fieldscribe.importing.wb import rendering
from fieldscribe.safe_files import read_regular
from fieldscribe.text import line

PROTOCOLS = ("modbus", "modbus_io")
"""The protocols of readable templates; that of modules in slots comes second."""
MOST_BYTES = 16 << 20
_HINT = "templates are those of wb-mqtt-serial"
_WALL_SECONDS = 60
_LINT = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)


def read_template(path: Path) -> dict[str, Any]:
    """Return the object that a template holds; its numbers are int or Fraction. Raises UnreadableError, OSError."""
    text = _text(path)
    plain = _LINT.sub(lambda match: match[1] or re.sub(r"[^\n]", "", match[0]), text)
    try:
        read = json.loads(plain, parse_float=_number, parse_constant=_number)
    except json.JSONDecodeError as error:
        place, where = f", in line {error.lineno} as rendered", 0
        if path.suffix != ".jinja":
            place, where = "", error.lineno
        raise UnreadableError(f"this is no JSON: {error.msg}{place}", where, _HINT) from error
    except (RecursionError, ValueError) as error:
        raise UnreadableError(f"this is no JSON: {line(str(error))[:200]}", hint=_HINT) from error
    if not isinstance(read, dict) or not isinstance(read.get("device"), dict):
        raise UnreadableError("this is no template: there is no `device`", hint=_HINT)
    if (protocol := read["device"].get("protocol", PROTOCOLS[0])) not in PROTOCOLS:
        hint = f"templates with {' or '.join(PROTOCOLS)} are read"
        raise UnreadableError(f"the protocol is {line(str(protocol))[:40]}", hint=hint)
    return read


def in_slots(body: Mapping[str, Any]) -> bool:
    """Return True for modules whose addresses depend on their slot."""
    return body.get("protocol") == PROTOCOLS[1]


def _number(text: str) -> Fraction:
    if len(text) > 40 or not re.fullmatch(r"-?[0-9.]+(?:[eE][-+]?[0-9]{1,3})?", text):
        raise ValueError(f"{text[:40]} is no number")
    return Fraction(text)


def _text(path: Path) -> str:
    data = read_regular(path, MOST_BYTES).data
    if path.suffix == ".jinja":
        data = _rendered(path)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise UnreadableError("this is no UTF-8") from error


def _rendered(path: Path) -> bytes:
    """Return the text of a Jinja template, rendered in a separate process. Raises UnreadableError if that fails."""
    command = [sys.executable, "-I", rendering.__file__, str(path.absolute())]
    try:
        ended = subprocess.run(command, capture_output=True, timeout=_WALL_SECONDS, check=False)  # noqa: S603 # all ours
    except subprocess.TimeoutExpired as error:
        raise UnreadableError(f"the template is not rendered after {_WALL_SECONDS} s") from error
    if ended.returncode == 0:
        return ended.stdout
    if ended.returncode < 0:
        raise UnreadableError(f"the template is not rendered after {rendering.SECONDS} s of a processor")
    reason = line(ended.stderr.decode("utf-8", "replace").strip().rpartition("\n")[2])[:200]
    raise UnreadableError(f"the template does not render: {reason}")


Labels: TypeAlias = dict[int, str]
"""The names of raw numbers."""


class Texts:
    """The texts of a template, which are English or keys of its translations."""

    def __init__(self, translations: Any) -> None:
        read = translations if isinstance(translations, dict) else {}
        self._texts = {
            language: texts
            for language, texts in read.items()
            if re.fullmatch("[a-z]{2}", language) and isinstance(texts, dict)
        }

    def english(self, key: str) -> str:
        """Return the English text."""
        return str(self._texts.get("en", {}).get(key, key))

    def others(self, key: str) -> dict[str, str]:
        """Return the texts in other languages."""
        found = {language: texts.get(key) for language, texts in self._texts.items() if language != "en"}
        return {language: str(text) for language, text in found.items() if text and str(text) != self.english(key)}


def objects(value: Any) -> list[dict[str, Any]]:
    """Return the objects of a list; empty for anything else."""
    return [each for each in value if isinstance(each, dict)] if isinstance(value, list) else []


def whole_of(value: Any) -> int | None:
    """Return a whole number of a template; None for anything else."""
    number = number_of(value)
    return None if number is None or number.denominator != 1 else int(number)


def number_of(value: Any) -> Fraction | None:
    """Return a number of a template (5, 0.1, "0x1F"); None for anything else."""
    if isinstance(value, int | Fraction) and not isinstance(value, bool):
        return Fraction(value)
    text = str(value).strip()
    if re.fullmatch("0[xX][0-9a-fA-F]{1,16}", text):
        return Fraction(int(text, 16))
    return Fraction(text) if re.fullmatch(r"-?[0-9]{1,20}(?:\.[0-9]{1,20})?", text) else None


def labels_text(labels: Labels, texts: Texts) -> str:
    """Return the names of numbers as the block of an `enum`."""
    english = {number: texts.english(label) for number, label in labels.items()}
    return named_numbers(
        (number, english[number], str(abs(number)), titles_text(english[number], texts.others(label))[1:-1])
        for number, label in labels.items()
    )
