"""What the manual prints in place of a fact that does not stand where it is cited."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.outcome import Unused
    from fieldscribe.audit.passage import Passage

_END_OF_CELL = re.compile(r"[|\t\n]|<br>")
_SECTION = re.compile(r"[0-9]+(?:\.[0-9]+)+")
_SHORT = 60
"""So many characters of a label are shown."""


def instead(claim: Claim, passages: Sequence[Passage], unused: Sequence[Unused]) -> str | None:
    """The words beside the number of a label, the other access or section, or the number there that no fact uses."""
    if claim.fact == "access":
        return next((word for passage in passages for word in printed_access(claim, passage.text)), None)
    if claim.beside:
        beside = (_beside(claim, passage) for passage in passages)
        return next((words for words in beside if words), None)
    if claim.fact == "code":
        return next((code for passage in passages for code in _codes_like(claim, passage.text)), None)
    if claim.fact == "section" and _SECTION.fullmatch(claim.words[0]):
        headings = (_SECTION.match(passage.text) for passage in passages)
        return next((heading[0] for heading in headings if heading), None)
    said = set(re.split(r"\.\.|[^\w.,]+", claim.shown))
    others = [number for number in unused if number.number not in said]  # its own numbers stand in no other's place
    if not others or not claim.numbers:
        return None
    return min(others, key=lambda number: (-_likeness(claim.shown, number.number), number.line, number.column)).number


def _codes_like(claim: Claim, text: str) -> list[str]:
    """The words that have the form of a code, such as a letter and three digits."""
    form = re.sub(r"[0-9]", "[0-9]", re.escape(claim.words[0]))
    return re.findall(rf"(?<!\w){form}(?!\w)", text)


def printed_access(claim: Claim, text: str) -> list[str]:
    """The notations of access in a text: this claim's and its rivals'."""
    notations = sorted((*claim.words, *claim.rivals), key=len, reverse=True)
    patterns = (rf"(?<!\w){re.escape(word)}(?!\w)" if word.isalnum() else re.escape(word) for word in notations)
    return re.findall("|".join(patterns), text)


def _beside(claim: Claim, passage: Passage) -> str | None:
    for token, end in zip(passage.tokens, passage.ends, strict=True):
        if token.readings & claim.beside:
            words = _END_OF_CELL.split(passage.text[end:], maxsplit=1)[0].strip(" .:=)-")
            if any(map(str.isalpha, words)):
                return words[:_SHORT]
    return None


def _likeness(left: str, right: str) -> int:
    """How many characters two numbers share from their beginning and from their end."""
    same = [first == second for first, second in zip(left, right, strict=False)]
    back = [first == second for first, second in zip(left[::-1], right[::-1], strict=False)]
    return (same.index(False) if False in same else len(same)) + (back.index(False) if False in back else len(back))
