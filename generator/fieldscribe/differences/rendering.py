"""Renders differences: as text, and as the changelog of a release in Markdown."""

from collections.abc import Callable, Iterator, Mapping
from itertools import islice
from typing import Any, NamedTuple

from fieldscribe.diagnostics import Line, visible
from fieldscribe.differences.changes import CLASSES, Comparison, fact_of, is_taken, next_version, subject_of
from fieldscribe.differences.comparison import Difference
from fieldscribe.facts.table import DOCS
from fieldscribe.text import markdown
from fieldscribe.wording import without_lines
from fieldscribe.wording.numbers import hex_text

_MOST_NAMES = 12
_PLURALS = {"erratum": "errata"}
_MOST_SYMBOLS = 3
_OTHER_LINES = "other lines of the manual"
_ARROW = "\N{RIGHTWARDS ARROW}"


class _Group(NamedTuple):
    """The same difference of several points."""

    first: Difference
    all: list[Difference]

    @property
    def subjects(self) -> list[str]:
        """The points, or the single other thing."""
        return [subject for difference in self.all if (subject := subject_of(difference)) is not None]

    @property
    def moved(self) -> str:
        """The number of things that moved to other lines of the manual, as text; empty for other differences."""
        return f"{len(self.all)} things" if len(self.all) > 1 and _is_moved(self.first) else ""


def as_text(comparisons: list[Comparison]) -> Iterator[Line]:
    """Return styled lines: the devices that differ, the gravest class first."""
    for comparison in comparisons:
        if not comparison.differences:
            continue
        yield [("strong", visible(f"{comparison.device} {_versions(comparison)}"))]
        for weight, groups in _by_class(comparison.differences):
            yield [("", "  "), ("error" if weight in ("wire", "api") else "warning", CLASSES[weight])]
            for group in groups:
                yield from _text_of(comparison, group)
        if comparison.is_nameless:
            yield [("hint", f"  {visible(_nameless(comparison))}")]
        yield [("hint", f"  {visible(_advice(comparison))}")]
        yield []
    count = sum(len(comparison.differences) for comparison in comparisons)
    yield [("strong", f"{count or 'no'} difference{'' if count == 1 else 's'}")]


def as_markdown(comparisons: list[Comparison]) -> Iterator[str]:
    """Return the lines of a changelog."""
    for comparison in comparisons:
        if not comparison.differences:
            continue
        yield from (f"## {markdown(comparison.device)} {markdown(_next(comparison))}", "")
        yield from (markdown(_advice(comparison, _ARROW)), "")
        for weight, groups in _by_class(comparison.differences):
            yield from (f"### {CLASSES[weight].capitalize()}", "")
            yield from (_item(comparison, group) for group in groups)
            yield ""
        if comparison.is_nameless:
            yield from (f"{markdown(_nameless(comparison)).capitalize()}.", "")


def _by_class(found: list[Difference]) -> Iterator[tuple[str, list[_Group]]]:
    """Return the differences of each class; the same difference of several points is one group."""
    groups: dict[str, dict[object, _Group]] = {weight: {} for weight in CLASSES}
    for difference in found:
        whole = len(difference.things) == 1 and not difference.fact
        same = id(difference) if whole else (fact_of(difference), repr(difference.old), repr(difference.new))
        about = difference.things[0].kind if difference.things else ""
        if _is_moved(difference):
            about, same = "", ("source", "", "")
        groups[difference.weight].setdefault((about, same), _Group(difference, [])).all.append(difference)
    return ((weight, list(group.values())) for weight, group in groups.items() if group)


def _is_moved(difference: Difference) -> bool:
    """Return True if only lines of the manual differ: a new edition moves most of them."""
    old, new = difference.old, difference.new
    if difference.weight != DOCS or not difference.fact:
        return False
    if difference.fact == "source":
        return bool({**(old or {}), "line": None} == {**(new or {}), "line": None})
    return bool(without_lines(old) == without_lines(new))


def _text_of(comparison: Comparison, group: _Group) -> Iterator[Line]:
    if group.moved:
        yield [("", "    "), ("strong", group.moved), ("", f": {_OTHER_LINES}")]
        return
    yield [("", "    "), ("strong", visible(_subject(group))), ("", visible(_sentence(group.first)))]
    places = comparison.places(group.first)
    where = [place for place in dict.fromkeys(places.values()) if place]
    yield [("", "      "), ("place", visible(" -> ".join(where)))]
    for language, names in _symbols(comparison, group.first):
        yield [("", visible(f"      {language}: {names}"))]


