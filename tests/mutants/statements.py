"""Statements and conditions that are dropped."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence

from mutants.tokens import Token, line_starts, span

Edit = tuple[int, int, str]

_KEEPS = {
    "c": re.compile(r"(?:static|const|extern|typedef|struct|return [^;])|(?:\w+ )+\*?\w+(?:\[|;| =)|\}"),
    "rust": re.compile(r"(?:pub|let|const|static|type|use|fn|return)\b|\}|[\w:]+!"),
    "typescript": re.compile(r"(?:const|let|static|export|return [^;])|\}"),
}


def dropped(language: str, text: str, tokens: Sequence[Token]) -> Iterator[tuple[str, Edit]]:
    """What can be left out, and what stands there then."""
    if language == "python":
        yield from _python(text)
    else:
        yield from (("statement", edit) for edit in _statements(language, text, tokens))
        yield from (("condition", edit) for edit in _conditions(language, text, tokens))


def _statements(language: str, text: str, tokens: Sequence[Token]) -> Iterator[Edit]:
    """Whole lines with one simple statement inside a function."""
    for before, after in zip((None, *tokens), tokens, strict=False):
        start = text.rfind("\n", 0, after.start) + 1
        first_of_line = before is None or before.end <= start
        end = text.find("\n", after.end)
        line = text[after.start : end].partition(" /*")[0].partition(" //")[0].rstrip()
        indented = after.start - start >= (2 if language == "typescript" else 4)
        if first_of_line and indented and line.endswith(";") and not _KEEPS[language].match(line):
            simple = line.count(";") == 1 and (before is None or before.text in (";", "{", "}", ")", ":"))
            if simple and line.count("(") == line.count(")") and line.count("{") == line.count("}"):
                yield after.start, after.start + len(line), "" if language == "rust" else ";"


def _conditions(language: str, text: str, tokens: Sequence[Token]) -> Iterator[Edit]:
    """`if` never and always."""
    del text
    for place, token in enumerate(tokens):
        if token.text != "if" or (place and tokens[place - 1].text == "#"):
            continue
        end = _end_of_condition(language, tokens, place + 1)
        if end is not None:
            first, last = (tokens[place + 1], tokens[end]) if language == "rust" else (tokens[place + 2], tokens[end])
            never, always = ("false", "true") if language == "rust" else ("0", "1")
            yield first.start, last.end, never
            yield first.start, last.end, always


def _end_of_condition(language: str, tokens: Sequence[Token], start: int) -> int | None:
    """The last token of the condition; None for `if let` and for a guard of a match."""
    depth = 0
    for place in range(start, min(start + 120, len(tokens))):
        text = tokens[place].text
        if text in ("let", "=>", ";"):
            return None
        if language == "rust" and text == "{" and depth == 0:
            return place - 1
        depth += (text in "([") - (text in ")]")
        if language != "rust" and depth == 0:
            return place - 1
    return None


def _python(text: str) -> Iterator[tuple[str, Edit]]:
    starts, lines = line_starts(text), text.encode("utf-8").splitlines(keepends=True)
    for function in ast.walk(ast.parse(text)):
        if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        for node in ast.walk(function):
            if isinstance(node, ast.stmt) and _may_be_dropped(node):
                yield "statement", (*span(node, starts, lines), "pass")
            elif isinstance(node, ast.If | ast.IfExp):
                for after in ("False", "True"):
                    yield "condition", (*span(node.test, starts, lines), after)


def _may_be_dropped(node: ast.stmt) -> bool:
    """A call, an assignment to a part of something, and what leaves its place."""
    if isinstance(node, ast.Expr):
        return isinstance(node.value, ast.Call | ast.Await)
    if isinstance(node, ast.Assign):
        return isinstance(node.targets[0], ast.Attribute | ast.Subscript)
    return isinstance(node, ast.Raise | ast.Continue | ast.Break | ast.AugAssign)
