"""The Python expressions for the facts of points: forms, rules, limits and places."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from fractions import Fraction

from fieldscribe.conditions import Comparison
from fieldscribe.lowered import Operand
from fieldscribe.model import Bound, Command, Linear, Point, ScaleCase, Special, Step, Word
from fieldscribe.model.steps import WHOLE_WORD
from fieldscribe.targets.python.identifiers import PackageScope
from fieldscribe.targets.python.layout import Group, Node, assigned, call
from fieldscribe.text import python_string

_PLACES = {"coil": "coil", "discrete": "discrete", "holding": "holding", "input": "input_register"}
_FORMS = {"enum": "Named", "float": "Floating"}
"""The classes of the runtime for forms of points that are not named after the form."""

NUMBERED = frozenset({"parameter", "telegram", "signal"})
"""Spaces whose addresses are written in decimal."""


def form(point: Point, named: str, scope: PackageScope) -> Node:
    """Return the form of a point: `Scaled(U16, Rule(num=10), decimals=1)`; `named` is its class of numbers or flags."""
    inner = _plain_form(point, named, scope)
    if not point.specials:
        return inner
    writes = point.writable and any(special.writable for special in point.specials)
    around = scope.runtime("WithWritableCodes" if writes else "WithCodes")
    return call(around, (inner, _codes(point, scope)))


def _codes(point: Point, scope: PackageScope) -> Node:
    """Return the special codes of a point; shared ones by the name of their constant."""
    codes = call(scope.runtime("Codes"), _code_arguments(point))
    if not point.shared_codes:
        return codes
    name = f"{point.shared_codes.upper()}_CODES"
    scope.codes.setdefault(name, assigned(name, codes))
    return name


def _code_arguments(point: Point) -> Iterator[Node]:
    texts = []
    for special in point.specials:
        low, high = (_code_number(end, special) for end in (special.low, special.high))
        texts.append(f"{python_string(special.name)}: {low if low == high else f'({low}, {high})'}")
    yield Group("{", tuple(texts), "}")
    for key in ("no_value", "writable"):
        names = [python_string(special.name) for special in point.specials if getattr(special, key)]
        if names:
            yield Group(f"{key}=(", tuple(names))


def _code_number(raw: int, special: Special) -> str:
    return f"0x{raw:04X}" if special.hexadecimal and raw >= 0 else str(raw)


def _plain_form(point: Point, named: str, scope: PackageScope) -> Node:
    """Return the form of values that are no special codes."""
    kind = scope.runtime(_FORMS.get(point.form, point.form.capitalize()))
    if point.form == "bit":
        return call(kind, [_wire(point, scope)] if point.swapped else ())
    if point.text is not None:
        layout = point.text
        encoding = [] if layout.encoding == "ascii" else [python_string(layout.encoding)]
        others = [
            ("per_word=1", layout.per_word == 1 and layout.encoding != "utf-16"),
            ("padding=0", not layout.padding),
        ]
        others.append(("low_first=True", layout.low_first))
        return call(kind, (str(layout.characters), *encoding, *(text for text, differs in others if differs)))
    arguments: list[Node] = [_wire(point, scope)]
    if named:
        scope.runtime("enums")
        arguments.append(f"enums.{named}")
    if point.digits is not None:
        arguments.append(f"count={point.digits.count}")
    elif point.enum is not None and point.enum.closed:
        arguments.append("closed=True")
    elif point.form == "scaled":
        arguments += _scaled(point, scope)
    elif point.allowed.units:
        pairs = tuple(f"({number(low, True)}, {number(high, True)})" for low, high in point.allowed.units)
        arguments.append(Group("units=(", pairs))
    return call(kind, arguments)


def _wire(point: Point, scope: PackageScope) -> Node:
    """Return the type on the wire: `U16`; one that has no constant as `Type(24)`."""
    shape = point.shape
    if not shape.narrow and not shape.swapped and not shape.coding:
        return scope.runtime(point.type.upper())
    facts = {"signed": shape.info.signed, "low_byte_first": shape.swapped}
    bits = point.width if shape.narrow else shape.info.bits
    stated = [f"{name}=True" for name, holds in facts.items() if holds]
    stated += [f"coding={python_string(shape.coding)}"] if shape.coding else []
    return call(scope.runtime("Type"), (str(bits), *stated))


def _scaled(point: Point, scope: PackageScope) -> Iterator[Node]:
    yield _scale(point.scale or (), scope)
    yield f"decimals={point.decimals}"
    if not point.encodes_values:
        yield "encodes=False"
    if point.most_raw is not None:
        yield f"most={point.most_raw}"


def _only_named(point: Point) -> bool:
    """Return True if the numbers that may be written are exactly those of the closed enum."""
    if point.enum is None or not point.enum.closed:
        return False
    named, ranges = {entry.raw for entry in point.enum.entries}, point.allowed.fixed
    as_many = not point.allowed.moves and sum(high - low + 1 for low, high in ranges) == len(named)
    return as_many and all(named.issuperset(range(low, high + 1)) for low, high in ranges)


def _scale(cases: tuple[ScaleCase, ...], scope: PackageScope) -> Node:
    if len(cases) == 1 and cases[0].point is None:
        return rule(cases[0].rule, scope, of_scale=True)
    items = []
    for case in cases:
        of = "None" if case.point is None else python_string(case.point)
        items.append(call(scope.runtime("Case"), (of, str(case.raw), rule(case.rule, scope, of_scale=True))))
    return Group("(", tuple(items))


def rule(linear: Linear, scope: PackageScope, *, of_scale: bool = False) -> Node:
    """Return a linear rule as integers; factors of a scale have their special codes with them."""
    ratio, offset = linear.ratio, linear.offset
    arguments: list[Node] = []
    if ratio.numerator != 1:
        arguments.append(f"num={ratio.numerator}")
    if ratio.denominator != 1:
        arguments.append(f"den={ratio.denominator}")
    if offset:
        arguments.append(f"offset=({offset.numerator}, {offset.denominator})")
    if linear.factors:
        factors = [_factor(operand, scope, of_scale=of_scale) for operand in scope.lowered.rule(linear).operands]
        arguments.append(Group("factors=(", tuple(factors)))
    return call(scope.runtime("Rule"), arguments)


def _factor(operand: Operand, scope: PackageScope, *, of_scale: bool) -> Node:
    factor = operand.factor
    arguments: list[Node] = [python_string(factor.point)]
    if factor.slope != 1:
        arguments.append(f"slope={factor.slope}")
    if factor.intercept:
        arguments.append(f"intercept={factor.intercept}")
    if factor.power != 1:
        arguments.append(f"power={factor.power}")
    if operand.floating:
        arguments.append("f32=True")
    if operand.within is not None:
        arguments.append("{}=({}, {})".format("ten_to" if factor.ten_to else "within", *operand.within))
    if of_scale and operand.codes:
        arguments.append(Group("codes=(", tuple([f"({low}, {high})" for low, high in operand.codes])))
    return call(scope.runtime("Factor"), arguments)


def is_limited(point: Point) -> bool:
    """Return True if the raw numbers that may be written are fewer than the type or the enum says."""
    if point.form in ("float", "text", "digits") or _only_named(point):
        return False
    return point.allowed.fixed != ((point.least, point.greatest),)


def allowed(point: Point, ends: tuple[str, ...], scope: PackageScope) -> Node:
    """Return the argument for the raw numbers that may be written; `ends`, if any, are the bounds of its intervals."""
    bounds = ends or [
        _bound(end, scope) for interval in point.allowed.intervals for end in (interval.low, interval.high)
    ]
    return Group("allowed=(", tuple([Group("(", pair) for pair in zip(bounds[::2], bounds[1::2], strict=True)]))


def _bound(bound: Bound, scope: PackageScope) -> Node:
    if isinstance(bound, int):
        return str(bound)
    unless = [
        Group(f"{python_string(name)}: (", tuple([f"({low}, {high})" for low, high in codes]))
        for name, codes in bound.unless
        if codes
    ]
    ends = (f"least={bound.least}", f"greatest={bound.greatest}")
    return call(scope.runtime("Limit"), (rule(bound.rule, scope), *ends, Group("unless={", tuple(unless), "}")))


def addresses_of(addresses: tuple[int, ...], space: str) -> list[str]:
    """Return addresses of a space as literals."""
    return [str(address) if space in NUMBERED else f"0x{address:04X}" for address in addresses]


def place(keyword: str, point: Point, addresses: Iterable[str], index: str, scope: PackageScope) -> Node:
    """Return a place of a point as an argument, such as `at=holding(0x1028)`, with its index in an array."""
    named = ("index", index), ("base", python_string(point.base) if point.base else "")
    beside = tuple(f"{key}={text}" for key, text in named if text)
    telegram = () if point.telegram is None else (python_string(point.telegram),)
    if point.place.bit is not None:
        of_message = (*beside, *(f"telegram={name}" for name in telegram))
        return _place(keyword, point.space, addresses, of_message, scope)
    if point.space not in NUMBERED:
        return _place(keyword, point.space, addresses, beside, scope)
    return call(f"{keyword}={scope.runtime(point.space)}", (*telegram, *addresses, *beside))


def place_of_command(command: Command, scope: PackageScope) -> Node:
    """Return the place that a command writes to, with the function that it takes."""
    address = addresses_of((command.address,), command.space)
    return _place("at", command.space, address, (f"function=0x{command.function:02X}",), scope)


def step_of(step: Step, scope: PackageScope) -> Node:
    """Return a step of a command."""
    last = step.address + len(step.words)
    function = () if step.write is None else (f"function=0x{step.write:02X}",)
    where = _place("", step.space, addresses_of(tuple(range(step.address, last)), step.space), function, scope)
    words = Group("(", tuple(_word(word, scope) for word in step.words))
    facts: list[Node] = [] if step.within is None else [f"within={number(Fraction(step.within, 1000), binary=True)}"]
    if step.when is not None:
        facts.append(Group("when=(", tuple(Group("(", tuple(map(_test, clause))) for clause in step.when.clauses)))
    return call(scope.runtime("Step"), (python_string(step.says), where, words, *facts))


def _word(word: Word, scope: PackageScope) -> Node:
    if word.argument is None and word.mask == WHOLE_WORD:
        return str(word.constant & WHOLE_WORD)
    argument = (str(word.factor), python_string(word.argument)) if word.argument else ()
    mask = () if word.mask == WHOLE_WORD else (f"mask=0x{word.mask:04X}",)
    return call(scope.runtime("StepWord"), (str(word.constant), *argument, *mask))


def _test(comparison: Comparison) -> Node:
    than = [python_string(each) if isinstance(each, str) else str(each) for each in comparison.than]
    return Group("(", (python_string(comparison.of), python_string(comparison.test), Group("(", tuple(than))))


def _place(keyword: str, space: str, addresses: Iterable[str], beside: tuple[str, ...], scope: PackageScope) -> Node:
    maker = scope.runtime(_PLACES.get(space, "Place"))
    where = (python_string(space), Group("(", tuple(addresses))) if maker == "Place" else addresses
    return call(f"{keyword}={maker}" if keyword else maker, (*where, *beside))


def number(value: Fraction, binary: bool = False) -> str:
    """Return a number as a literal; `binary` makes whole numbers floats too."""
    return str(value.numerator) if value.denominator == 1 and not binary else repr(float(value))
