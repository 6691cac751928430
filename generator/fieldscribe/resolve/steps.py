"""Resolves `steps`: turns values of points and formulas of arguments into the words of requests, in order."""

from collections.abc import Iterator, Mapping
from typing import Any

from fieldscribe.arithmetic.codec import CodecError, check
from fieldscribe.arithmetic.words import exchanged, group_mask, insert, with_fixed, words_of
from fieldscribe.conditions import Condition
from fieldscribe.diagnostics import Span
from fieldscribe.language.formula.parser import VARIABLES
from fieldscribe.language.nodes import Map
from fieldscribe.language.suggestions import space_hint
from fieldscribe.model import Bus, Point, Step, SteppedCommand, Word
from fieldscribe.resolve.bus import NO_BUS, reader_of
from fieldscribe.resolve.conditions import condition_of
from fieldscribe.resolve.frames import RAW, StatedValues
from fieldscribe.resolve.point_facts import PointFacts
from fieldscribe.resolve.scales import Scales
from fieldscribe.resolve.scope import Scope, source_of, titles
from fieldscribe.resolve.symbols import SymbolTable
from fieldscribe.resolve.values import FactError, formula_multiples, interval, whole
from fieldscribe.text import humanised
from fieldscribe.wording import meaning_text

MOST_STEPS = 1000
MOST_ARGUMENTS = 8
_LEAST, _GREATEST = -0x8000, 0xFFFF
"""The numbers that a word can hold, with or without a sign."""
_MILLISECONDS = {"ms": 1, "s": 1000, "min": 60_000}
_ACTIONS = ("write", "words", "wait")


