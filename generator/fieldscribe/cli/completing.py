"""What may stand where a person is typing: commands, options, choices, devices, and points of the device before."""

from __future__ import annotations

import re
from argparse import ArgumentParser
from pathlib import Path
from typing import TYPE_CHECKING

from fieldscribe.cli import COMMANDS, command_of
from fieldscribe.cli.common import known_devices, roots
from fieldscribe.language.keys.forms import ID

if TYPE_CHECKING:
    from argparse import Action
    from collections.abc import Iterable, Sequence

_GENERAL = ("--help", "--version")


def candidates(typed: Sequence[str]) -> list[str]:
    """The words that may take the place of the last one; none where files may stand, or nothing is known."""
    *before, word = [text.strip() for text in _joined(typed)] or [""]
    if not before:
        return _beginning((*COMMANDS, *_GENERAL), word)
    if before[0] not in COMMANDS:
        return []
    return _Line(before[0], before[1:]).candidates(word)


def _joined(typed: Sequence[str]) -> list[str]:
    """The words, without the `=` that bash takes for a word of its own."""
    return [word for place, word in enumerate(typed) if word != "=" or place + 1 == len(typed)]


def _beginning(known: Iterable[str], word: str) -> list[str]:
    return [name for name in dict.fromkeys(known) if name.casefold().startswith(word.casefold())]


class _Line:
    """What is typed of a command, without the last word."""

    def __init__(self, command: str, before: list[str]) -> None:
        parser = ArgumentParser(prog=command, add_help=True)
        command_of(command).add_arguments(parser)
        actions: list[Action] = parser._actions  # argparse has no other way to ask
        self._options = {name: action for action in actions for name in action.option_strings}
        self._positionals = [action for action in actions if not action.option_strings]
        self._given: list[str] = []
        self._open: Action | None = None
        self._folder: Path | None = None
        for word in before:
            self._take(word)

    def _take(self, word: str) -> None:
        option = self._options.get(word)
        if self._open is not None:
            self._folder = Path(word) if self._open.dest == "descriptions" else self._folder
            self._open = None
        elif option is not None:
            self._open = option if option.nargs != 0 else None
        elif not word.startswith("-"):
            self._given.append(word)

    def candidates(self, word: str) -> list[str]:
        """What may stand behind it."""
        name, equals, value = word.partition("=")
        if equals and name in self._options:
            return [f"{name}={known}" for known in _beginning(self._known(self._options[name]), value)]
        if self._open is not None:
            return _beginning(self._known(self._open), "" if word == "=" else word)
        if word.startswith("-"):
            return _beginning(self._options, word)
        place = min(len(self._given), len(self._positionals) - 1)
        return _beginning(self._known(self._positionals[place]), word) if place >= 0 else []

    def _known(self, action: Action) -> Iterable[str]:
        """What an argument takes, as far as it is known."""
        if action.choices is not None:
            return [str(choice) for choice in action.choices]
        metavar = str(action.metavar or "")
        if metavar in ("DEVICE", "PATH"):
            return self._devices()
        if metavar in ("POINT", "WHAT"):
            return self._points()
        return [f"{name}=" for name in self._points()] if metavar.startswith("POINT=") else []

    def _devices(self) -> dict[str, Path]:
        """The devices, without folders whose names are no ids: they cannot be one word on a command line."""
        known = known_devices(roots() if self._folder is None else [self._folder])
        return {name: file for name, file in known.items() if re.fullmatch(ID.pattern, name)}

    def _points(self) -> Iterable[str]:
        """The names and codes of the points of the device that is named before."""
        from fieldscribe.search.summaries import outline_of

        known = self._devices()
        file = next((known[word] for word in self._given if word in known), None)
        outline = None if file is None else outline_of(file)
        return () if outline is None else outline.names
