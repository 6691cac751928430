"""Titles of what a new edition adds: in the manual's language, and in English where that is known already."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.audit.editions.tables import yaml_text
from fieldscribe.audit.editions.tables.naming import Names, snake
from fieldscribe.language.nodes import Map, Seq

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from fieldscribe.resolve.analysis import Analysis

_ASKED_TITLE, _ASKED_NAME = yaml_text.question("en"), yaml_text.question("in English")


class Titles:
    """English words of the glossary and of the description's own titles; names that are taken."""

    def __init__(self, subject: Analysis, language: str, glossary: Mapping[str, str]) -> None:
        self.language = language
        self._english = {own: english for own, english in glossary.items() if language != "en"}
        if language != "en":
            self._english |= {own: english for file in subject.scope.files for own, english in _pairs(file, language)}
        self._asked: dict[str, None] = {}
        self._names = Names()
        for name in dict.fromkeys(resolved.facts.name for resolved in subject.resolved):
            self._names.give(name)

    def titled(self, text: str) -> str:
        """The titles of a text of the manual as YAML; English is asked for where nobody knows it."""
        if self.language == "en":
            return f"{{en: {yaml_text.text(text)}}}"
        own = f"{self.language}: {yaml_text.text(text)}}}"
        english = self._english.get(text.casefold())
        if english is None:
            self._asked[own] = None
            return f"{{{own}"
        return f"{{en: {yaml_text.text(english)}, {own}"

    def name(self, title: str, code: str) -> str:
        """A name that no point has: from the English title if there is one."""
        return self._names.give(snake(self._english.get(title.casefold(), title), snake(code, "point")), snake(code))

    def asking(self, lines: list[str], title: str) -> list[str]:
        """The lines with a question wherever English is missing."""
        knows = self.language == "en" or title.casefold() in self._english
        return [self._asks(line, knows=knows) for line in lines]

    def _asks(self, line: str, *, knows: bool) -> str:
        if line.lstrip(" -").startswith(("name: ", "group: ")):
            return line if knows else f"{line}  {_ASKED_NAME}"
        return f"{line}  {_ASKED_TITLE}" if any(own in line for own in self._asked) else line


def _pairs(value: Map | Seq, language: str) -> Iterator[tuple[str, str]]:
    """Every text in the manual's language that stands beside an English one, as in `title: {en: Mode, de: Modus}`."""
    if isinstance(value, Map):
        own, english = value.get(language), value.get("en")
        if isinstance(own, str) and isinstance(english, str):
            yield own.casefold(), english
    for item in value.values() if isinstance(value, Map) else value:
        if isinstance(item, Map | Seq):
            yield from _pairs(item, language)
