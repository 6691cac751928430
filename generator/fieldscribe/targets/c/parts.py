"""Texts, and words whose decimal digits each mean something."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.c.layout import function
from fieldscribe.targets.c.special_codes import codes_first
from fieldscribe.targets.c.views import Function

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.model import Point
    from fieldscribe.targets.c.scope import HeaderScope
    from fieldscribe.targets.c.views import SpecialView

STATUS = "FIELDSCRIBE_STATUS"


def text_functions(point: Point, name: str) -> Iterator[Function]:
    """The conversions of a text."""
    assert point.text is not None
    words = f"uint16_t words[{point.words}]"
    latin = "true" if point.text.encoding == "latin-1" else "false"
    if point.writable:
        body = f"return fieldscribe_words_of_text(text, length, {latin}, words, {point.words}U);"
        yield Function(function(STATUS, f"{name}_encode", ("const char *text", "size_t length", words), body))
    if point.readable:
        body = f"return fieldscribe_text_of_words(words, {point.words}U, text);"
        parameters = (f"const {words}", f"char text[{point.text.characters + 1}]")
        yield Function(function("static inline size_t", f"{name}_decode", parameters, body))


def digits_functions(point: Point, name: str, special: SpecialView | None, scope: HeaderScope) -> Iterator[Function]:
    """The conversions of digits."""
    assert point.digits is not None
    count = point.digits.count
    names = f"{scope.prefix}_{point.digits.enum.name}_names"
    known = f"{count}U, {names}, FIELDSCRIBE_COUNT({names})"
    digits = f"uint16_t digits[{count}]"
    if point.writable:
        check = codes_first(point, special, f"fieldscribe_check_digits(raw, {known})")
        yield Function(function(STATUS, f"{name}_check", ("uint16_t raw",), f"return {check};"))
        whole = f"const fieldscribe_whole whole = fieldscribe_number_of_digits(digits, {known});"
        status = "whole.status"
        if special is not None:
            refused = f"{special.test}((uint16_t)whole.number) ? FIELDSCRIBE_SPECIAL : FIELDSCRIBE_OK"
            status = f"fieldscribe_both(whole.status, {refused})"
        store = f"return fieldscribe_keep_u16({status}, (uint16_t)whole.number, raw);"
        yield Function(function(STATUS, f"{name}_encode", (f"const {digits}", "uint16_t *raw"), whole, store))
    if point.readable and special is None:
        body = f"fieldscribe_digits_of(raw, digits, {count}U);"
        yield Function(function("static inline void", f"{name}_decode", ("uint16_t raw", digits), body))
    elif point.readable and special is not None:
        body = f"return fieldscribe_quantity_digits({special.test}(raw), raw, digits, {count}U);"
        yield Function(function(STATUS, f"{name}_decode", ("uint16_t raw", digits), body))
