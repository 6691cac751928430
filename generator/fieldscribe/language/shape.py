"""The checks of lists and mappings: what is wrong in them is reported and dropped."""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING, Any, NamedTuple

from fieldscribe.diagnostics import Report
from fieldscribe.language.hints import key_hint, quoted
from fieldscribe.language.keys import forms, keys_of, needs, required
from fieldscribe.language.nodes import Map, Seq
from fieldscribe.language.suggestions import reversed_hint
from fieldscribe.language.value_checks import NumberCheck, ShapeCheck, TextCheck, compiled_pattern
from fieldscribe.schema_types import BOOLEAN, NOTHING, NUMBER, Items, Place, Text, Whole, says_yes_or_no

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from fieldscribe.language.value_checks import Check, Test
    from fieldscribe.schema_types import Kind, Shape

_NAMING = ("name", "code", "id")
_MOST_PLANS = 1000


class ItemsCheck:
    """Checks a list: each item, and that there are at least `least`."""

    __slots__ = ("item", "least")

    def __init__(self, item: ShapeCheck, least: int) -> None:
        self.item, self.least = item, least

    def fits(self, value: Seq) -> bool:
        """Whether all items surely are right."""
        free, tests, _ = self.item.at_hand
        if value.uses is not None or len(value) < self.least:
            return False
        for element in value:
            kind = type(element)
            if kind not in free and not (kind in tests and tests[kind](element)):
                return False
        return True

    def __call__(self, value: Seq, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the list is right; a `Check`."""
        if value.uses is not None:
            return _check_aliased(self, value, holder, at, report)
        if len(value) < self.least:
            report.error("too-few", "the list is empty", holder.span(at), "fill it or leave the key out")
            return False
        free, tests, item = self.item.at_hand
        broken = []
        for index, element in enumerate(value):
            kind = type(element)
            if kind in free or (kind in tests and tests[kind](element)):
                continue
            if not item(element, value, index, report):
                broken.append(index)
                if report.full:
                    return False
        for index in reversed(broken):
            _remember_names(value[index], value.file.lost)
            value.drop(index)
        return len(value) >= self.least


class Plan(NamedTuple):
    """What is to check in mappings with these keys."""

    entries: tuple[tuple[str, frozenset[type], dict[type, Test], ShapeCheck | None], ...]
    """For each key the free types and tests of what stands there, and its check: None for an unknown key."""
    missing: tuple[tuple[str, str], ...]
    """Each missing key with a message."""
    complete: bool


_NOTHING: tuple[frozenset[type], dict[type, Test], None] = (frozenset(), {}, None)


class KeysCheck:
    """Checks a mapping; the checks of its keys are made when the first such mapping comes."""

    __slots__ = ("additional", "check_of", "patterns", "place", "plans", "properties", "required")

    def __init__(self, place: Place, check_of: Callable[[Shape], ShapeCheck]) -> None:
        self.place, self.check_of = place, check_of
        self.plans: dict[tuple[str, ...], Plan] = {}
        self.properties: dict[str, ShapeCheck] | None = None

    def _open(self) -> dict[str, ShapeCheck]:
        place, check_of = self.place, self.check_of
        self.properties = {name: check_of(key.shape) for name, key in keys_of(place).items()}
        self.patterns = [
            (form, compiled_pattern(form.pattern), check_of(shape))
            for form, shape in place.by_form.items()
            if form is not forms.ANY
        ]
        other = place.by_form.get(forms.ANY)
        self.additional = None if other is None else check_of(other)
        self.required = frozenset(required(place))
        return self.properties

    def fits(self, value: Map) -> bool:
        """Whether such keys were met before, and all values surely are right."""
        plan = self.plans.get(tuple(value))
        if plan is None or not plan.complete or value.uses is not None:
            return False
        for key, free, tests, _ in plan.entries:
            entry = value[key]
            kind = type(entry)
            if kind not in free and not (kind in tests and tests[kind](entry)):
                return False
        return True

    def __call__(self, value: Map, holder: Map | Seq, at: Any, report: Report) -> bool:
        """Whether the mapping is right; a `Check`."""
        if value.uses is not None:
            return _check_aliased(self, value, holder, at, report)
        keys = tuple(value)
        plan = self.plans.get(keys) or self._plan(keys)
        broken = self._broken(plan, value, report)
        if not broken and plan.complete:
            return True
        if report.full:
            return False
        deeper = {name for key in broken if isinstance(value[key], Map) for name in value[key]}
        for key, message in plan.missing:
            if key not in deeper:  # else it stands a level too deep, and the finding there says so
                report.error("missing-key", message, holder.span(at), f"add `{key}: …`")
        if len(value) < self.place.least:
            report.error("too-few", "the mapping is empty", holder.span(at), "fill it or leave the key out")
        for key in broken:
            self._drop(value, key, is_file=holder is value)
        return plan.complete and len(value) >= self.place.least and self.required.isdisjoint(broken)

    def _broken(self, plan: Plan, value: Map, report: Report) -> list[str]:
        """The keys that are unknown or whose values are wrong, as far as findings are kept."""
        broken: list[str] = []
        for key, free, tests, check in plan.entries:
            entry = value[key]
            kind = type(entry)
            if kind in free or (kind in tests and tests[kind](entry)):
                continue
            if check is None:
                self._unknown(value, key, report)
            elif check(entry, value, key, report):
                continue
            broken.append(key)
            if report.full:
                break
        return broken

    def _plan(self, keys: tuple[str, ...]) -> Plan:
        """What follows from a list of keys; kept for the next mapping that has the same, if there are not too many."""
        properties = self.properties or self._open()
        checks = {key: properties.get(key) or self._pattern(key) for key in keys}
        entries = ((key, *(_NOTHING if check is None else check.at_hand)) for key, check in checks.items())
        missing = self._missing(keys)
        plan = Plan(tuple(entries), tuple(missing.items()), not missing and len(keys) >= self.place.least)
        if len(self.plans) < _MOST_PLANS:
            self.plans[keys] = plan
        return plan

    def _pattern(self, key: str) -> ShapeCheck | None:
        for _, pattern, pattern_check in self.patterns:
            if pattern.search(key):
                return pattern_check
        return self.additional

    def _missing(self, keys: tuple[str, ...]) -> dict[str, str]:
        missing = {key: f"the key `{key}` is missing" for key in required(self.place) if key not in keys}
        for key, beside in needs(self.place).items():
            for needed in beside:
                if key in keys and needed not in keys:
                    missing.setdefault(needed, f"the key `{needed}` is missing: `{key}` needs it")
        return missing

    def _unknown(self, value: Map, key: str, report: Report) -> None:
        entry, known = value[key], [form for form, _, _ in self.patterns]
        named = forms.NUMBER in known or forms.BITS in known
        properties = self.properties or {}
        hint = (reversed_hint(key, entry) if named else None) or key_hint(key, properties, known, entry)
        report.error("unknown-key", f"the key {quoted(key)} is not known here", value.key_span(key), hint)

    def _drop(self, value: Map, key: str, *, is_file: bool) -> None:
        lost = value.file.lost
        if is_file or key == "points":
            lost.add(f"*{key}")  # a whole section
        if key not in (self.properties or ()):
            lost.add(key)
        _remember_names(value[key], lost)
        del value[key]
        value.broken += (key,)


def _check_aliased(check: Check, value: Any, holder: Any, at: Any, report: Report) -> bool:
    """Check a value that aliases repeat: once for each check, on a copy that keeps what is right for this check."""
    if report.full:
        return False
    if check not in value.uses:
        copy, own = value.copied(), Report()
        fine = check(copy, holder, at, own)
        report.extend(own if value.span() == holder.span(at) else own.also(holder.span(at), "used here"))
        value.uses[check] = copy, fine
    holder[at], fine = value.uses[check]
    return bool(fine)


def _remember_names(value: Any, lost: set[str]) -> None:
    """Remember the names inside a dropped value, so that they are not reported as unknown too."""
    waiting: list[Iterable[Any]] = [(value,)]
    seen: set[int] = set()
    while waiting:
        for node in waiting.pop():
            if not isinstance(node, Map | Seq) or id(node) in seen:
                continue
            seen.add(id(node))
            waiting.append(node.values() if isinstance(node, Map) else node)
            if isinstance(node, Map):
                lost.update(node, (node[key] for key in _NAMING if isinstance(node.get(key), str)))


_WORDS: dict[type, str] = {Place: "a mapping", Items: "a list", Text: "text", Whole: "a whole number"}
_PLAIN: dict[Kind, tuple[str, tuple[type, ...]]] = {
    NUMBER: ("a number", (int, Decimal)),
    BOOLEAN: ("true or false", (bool,)),
    NOTHING: ("~", (type(None),)),
}
_ANY: dict[type, Check | None] = dict.fromkeys((Map, Seq, int, Decimal, bool, str, type(None)))
_made: dict[Shape, ShapeCheck] = {}


def check_shape(value: Map, place: Place, report: Report) -> bool:
    """Whether the file has the shape of a place (`DEVICE` or `PART`); findings go to the report."""
    return not report.full and check_of(place.shape)(value, value, None, report)


def check_of(shape: Shape) -> ShapeCheck:
    """The check for a shape, made once."""
    if shape not in _made:
        _made[shape] = _check(shape)
    return _made[shape]


def _check(shape: Shape) -> ShapeCheck:
    checks: dict[type, Check | None] = {}
    for kind in shape.kinds:
        for python_type, check in _by_python_type(kind):
            checks.setdefault(python_type, check)
    form = next((kind.form for kind in shape.kinds if isinstance(kind, Text)), None)
    yes_no = says_yes_or_no(shape)
    wanted = "yes or no" if yes_no else " or ".join(map(_word, shape.kinds))
    return ShapeCheck(checks or _ANY, wanted, next(iter(shape.examples), None), form, yes_no=yes_no)


def _word(kind: Kind) -> str:
    return _WORDS.get(type(kind)) or _PLAIN[kind][0]


def _by_python_type(kind: Kind) -> Iterator[tuple[type, Check | None]]:
    """The check for a kind of value, by the Python types of its values; None where each of them is right."""
    if isinstance(kind, Place):
        yield Map, KeysCheck(kind, check_of)
    elif isinstance(kind, Items):
        yield Seq, ItemsCheck(check_of(kind.item), kind.least)
    elif isinstance(kind, Text):
        yield str, TextCheck(kind) if kind.choices or kind.longest or kind.form else None
    elif isinstance(kind, Whole):
        bounded = kind.choices or kind.least is not None or kind.greatest is not None
        yield int, NumberCheck(kind) if bounded else None
    else:
        yield from dict.fromkeys(_PLAIN[kind][1]).items()
