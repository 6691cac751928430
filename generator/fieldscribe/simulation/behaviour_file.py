"""Reads behaviour.yaml, the file next to device.yaml with the rules of a simulated device, and checks it."""

import os
from collections.abc import Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from fractions import Fraction
from pathlib import Path
from typing import Any

from fieldscribe.arithmetic.codec import CodecError, encode
from fieldscribe.arithmetic.words import mask_of
from fieldscribe.diagnostics import Report, Span
from fieldscribe.grouping import grouped
from fieldscribe.language.formula import conditions
from fieldscribe.language.formula.conditions import Move, parse_move
from fieldscribe.language.formula.normal import evaluate
from fieldscribe.language.formula.syntax import (
    Binary,
    Expression,
    FormulaError,
    Name,
    Negate,
    Number,
    ZeroDivisorError,
    names,
)
from fieldscribe.language.hints import nearest, quoted
from fieldscribe.language.keys.places import BEHAVIOUR
from fieldscribe.language.load import load
from fieldscribe.language.nodes import Map, read_source
from fieldscribe.language.shape import check_shape
from fieldscribe.language.units import shipped_unit
from fieldscribe.model import Device, Flag, Point
from fieldscribe.resolve.scope import titles
from fieldscribe.resolve.values import FactError, formula_finding, number
from fieldscribe.simulation.behaviour_rules import TIME, Amount, Quantity, Ref, Rule, Rules, Step, Test

FILE = "behaviour.yaml"
_BEGINNING = "a behaviour starts with `behaviour: DEVICE`, and its rules stand under `moves`"
_SECONDS = {"ms": Fraction(1, 1000), "s": Fraction(1), "min": Fraction(60), "h": Fraction(3600)}
_NO_NUMBER = "use a quantity under `plant` instead"

Dimension = dict[str, int]
"""The units of an expression, each with its power."""


def read_behaviour(device_file: Path, device: Device, report: Report) -> Rules | None:
    """Return the rules of the behaviour file beside a device.yaml; None without one, or after a finding."""
    findings, path = Report(), device_file.parent / FILE
    if not os.path.lexists(path):
        return None
    source = read_source(path, findings, beginning=_BEGINNING)
    documents = [] if source is None else load(source, findings)
    rules = None
    if documents and documents[0] is not None:
        if len(documents) > 1:
            findings.error("bad-behaviour", "a behaviour is one document", documents[0].span(), "remove the `---`")
        if check_shape(documents[0], BEHAVIOUR, findings):
            rules = _Reader(documents[0], device, findings).rules()
    report.extend(findings)
    return None if findings.has_errors else rules


