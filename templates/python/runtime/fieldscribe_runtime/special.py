# SPDX-License-Identifier: 0BSD
"""Special codes: raw numbers that are no quantity, and what decoding returns for them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic

from .arguments import raw_number, shown
from .records import Record

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping

    from typing_extensions import TypeVar

    # Type checkers know the module and the default; a program needs neither.
    N_co = TypeVar("N_co", bound=str, covariant=True, default=str)
else:
    from typing import TypeVar

    N_co = TypeVar("N_co", bound=str, covariant=True)


class Special(Record, Generic[N_co]):
    """A special code, which a point holds instead of a quantity.

    `no_value`: it means that there is no value. `writable`: it may be written. The type of its name is a `Literal`.
    """

    name: N_co
    raw: int
    no_value: bool = False
    writable: bool = False

    def __str__(self) -> str:
        return self.name


class Codes(Generic[N_co]):
    """The special codes of a point: `codes.inactive` or `codes["inactive"]`, or the code of a raw number: `codes(0)`.

    A code is a raw number, or the first and the last one of a band. `no_value` names those that mean that there is no
    value, `writable` those that may be written.
    """

    def __init__(
        self,
        codes: Mapping[N_co, int | tuple[int, int]],
        *,
        no_value: Collection[str] = (),
        writable: Collection[str] = (),
    ) -> None:
        self._spans: dict[str, tuple[int, int]] = {
            name: (code, code) if isinstance(code, int) else code for name, code in codes.items()
        }
        self._no_value = frozenset(no_value)
        self._writable = frozenset(writable)
        ends = self._spans.items()
        self._single = {low: self._made(name, low) for name, (low, high) in ends if low == high}
        self._bands = tuple((low, high, name) for name, (low, high) in ends if low != high)

    def __call__(self, raw: int) -> Special[N_co] | None:
        """Return the special code of a raw number; None for a quantity. Raises WrongTypeError for a non-integer."""
        if type(raw) is not int:
            raw = raw_number(raw, 0)
        found = self._single.get(raw)
        if found is None and self._bands:
            return next((self._made(name, raw) for low, high, name in self._bands if low <= raw <= high), None)
        return found

    @property
    def finder(self) -> Callable[[int], Special[N_co] | None]:
        """The function that finds the code of a raw number; it skips bands if there are none."""
        return self if self._bands else self._single.get

    def __getitem__(self, name: str) -> Special[N_co]:
        """Return the code with a name; raises KeyError, also for a band, which needs a raw number."""
        if not isinstance(name, str) or name not in self._spans:
            raise KeyError(self._no_such(name))
        low, high = self._spans[name]
        if low != high:
            raise KeyError(f"{name} is all of {low}..{high}: call the codes with a raw number")
        return self._made(name, low)

    def __getattr__(self, name: str) -> Special[N_co]:
        if name not in self.__dict__.get("_spans", ()):  # which a copy has not from the beginning
            raise AttributeError(self._no_such(name))
        try:
            return self[name]
        except KeyError as error:
            raise AttributeError(error.args[0]) from None

    def __dir__(self) -> list[str]:
        """Return the names of the codes."""
        return [*self._spans]

    def _no_such(self, name: object) -> str:
        known = f", only {', '.join(self)}" if self.__dict__.get("_spans") else ""
        return f"there is no special code {name if isinstance(name, str) else shown(name)}{known}"

    def __iter__(self) -> Iterator[str]:
        """Return the names."""
        return iter(self._spans)

    def __len__(self) -> int:
        return len(self._spans)

    def said(self, code: Special) -> str:
        """Return how a program names a code: `special.inactive`, or `special(4101)` for one of a band."""
        low, high = self._spans[code.name]
        return f"special.{code.name}" if low == high else f"special({code.raw})"

    def not_a_text(self, given: str) -> str:
        """Return why a text is no value, with the special code of this name."""
        named = given if given in self._spans and self._spans[given][0] == self._spans[given][1] else "name"
        return f"takes a number or a special code, as in special.{named}, not {shown(given)}"

    def _made(self, name: Any, raw: int) -> Special[N_co]:
        return Special(name, raw, name in self._no_value, name in self._writable)


NO_CODES = Codes({})
