"""A point is one thing: a named number, a word of flags, a quantity with a scale, or a floating-point number."""

from fieldscribe.language.keys import facts_of
from fieldscribe.language.keys.places import POINT
from fieldscribe.resolve.analysis import Analysis
from fieldscribe.resolve.point_facts import PointFacts, is_counted
from fieldscribe.resolve.points import ResolvedPoint
from fieldscribe.schema_types import NUMBERS, WHOLE_NUMBERS

_OF_INTEGERS = facts_of(POINT, WHOLE_NUMBERS)
_OF_PATTERNS = tuple(key for key in (*_OF_INTEGERS, "range", "range_in_units", "scale") if key not in ("enum", "open"))
_OF_NUMBERS = (*facts_of(POINT, WHOLE_NUMBERS, NUMBERS), "words")
_NO_NUMBERS = {
    "a date or time": (tuple(key for key in _OF_NUMBERS if key != "coding"), "its parts are all that it means"),
    "made of bytes": (_OF_NUMBERS, "its `notation` says all about it"),
    "a text": (_OF_NUMBERS, "its characters are its value"),
}
"""What is no number: the keys that it cannot have, and why."""
_RIVALS = (
    ("enum", "flags", "name the numbers of several bits under `values` of one flag"),
    ("enum", "scale", "codes beside the numbers go under `special`"),
    ("flags", "scale", "bits with a number of their own are a point with `bits`"),
    ("digits", "enum", "the names of single digits stand under `digits`"),
    ("digits", "flags", "digits are decimal; bits of the word are `flags`"),
    ("digits", "scale", "each digit has a meaning of its own"),
    ("digits", "range", "the enum of the digits says which there are; the printed range goes under `printed`"),
    ("fixed", "scale", "fixed bits belong to words that are no quantity, or beside a bit group"),
    ("fixed", "enum", "fixed bits belong to words of flags or numbers, or beside a bit group"),
    ("fixed", "digits", "fixed bits belong to words of flags or numbers, or beside a bit group"),
    ("range", "range_in_units", "give one of them; what the manual prints in addition goes under `printed`"),
    ("default", "default_in_units", "give one of them: `default` is a raw number, `default_in_units` a value"),
)


def check(analysis: Analysis) -> None:
    """Report facts of one point that exclude each other."""
    for resolved in analysis.resolved:
        facts, shape = resolved.facts, resolved.point.shape
        if shape.specials:
            _shared_names(analysis, resolved)
        if (alien := _alien_to(facts)) is not None:
            _alien(analysis, facts, *alien)
            continue
        if shape.type == "bit" and facts.get("special") is not None and "type" not in facts.failed:
            message = f"`{facts.name}` is a single bit, which has no room for a special code"
            analysis.report.error("two-meanings", message, facts.span("special"), "name its two states by an `enum`")
        if shape.type == "bit" and facts.get("scale") is not None and "type" not in facts.failed:
            message = f"`{facts.name}` is a single bit, which is 0 or 1 and has no scale"
            analysis.report.error("two-meanings", message, facts.span("scale"), "name its two states by an `enum`")
        _needless(analysis, facts, writable=shape.writable)
        keys = facts.keys
        for first, second, hint in _RIVALS:
            if first not in keys or second not in keys or (first == "fixed" and resolved.point.bits is not None):
                continue
            if facts.get(first) is not None and facts.get(second) is not None:
                related = [(facts.span(first), f"`{first}` stands here")]
                message = f"`{facts.name}` cannot have both `{first}` and `{second}`"
                analysis.report.error("two-meanings", message, facts.span(second), hint, related)


def _needless(analysis: Analysis, facts: PointFacts, *, writable: bool) -> None:
    """Report `fixed` of a point that is only read, and `most` of a row whose elements the device does not count."""
    if facts.get("fixed") is not None and not writable:
        message = f"`fixed` says what is written, and `{facts.name}` is only read"
        analysis.report.error("two-meanings", message, facts.span("fixed"), "leave it out, or correct `access`")
    if "most" in facts.node and not is_counted(facts) and not facts.node.broken:  # `indices` may be misspelt
        message = f"`most` is for elements that the device counts, and `{facts.name}` has none"
        hint = "leave it out, or let the device count: `indices: 1..phases`, or `indices: to end` in a block"
        analysis.report.error("two-meanings", message, facts.span("most"), hint)


def _alien_to(facts: PointFacts) -> tuple[tuple[str, ...], str, str] | None:
    """Return the keys that a text or a floating-point number cannot have, what it is, and why; None for others."""
    if facts.layer("type") is None and facts.layer("parts") is None:
        return None  # without a type it is a whole number
    if facts.floating:
        return _OF_INTEGERS, "a floating-point number", "the device sends the value itself in the unit"
    if facts.pattern_bits:
        return _OF_PATTERNS, "a floating-point number", "its enum names all that may be written"
    keys, why = _NO_NUMBERS.get(facts.no_number, ((), ""))
    return (keys, facts.no_number, why) if why else None


def _shared_names(analysis: Analysis, resolved: ResolvedPoint) -> None:
    """Report a name that is both a special code and an enum entry or a flag."""
    point = resolved.point
    enum = point.digits.enum if point.digits is not None else point.enum
    numbers = {} if enum is None else {entry.name: entry.raw for entry in enum.entries}
    flags = {flag.name for flag in point.flags}
    for code in point.specials:
        number = numbers.get(code.name)
        if number is not None and not number == code.low == code.high:
            other = f"the name of {number}"
        elif code.name in flags:
            other = "the name of a flag"
        else:
            continue
        message = f"the special code `{code.name}` of `{point.name}` is also {other}"
        hint = "give the code another name, so that the name stands for one number"
        analysis.report.error("special-twice", message, resolved.facts.span("special"), hint)
        resolved.facts.failed.add("special")


def _alien(analysis: Analysis, facts: PointFacts, keys: tuple[str, ...], what: str, why: str) -> None:
    """Report facts about whole numbers that a text or a floating-point number has."""
    rule = "text-fact" if facts.text else "float-fact"
    for key in keys:
        if facts.get(key) is not None and facts.layer(key) is not facts.group:
            message = f"`{key}` is for {'' if facts.text else 'whole '}numbers, and `{facts.name}` is {what}"
            analysis.report.error(rule, message, facts.span(key), f"{why}: leave it out")