class _Reader:
    """Turns the nodes of a file into rules; reports and leaves out what is wrong."""

    def __init__(self, node: Map, device: Device, report: Report) -> None:
        self.node, self.device, self.report = node, device, report
        self.by_name = grouped((point.name, point) for point in device.points)
        by_code = grouped((point.code, point) for point in device.points if point.code is not None)
        self.by_code = {code: points for code, points in by_code.items() if code not in self.by_name}
        self.plant: dict[str, Quantity] = {}
        self.wrong: AbstractSet[str] = frozenset()
        """Quantities with a finding: what uses them has no further one."""

    def rules(self) -> Rules:
        """Return the rules of the file."""
        if self.node["behaviour"] != self.device.id:
            message = f"this is the behaviour of `{self.node['behaviour']}`, next to the description of another device"
            self.report.error("bad-behaviour", message, self.node.span("behaviour"), f"write `{self.device.id}`")
        stated = {name: self._quantity(name, given) for name, given in self.node.get("plant", {}).items()}
        self.plant = {name: quantity for name, quantity in stated.items() if quantity is not None}
        self.wrong = stated.keys() - self.plant
        start = dict(self._start())
        return Rules(self.plant, start, tuple(self._rules()))

    def _quantity(self, name: str, given: Any) -> Quantity | None:
        """Return a quantity; None after a finding."""
        plant: Map = self.node["plant"]
        named = self.by_name.get(name, self.by_code.get(name, []))
        if name == TIME or any(map(_has_number, named)):
            message = f"`{name}` is the name of {'the time' if name == TIME else 'a point'}"
            self.report.error("duplicate-name", message, plant.key_span(name), "give the quantity another name")
            return None
        facts: Mapping[str, Any] = given if isinstance(given, Map) else {"start": given}
        symbol, declared = facts.get("unit", ""), {point.unit.symbol for point in self.device.points}
        if any(shipped_unit(part) is None and part not in declared for part in _units_of(symbol)):
            hint = "write a unit that `fieldscribe units` lists, or that a point has"
            self._unknown("unit", symbol, given.span("unit"), declared, hint)
            return None
        return Quantity(Fraction(facts.get("start", 0)), symbol, titles(facts.get("title")).get("en", ""))

    def _start(self) -> Iterator[tuple[str, Fraction]]:
        """Yield the start values of points."""
        stated: Map = self.node.get("start") or Map(self.node.file, self.node.start)
        for word, value in stated.items():
            point = self._point(word, stated.key_span(word))
            if point is None:
                continue
            named = _names_of(point, None)
            if isinstance(value, str) and value in named:
                yield point.name, Fraction(named[value])
                continue
            if isinstance(value, str) and named and not value[:1].isdigit():
                self._unknown("entry", value, stated.span(word), named)
                continue
            exact = Fraction(value) if isinstance(value, bool) else number(value, stated.span(word), self.report)
            if exact is not None and self._fits(point, None, exact, word, stated.span(word)):
                yield point.name, exact

    def _fits(self, point: Point, flag: Flag | None, value: Fraction, word: str, span: Span) -> bool:
        """Report a value that the bits of a point, or of a flag of it, cannot hold."""
        low, high, raw = point.least, point.greatest, value
        if flag is not None:
            low, high = 0, mask_of(flag.width)
        elif point.scale_arguments or point.info.floating:
            return True
        else:
            try:
                raw = Fraction(encode(point, value, {}))
            except CodecError:
                return True
        if not low <= raw <= high:
            self.report.error("range-outside-type", f"`{word}` cannot be {value}", span, "correct the number")
        return low <= raw <= high

    def _rules(self) -> Iterator[Rule]:
        stated: Map = self.node["moves"]
        seen: dict[Ref, str] = {}
        for word, texts in stated.items():
            ref = self._target(word, stated.key_span(word))
            if ref is None:
                continue
            if ref in seen:
                message = f"`{word}` moves twice: `{seen[ref]}` is the same"
                self.report.error("duplicate-name", message, stated.key_span(word), "put the moves into one list")
                continue
            seen[ref] = word
            listed = (
                [(texts, stated.span(word))]
                if isinstance(texts, str)
                else zip(texts, map(texts.span, range(len(texts))), strict=True)
            )
            steps = [self._step(ref, text, span) for text, span in listed]
            yield Rule(ref, tuple([step for step in steps if step is not None]))

    def _step(self, ref: Ref, text: str, span: Span) -> Step | None:
        """Return one move; None after a finding."""
        try:
            move = parse_move(text)
            return self._resolved(ref, move, span)
        except FormulaError as error:
            formula_finding(error, span, self.report)
        except FactError as error:
            error.report(self.report)
        return None

    def _resolved(self, ref: Ref, move: Move, span: Span) -> Step:
        """Return a move with its names resolved. Raises FactError or FormulaError."""
        target = self._named(ref, move.target) or self._amount(move.target, span)
        if not (move.rates or move.once) and ref in target.refs.values():
            hint = "write `when` to count, or `ramp to … at …` to move on"
            raise FormulaError("a number cannot be set from itself again and again", move.target.column, hint)
        points = () if target.refs else self.by_name.get(ref.name, ())
        word = ".".join(filter(None, (ref.name, ref.flag_name)))
        if points and not self._fits(points[0], ref.flag, evaluate(target.expression, {}), word, span):
            raise FactError
        rates = [self._with_unit(rate, span, ref.unit, per_second=True) for rate in move.rates]
        delay = None if move.delay is None else self._with_unit(move.delay, span, "", per_second=False)
        clauses = tuple([tuple([self._test(each, move, span) for each in clause]) for clause in move.condition])
        return Step(target, tuple(rates), clauses, move.once, delay)

    def _named(self, ref: Ref, written: conditions.Amount) -> Amount | None:
        """Return the number of a name of the moved point or flag; None if the target is no such name."""
        expression = written.expression
        points = self.by_name.get(ref.name)
        known = {} if points is None else _names_of(points[0], ref.flag)
        if not isinstance(expression, Name) or expression.name not in known:
            return None
        return Amount(Number(Fraction(known[expression.name]), expression.column), {})

    def _amount(self, written: conditions.Amount, span: Span) -> Amount:
        """Return an expression with its names resolved. Raises FactError or FormulaError."""
        if (column := _zero_divisor(written.expression)) is not None:
            raise ZeroDivisorError(written.column + column)
        refs = {}
        for name in names(written.expression):
            place = span.moved(written.column + name.column, len(name.name))
            refs[name] = self._ref(name.name, "", raw=name.part == "raw", span=place)
        return Amount(written.expression, refs)

    def _with_unit(self, written: conditions.Amount, span: Span, unit: str, *, per_second: bool) -> Amount:
        """Return a rate in `unit` a second, or a time in seconds. Raises FactError or FormulaError."""
        amount = self._amount(written, span)
        if not per_second and not amount.refs and evaluate(amount.expression, {}) < 0:
            raise FormulaError("a time is not negative", written.column, "write one from 0 on")
        stated = _units_of(written.unit) if written.unit else _dimension(amount.expression, amount.refs)
        for time, seconds in _SECONDS.items():
            wanted = _units_of(f"{unit}/{time}" if per_second else time)
            if stated == wanted:
                return Amount(amount.expression, amount.refs, 1 / seconds if per_second else seconds)
        wanted_text = f"{unit or '1'}/s" if per_second else "s"
        hint = f"write that unit after it, as in `10 {wanted_text}`"
        raise FormulaError(f"this is not in {wanted_text}", written.column, hint)

    def _test(self, stated: conditions.Comparison, move: Move, span: Span) -> Test:
        """Return a comparison with its words resolved. Raises FactError or FormulaError."""
        name, column = stated.name, move.condition_column
        if stated.op in (conditions.EXISTS, conditions.NOT_EXISTS):
            raise FormulaError("a simulated device has all its points", column + stated.column, "leave this out")
        place = span.moved(column + name.column, len(name.name))
        ref = self._ref(name.name, stated.key, raw=name.part == "raw", span=place)
        points = self.by_name.get(ref.name)
        named = {} if points is None or ref.kind == "raw" else _names_of(points[0], ref.flag)
        constants = []
        for constant in stated.constants:
            value = named.get(constant.value) if isinstance(constant.value, str) else constant.value
            if value is None:
                self._unknown("entry", str(constant.value), span.moved(column + constant.column), named)
                raise FactError
            constants.append(Fraction(value))
        return Test(ref, stated.op, tuple(constants))

    def _target(self, word: str, span: Span) -> Ref | None:
        """Return the target of a key under `moves`; None after a finding."""
        name, _, part = word.partition(".")
        try:
            ref = self._ref(name, part, raw=False, span=span)
        except FactError as error:
            error.report(self.report)
            return None
        if ref.kind == "time":
            self.report.error("unknown-point", "the time cannot be moved", span, "move a point or a quantity")
            return None
        return ref

    def _ref(self, name: str, part: str, *, raw: bool, span: Span) -> Ref:
        """Return the reference of a name, with its flag if it has one. Raises FactError."""
        names = [name, *(point.name for point in self.by_code.get(name, ()))]
        name = next((each for each in names if each in self.plant), name)
        if name in self.wrong:
            raise FactError
        if name in self.plant or name == TIME:
            if part or raw:
                raise FactError("unknown-point", f"`{name}` is a number and has no part", span, "leave it out")
            if name == TIME:
                return Ref(name, "time", unit="s")
            return Ref(name, "plant", unit=self.plant[name].unit)
        point = self._point(name, span)
        if point is None:
            raise FactError
        if not part:
            return Ref(point.name, "raw") if raw else Ref(point.name, "value", unit=point.unit.symbol)
        flags = {flag.name: flag for flag in point.flags}
        if part not in flags:
            self._unknown("flag", part, span, flags, None if flags else f"`{name}` has no flags: leave `.{part}` out")
            raise FactError
        return Ref(point.name, "flag", flags[part], flag_name=part)

    def _point(self, word: str, span: Span) -> Point | None:
        """Return the point that a word names, the first of its variants; None after a finding."""
        points = self.by_name.get(word) or self.by_code.get(word, [])
        if len({point.name for point in points}) > 1:
            message = f"`{word}` is the code of {len(points)} points"
            self.report.error("unknown-point", message, span, f"name one of them, such as `{points[0].name}`")
            return None
        if not points:
            self._unknown("point", word, span, [*self.by_name, *self.by_code, *self.plant])
            return None
        point = points[0]
        if not _has_number(point):
            what = (
                f"is {point.text.kind}" if point.text is not None else "has no number here: the manual leaves it open"
            )
            self.report.error("unknown-point", f"`{word}` {what}", span, _NO_NUMBER)
            return None
        return point

    def _unknown(self, what: str, word: str, span: Span, known: Iterable[str], hint: str | None = None) -> None:
        near = nearest(word, tuple(known))
        hint = hint or (
            f"did you mean `{near}`?" if near else f"known: {', '.join([*known][:12])}" if known else "write a number"
        )
        self.report.error(f"unknown-{what}", f"there is no {what} {quoted(word)}", span.moved(0, len(word)), hint)


