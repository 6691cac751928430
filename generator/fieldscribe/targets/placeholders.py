"""Text templates: a text is laid out once, with placeholders for fields, and filled in for each point."""

import re
from collections.abc import Callable, Hashable, Iterable, Sequence
from operator import itemgetter

_PLACEHOLDERS = tuple(map(chr, range(0xFDD0, 0xFDF0)))
"""Unicode noncharacters: the encoders of `text` strip them, so no text of a description holds one."""

MOST_FIELDS = len(_PLACEHOLDERS)

_RUN = re.compile("([\ufdd0-\ufdef])\\1*")


def placeholders(fields: Iterable[str]) -> tuple[str, ...]:
    """Return a placeholder for each field, as wide as the field, so that line breaks are the same."""
    return tuple([_PLACEHOLDERS[number] * len(field) for number, field in enumerate(fields)])


class TextTemplate:
    """A text with placeholders. Two placeholders of the same field never touch."""

    def __init__(self, text: str) -> None:
        self._parts = [text] if text.isascii() else _RUN.split(text)
        self._chosen = _chooser([ord(sign) - 0xFDD0 for sign in self._parts[1::2]])

    def fill(self, fields: Sequence[str]) -> str:
        """Return the text with these fields, in the order in which the placeholders were made."""
        parts = self._parts.copy()
        parts[1::2] = self._chosen(fields)
        return "".join(parts)


class TextTemplates:
    """Texts that are laid out once for each key, and filled with fields."""

    def __init__(self) -> None:
        self._templates: dict[Hashable, TextTemplate] = {}

    def fill(self, key: Hashable, fields: Sequence[str], lay_out: Callable[[Sequence[str]], str]) -> str:
        """Return the text of a key with these fields; `lay_out` returns it with the fields or placeholders for them."""
        if len(fields) > MOST_FIELDS:
            return lay_out(fields)
        template = self._templates.get(key)
        if template is None:
            template = self._templates[key] = TextTemplate(lay_out(placeholders(fields)))
        return template.fill(fields)


def _chooser(numbers: list[int]) -> Callable[[Sequence[str]], Sequence[str]]:
    """Return a function that takes the fields of these numbers."""
    if len(numbers) > 1:
        return itemgetter(*numbers)
    return lambda fields: [fields[number] for number in numbers]
