"""What expressions of the Python target say, as objects."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fieldscribe.targets.runtime_calls.expressions import Call, Hex, Name, Node, PointName


def evaluated(node: Node, names: Mapping[str, Any]) -> Any:
    """Return the object that an expression makes; `names` are the classes, functions and constants that it may name."""
    if isinstance(node, Call):
        keywords = {name: evaluated(item, names) for name, item in node.keywords.items()}
        return names[node.name](*[evaluated(item, names) for item in node.positional], **keywords)
    if isinstance(node, Name):
        return names[node]
    if isinstance(node, tuple):
        return tuple([evaluated(item, names) for item in node])
    if isinstance(node, Mapping):
        return {evaluated(key, names): evaluated(item, names) for key, item in node.items()}
    if isinstance(node, PointName):
        return str(node)
    return int(node) if isinstance(node, Hex) else node
