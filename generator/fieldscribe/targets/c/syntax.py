"""C as this target writes it: types and literals, and functions, on one line if they fit, else on as many as needed."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache
from typing import NamedTuple

from fieldscribe.arithmetic.exact import pattern_of
from fieldscribe.arithmetic.words import INT32, INT64, UINT64
from fieldscribe.model import Point
from fieldscribe.resources import Render
from fieldscribe.targets.placeholders import placeholders

# Types and literals.


VALUE_BOUNDS = {"int32_t": INT32, "int64_t": INT64, "uint64_t": UINT64}
"""The bounds of the types in which values and counts are passed."""

_PATTERNS = {"f32": "u32", "f64": "u64", "text": "u16"}
"""The types that hold floating-point patterns, and one word of a text."""


def wire_kind(point: Point) -> str:
    """Return the type of a point's raw number (of a text: of one word), as the runtime names layouts: `u16`, `bit`."""
    return _PATTERNS.get(point.type, point.type)


def raw_kind(point: Point) -> str:
    """Return the type of a point's raw number, as in the names of the runtime's cores: `u16`, `bool`."""
    return "bool" if point.type == "bit" else wire_kind(point)


def raw_type(point: Point) -> str:
    """Return the C type of a point's raw number (of a text: of one word)."""
    kind = raw_kind(point)
    return kind if kind == "bool" else f"{'int' if kind[0] == 's' else 'uint'}{kind[1:]}_t"


def cast(kind: str, number: str) -> str:
    """Return a number as another type."""
    return f"({kind}){number}" if number.isidentifier() else f"({kind})({number})"


def sign_and_size(point: Point) -> tuple[str, str]:
    """Return two expressions: whether `raw` is negative, and its magnitude."""
    if not point.info.signed:
        return "false", "raw"
    return "raw < 0", "fieldscribe_magnitude(raw)"


@lru_cache(maxsize=65536)
def signed(number: int) -> str:
    """Return a number as a constant for any expression or `#define`, signed if a signed type can hold it."""
    if number > INT64[1]:
        return f"UINT64_C({number})"
    if number >= 0:
        return str(number)
    return f"({number})" if number > INT64[0] else f"({number + 1} - 1)"


@lru_cache(maxsize=65536)
def bare(number: int) -> str:
    """Return a number as a signed constant without brackets, for comparisons and arguments."""
    return str(number) if INT64[0] < number <= INT64[1] else signed(number)


@lru_cache(maxsize=65536)
def unsigned(number: int) -> str:
    """Return a number of 0 or more as an unsigned constant."""
    return f"{number}U" if number < 1 << 32 else f"UINT64_C({number})"


@lru_cache(maxsize=65536)
def hexadecimal(number: int, digits: int = 4) -> str:
    """Return an address or mask as an unsigned constant: `0x1028U`."""
    return f"0x{number:0{digits}X}U" if number < 1 << 32 else f"UINT64_C(0x{number:0{digits}X})"


def float_order(value: float, bits: int) -> int:
    """Return the rank of the nearest binary32 or binary64 among all numbers of its type; 0 and -0 have rank 0."""
    infinity = 0x7F80_0000 if bits == 32 else 0x7FF0 << 48
    try:
        size = min(pattern_of(abs(value), bits), infinity - 1)
    except OverflowError:
        size = infinity - 1
    return -size if value < 0 else size


def real(number: Fraction) -> str:
    """Return the nearest binary64 number as a constant that converts back to the same bits."""
    return repr(number.numerator / number.denominator)


# Functions and lines.


WIDTH = 120
"""The longest line."""

INLINE = "static inline"
STATUS = "FIELDSCRIBE_STATUS"
"""The heads of functions: of one that cannot fail, before its result type, and of one that returns a status."""

_LAST = 100
"""Added to the depth of a break after an opening bracket, so that it is the last choice."""

_DEEPER = "    "
_WHOLE = re.compile(r'"(?:[^"\\]|\\.)*"| ')
"""A string, which must not be broken, or a space, where a line may be broken."""

_SIGNS = re.compile(r'"[^"]*"|[()\[\]{}]|,(?= )| (?:\?|:|\|\||&&)(?= )')
"""A string, a bracket, a comma or an operator."""


class Function(NamedTuple):
    """A function as it stands in the header; FIELDSCRIBE_NO_FLOAT leaves `floating` ones out."""

    name: str
    text: str
    floating: bool = False


