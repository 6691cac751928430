"""Source text of C, Rust, Python and JavaScript as tokens with their places; what is for people is left out."""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Token:
    """A word of the language: a number, a string, a name or an operator."""

    kind: str
    text: str
    start: int
    end: int


_OPERATORS = (
    r"===|!==|\?\?|\?\.|<<=|>>=|\.\.=|\.\.|<<|>>|<=|>=|==|!=|&&|\|\||->|=>|::|\+=|-=|\*=|/=|\|=|&=|\^="
    r"|[-+*/%<>=!&|^~?:;,.(){}\[\]#@$]"
)
_LEFT_OUT = {
    "c": r"^extern \"C\"|/\*.*?\*/|//[^\n]*|^[ \t]*\#(?!\s*define)(?:\\\n|[^\n])*|\#\s*define[ \t]+\w+(?:\([^)]*\)|$)?",
    "rust": r"/\*.*?\*/|//[^\n]*|\#!?\[[^\]]*\]|^[ ]*(?:pub )?(?:use|mod|extern)\b[^;{]*;|'\w+\b(?!')",
    "typescript": r"/\*.*?\*/|//[^\n]*|`[^`]*`|^(?:import|export \*)[^;]*;|(?:(?<=[=:] )|(?<=\())/(?![ /*])[^/\n]+/\w*",
}
_LEXERS = {
    language: re.compile(
        rf"(?P<skip>{skip})|(?P<string>b?\"(?:\\.|[^\"\\])*\"|b?'(?:\\.|[^'\\])')"
        rf"|(?P<number>\b(?:0[xX][0-9A-Fa-f_]+|\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][-+]?\d+)?)\w*)"
        rf"|(?P<name>[A-Za-z_]\w*)|(?P<operator>{_OPERATORS})",
        re.DOTALL | re.MULTILINE,
    )
    for language, skip in _LEFT_OUT.items()
}


def tokens_of(language: str, text: str) -> list[Token]:
    """All tokens that may be changed, in their order."""
    if language == "python":
        return list(_python(text))
    if language == "rust":
        text = text.partition("#[cfg(test)]")[0]
    found = _LEXERS[language].finditer(text)
    return [Token(str(one.lastgroup), one[0], *one.span()) for one in found if one.lastgroup != "skip"]


def _python(text: str) -> Iterator[Token]:
    starts = line_starts(text)
    hidden = list(for_people(text, starts))
    kinds = {tokenize.NUMBER: "number", tokenize.STRING: "string", tokenize.NAME: "name", tokenize.OP: "operator"}
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        start = starts[token.start[0] - 1] + token.start[1]
        if token.type in kinds and not any(low <= start < high for low, high in hidden):
            yield Token(kinds[token.type], token.string, start, start + len(token.string))


def for_people(text: str, starts: list[int]) -> Iterator[tuple[int, int]]:
    """The places of docstrings, imports, annotations, decorators and what exists for the type checker alone."""
    lines = text.encode("utf-8").splitlines(keepends=True)
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.stmt) and _isfor_people(node):
            yield span(node, starts, lines)
        typed = (getattr(node, "annotation", None), getattr(node, "returns", None))
        for noted in (*typed, *getattr(node, "decorator_list", ())):
            if isinstance(noted, ast.expr):
                yield span(noted, starts, lines)


def _isfor_people(node: ast.stmt) -> bool:
    if isinstance(node, ast.Expr):
        return isinstance(node.value, ast.Constant)
    if isinstance(node, ast.If):
        return isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
    if isinstance(node, ast.Assign):
        return _is_literal_type(node.value) or _is_type_variable(node.value) or _only_typed(node.targets[0])
    return isinstance(node, ast.Import | ast.ImportFrom)


def _only_typed(target: ast.expr) -> bool:
    return isinstance(target, ast.Name) and target.id in ("__all__", "__slots__")


def _is_literal_type(value: ast.expr) -> bool:
    return isinstance(value, ast.Subscript) and isinstance(value.value, ast.Name) and value.value.id == "Literal"


def _is_type_variable(value: ast.expr) -> bool:
    return isinstance(value, ast.Call) and isinstance(value.func, ast.Name) and value.func.id == "TypeVar"


def span(node: ast.expr | ast.stmt, starts: list[int], lines: list[bytes]) -> tuple[int, int]:
    """Where a node of Python stands, in characters (the parser counts bytes)."""
    assert node.end_lineno is not None
    assert node.end_col_offset is not None
    first = starts[node.lineno - 1] + len(lines[node.lineno - 1][: node.col_offset].decode("utf-8"))
    last = starts[node.end_lineno - 1] + len(lines[node.end_lineno - 1][: node.end_col_offset].decode("utf-8"))
    return first, last


def line_starts(text: str) -> list[int]:
    """Where each line starts."""
    result = [0]
    for line in text.splitlines(keepends=True):
        result.append(result[-1] + len(line))
    return result