class Steps:
    """Resolves commands with steps; findings are reported."""

    def __init__(self, scope: Scope, bus: Bus, symbols: SymbolTable, points: Mapping[str, Point]) -> None:
        self.scope, self.bus, self.symbols, self.points = scope, bus, symbols, points
        self.arguments: dict[str, tuple[int, int]] = {}
        self._meanings: list[str] = []
        """The values that the points of the step shall hold."""

    def command(self, node: Map) -> SteppedCommand | None:
        """Return a command; None after a finding."""
        before = self.scope.report.count
        stated = node.get("arguments", {})
        self.arguments = {name: self._argument(name, str(ends), stated.span(name)) for name, ends in stated.items()}
        run = str(node.get("run", "by caller"))
        if run in ("first", "before write") and self.arguments:
            message, hint = f"`run: {run}` can choose no arguments", "leave out `arguments`, or `run`"
            self._report(message, node.key_span("arguments"), hint)
        for key, most in (("steps", MOST_STEPS), ("arguments", MOST_ARGUMENTS)):
            if len(node.get(key, ())) > most:
                self._report(f"a command has at most {most} {key}", node.key_span(key), "make it several commands")
                return None
        if "arguments" in node.broken or (stated and stated.broken):
            return None
        steps: list[Step] = []
        for step in node["steps"]:
            try:
                steps.append(self._step(step))
            except FactError as error:
                error.report(self.scope.report)
        if self.scope.report.count > before:
            return None
        used = {word.argument for step in steps for word in step.words}
        unused = next((name for name in self.arguments if name not in used), None)
        is_whole = len(steps) == len(node["steps"]) and not node["steps"].broken
        if unused is not None and is_whole:  # a step that is left out might use it
            self._report(f"no step uses the argument `{unused}`", stated.key_span(unused), "use it, or leave it out")
        name = str(node["name"])
        return SteppedCommand(
            name=name,
            title=titles(node.get("title"), humanised(name)),
            note=titles(node.get("note")),
            run="every" if run.startswith("every") else run,
            every=_milliseconds(run.removeprefix("every ")) if run.startswith("every") else None,
            arguments=self.arguments,
            steps=tuple(steps),
            source=source_of(self.scope, node),
        )

    def _report(self, message: str, span: Span, hint: str) -> None:
        self.scope.report.error("steps", message, span, hint)

    def _argument(self, name: str, text: str, span: Span) -> tuple[int, int]:
        ends = interval(text, span, self.scope.report) or (0, 0)
        if name in VARIABLES:
            self._report(f"`{name}` is a word of formulas", span, "give the argument another name")
        if not _LEAST <= ends[0] <= ends[1] <= _GREATEST:
            self._report(f"a word cannot hold `{name}`", span, f"write {_LEAST}..{_GREATEST} or less")
        return ends

    def _step(self, node: Map) -> Step:
        """Return a step. Raises FactError."""
        actions = [key for key in _ACTIONS if key in node]
        if node.broken or ("words" in node and "at" not in node) or ("wait" in node) != ("within" in node):
            raise FactError  # it has a finding already
        if len(actions) != 1:
            hint = "write `write: {POINT: value}`, `at` and `words`, or `wait: {POINT: value}` and `within`"
            raise FactError("steps", "a step writes or waits, one of the two", node.span(), hint)
        action = actions[0]
        for key in ("space", "at"):
            if key in node and action != "words":
                message, hint = f"`{key}` does not belong beside `{action}`", "the points say where they are"
                raise FactError("steps", message, node.key_span(key), hint)
        if action == "words":
            (space, address, words), base = self._by_address(node), None
        else:
            space, base, address, words = self._by_points(node, action)
        masked = any(word.mask != 0xFFFF for word in words)
        return Step(
            space=space,
            address=address,
            words=words,
            read=self._function(node, space, len(words), writes=False) if masked or action == "wait" else None,
            write=None if action == "wait" else self._function(node, space, len(words), writes=True),
            within=_milliseconds(str(node["within"])) if action == "wait" else None,
            when=self._condition(node),
            says=", ".join(map(str, words) if action == "words" else self._meanings),
            base=base,
        )

    def _by_address(self, node: Map) -> tuple[str, int, tuple[Word, ...]]:
        """Return the space, the first address and the words of a step by address. Raises FactError."""
        space, known = str(node.get("space", self.scope.family.commands_in)), self.scope.family.spaces
        if space not in known:
            self.scope.unknown("space", space, node.span("space"), known, space_hint(space, known))
            raise FactError
        listed = node["words"]
        ends = (0, 1) if known[space] == "bit" else (_LEAST, _GREATEST)
        words = tuple(self._word(value, listed.span(place), ends) for place, value in enumerate(listed))
        address = whole(node["at"], node.span("at"))
        last = self.scope.family.last_address
        if not 0 <= address <= last + 1 - len(words):
            message = f"the words lie outside 0..{last}"
            raise FactError("address-outside-space", message, node.span("at"), "`at` is the number on the wire")
        if any(low < address + len(words) and address <= high for low, high in self.bus.gaps.get(space, ())):
            message = "the words lie in a gap that no request may touch"
            raise FactError("address-in-gap", message, node.span("at"), "leave their addresses out of the gap")
        return space, address, words

    def _word(self, value: Any, span: Span, ends: tuple[int, int]) -> Word:
        """Return the word of a number or a formula. Raises FactError if it can leave the ends."""
        word = self._formula(value, span)
        if low := next((number for number in self._extremes(word) if not ends[0] <= number <= ends[1]), None):
            raise FactError("steps", f"a word cannot be {low}", span, f"{ends[0]}..{ends[1]} can be written")
        return word

    def _formula(self, value: Any, span: Span) -> Word:
        """Return a number, or a formula of one argument, as a word of any size. Raises FactError."""
        known = f"known: {', '.join(self.arguments)}" if self.arguments else "write a number, or declare `arguments`"
        constant, factors = formula_multiples(str(value), self.arguments, span, known)
        if len(factors) > 1:
            hint = "write a whole number, or one argument times and plus whole numbers: 65535 - unit"
            raise FactError("steps", f"`{value}` has two arguments", span, hint)
        for name, factor in factors.items():
            return Word(constant, factor, name)
        return Word(constant)

    def _extremes(self, word: Word) -> Iterator[int]:
        """Yield the least and the greatest number that a word can hold."""
        for end in self.arguments.get(word.argument or "", (0,)):
            yield word.constant + word.factor * end

    def _by_points(self, node: Map, action: str) -> tuple[str, str | None, int, tuple[Word, ...]]:
        """Return the space, the base, the first address and the words of the points of a step. Raises FactError."""
        values: Map = node[action]
        if values.broken:
            raise FactError  # it has a finding already
        placed: dict[int, Word] = {}
        self._meanings = []
        spaces: set[tuple[str, str | None]] = set()
        for named, value in values.items():
            point, span = self._point(values, named, action), values.key_span(named)
            spaces.add((point.space, point.base))
            place = point.written if action == "write" else point.place
            for address, word in zip(place.addresses, self._words(point, values, named, value, action), strict=True):
                other = placed.get(address, Word(0, mask=0))
                if other.mask & word.mask or (other.factor and word.factor):
                    shared = "bits" if other.mask & word.mask else "a word with a formula"
                    raise FactError("steps", f"`{named}` shares {shared} with a point before it", span, "leave one out")
                argument, factor = (word.argument, word.factor) if word.factor else (other.argument, other.factor)
                placed[address] = Word(other.constant + word.constant, factor, argument, other.mask | word.mask)
        first = min(placed, default=0)
        if len(spaces) != 1 or max(placed, default=0) - first + 1 != len(placed):
            hint = "one step is one request: give each a step of its own"
            raise FactError("steps", "these points do not follow each other", node.key_span(action), hint)
        return *spaces.pop(), first, tuple(placed[address] for address in sorted(placed))

    def _point(self, values: Map, named: str, action: str) -> Point:
        """Return the point that a step names. Raises FactError."""
        facts = self.symbols.find(named.removesuffix(RAW))
        if facts is None:
            self.symbols.unknown(named.removesuffix(RAW), values.key_span(named))
            raise FactError
        point = self.points[facts.item]
        if facts.failed:
            raise FactError
        reached = point.writable if action == "write" else point.readable
        is_split = point.variant is not None or (point.bits and point.write_place)
        if not reached or is_split or point.text is not None or point.untyped is not None or not point.addresses:
            message = f"`{point.name}` cannot be {'written' if action == 'write' else 'read'} by a step"
            hint = "name a number that all variants have at one address, or write its words by `at` and `words`"
            raise FactError("steps", message, values.key_span(named), hint)
        return point

    def _words(self, point: Point, values: Map, named: str, value: Any, action: str) -> tuple[Word, ...]:
        """Return the words of a point in the order of its addresses. Raises FactError."""
        span = values.span(named)
        if named.endswith(RAW):
            word = self._formula(value, span)
            meaning = str(word)
        else:
            if str(value) in self.arguments:
                message = f"`{value}` is an argument, and `{named}` takes values"
                raise FactError("steps", message, span, f"arguments are raw numbers: write `{named}{RAW}: {value}`")
            word = Word(StatedValues(self.scope, values).raw(point, named, value))
            meaning = meaning_text(point, word.constant) or str(word)
        self._meanings.append(f"{named} = {meaning}")
        for raw in self._extremes(word):
            self._check(point, with_fixed(point, raw) if word.factor == 0 else raw, span, action)
        if word.factor == 0:
            return self._constants(point, with_fixed(point, word.constant), action)
        moved = point.words != 1 or point.swapped or point.coding
        if moved or (point.bits is not None and min(self._extremes(word)) < 0):
            message = (
                f"`{point.name}` takes no formula: it is several words, has bits of its own order, or a sign in bits"
            )
            raise FactError("steps", message, span, "write its words by `at` and `words`")
        shift = 0 if point.bits is None else point.bits[1]
        [fixed] = self._constants(point, 0, action)
        return (Word(fixed.constant + (word.constant << shift), word.factor << shift, word.argument, fixed.mask),)

    def _constants(self, point: Point, raw: int, action: str) -> tuple[Word, ...]:
        if point.bits is None:
            return tuple(map(Word, words_of(point, raw)))
        fixed = point.fixed.mask if point.fixed is not None and action == "write" else 0
        [mask] = exchanged(point, group_mask(point) | fixed)
        return (Word(insert(point, 0, raw) & mask, mask=mask),)

    def _check(self, point: Point, raw: int, span: Span, action: str) -> None:
        """Raise FactError if the point cannot hold the raw number, or a step must not write it."""
        low, high = point.held
        fits = point.info.floating or low <= raw <= high
        try:
            if fits and action == "write":
                check(point, raw, {})
        except CodecError as error:
            fits = error.status == "missing"
        if not fits:
            message = f"`{point.name}` cannot be raw {raw}"
            raise FactError("range-outside-type", message, span, "write what its range and its type allow")

    def _function(self, node: Map, space: str, count: int, *, writes: bool) -> int:
        """Return the function of the step, or the one that the device has for this many words. Raises FactError."""
        able = reader_of(self.scope).able(self.bus, space, count, writes=writes)
        function = next(iter(able), 0)
        if writes and "function" in node:
            function = whole(node["function"], node.span("function"))
        if function not in able and self.bus is not NO_BUS:
            message = f"the device has no function that {'writes' if writes else 'reads'} {count} at once in `{space}`"
            hint = f"functions that do: {', '.join(f'{other:02X}h' for other in able) or 'none'}"
            if able:
                message = f"function {function:02X}h does not write {count} at once into `{space}`"
            raise FactError("unknown-function", message, node.span("function" if "function" in node else None), hint)
        return function

    def _condition(self, node: Map) -> Condition | None:
        """Return the condition of the step. Raises FactError."""
        if "when" not in node:
            return None
        asking = PointFacts("", (node,), Map(node.file, node.start), node, {})
        condition = condition_of(asking, Scales(self.scope, self.symbols))
        if condition is None:
            raise FactError
        unknown = [name for name in condition.names if name not in self.scope.axes and not self._is_read(name)]
        if unknown:
            message, hint = f"`{unknown[0]}` cannot be read", "compare a variant, or a point that all variants have"
            raise FactError("steps", message, node.span("when"), hint)
        return condition

    def _is_read(self, name: str) -> bool:
        return name in self.points and self.points[name].readable and bool(self.points[name].addresses)


def _milliseconds(text: str) -> int:
    number, unit = text.split()
    return int(number) * _MILLISECONDS[unit]