def function(head: str, name: str, parameters: Sequence[str], *statements: str, floating: bool = False) -> Function:
    """Return a function whose body is one or two statements."""
    start = f"{head}{'' if head.endswith('*') else ' '}{name}("
    signature = f"{start}{', '.join(parameters) or 'void'})"
    body = f"{{ {' '.join(statements)} }}"
    if len(signature) > WIDTH:
        signature = "\n".join((start, *filled(parameters, ", ", "    ", ")")))
    elif len(signature) + 1 + len(body) <= WIDTH:
        return Function(name, f"{signature} {body}", floating)
    if len(statements) == 1 and len(body) <= WIDTH:
        return Function(name, f"{signature}\n{body}", floating)
    lines = [line for statement in statements for line in wrapped(statement, "    ")]
    return Function(name, "\n".join((signature, "{", *lines, "}")), floating)


def called(name: str, *arguments: str) -> str:
    """Return a call."""
    return f"{name}({', '.join(arguments)})"


def filled(parts: Iterable[str], between: str, indent: str, end: str = "") -> list[str]:
    """Return the parts in as few lines as possible; every line except the last ends with the separator."""
    lines: list[str] = []
    for part in parts:
        if lines and len(lines[-1]) + len(between) + len(part) + len(end) <= WIDTH:
            lines[-1] += between + part
            continue
        if lines:
            lines[-1] += between.rstrip()
        lines.append(indent + part)
    return [*lines[:-1], lines[-1] + end] if lines else []


def wrapped(statement: str, indent: str, first: str = "") -> list[str]:
    """Return a statement in lines that are not too long, broken at the least depth of brackets.

    Further lines are indented more than the first; `first` is the first line if it is not part of the statement.
    """
    if len(indent) + len(statement) <= WIDTH:
        return [indent + statement]
    places = list(_places(statement))
    room = WIDTH - len(indent)
    fitting = [(depth, -at) for depth, at in places if at <= room] or [(depth, at) for depth, at in places[:1]]
    if not fitting:
        return [indent + statement]
    at = abs(min(fitting)[1])
    deeper = indent if statement.startswith(("?", ":", "||", "&&")) or first else indent + "    "
    return [indent + statement[:at].rstrip(), *wrapped(statement[at:].lstrip(), deeper, first or indent)]


def _places(statement: str) -> Iterator[tuple[int, int]]:
    """Yield the possible breaks with their depth in brackets: after a comma or a bracket, or before an operator."""
    depth = 0
    for match in _SIGNS.finditer(statement):
        sign = match[0]
        if sign in "([{":
            depth += 1
            if sign == "(":
                yield depth + _LAST, match.end()
        elif sign in ")]}":
            depth -= 1
        elif sign == ",":
            yield depth, match.end()
        elif sign[0] == " ":
            yield depth, match.start()


def folded(text: str) -> str:
    """Return the same C in lines of at most 120 characters; lines of a macro end with a backslash."""
    lines = text.split("\n")
    if max(map(len, lines)) <= WIDTH:
        return text
    return "\n".join([part for line in lines for part in (_parts(line) if len(line) > WIDTH else (line,))])


def framed(render: Render, template: str, context: Mapping[str, object], texts: Mapping[str, str]) -> str:
    """Return the rendered template, folded, with `texts`, which are folded already, put in their places."""
    places = dict(zip(texts, placeholders(["_" if text else "" for text in texts.values()]), strict=True))
    result = folded(render(template, {**context, **places}))
    for name, text in texts.items():
        result = text.join(result.split(places[name])) if text else result
    return result


def _parts(line: str) -> list[str]:
    """Return one line broken into several; those after the first are indented."""
    directive = line.startswith("#")
    most = WIDTH - 2 if directive else WIDTH
    inside = " " * (len(line) - len(line.lstrip())) + _DEEPER
    parts: list[str] = []
    while len(line) > WIDTH and (at := _break(line, most)):
        parts.append(line[:at] + (" \\" if directive else ""))
        line = inside + line[at + 1 :]
    return [*parts, line]


def _break(line: str, most: int) -> int:
    """Return the last space up to `most` outside strings and indentation; 0 if there is none."""
    start = len(line) - len(line.lstrip())
    spaces = [match.start() for match in _WHOLE.finditer(line, start) if match[0] == " "]
    return max((at for at in spaces if at <= most), default=0)
