"""The expressions for the facts of points: forms, rules, limits and places."""

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction

from fieldscribe.conditions import Condition
from fieldscribe.lowered import Operand
from fieldscribe.model import Bound, Command, Linear, Point, ScaleCase, Special, Step, Text, Word
from fieldscribe.model.device import WHOLE_WORD
from fieldscribe.targets.runtime_calls import Call, Hex, Name, Node, PointName, Scope, call

_PLACES = {"coil": "coil", "discrete": "discrete", "holding": "holding", "input": "input_register"}
_DATES = {"date": "DateParts", "time": "TimeParts", "date and time": "DateTimeParts"}
_FORMS = {"enum": "Named", "float": "Floating"}
"""The classes of the runtime for forms of points that are not named after the form."""

NUMBERED = frozenset({"parameter", "telegram", "signal"})
"""Spaces whose addresses are written in decimal."""


def form(point: Point, named: str, scope: Scope) -> Node:
    """Return the form of a point: `Scaled(U16, Rule(num=10), decimals=1)`; `named` is its class of numbers or flags."""
    inner = _plain_form(point, named, scope)
    inner = call(scope.runtime("Time"), inner, point.epoch) if point.epoch else inner
    if not point.specials:
        return inner
    writes = point.writable and any(special.writable for special in point.specials)
    around = scope.runtime("WithWritableCodes" if writes else "WithCodes")
    return call(around, inner, _codes(point, scope))


def _codes(point: Point, scope: Scope) -> Node:
    """Return the special codes of a point; shared ones by the name of their constant."""
    raws: dict[str, Node] = {}
    for special in point.specials:
        low, high = (_code_number(end, special) for end in (special.low, special.high))
        raws[special.name] = low if low == high else (low, high)
    names = {
        key: tuple(special.name for special in point.specials if getattr(special, key))
        for key in ("no_value", "writable")
    }
    keywords = {key: stated for key, stated in names.items() if stated}
    codes = Call(scope.runtime("Codes"), (raws,), keywords, tuple(raws))
    if not point.shared_codes:
        return codes
    name = Name(f"{point.shared_codes.upper()}_CODES")
    scope.codes.setdefault(name, codes)
    return name


def _code_number(raw: int, special: Special) -> int:
    return Hex(raw) if special.hexadecimal and raw >= 0 else raw


def _plain_form(point: Point, named: str, scope: Scope) -> Node:
    """Return the form of values that are no special codes."""
    name = "bytes" if point.text is not None and point.text.is_bytes else point.form
    name = _DATES.get(point.text.encoding, name) if point.text is not None else name
    kind = scope.runtime(_FORMS.get(name, name[0].upper() + name[1:]))
    if point.form == "bit":
        return call(kind, *([_wire(point, scope)] if point.swapped else ()))
    if point.text is not None:
        return _date(point.text, kind) if point.text.parts else _text(point.text, kind)
    positional, keywords = [_wire(point, scope)], dict[str, Node]()
    if named:
        if scope.enums:
            scope.runtime("enums")
        positional.append(Name(f"{scope.enums}{named}"))
    if point.digits is not None:
        keywords["count"] = point.digits.count
    elif point.enum is not None and point.enum.closed:
        keywords["closed"] = True
    elif point.form == "scaled":
        positional.append(_scale(point.scale or (), scope))
        keywords.update(_scaled(point))
    elif point.allowed.units:
        keywords["units"] = tuple((number(low, True), number(high, True)) for low, high in point.allowed.units)
    return call(kind, *positional, **keywords)


def _text(layout: Text, kind: str) -> Node:
    positional: list[Node] = [layout.characters]
    if layout.encoding != "ascii":
        positional.append(layout.encoding)
    keywords: dict[str, Node] = {}
    if layout.per_word == 1 and layout.encoding != "utf-16":
        keywords["per_word"] = 1
    if not layout.padding:
        keywords["padding"] = 0
    if layout.low_first:
        keywords["low_first"] = True
    return call(kind, *positional, **keywords)


def _date(layout: Text, kind: str) -> Node:
    """Return a date and time: its parts with their words and bits, and what a 0 of them means."""
    parts: tuple[Node, ...] = tuple(
        (part.name, part.word, *part.bits, *[part.base] * bool(part.base)) for part in layout.parts
    )
    keywords: dict[str, Node] = {"bcd": layout.bcd, "low_first": layout.low_first}
    return call(kind, layout.words, parts, **{name: fact for name, fact in keywords.items() if fact})


def _wire(point: Point, scope: Scope) -> Node:
    """Return the type on the wire: `U16`; one that has no constant as `Type(24)`."""
    shape = point.shape
    if not shape.narrow and not shape.swapped and not shape.coding:
        return Name(scope.runtime(point.type.upper()))
    facts: dict[str, Node] = {"signed": shape.info.signed, "low_byte_first": shape.swapped, "coding": shape.coding}
    bits = point.width if shape.narrow else shape.info.bits
    return call(scope.runtime("Type"), bits, **{name: fact for name, fact in facts.items() if fact})


def _scaled(point: Point) -> Iterator[tuple[str, Node]]:
    yield "decimals", point.decimals
    if not point.encodes_values:
        yield "encodes", False
    if point.most_raw is not None:
        yield "most", point.most_raw


def _only_named(point: Point) -> bool:
    """Return True if the numbers that may be written are exactly those of the closed enum."""
    if point.enum is None or not point.enum.closed:
        return False
    named, ranges = {entry.raw for entry in point.enum.entries}, point.allowed.fixed
    as_many = not point.allowed.moves and sum(high - low + 1 for low, high in ranges) == len(named)
    return as_many and all(named.issuperset(range(low, high + 1)) for low, high in ranges)


