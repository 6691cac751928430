"""What may be changed in a source: one entry for each place, with the changes that can be made there."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from mutants.rewriting import rewritten, unjudged
from mutants.statements import dropped
from mutants.tokens import Token, for_people, line_starts, tokens_of


@dataclass(frozen=True, slots=True)
class Change:
    """`after` takes the place of the characters from `start` to `end`."""

    what: str
    start: int
    end: int
    after: str

    def applied(self, text: str) -> str:
        """The changed text."""
        return text[: self.start] + self.after + text[self.end :]


Places = dict[str, list[list[Change]]]
"""The changes of each place, by what is changed."""

_SWAPS = {
    before: after
    for pair in (
        *("+ -", "- +", "* +", "% *", "/ *", "// *", "+= -=", "-= +=", "<< >>", ">> <<"),
        *("< <=", "<= <", "> >=", ">= >", "== !=", "!= ==", "=== !==", "!== ===", "&& ||", "|| &&", "and or", "or and"),
        *("& |", "| &", "^ |", "&= |=", "|= &=", "^= |="),
    )
    for before, after in [pair.split()]
}
_TRUTH = {"true": "false", "false": "true", "True": "False", "False": "True"}
_ENDS_A_VALUE = re.compile(r"[\w)\]\"']$")


def places_of(language: str, text: str) -> Places:
    """Everything that can be changed in a source."""
    return _of_generator(text) if language == "generator" else _of_tokens(language, text)


def _of_generator(text: str) -> Places:
    """As Python, and what more can be changed where the compiler itself is judged, but for what cannot happen."""
    found, hidden = _of_tokens("python", text), [*for_people(text, line_starts(text)), *unjudged(text)]
    for what, start, end, after in rewritten(text):
        found.setdefault(what, []).append([Change(what, start, end, after)])
    judged = {
        what: [place for place in places if not any(low <= place[0].start < high for low, high in hidden)]
        for what, places in found.items()
    }
    return {what: places for what, places in judged.items() if places}


def _of_tokens(language: str, text: str) -> Places:
    tokens = tokens_of(language, text)
    found: Places = {}
    for change in (
        *_numbers(tokens),
        *_operators(text, tokens),
        *_truths(tokens),
        *_strings(text, tokens),
        *_swapped_rows(text, tokens),
        *_exchanged_names(language, text, tokens),
        *([Change(what, *edit)] for what, edit in dropped(language, text, tokens)),
    ):
        if change:
            found.setdefault(change[0].what, []).append(change)
    return found


def _numbers(tokens: Sequence[Token]) -> Iterator[list[Change]]:
    for place, token in enumerate(tokens):
        if token.kind == "number" and not _sizes_a_parameter(tokens[place - 3 : place + 3]):
            yield [Change("number", token.start, token.end, after) for after in numbers_near(token.text)]


def _sizes_a_parameter(around: Sequence[Token]) -> bool:
    """`uint16_t words[4],` of a function in C: the number means nothing to the language."""
    texts = [one.text for one in around]
    return len(texts) == 6 and texts[2] == "[" and texts[4] == "]" and texts[5] in ",)" and around[0].kind == "name"


def numbers_near(text: str) -> list[str]:
    """Other numbers in the same notation: one more, one less, zero, and two with one bit flipped."""
    found = re.fullmatch(r"(0[xX])?([0-9A-Fa-f_]+?|[\d_]+)([uUlL]+|[iu](?:8|16|32|64|128|size)|n)?", text)
    if found is None:
        return _fractions_near(text)
    base = 16 if found[1] else 10
    try:
        number = int(found[2].replace("_", ""), base)
    except ValueError:
        return []
    wanted = {number + 1, number - 1, 0, number ^ 1 << max(number.bit_length() - 1, 0), number ^ 4} - {number, -1}
    width = len(found[2].replace("_", ""))
    shown = (f"{one:0{width}X}" if base == 16 else str(one) for one in sorted(wanted))
    return [f"{found[1] or ''}{one}{found[3] or ''}" for one in shown]


def _fractions_near(text: str) -> list[str]:
    found = re.fullmatch(r"(\d+\.)(\d+)(.*)", text)
    return [f"{found[1]}{int(found[2]) + 1}{found[3]}"] if found else []


def _operators(text: str, tokens: Sequence[Token]) -> Iterator[list[Change]]:
    for before, token in pairwise(tokens):
        if token.text in _SWAPS and _binary(text, before, token):
            yield [Change("operator", token.start, token.end, _SWAPS[token.text])]
        elif _is_sign(text, token) or _negates(before, token, text[before.end : token.start]):
            yield [Change("operator", token.start, token.end, "")]


def _is_sign(text: str, token: Token) -> bool:
    return token.text == "-" and text[token.end : token.end + 1].isalnum()


def _negates(before: Token, token: Token, between: str) -> bool:
    return token.text in ("!", "~", "not") and "\n" not in between and before.text not in ("is", "#", "]")


def _binary(text: str, before: Token, token: Token) -> bool:
    """Whether the operator stands between two values: with a space on each side, after something that is a value."""
    spaced = text[token.start - 1 : token.start].isspace() and text[token.end : token.end + 1].isspace()
    return spaced and bool(_ENDS_A_VALUE.search(before.text)) and before.text not in ("return", "in", "=")


def _truths(tokens: Iterable[Token]) -> Iterator[list[Change]]:
    for token in tokens:
        if token.kind == "name" and token.text in _TRUTH:
            yield [Change("truth", token.start, token.end, _TRUTH[token.text])]


_NAME = re.compile(r"""(b?["'])([^\s{}\\"']+)(["'])""")


def _strings(text: str, tokens: Sequence[Token]) -> Iterator[list[Change]]:
    """A name in a string with another last letter, and without its first one; texts with spaces are for people."""
    for token in tokens:
        found = _NAME.fullmatch(token.text) if token.kind == "string" else None
        if found is None or text[token.start - 1] in "rfRF":
            continue
        last = "x" if found[2][-1] != "x" else "y"
        others = (found[2][:-1] + last, found[2][1:]) if len(found[2]) > 1 else (last,)
        yield [Change("name in a string", token.start, token.end, found[1] + one + found[3]) for one in others]


def _swapped_rows(text: str, tokens: Sequence[Token]) -> Iterator[list[Change]]:
    """Neighbouring lines of one shape exchange one literal."""
    lines = [line[:-1] if line and line[-1].text == "," else line for line in _by_line(text, tokens)]
    for first, second in pairwise(lines):
        if len(first) != len(second) or any(_shape(a) != _shape(b) for a, b in zip(first, second, strict=True)):
            continue
        pairs = [
            (a, b)
            for a, b in zip(first, second, strict=True)
            if a.kind in ("number", "string") and a.text != b.text and not _same_number(a, b)
        ]
        if pairs:
            yield [
                Change("neighbours", a.start, b.end, b.text + text[a.end : b.start] + a.text)
                for a, b in pairs
                if " " not in a.text + b.text
            ]


def _same_number(one: Token, other: Token) -> bool:
    """Whether two literals are one number in two notations, as `0U` and `0x0000U`."""
    digits = [token.text.rstrip("UuLl").replace("_", "") for token in (one, other)]
    try:
        return one.kind == "number" and int(digits[0], 0) == int(digits[1], 0)
    except ValueError:
        return False


def _by_line(text: str, tokens: Iterable[Token]) -> Iterator[list[Token]]:
    line: list[Token] = []
    for token in tokens:
        if line and "\n" in text[line[-1].end : token.start]:
            yield line
            line = []
        line.append(token)
    yield line


def _shape(token: Token) -> str:
    return token.text if token.kind == "operator" else token.kind


_TWINS = {
    name: {twin} for one, other in (("F32", "U32"), ("F64", "U64")) for name, twin in ((one, other), (other, one))
}
"""Wire types of TypeScript that are the same but for their names."""


def _exchanged_names(language: str, text: str, tokens: Sequence[Token]) -> Iterator[list[Change]]:
    """A named constant (a status, a type, a member) gives way to another one of the same family in this file."""
    family = {"c": _c_families, "rust": _rust_families}.get(language, _python_families)(text, tokens)
    members: dict[str, list[str]] = {}
    for token, of in family:
        members.setdefault(of, []).append(token.text)
    for token, of in family:
        others = sorted(set(members[of]) - {token.text} - _TWINS.get(token.text, set()))
        yield [Change("named constant", token.start, token.end, other) for other in others[:12]]


Family = list[tuple[Token, str]]


def _c_families(text: str, tokens: Sequence[Token]) -> Family:
    """Uses of enumerators, by the enum that declares them: the ones with no `=` or `,` at once behind them."""
    owner: dict[str, str] = {}
    for place, body in enumerate(re.findall(r"enum[^{;]*\{(.*?)\}", text, re.DOTALL)):
        owner |= {name: str(place) for name in re.findall(r"^\s*([A-Z]\w+)(?: = |,|$)", body, re.MULTILINE)}
    return [
        (token, owner[token.text])
        for token, after in pairwise(tokens)
        if token.text in owner and after.text != "=" and not _declares(text, token)
    ]


def _declares(text: str, token: Token) -> bool:
    line = text[text.rfind("\n", 0, token.start) + 1 : text.find("\n", token.end)]
    return re.fullmatch(r"\s*\w+( = [^;]+)?,?\s*(/\*.*)?", line) is not None


def _rust_families(text: str, tokens: Sequence[Token]) -> Family:
    """Members behind `Type::`, by the type."""
    del text
    fours = zip(tokens, tokens[1:], tokens[2:], tokens[3:], strict=False)
    return [
        (member, owner.text)
        for owner, colons, member, behind in fours
        if colons.text == "::" and owner.text[:1].isupper() and member.text[:1].isupper() and behind.text != "<"
    ]


def _python_families(text: str, tokens: Sequence[Token]) -> Family:
    """Errors that are raised, names in capitals, members behind a class or module name, and classes that are called."""
    del text
    found: Family = []
    for before, token, after in zip(tokens, tokens[1:], tokens[2:], strict=False):
        if token.kind != "name" or before.text in ("class", "def", "extends", "instanceof") or after.text in ("=", ":"):
            continue
        if token.text.endswith("Error"):
            found.append((token, "error"))
        elif re.fullmatch(r"[A-Z][A-Z0-9_]+", token.text):
            found.append((token, f"constant of {before.text if before.text == '.' else ''}"))
        elif token.text[0].isupper() and after.text == "(":
            found.append((token, "class"))
        elif token.text[0].isupper() and before.text == ".":
            found.append((token, "member"))
    return found
