"""The views of commands with steps for the Modbus header."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from dataclasses import dataclass

from fieldscribe.model import SteppedCommand
from fieldscribe.targets.c.literals import hexadecimal, unsigned
from fieldscribe.targets.c.scope import HeaderScope
from fieldscribe.text import c_comment, upper
from fieldscribe.wording.steps import run_text, steps_texts

_WIDTH = 114


@dataclass(frozen=True, slots=True)
class SteppedView:
    """The tables of a command: its words, its steps, and the numbers of its arguments."""

    command: SteppedCommand
    steps: str
    macro: str

    @property
    def names(self) -> tuple[str, ...]:
        """The identifiers."""
        return self.steps, f"{self.steps}_words", f"{self.macro}_STEPS", *(name for name, _, _ in self.arguments)

    @property
    def comment(self) -> Iterator[str]:
        """The lines that say what it does."""
        texts = [f"{number}. {text}" for number, text in enumerate(steps_texts(self.command), 1)]
        for text in (f"{self.command.title['en']}: {run_text(self.command)}", *texts):
            yield from textwrap.wrap(c_comment(text), _WIDTH)

    @property
    def arguments(self) -> list[tuple[str, str, str]]:
        """The macro of each argument, its number, and what it may be."""
        ends = enumerate(self.command.arguments.items())
        return [(f"{self.macro}_{upper(name)}", f"{at}U", f"{low}..{high}") for at, (name, (low, high)) in ends]

    @property
    def words(self) -> Iterator[str]:
        """The rows of the words of all steps."""
        numbers = {name: at for at, name in enumerate(self.command.arguments)}
        for step in self.command.steps:
            for word in step.words:
                parts = hexadecimal(word.constant & 0xFFFF), hexadecimal(word.factor & 0xFFFF), hexadecimal(word.mask)
                yield f"{{{', '.join(parts)}, {numbers.get(word.argument or '', 0)}U}}"

    @property
    def rows(self) -> Iterator[str]:
        """The rows of the steps."""
        first = 0
        for step in self.command.steps:
            place = f"{hexadecimal(step.address)}, {len(step.words)}U"
            ways = ", ".join(f"{{{unsigned(function or 0)}, {place}}}" for function in (step.read, step.write))
            whether = ", ".join("true" if fact else "false" for fact in (step.when, step.base))
            yield f"{{{ways}, &{self.steps}_words[{first}], {unsigned(step.within or 0)}, {whether}}}"
            first += len(step.words)

    @property
    def case(self) -> str:
        """What the conformance program checks."""
        given = "".join(f'(uint16_t)fieldscribe_with(v, "{name}"), ' for name in self.command.arguments)
        return f'"{self.command.name}", {self.steps}, {{{given}0U}}'


def stepped_views(commands: tuple[SteppedCommand, ...], scope: HeaderScope) -> list[SteppedView]:
    """Return the views of the commands."""
    return [
        SteppedView(
            command, f"{scope.prefix}_command_{command.name}_steps", f"{scope.upper}_COMMAND_{upper(command.name)}"
        )
        for command in commands
    ]