def _item(comparison: Comparison, group: _Group) -> str:
    if group.moved:
        return f"- {group.moved}: {_OTHER_LINES}"
    symbols = "; ".join(f"{language} {names}" for language, names in _symbols(comparison, group.first, _code))
    sentence = markdown(_sentence(group.first, _ARROW)).lstrip()
    subject = _subject(group, _code)
    joint = "" if not subject or sentence.startswith(":") else " "
    return f"- {subject}{joint}{sentence}{f' ({symbols})' if symbols else ''}"


def _code(name: str) -> str:
    """Return a name as code; one with unusual characters, from a foreign file, as text."""
    return f"`{name}`" if all(char.isalnum() or char in "_:." for char in name) else markdown(name)


def _subject(group: _Group, quoted: Callable[[str], str] = str) -> str:
    """Return the points or the thing as quoted names; empty for the device as a whole."""
    subjects = group.subjects
    if not subjects:
        return ""
    if group.first.is_rename and len(group.first.things) == 1:
        thing = group.first.things[0]
        return quoted(thing.old or "" if thing.kind == "point" else f"{thing.kind}:{thing.old}")
    kind = group.first.things[0].kind
    few = ", ".join(map(quoted, subjects[:_MOST_NAMES])) + _more(len(subjects) - _MOST_NAMES)
    return few if len(subjects) == 1 else f"{len(subjects)} {_PLURALS.get(kind, f'{kind}s')} ({few})"


def _sentence(difference: Difference, arrow: str = "->") -> str:
    """Return what happened, as the rest of a sentence after the subject."""
    thing = difference.things[-1] if difference.things else None
    inner = " ".join(f"{part.kind} {part.name}" for part in difference.things[1:])
    what = f": {inner}" if inner else ""
    if difference.is_rename:
        before = " ".join(f"{part.kind} {part.old}" for part in difference.things[1:])
        return f"{f': {before}' if before else ''} is now {difference.new}{_kept(difference)}"
    if not difference.fact and thing is not None:
        kind = thing.kind if len(difference.things) == 1 else ""
        value = difference.old if difference.new is None else difference.new
        more = f": {value_text('', value)}" if value != thing.name else ""
        return f"{what} is {'gone' if difference.new is None else 'new'}{f' ({kind})' if kind else ''}{more}"
    values = [value_text(difference.fact, value) for value in (difference.old, difference.new)]
    return f"{what}{' ' if what else ': ' if thing else ''}{difference.fact} {values[0]} {arrow} {values[1]}"


def _kept(difference: Difference) -> str:
    return "; the old name stays as a deprecated alias" if difference.weight == "compatible" else ""


def _versions(comparison: Comparison) -> str:
    return " -> ".join(dict.fromkeys(side.version for side in (comparison.old, comparison.new) if side is not None))


def _next(comparison: Comparison) -> str:
    """Return the version of the changes: that of the new side if its step is large enough, else the next one."""
    old, new, step = comparison.old, comparison.new, comparison.step
    if old is None or new is None or step is None or is_taken(old.version, new.version, step):
        side = new or old
        return "" if side is None else side.version
    return next_version(old.version, step) or new.version


def _advice(comparison: Comparison, arrow: str = "->") -> str:
    """Return the step that the version must take, and whether it does."""
    old, new, step = comparison.old, comparison.new, comparison.step
    if old is None or new is None or step is None:
        return "a new device" if old is None else "the device is gone"
    wanted = next_version(old.version, step)
    if wanted is None:
        return f"a {step} step of the version ({old.version} is not a version like 1.2.3)"
    below = " (below 1.0 the middle number says what breaks)" if old.version.startswith("0.") else ""
    if is_taken(old.version, new.version, step):
        return f"a {step} step of the version: {old.version} {arrow} {new.version}{below}"
    return f"the version must take a {step} step: {wanted} or more, it says {new.version}{below}"


def _symbols(
    comparison: Comparison, difference: Difference, quoted: Callable[[str], str] = str
) -> Iterator[tuple[str, str]]:
    """Return the first names in each language; for a renamed thing, its old and its new ones."""
    for language, sides in comparison.symbols_of_sides(difference).items():
        if difference.is_rename and all(sides):
            yield language, " -> ".join(_few(names, quoted) for names in sides)
        elif any(sides):
            yield language, _few(list(dict.fromkeys((*sides[0], *sides[1]))), quoted)


