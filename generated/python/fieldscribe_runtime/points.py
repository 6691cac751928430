# SPDX-License-Identifier: 0BSD
"""Points: pure conversion between values, raw numbers and words."""

from __future__ import annotations

from functools import cached_property
from operator import itemgetter
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from .arguments import raw_number, shown, whole
from .errors import (
    AbsentError,
    CodecError,
    RangeError,
    SpecialCodeError,
    UnknownValueError,
    WrongLengthError,
    WrongTypeError,
)
from .forms import U16
from .guided import Guided
from .rules import NO_RAWS, Limit, Raws, high_end, low_end, outside
from .special import Special

if TYPE_CHECKING:
    import enum
    from collections.abc import Callable, Iterable, Sequence

    from .facts import Facts, Place
    from .fast import Way
    from .forms import Allowed, Form, Type
    from .special import Codes

R_co = TypeVar("R_co", covariant=True)
W_contra = TypeVar("W_contra", contravariant=True)


def _shown(value: object) -> str:
    """Return a value for messages."""
    try:
        return f"{value:.12g}" if isinstance(value, float) else f"{value!s}"
    except ValueError:  # more digits than Python prints
        return "a number of thousands of digits"


_READS = frozenset({"read", "read_raw", "decode"})
_WRITES = frozenset({"write", "write_raw", "encode"})


def _lacks(point: Point, name: str) -> str:
    """Return why a point has no method of this name."""
    for methods, kind, done in ((_READS, Decoding, "written"), (_WRITES, Encoding, "read")):
        if name in methods and not isinstance(point, kind):
            return f"{point.label} is only {done}: it has no {name}"
    if name in _READS | _WRITES:
        return (
            f"{point.label} of the class only converts: make a device, and call device.{point.facts.item}.{name}(...)"
        )
    return f"{type(point).__name__!r} object has no attribute {name!r}"


_SPECIALISED = frozenset({"decode", "decoder", "encode", "encoder", "joined", "sure_decoder"})


_FOR_PEOPLE = (
    *("read", "write", "read_raw", "write_raw", "decode", "encode", "decode_count", "encode_count", "check", "text"),
    *("title", "label", "unit", "minimum", "maximum", "raw_limits", "decimals", "names", "name_of", "special", "facts"),
    *("scale_needs", "limit_needs", "from_words", "to_words"),
)
"""What `dir()` lists, for completion; the other names are for devices and layouts."""


