# SPDX-License-Identifier: 0BSD
"""Forms around other forms: codes for "there is no value", and bits that are always written as a constant."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from .errors import NoValueError, RangeError
from .forms import Form

if TYPE_CHECKING:
    from collections.abc import Mapping

    from .forms import Allowed
    from .rules import Raws

R = TypeVar("R")
W = TypeVar("W")


class _Around(Form[R, W]):
    """Another form as it is; subclasses change some of it."""

    def __init__(self, form: Form[Any, W]) -> None:
        self.form = form
        self.wire = form.wire
        self.needs = form.needs
        self.decimals = form.decimals
        self.no_value = form.no_value
        self.names = form.names
        self.refused = form.refused

    def decode(self, raw: int, raws: Raws) -> R:
        """As in the form."""
        value: R = self.form.decode(raw, raws)
        return value

    def decode_count(self, raw: int, raws: Raws) -> int:
        """As in the form."""
        return self.form.decode_count(raw, raws)

    def encode(self, value: W, allowed: Allowed, raws: Raws) -> int | None:
        """As in the form."""
        return self.form.encode(value, allowed, raws)

    def encode_count(self, count: int, allowed: Allowed, raws: Raws) -> int | None:
        """As in the form."""
        return self.form.encode_count(count, allowed, raws)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """As in the form."""
        return self.form.checked(raw, allowed, raws)

    def limits(self, width: int) -> tuple[int, int]:
        """As in the form."""
        return self.form.limits(width)

    def shown(self, raw: int, raws: Raws) -> str:
        """As in the form."""
        return self.form.shown(raw, raws)

    def same(self, raw: int, other: int) -> bool:
        """As in the form."""
        return self.form.same(raw, other)

    def choices(self, unit: str) -> str | None:
        """As in the form."""
        return self.form.choices(unit)

    def name_of(self, raw: int) -> str | None:
        """As in the form."""
        return self.form.name_of(raw)


class OrNone(_Around[R | None, W]):
    """Another form in which some raw numbers, by name, mean "there is no value"; those decode to None."""

    def __init__(self, form: Form[R, W], no_value: Mapping[str, tuple[int, int]]) -> None:
        super().__init__(form)
        self.no_value = no_value

    def _missing(self, raw: int) -> bool:
        return any(low <= raw <= high for low, high in self.no_value.values())

    def decode(self, raw: int, raws: Raws) -> R | None:
        """None for the codes, else as in the form."""
        return None if self._missing(raw) else super().decode(raw, raws)

    def decode_count(self, raw: int, raws: Raws) -> int:
        """As in the form; raises NoValueError, because a count has no room for "no value"."""
        if self._missing(raw):
            raise NoValueError(f"raw {raw} means that there is no value")
        return super().decode_count(raw, raws)


class FixedBits(_Around[R, W]):
    """Another form, of a whole word in which some bits are always written as a constant."""

    def __init__(self, form: Form[R, W], mask: int, bits: int) -> None:
        super().__init__(form)
        self.mask = mask
        self.bits = bits

    def _put(self, raw: int | None, allowed: Allowed, raws: Raws) -> int | None:
        return None if raw is None else self.checked(raw & ~self.mask | self.bits, allowed, raws)

    def encode(self, value: W, allowed: Allowed, raws: Raws) -> int | None:
        """As in the form, with the constant bits put in before the check."""
        return self._put(super().encode(value, (self.wire.limits(self.wire.bits),), raws), allowed, raws)

    def encode_count(self, count: int, allowed: Allowed, raws: Raws) -> int | None:
        """As in the form, with the constant bits put in before the check."""
        return self._put(super().encode_count(count, (self.wire.limits(self.wire.bits),), raws), allowed, raws)

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """The same number if it has the constant bits and the form takes it."""
        if raw & self.mask != self.bits:
            raise RangeError(f"raw {raw} has not {self.bits:04X}h in the bits {self.mask:04X}h, as it must")
        return super().checked(raw, allowed, raws)
