"""Resolves errata, and compares what the manual prints redundantly with the facts taken."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from fieldscribe.diagnostics import Span
from fieldscribe.families import sections_of_codes
from fieldscribe.language.keys import keys_of
from fieldscribe.language.keys.places import POINT
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.numbers import number_in
from fieldscribe.model import About, Bus, Erratum, Named
from fieldscribe.resolve.scope import Scope, source_of
from fieldscribe.resolve.symbols import SymbolTable
from fieldscribe.resolve.values import integer

_NAMED = (("frames", "frame"), ("messages", "message"), ("telegrams", "telegram"))
"""The sections of named things that an erratum may be about, each with the key that names one."""


class PrintedFact(NamedTuple):
    """A printed fact that differs from the description.

    `about` is its subject, `span` its place. `taken` is the value in the description, None if
    only an erratum can give the right value. `right` decides whether the `taken` of an erratum is correct, where
    comparing numbers or texts is not enough. `flag` names the flag that the fact is about; `hint` replaces the usual
    advice.
    """

    about: About
    key: str
    printed: Any
    taken: Any
    span: Span
    message: str
    right: Callable[[Any], bool] | None = None
    flag: str | None = None
    hint: str = ""

    def fits(self, stated: Any) -> bool:
        """Return True if the `taken` of an erratum is what the description says."""
        return self.right(stated) if self.right is not None else same(stated, self.taken)


@dataclass(slots=True)
class LocatedErratum:
    """An erratum with its text. `used` collects the keys of `printed` for which a check found the misprint."""

    erratum: Erratum
    node: Map
    used: set[str]

    @property
    def subjects(self) -> tuple[About, ...]:
        """Return its subjects: its points, or another named thing, or nothing."""
        where = self.erratum.where
        return self.erratum.points or ((where,) if isinstance(where, Named) else ())

    def printed(self, key: str) -> Any:
        """Return the printed value of a key, or None."""
        printed = self.node["printed"]
        return printed.get(key) if isinstance(printed, Map) else None


def errata_of(scope: Scope, symbols: SymbolTable, bus: Bus) -> list[LocatedErratum]:
    """Return all errata in the order of the text, without those whose subject does not exist."""
    result = []
    for node in scope.unique("errata", "id"):
        points = tuple(_points(symbols, node))
        where = _where(scope, node, bus)
        if not points and where is None:
            continue
        _flag_exists(scope, symbols, node)
        source = source_of(scope, node)
        if source.document not in scope.documents:
            scope.unknown("document", source.document, node.span("document"), scope.documents)
        text = Erratum(
            node["id"],
            points,
            where or "",
            source,
            in_one_line(node["printed"]),
            in_one_line(node["taken"]),
            str(node["why"]),
            node["certainty"],
            _facts(node["printed"]),
            tuple(_leaves_open(scope, node)),
        )
        result.append(LocatedErratum(text, node, set()))
    return result


def _points(symbols: SymbolTable, node: Map) -> Iterator[str]:
    """Yield the names of the points that an erratum is about; report unknown ones."""
    words = [(node["point"], node.span("point"))] if "point" in node else []
    words += [(word, node["points"].span(number)) for number, word in enumerate(node.get("points", ()))]
    for word, span in words:
        named = symbols.all(word)
        if not named:
            symbols.unknown(word, span)
        yield from dict.fromkeys(facts.name for facts in named)


def _leaves_open(scope: Scope, node: Map) -> Iterator[tuple[str, str]]:
    """Yield what an erratum leaves open by the key of the fact; report what contradicts its certainty."""
    texts: Map | dict[str, str] = node.get("leaves_open", {})
    if not texts and node["certainty"] == "unknown":
        message = f"the erratum `{node['id']}` does not say what is `unknown`"
        hint = "say it as the end of a sentence: `leaves_open: {range: whether 5 may be written}`"
        scope.report.error("erratum-open", message, node.span("certainty"), hint)
    elif texts and node["certainty"] == "certain":
        message, hint = (
            f"the erratum `{node['id']}` is `certain`, and leaves something open",
            "say `likely` or `unknown`",
        )
        scope.report.error("erratum-open", message, node.span("certainty"), hint)
    keys = keys_of(POINT) if "point" in node or "points" in node else ()
    for key, text in texts.items():
        if keys and key not in keys:
            scope.unknown("key", key, node["leaves_open"].key_span(key), keys)
        yield key, str(text).rstrip(".")


def _flag_exists(scope: Scope, symbols: SymbolTable, node: Map) -> None:
    """Report an erratum about a flag that its points do not have."""
    if "flag" not in node:
        return
    words = [node["point"]] if "point" in node else list(node.get("points", ()))
    flags = [value for word in words for facts in symbols.all(word) for value in (facts.get("flags") or {}).values()]
    names = [str(value if isinstance(value, str) else value["name"]) for value in flags]
    if node["flag"] not in names:
        scope.unknown("flag", node["flag"], node.span("flag"), names)


def _where(scope: Scope, node: Map, bus: Bus) -> Named | str | None:
    """Return the subject of an erratum that names no point: a thing, or a place in words; None after a finding."""
    for section, key in _NAMED:
        if key in node:
            known = [str(item["name"]) for item in scope.listed(section)]
            if node[key] not in known:
                scope.unknown(key, node[key], node.span(key), known)
            return Named(key, node[key])
    for key, section in sections_of_codes().items():
        if key in node:
            number = integer(node[key], node.span(key), scope.report)
            if number is not None and all(code.number != number for code in bus.codes(section)):
                scope.unknown(key, str(node[key]), node.span(key), ())
            return Named(key, str(node[key]) if number is None else number)
    if "where" in node:
        return str(node["where"])
    if "point" not in node and "points" not in node:
        hint = "say `point`, `points`, `frame`, `function`, `message`, `telegram` or `where`"
        scope.report.error("erratum-unused", f"the erratum `{node['id']}` is about nothing", node.span("id"), hint)
        return None
    return f"the flag {node['flag']}" if "flag" in node else ""


def in_one_line(value: Any) -> str:
    """Return a printed or taken text as one line."""
    facts = _facts(value)
    return "; ".join(f"{key.replace('_', ' ')} {text}" for key, text in facts) if facts else str(value)


def _facts(value: Any) -> tuple[tuple[str, str], ...]:
    """Return the facts as (key, text); nothing if the erratum states them in words."""
    return tuple((str(key), _fact_text(fact, key)) for key, fact in value.items()) if isinstance(value, Map) else ()


def _fact_text(value: Any, key: str) -> str:
    """Return a fact as text: masks in hexadecimal, lists with slashes."""
    if key == "mask" and isinstance(value, int):
        return f"{value:04X}h"
    if isinstance(value, Seq):
        return " / ".join(map(str, value))
    return "nothing" if value is None else str(value)


def same(left: Any, right: Any) -> bool:
    """Return True if two facts are equal: as numbers in any notation, or as texts apart from blanks and case."""
    if isinstance(left, Seq | list | tuple) or isinstance(right, Seq | list | tuple):
        lefts, rights = _items(left), _items(right)
        return len(lefts) == len(rights) and all(same(left, other) for left, other in zip(lefts, rights, strict=True))
    numbers = [_number(left), _number(right)]
    if None not in numbers:
        return numbers[0] == numbers[1]
    return "".join(str(left).split()).lower() == "".join(str(right).split()).lower()


def fact_text(value: Any) -> str:
    """Return a fact as a message shows it."""
    if isinstance(value, Seq | list | tuple):
        return "[" + ", ".join(map(str, value)) + "]"
    return "…" if value is None else str(value)


def _items(value: Any) -> list[Any]:
    """Return the items of a list, or the parts of a text between commas."""
    if isinstance(value, Iterable) and not isinstance(value, str):
        return list(value)
    return [part for part in str(value).split(",") if part.strip()]


def _number(value: Any) -> Fraction | None:
    """Return a number in any notation as a fraction; None for other texts."""
    if isinstance(value, str):
        return number_in(value)
    return Fraction(value) if value is not None else None