class Point(Guided):
    """One data point. Its methods need no device; subclasses add decoding and encoding."""

    _form: Form[Any, Any]
    facts: Facts

    @property
    def label(self) -> str:
        """The code and the name, for messages."""
        return f"{self.facts.code} {self.facts.item}" if self.facts.code else self.facts.item

    def __repr__(self) -> str:
        display = self.facts.display
        shown = "" if display is None else f", shown with {display} decimal{'' if display == 1 else 's'}"
        return f"<{type(self).__name__} {self.label}: {self.facts.where}{shown}>"

    def _guide(self) -> str:
        from .guide import described  # only help() needs it

        return described(self)

    if not TYPE_CHECKING:  # type checkers report names that do not exist

        def __getattr__(self, name: str) -> Any:
            """Raise AttributeError with the reason why a point lacks a method."""
            kind = AbsentError if name in _READS | _WRITES else AttributeError
            raise kind(_lacks(self, name), name=name, obj=self)

    def __dir__(self) -> list[str]:
        """Return the names that users of a point need."""
        return [name for name in _FOR_PEOPLE if name in self.__dict__ or hasattr(type(self), name)]

    @property
    def title(self) -> str:
        """The name in words: `Base frequency set 2`."""
        return self.facts.item.replace("_", " ").capitalize()

    @property
    def unit(self) -> str:
        """The unit of its values; empty if they have none."""
        return self.facts.unit

    @property
    def minimum(self) -> float | None:
        """The least value that is ever allowed, in the unit; None if there is none, or other points decide."""
        bounds = self._bounds
        return bounds[0] if bounds else None

    @property
    def maximum(self) -> float | None:
        """The greatest value that is ever allowed, in the unit; None as for `minimum`."""
        bounds = self._bounds
        return bounds[1] if bounds else None

    @property
    def _bounds(self) -> tuple[float, float] | None:
        try:
            return self._form.bounds(*self.raw_limits)
        except CodecError:
            return None

    def __getstate__(self) -> dict[str, Any]:
        """Return the state without the specialised functions: a copy makes its own."""
        return {name: value for name, value in self.__dict__.items() if name not in _SPECIALISED}

    @property
    def wire(self) -> Type:
        """The wire type."""
        return self._form.wire

    @property
    def width(self) -> int:
        """The number of bits of the raw number."""
        return self.wire.bits if self.facts.bits is None else self.facts.bits[0] - self.facts.bits[1] + 1

    @cached_property
    def size(self) -> int:
        """The number of words (or single bits) of the point."""
        return 1 if self.facts.bits is not None else -(-self.wire.bits // 16)

    @property
    def names(self) -> type[enum.IntEnum | enum.IntFlag] | None:
        """The class that names its numbers or its flags; None if there is none."""
        return self._form.names

    @property
    def decimals(self) -> int | None:
        """Counts are in units of 10^-decimals; None if there are no counts."""
        return self._form.decimals

    @property
    def special(self) -> Codes:
        """The special codes: `point.special.inactive`, or `point.special(raw)` for what a raw number is."""
        return self._form.codes

    @property
    def allowed(self) -> Allowed:
        """The raw numbers that the description allows."""
        return (self.wire.limits(self.width),) if self.facts.allowed is None else self.facts.allowed

    @property
    def raw_limits(self) -> tuple[int, int]:
        """The least and the greatest raw number that is ever allowed, whatever other points hold."""
        if self.facts.allowed is None:
            return self._form.limits(self.width)
        lows = [low.least if isinstance(low, Limit) else low for low, _ in self.facts.allowed]
        highs = [high.greatest if isinstance(high, Limit) else high for _, high in self.facts.allowed]
        return min(lows), max(highs)

    @property
    def scale_needs(self) -> tuple[str, ...]:
        """The points whose raw numbers decoding needs."""
        return self._form.needs

    @property
    def limit_needs(self) -> tuple[str, ...]:
        """The points whose raw numbers checking needs."""
        bounds = [bound for interval in self.facts.allowed or () for bound in interval if isinstance(bound, Limit)]
        names = [name for limit in bounds for name in (*(one.point for one in limit.rule.factors), *limit.unless)]
        return tuple(dict.fromkeys(names))

    def name_of(self, raw: int) -> str | None:
        """Return the description's name for a raw number; None if it has none."""
        return self._form.name_of(self._number(raw))

    def from_words(self, words: Sequence[int]) -> int:
        """Return the raw number in unsigned words (or bits) in ascending order of address.

        Raises WrongLengthError, RangeError for a number that does not fit a word, and WrongTypeError.
        """
        found = self._words(words)
        if len(found) != self.size:
            raise self._named(WrongLengthError(f"takes {self.size} words, not {len(found)}"))
        return self.joined(found)

    @cached_property
    def joined(self) -> Callable[[Sequence[int]], int]:
        """The same without checks, for words that are known to be those of the point."""
        is_its_word = self.facts.bits is None and self.wire == U16
        return itemgetter(0) if is_its_word else self._joined

    def _joined(self, words: Sequence[int]) -> int:
        words = self.wire.ordered(words)
        if self.facts.bits is not None:
            return self.wire.number(words[0] >> self._lowest_bit, self.width)
        pattern = 0
        for place in self._order:
            pattern = pattern << 16 | words[place]
        return self.wire.number(pattern, self.wire.bits)

    def _words(self, words: Iterable[int]) -> list[int]:
        """Return words or bits as plain integers."""
        try:
            if isinstance(words, (str, bytes, bytearray, set, frozenset, dict)):
                raise TypeError
            listed = [*words]
        except TypeError:
            raise self._named(WrongTypeError(f"takes words, as in [1], not {shown(words)}")) from None
        return [self._within(word, 0, 0xFFFF) for word in listed]

    def to_words(self, raw: int) -> tuple[int, ...]:
        """Return the unsigned words of a raw number in ascending order of address; raises RangeError."""
        raw = self.wire.pattern(self._within(raw, *self.wire.limits(self.width)), self.width)
        words = [0] * self.size
        for part, place in enumerate(reversed(self._from_high(self.facts.write_at or self.facts.at))):
            words[place] = raw >> 16 * part & 0xFFFF
        return tuple(self.wire.ordered(words))

    @cached_property
    def _order(self) -> Sequence[int]:
        return self._from_high(self.facts.at)

    def _from_high(self, place: Place) -> Sequence[int]:
        """Return the indices of the number's words, the high one first, among words in ascending order of address."""
        if len(place.addresses) == 1:  # one address holds all words, and they travel high word first
            return range(self.size)
        ascending = sorted(place.addresses)
        return [ascending.index(address) for address in place.addresses]

    def extract(self, word: int) -> int:
        """Return the raw number of a bit group, from its whole word."""
        return self.wire.number(self.wire.ordered([self._number(word)])[0] >> self._lowest_bit, self.width)

    def insert(self, word: int, raw: int) -> int:
        """Return the whole word with this bit group replaced, and with the constant bits set."""
        mask = (1 << self.width) - 1
        word, raw = self.wire.ordered([self._number(word)])[0], self._number(raw)
        raw = self.wire.pattern(raw, self.width)
        result = word & ~(mask << self._lowest_bit) | (raw & mask) << self._lowest_bit
        fixed, bits = self.facts.fixed or (0, 0)
        return self.wire.ordered([result & ~fixed | bits])[0]

    @property
    def bit_field(self) -> tuple[int, int, int]:
        """The lowest bit of the number in its word, the mask for the rest, and the sign bit (0 for none)."""
        sign = 1 << self.width - 1 if self.wire.signed else 0
        return self._lowest_bit, (1 << self.width) - 1, sign

    @property
    def _unit(self) -> str:
        """The unit as written after a number."""
        return f" {self.facts.unit}" if self.facts.unit else ""

    def same(self, raw: int, other: int) -> bool:
        """Return True if two raw numbers mean the same."""
        return self._form.same(raw, other)

    def text(self, value: Any, raws: Raws = NO_RAWS) -> str:
        """Return a value as text with its unit: `drive.base_frequency.text(50.0)` is `50 Hz`.

        It has as many decimals as the description says, rounded from what the device stores for the value; without such
        a number, as many as needed. `raws` holds the raw numbers of other points that the scale needs. Raises as
        `encode` does, but also accepts values that may not be written.
        """
        if isinstance(value, Special):
            return str(value)
        try:
            raw = self._form.converted(value, raws)
            if raw is None:
                raise RangeError(f"{_shown(value)} is no value of this point")
        except CodecError as error:
            raise self._named(error) from None
        return self.told(self._within(raw, *self.wire.limits(self.width)), raws)

    def raw_of(self, value: Any) -> int | None:
        """Return the raw number of a value or special code; None if there is none, or if other points decide it."""
        if isinstance(value, Special):
            return value.raw
        try:
            return self._form.converted(value, NO_RAWS)
        except CodecError:
            return None

    def told(self, raw: int, raws: Raws = NO_RAWS) -> str:
        """Return the value of a raw number as `text` does, or `raw ...` if `raws` lacks what the scale needs."""
        return self._told(raw, raws, self.facts.display)

    def told_exactly(self, raw: int, raws: Raws = NO_RAWS) -> str:
        """Return the same with all decimals, for messages: rounding could make two numbers look alike."""
        return self._told(raw, raws, None)

    def _told(self, raw: int, raws: Raws, display: int | None) -> str:
        raw = self._number(raw)
        low, high = self.wire.limits(self.width)
        if not low <= raw <= high:
            return f"raw {_shown(raw)}"
        code = self.special(raw)
        if code is not None:
            return code.name
        try:
            return self._form.shown(raw, raws, display) + self._unit
        except CodecError:
            return f"raw {raw}"

    def _within(self, number: int, low: int, high: int) -> int:
        """Return the number as a plain integer; a bool is allowed for one bit."""
        try:
            plain = int(number) if isinstance(number, bool) and self.width == 1 else whole(number)
            if low <= plain <= high:
                return plain
            raise RangeError(f"{_shown(number)} is outside {low}..{high}")
        except CodecError as error:
            raise self._named(error) from None

    def _number(self, raw: int) -> int:
        """Return a raw number as a plain integer; raises WrongTypeError if it is not an integer."""
        try:
            return raw_number(raw, self.width)
        except CodecError as error:
            raise self._named(error) from None

    @property
    def _lowest_bit(self) -> int:
        return 0 if self.facts.bits is None else self.facts.bits[1]

    def _named(self, error: CodecError) -> CodecError:
        error.point = self.label
        return error


class Decoding(Point, Generic[R_co]):
    """The pure functions of a point that can be read."""

    def decode(self, raw: int, raws: Raws = NO_RAWS) -> R_co:
        """Return the value (or special code) of a raw number; `raws` has the raw numbers that its scale needs.

        Raises RangeError if this is not a possible raw number of the point, WrongTypeError if it is not an integer, and
        if the scale needs other points, ZeroFactorError, NoCaseError, ResultOverflowError and MissingRawError.
        """
        quick = self.__dict__["decode"] = self.decoder  # from the first call on
        value: R_co = quick(raw, raws)
        return value

    @cached_property
    def decoder(self) -> Way:
        """The `decode` function, specialised for this point."""
        return self._form.quick_decode(*self._ends, self._decode)

    @cached_property
    def sure_decoder(self) -> Way:
        """The same without checks of the raw number; it takes `raws` by position."""
        return self._form.sure_decode(*self._ends, self._decode)

    def _decode(self, raw: int, raws: Raws = NO_RAWS) -> R_co:
        """Decode any argument; the errors say what is wrong with it."""
        try:
            value: R_co = self._form.decode(self._possible(raw), raws)
        except CodecError as error:
            raise self._named(error) from None
        return value

    def decode_count(self, raw: int, raws: Raws = NO_RAWS) -> int:
        """Return the value as an integer count of 10^-decimals units; raises SpecialCodeError for a special code."""
        try:
            return self._form.decode_count(self._possible(raw), raws)
        except CodecError as error:
            raise self._named(error) from None

    def _possible(self, raw: int) -> int:
        """Return the number; raises RangeError if the point cannot hold it, such as 8000h for an s16."""
        low, high = self._ends
        raw = raw_number(raw, self.width)
        if low <= raw <= high:
            return raw
        hint = ", with its sign: from_words gives it" if self.wire.signed else ""
        raise RangeError(f"{_shown(raw)} is no raw number, which is {low}..{high}{hint}")

    @cached_property
    def _ends(self) -> tuple[int, int]:
        return self.wire.limits(self.width)


class Encoding(Point, Generic[W_contra]):
    """The pure functions of a point that can be written."""

    def encode(self, value: W_contra, raws: Raws = NO_RAWS) -> int:
        """Return the raw number for a value; `raws` holds the raw numbers of the points that scale and limits need.

        Raises RangeError, UnknownValueError, NotANumberError, ZeroFactorError, NoCaseError and MissingRawError, and
        SpecialCodeError for a value that would be a special code.
        """
        quick = self.__dict__["encode"] = self.encoder  # from the first call on
        raw: int = quick(value, raws)
        return raw

    @cached_property
    def encoder(self) -> Way:
        """The `encode` function, specialised for this point."""
        return self._form.quick_encode(self.allowed, self._encode)

    def _encode(self, value: W_contra, raws: Raws = NO_RAWS) -> int:
        """Encode any argument; the errors say what is wrong with it."""
        self.require(value)
        try:
            raw = self._form.encode(value, self.allowed, raws)
            if raw is None:
                raise self._refusal(_shown(value), raws)
        except CodecError as error:
            raise self._named(error) from None
        return raw

    def require(self, value: object) -> None:
        """Raises SpecialCodeError, UnknownValueError or WrongTypeError for a value that can never be written.

        Devices call this before they read what the scale and the limits need.
        """
        if isinstance(value, str) and (self.scale_needs or self.limit_needs):  # only quantities have such needs
            text = self.special.not_a_text(value) if len(self.special) else f"takes a number, not {shown(value)}"
            raise self._named(WrongTypeError(text))
        if isinstance(value, Special):
            code = self.special(value.raw)
            if code != value:
                raise self._named(UnknownValueError(f"{value} is no special code of this point"))
            self._require_writable(code)

    def require_raw(self, raw: int) -> None:
        """The same for a raw number."""
        if not isinstance(raw, int):
            self.to_words(raw)
        self._require_writable(self.special(int(raw)))

    def _require_writable(self, code: Special | None) -> None:
        if code is not None and not code.writable:
            raise self._named(
                SpecialCodeError(code.name, f"raw {code.raw} is the special code {code}: it is only read")
            )

    def encode_count(self, count: int, raws: Raws = NO_RAWS) -> int:
        """Return the raw number for an integer count of 10^-decimals units, without floats; raises as `encode`."""
        try:
            raw = self._form.encode_count(count, self.allowed, raws)
            if raw is None:
                raise self._refusal(self._amount(count), raws)
        except CodecError as error:
            raise self._named(error) from None
        return raw

    def _amount(self, count: int) -> str:
        """Return a count in the unit, for messages."""
        count = whole(count)
        try:
            return f"{count / 10**self.decimals:.12g}" if self.decimals else _shown(count)
        except OverflowError:
            return f"a count of {_shown(count)}"

    def check(self, raw: int, raws: Raws = NO_RAWS) -> None:
        """Raises RangeError, UnknownValueError, SpecialCodeError or ZeroFactorError if it may not be written."""
        try:
            number = int(raw) if isinstance(raw, bool) and self.width == 1 else whole(raw)
            if self._form.checked(number, self.allowed, raws) is None:
                choices = self._form.choices(self._unit) or self._raw_bounds(raws)
                raise self._form.refused(f"raw {_shown(raw)} is {choices}")
        except CodecError as error:
            raise self._named(error) from None

    def _raw_bounds(self, raws: Raws) -> str:
        return self._outside(str, "", raws)

    def _refusal(self, value: str, raws: Raws) -> CodecError:
        choices = self._form.choices(self._unit)
        if choices is None:
            choices = self._outside(lambda raw: self._form.shown(raw, raws), self._unit, raws)
        return self._form.refused(f"{value}{self._unit} is {choices}")

    def _limiting(self) -> str:
        """Return which points set the limits."""
        return f" (set by {' and '.join(self.limit_needs)})" if self.limit_needs else ""

    def _outside(self, told: Callable[[int], str], unit: str, raws: Raws) -> str:
        """Return why a number is outside the limits that other points set now."""
        ends = [(low_end(low, raws), high_end(high, raws)) for low, high in self.allowed]
        left = [(told(low), told(high)) for low, high in ends if low <= high]
        if left:
            return outside(left, unit) + self._limiting()
        limits = " or ".join([f"{told(low)}..{told(high)}" for low, high in ends])
        return f"refused, as anything is now: {' and '.join(self.limit_needs)} leave {limits}{unit}"