def _has_number(point: Point) -> bool:
    """Return True if a behaviour can compute with the point."""
    return point.untyped is None and point.text is None and bool(point.addresses)


def _names_of(point: Point, flag: Flag | None) -> dict[str, int]:
    """Return the names of the numbers of a point, or of a flag."""
    entries = (point.enum.entries if point.enum is not None else ()) if flag is None else flag.values
    single = point.width == 1 if flag is None else flag.width == 1
    return {entry.name: entry.raw for entry in entries} or ({"off": 0, "on": 1} if single else {})


def _units_of(text: str) -> Dimension:
    """Return the units of a symbol such as `Hz/s`, each with its power."""
    above, _, below = text.partition("/")
    return {symbol: power for symbol, power in ((above, 1), (below, -1)) if symbol not in ("", "1")}


def _zero_divisor(expression: Expression) -> int | None:
    """Return the column of a division by 0 in an expression; None if there is none."""
    match expression:
        case Binary(op, left, right, column):
            inner = next((at for at in map(_zero_divisor, (left, right)) if at is not None), None)
            return column if inner is None and op == "/" and _is_zero(right) else inner
        case Negate(operand):
            return _zero_divisor(operand)
    return None


def _is_zero(expression: Expression) -> bool:
    """Return True if an expression without a zero divisor is 0, whatever its names are."""
    match expression:
        case Binary("*", left, right):
            return _is_zero(left) or _is_zero(right)
        case Binary("/", operand) | Negate(operand):
            return _is_zero(operand)
    return not names(expression) and evaluate(expression, {}) == 0


def _dimension(expression: Expression, refs: Mapping[Name, Ref]) -> Dimension:
    """Return the units of an expression; for a sum, those of the first part with units."""
    match expression:
        case Name():
            return _units_of(refs[expression].unit)
        case Negate(operand):
            return _dimension(operand, refs)
        case Binary(op, left, right):
            first, second = _dimension(left, refs), _dimension(right, refs)
            if op in "+-":
                return first or second
            sign = 1 if op == "*" else -1
            powers = {unit: first.get(unit, 0) + sign * second.get(unit, 0) for unit in {**first, **second}}
            return {unit: power for unit, power in powers.items() if power}
    return {}
