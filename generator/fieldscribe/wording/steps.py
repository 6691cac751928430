"""Texts of the steps of a command."""

from __future__ import annotations

from fieldscribe.model import Step, SteppedCommand, Word
from fieldscribe.model.steps import WHOLE_WORD
from fieldscribe.wording.exact import hex_text
from fieldscribe.wording.rules import Points, condition_text


def time_text(milliseconds: int) -> str:
    """Return a time as `500 ms` or `2 s`."""
    return f"{milliseconds} ms" if milliseconds % 1000 else f"{milliseconds // 1000} s"


def word_text(word: Word) -> str:
    """Return a word as a formula, and its bits if it has not all."""
    return str(word) if word.mask == WHOLE_WORD else f"{word} in the bits {hex_text(word.mask)}"


def step_text(step: Step) -> str:
    """Return what a step writes where and how, or what it waits for."""
    words = ", ".join(map(word_text, step.words))
    says = "" if step.says == words else f"{step.says}: "
    where = f"{step.space} {step.address} ({hex_text(step.address)}){f' from {step.base}' if step.base else ''}"
    if step.write is None:
        how = f"with function {hex_text(step.read or 0, 2)} until it is {words}"
        return f"{says}read {where} {how}, for {time_text(step.within or 0)}"
    kept = "" if step.read is None else f", read with function {hex_text(step.read, 2)} before"
    return f"{says}write {words} to {where} with function {hex_text(step.write, 2)}{kept}"


def steps_texts(command: SteppedCommand, points: Points | None = None) -> list[str]:
    """Return the steps of a command in order, each with its condition."""
    whens = [f"; only when {condition_text(step.when, points)}" if step.when else "" for step in command.steps]
    return [f"{step_text(step)}{when}" for step, when in zip(command.steps, whens, strict=True)]


def run_text(command: SteppedCommand) -> str:
    """Return when a command is given, and with which arguments."""
    run = command.run if command.every is None else f"every {time_text(command.every)}, by caller"
    return ", ".join([run, *(f"{name} {low}..{high}" for name, (low, high) in command.arguments.items())])
