"""Calls laid out as JavaScript: on one line if they fit, else with a line for each item."""

import re
import textwrap
from collections.abc import Callable, Mapping

from fieldscribe.targets.runtime_calls.scope import Call, Hex, Leaf, Name, Node, PointName
from fieldscribe.text import camel, js_string

WIDTH = 120
_SAFE = 1 << 53
_PLAIN_KEY = re.compile(r"[A-Za-z_$][A-Za-z0-9_$]*")


class Layout:
    """Lays out calls. `makers` are functions whose names differ from those of the calls; `names` are of points."""

    def __init__(self, makers: Mapping[str, str], name_of: Callable[[str], str]) -> None:
        self._makers, self._name_of = makers, name_of

    def maker(self, name: str) -> str:
        """Return the function or the constant of the runtime for a name in a call."""
        return self._makers.get(name) or (name if name.isupper() else camel(f"{name[0].lower()}{name[1:]}"))

    def laid_out(self, node: Node, indent: int, before: str = "") -> str:
        """Return the lines of the expression at that indentation; `before` precedes it on its line."""
        if node is None or isinstance(node, (str, int, float)):
            return before + self.leaf(node)
        line = before + self.flat(node)
        if indent + len(line) < WIDTH:
            return line
        opening, closing, items = self._parts(node)
        inner = " " * (indent + 2)
        lines = "".join([f"{inner}{self.laid_out(item, indent + 2, key)},\n" for key, item in items])
        return f"{before}{opening.rstrip()}\n{lines}{' ' * indent}{closing.lstrip()}"

    def flat(self, node: Node) -> str:
        """Return the expression on one line."""
        if node is None or isinstance(node, (str, int, float)):
            return self.leaf(node)
        opening, closing, items = self._parts(node)
        if not items:
            return opening.rstrip() + closing.lstrip()
        return f"{opening}{', '.join([key + self.flat(item) for key, item in items])}{closing}"

    def flat_keyword(self, name: str, node: Node) -> str:
        """Return a keyword of a call, as a property of its object."""
        return f"{camel(name)}: {self.flat(node)}"

    def leaf(self, node: Leaf) -> str:
        """Return a name, a string or a number as text; an integer beyond 2^53 is a bigint."""
        if isinstance(node, str):
            if isinstance(node, Name):
                return self.maker(node) if node.isidentifier() and node.isupper() else node
            return js_string(self._name_of(node) if isinstance(node, PointName) else node)
        if node is None or isinstance(node, bool):
            return "null" if node is None else str(node).lower()
        if isinstance(node, float):
            return repr(node).removesuffix(".0")
        text = f"0x{node:0{node.digits}x}" if isinstance(node, Hex) else str(int(node))
        return text if abs(node) < _SAFE else f"{text}n"

    def key(self, key: Node) -> str:
        """Return the key of a value in an object; no name of a description sets a prototype."""
        if isinstance(key, str):
            text = self._name_of(key) if isinstance(key, PointName) else key
            if text == "__proto__":
                return '["__proto__"]: '
            return f"{text if _PLAIN_KEY.fullmatch(text) else js_string(text)}: "
        return f"{self.flat(key)}: "

    def _parts(self, node: Node) -> tuple[str, str, list[tuple[str, Node]]]:
        """Return brackets and items, each with its key. Keywords become one object after the other items."""
        if isinstance(node, Call):
            items: list[tuple[str, Node]] = [("", item) for item in node.positional]
            if node.keywords:
                items.append(("", {camel(name): item for name, item in node.keywords.items()}))
            return f"{self.maker(node.name)}(", ")", items
        if isinstance(node, tuple):
            return "[", "]", [("", item) for item in node]
        assert isinstance(node, Mapping)
        if any(isinstance(key, tuple) for key in node):
            return "[", "]", [("", (key, item)) for key, item in node.items()]
        return "{ ", " }", [(self.key(key), item) for key, item in node.items()]


def lazily(made: str) -> str:
    """Return an expression that bundlers drop whole if its constant is unused, including calls in arguments."""
    return f"/* @__PURE__ */ (() => {made})()"


def doc_lines(text: str) -> tuple[str, ...]:
    """Return the lines of a `/** */` comment."""
    if len(text) + 7 <= WIDTH:
        return (f"/** {text} */",)
    lines = textwrap.wrap(text, WIDTH - 3, break_long_words=False, break_on_hyphens=False)
    return ("/**", *(f" * {line}" for line in lines), " */")