def _scale(cases: tuple[ScaleCase, ...], scope: Scope) -> Node:
    if len(cases) == 1 and cases[0].point is None:
        return rule(cases[0].rule, scope, of_scale=True)
    made = scope.runtime("Case")
    return tuple(call(made, _name(case.point), case.raw, rule(case.rule, scope, of_scale=True)) for case in cases)


def _name(point: str | None) -> Node:
    return None if point is None else PointName(point)


def rule(linear: Linear, scope: Scope, *, of_scale: bool = False) -> Node:
    """Return a linear rule as integers; factors of a scale include their special codes."""
    ratio, offset = linear.ratio, linear.offset
    facts: dict[str, Node] = {}
    if ratio.numerator != 1:
        facts["num"] = ratio.numerator
    if ratio.denominator != 1:
        facts["den"] = ratio.denominator
    if offset:
        facts["offset"] = offset.numerator, offset.denominator
    if linear.factors:
        operands = scope.lowered.rule(linear).operands
        facts["factors"] = tuple(_factor(operand, scope, of_scale=of_scale) for operand in operands)
    return call(scope.runtime("Rule"), **facts)


def _factor(operand: Operand, scope: Scope, *, of_scale: bool) -> Node:
    factor = operand.factor
    facts: dict[str, Node] = {}
    if factor.slope != 1:
        facts["slope"] = factor.slope
    if factor.intercept:
        facts["intercept"] = factor.intercept
    if factor.power != 1:
        facts["power"] = factor.power
    if operand.floating:
        facts["f32"] = True
    if operand.within is not None:
        facts["ten_to" if factor.ten_to else "within"] = operand.within
    if of_scale and operand.codes:
        facts["codes"] = operand.codes
    return call(scope.runtime("Factor"), PointName(factor.point), **facts)


def is_limited(point: Point) -> bool:
    """Return True if fewer raw numbers may be written than the type or the enum has."""
    if point.form in ("float", "text", "digits") or _only_named(point):
        return False
    return point.allowed.fixed != ((point.least, point.greatest),)


def allowed(point: Point, ends: tuple[Node, ...], scope: Scope) -> Node:
    """Return the raw numbers that may be written; `ends`, if any, are the bounds of its intervals."""
    bounds = ends or [
        _bound(end, scope) for interval in point.allowed.intervals for end in (interval.low, interval.high)
    ]
    return tuple(zip(bounds[::2], bounds[1::2], strict=True))


def _bound(bound: Bound, scope: Scope) -> Node:
    if isinstance(bound, int):
        return bound
    unless: dict[Node, Node] = {PointName(name): codes for name, codes in bound.unless if codes}
    return call(
        scope.runtime("Limit"), rule(bound.rule, scope), least=bound.least, greatest=bound.greatest, unless=unless
    )


def addresses_of(addresses: tuple[int, ...], space: str) -> tuple[int, ...]:
    """Return addresses in the notation of their space."""
    return addresses if space in NUMBERED else tuple(map(Hex, addresses))


def place(point: Point, addresses: Iterable[Node], scope: Scope) -> Node:
    """Return a place of a point, such as `holding(0x1028)`, with its index in an array."""
    facts: dict[str, Node] = {}
    if point.index is not None:
        facts["index"] = point.index
    if point.base:
        facts["base"] = point.base
    telegram = () if point.telegram is None else (point.telegram,)
    if point.place.bit is not None and point.telegram is not None:
        facts["telegram"] = point.telegram
    if point.place.bit is not None or point.space not in NUMBERED:
        return _place(point.space, addresses, facts, scope)
    return call(scope.runtime(point.space), *telegram, *addresses, **facts)


def place_of_command(command: Command, scope: Scope) -> Node:
    """Return the place that a command writes to, with the function that it takes."""
    address = addresses_of((command.address,), command.space)
    return _place(command.space, address, {"function": Hex(command.function, 2)}, scope)


def step_of(step: Step, scope: Scope) -> Node:
    """Return a step of a command."""
    addresses = addresses_of(tuple(range(step.address, step.address + len(step.words))), step.space)
    place: dict[str, Node] = {} if step.write is None else {"function": Hex(step.write, 2)}
    if step.base is not None:
        place["base"] = step.base
    where = _place(step.space, addresses, place, scope)
    facts: dict[str, Node] = {}
    if step.within is not None:
        facts["within"] = number(Fraction(step.within, 1000), binary=True)
    if step.when is not None:
        facts["when"] = tests_of(step.when)
    words = tuple(_word(word, scope) for word in step.words)
    return call(scope.runtime("Step"), step.says, where, words, **facts)


def _word(word: Word, scope: Scope) -> Node:
    if word.argument is None and word.mask == WHOLE_WORD:
        return word.constant & WHOLE_WORD
    argument = (word.factor, word.argument) if word.argument else ()
    mask = {} if word.mask == WHOLE_WORD else {"mask": Hex(word.mask)}
    return call(scope.runtime("StepWord"), word.constant, *argument, **mask)


def tests_of(condition: Condition) -> Node:
    """Return a condition as alternatives of tests."""
    return tuple(tuple((PointName(each.of), each.test, each.than) for each in clause) for clause in condition.clauses)


def _place(space: str, addresses: Iterable[Node], facts: Mapping[str, Node], scope: Scope) -> Node:
    maker = scope.runtime(_PLACES.get(space, "Place"))
    where = (space, tuple(addresses)) if maker == "Place" else addresses
    return call(maker, *where, **facts)


def number(value: Fraction, binary: bool = False) -> int | float:
    """Return a number as an integer if it is one; `binary` makes whole numbers floats too."""
    return value.numerator if value.denominator == 1 and not binary else float(value)