def _nameless(comparison: Comparison) -> str:
    """Return why names in code are missing, and how to see them."""
    files = [side.name_of(side.file) for side in (comparison.old, comparison.new) if side and side.described is None]
    is_one = f"{' and '.join(files)} {'is' if len(files) == 1 else 'are each'} an exported model"
    return f"names in code are missing where {is_one}: compare descriptions, or GIT-REVISION:PATH, to see them"


def _few(names: list[str], quoted: Callable[[str], str]) -> str:
    return ", ".join(map(quoted, islice(names, _MOST_SYMBOLS))) + _more(len(names) - _MOST_SYMBOLS)


def _more(number: int) -> str:
    return f" and {number} more" if number > 0 else ""


_ADDRESSES = frozenset({"address", "number", "identifier"})
_NOTHING = {"order of words": "as usual", "range": "all that the type holds"}


def value_text(fact: str, value: Any) -> str:
    """Return a value in one line; mostly `none` where it is empty."""
    if value is None or value in ([], {}, ""):
        return _NOTHING.get(fact, "none")
    return _WORDS.get(fact, _plain)(value)


def _plain(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, dict):
        return "; ".join(f"{key} {_plain(inner)}" for key, inner in value.items() if inner is not None)
    if isinstance(value, list):
        return ", ".join(map(_plain, value))
    return "none" if value is None else str(value)


def _number(value: Any) -> str:
    return f"{value} ({hex_text(value)})" if isinstance(value, int) and value > 9 else _plain(value)


def _ranges(ranges: Any) -> str:
    return " | ".join(f"{low}..{high}" if low != high else str(low) for low, high in ranges)


def _interval(ends: Any) -> str:
    return _ranges([ends])


def _bits(bits: Any) -> str:
    return str(bits[0]) if bits[0] == bits[1] else f"{bits[0]}..{bits[1]}"


def _raw(value: Any) -> str:
    return str(value) if isinstance(value, int) else _interval(value)


def _titles(titles: Any) -> str:
    if isinstance(titles, str):  # of a document, which is in one language
        return titles
    return "; ".join(f"{language}: {text}" for language, text in titles.items())


def _case(case: Mapping[str, Any]) -> str:
    """Return one rule: `raw = value * 10 / 3 * factor + 5`."""
    rule = "raw = value"
    rule += "" if case["num"] == "1" else f" * {case['num']}"
    rule += "" if case["den"] == "1" else f" / {case['den']}"
    rule += "".join(map(_use, case["uses"]))
    rule += "" if case["offset"] == "0" else f" + {case['offset']}".replace("+ -", "- ")
    when = case["when"]
    return rule if when is None else f"when {when['point']} == {when['raw']}: {rule}"


def _use(use: Mapping[str, Any]) -> str:
    number = use["point"] if use["part"] == "value" else f"{use['point']}.raw"
    if "times" in use:
        number = f"({number} * {use['times']} + {use['plus']})"
    sign = use.get("power", use.get("ten_to"))
    return f" {'*' if sign == 1 else '/'} {'10 ** ' if 'ten_to' in use else ''}{number}"


def _condition(condition: Any) -> str:
    return " or ".join(
        " and ".join(f"{test['of']} {test['is']} {_plain(test['than'])}" for test in clause["all"])
        for clause in condition["any"]
    )


def _settings(serial: Mapping[str, Mapping[str, str]]) -> str:
    """Return settings of a line: each text with its code, if that differs."""
    texts = {
        setting: ", ".join(text if code == text else f"{code} {text}" for code, text in codes.items())
        for setting, codes in serial.items()
    }
    return "; ".join(f"{setting} {text}" for setting, text in texts.items())


_WORDS: Mapping[str, Callable[[Any], str]] = {
    **dict.fromkeys(_ADDRESSES, _number),
    "range": _ranges,
    "gaps": lambda gaps: "; ".join(f"{space} {_ranges(spans)}" for space, spans in gaps.items()),
    "units": _interval,
    "bits": _bits,
    "raw": _raw,
    "serial": _settings,
    "title": _titles,
    "note": _titles,
    "note of the bus": _titles,
    "scale": lambda cases: "; ".join(map(_case, cases)),
    "when": _condition,
}
