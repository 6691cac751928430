# SPDX-License-Identifier: 0BSD
"""Forms around other forms: special codes next to quantities, and constant bits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, TypeVar

from .arguments import shown
from .errors import RangeError, SpecialCodeError, UnknownValueError, WrongTypeError
from .fast import coded, uncoded
from .forms import Form
from .special import N_co, Special

if TYPE_CHECKING:
    from .fast import Way
    from .forms import Allowed
    from .rules import Raws
    from .special import Codes

R = TypeVar("R")
W = TypeVar("W")


_AS_IN_THE_FORM = (
    *("wire", "needs", "decimals", "codes", "names", "refused", "sure_decode", "decode_count"),
    *("converted_count", "checked", "limits", "bounds", "shown", "same", "choices", "name_of"),
)


class Around(Form[R, W]):
    """A form that delegates to another one, except for what a subclass overrides."""

    def __init__(self, form: Form[Any, W]) -> None:
        self.form = form
        for name in _AS_IN_THE_FORM:
            if getattr(type(self), name, None) is getattr(Form, name, None):
                setattr(self, name, getattr(form, name))

    def decode(self, raw: int, raws: Raws) -> R:
        """Delegate to the form."""
        value: R = self.form.decode(raw, raws)
        return value

    def converted(self, value: W, raws: Raws) -> int | None:
        """Delegate to the form."""
        return self.form.converted(value, raws)


class _Coded(Around[R | Special[N_co], W], Generic[R, W, N_co]):
    """A form with special codes around another form."""

    form: Form[Any, Any]
    codes: Codes[N_co]

    def __init__(self, form: Form[Any, Any], codes: Codes[N_co]) -> None:
        super().__init__(form)
        self.codes = codes

    def sure_decode(self, low: int, high: int, slow: Way) -> Way:
        """Return a decoder of special codes, and of other numbers by the form."""
        return coded(self.codes.finder, self.form.sure_decode(low, high, slow))

    def quick_encode(self, allowed: Allowed, slow: Way) -> Way:
        """Return the form's encoder, which must not return a special code."""
        return uncoded(self.codes.finder, self.form.quick_encode(allowed, slow), slow)

    def decode(self, raw: int, raws: Raws) -> R | Special[N_co]:
        """Return the special code, or the form's value."""
        return self.codes(raw) or self.form.decode(raw, raws)

    def decode_count(self, raw: int, raws: Raws) -> int:
        """Return the form's count; raises SpecialCodeError for a code, which has no count."""
        code = self.codes(raw)
        if code is not None:
            raise SpecialCodeError(code.name, f"raw {raw} is the special code {code}, which has no count: use decode")
        return self.form.decode_count(raw, raws)

    def converted(self, value: W, raws: Raws) -> int | None:
        """Return the form's raw number; raises SpecialCodeError if it is a special code."""
        raw = self.form.converted(value, raws)
        return None if raw is None else self._quantity(raw, "would be")

    def converted_count(self, count: int, raws: Raws) -> int:
        """Return the form's raw number; raises SpecialCodeError if it is a special code."""
        return self._quantity(self.form.converted_count(count, raws), "would be")

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the number if it is a writable code or the form allows it; raises SpecialCodeError."""
        code = self.codes(raw)
        if code is not None and code.writable:
            return raw
        return self.form.checked(self._quantity(raw, "is"), allowed, raws)

    def _quantity(self, raw: int, how: str) -> int:
        code = self.codes(raw)
        if code is None:
            return raw
        hint = f"to write that, write {self.codes.said(code)}" if code.writable else "it is only read"
        raise SpecialCodeError(code.name, f"raw {raw} {how} the special code {code}: {hint}")


class WithCodes(_Coded[R, W, N_co]):
    """A form with special codes: they decode to `Special`, and no value is encoded to one."""

    def __init__(self, form: Form[R, W], codes: Codes[N_co]) -> None:
        super().__init__(form, codes)


class WithWritableCodes(_Coded[R, W | Special, N_co]):
    """The same, with special codes that may be written."""

    def __init__(self, form: Form[R, W], codes: Codes[N_co]) -> None:
        super().__init__(form, codes)

    def converted(self, value: W | Special, raws: Raws) -> int | None:
        """Return the raw number of a special code or value; raises UnknownValueError for a code of another point."""
        if isinstance(value, str):
            raise WrongTypeError(self.codes.not_a_text(value))
        if not isinstance(value, Special):
            return super().converted(value, raws)
        if self.codes(value.raw) != value:
            raise UnknownValueError(f"{value} is no special code of this point")
        return value.raw


def with_fixed(form: Form[Any, Any], mask: int, bits: int) -> Form[Any, Any]:
    """Return the form with constant bits; special codes stay outermost."""
    if isinstance(form, _Coded):
        return type(form)(FixedBits(form.form, mask, bits), form.codes)
    return FixedBits(form, mask, bits)


class FixedBits(Around[R, W]):
    """The form of a whole word with constant bits."""

    def __init__(self, form: Form[R, W], mask: int, bits: int) -> None:
        super().__init__(form)
        self.mask = mask
        self.bits = bits

    def converted(self, value: W, raws: Raws) -> int | None:
        """Return the form's raw number with the constant bits."""
        raw = self.form.converted(value, raws)
        return None if raw is None else self._put(raw)

    def converted_count(self, count: int, raws: Raws) -> int:
        """Return the form's raw number with the constant bits."""
        return self._put(self.form.converted_count(count, raws))

    def _put(self, raw: int) -> int:
        return raw & ~self.mask | self.bits

    def checked(self, raw: int, allowed: Allowed, raws: Raws) -> int | None:
        """Return the number if it has the constant bits and the form allows it."""
        if raw & self.mask != self.bits:
            raise RangeError(f"raw {shown(raw)} must have {self.bits:04X}h in the bits {self.mask:04X}h")
        return self.form.checked(raw, allowed, raws)
