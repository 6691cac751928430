"""The classes of the table of keys: the places of a key, the values that it takes, and their meaning.

They are plain classes, compared by identity: the table is made in every run, and dataclasses would double that time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from decimal import Decimal
from typing import Any, TypeAlias


class Form:
    """The form of a text or of a key: a regular expression of ECMAScript, its name in messages, and a hint.

    `sign` represents such a key in KEYS.md.
    """

    def __init__(self, pattern: str, words: str, hint: str, sign: str = "") -> None:
        self.pattern, self.words, self.hint, self.sign = pattern, words, hint, sign


class Text:
    """A text: with a greatest length (0: no limit), of a form, or one of some `choices`."""

    words, schema_type = "text", "string"

    def __init__(self, longest: int = 0, form: Form | None = None, choices: tuple[str, ...] = ()) -> None:
        self.longest, self.form, self.choices = longest, form, choices


def one_of(*choices: str) -> Text:
    """Return the kind of a text that is one of these."""
    return Text(choices=choices)


class Whole:
    """A whole number within bounds, or one of some `choices`."""

    words, schema_type = "a whole number", "integer"

    def __init__(self, least: int | None = None, greatest: int | None = None, choices: tuple[int, ...] = ()) -> None:
        self.least, self.greatest, self.choices = least, greatest, choices


class Plain:
    """A kind of value without further rules, with its words in messages, its type in the schema, and in Python."""

    def __init__(self, words: str, schema_type: str, *types: type) -> None:
        self.words, self.schema_type, self.types = words, schema_type, types


NUMBER = Plain("a number", "number", int, Decimal)
BOOLEAN = Plain("true or false", "boolean", bool)
NOTHING = Plain("~", "null", type(None))
YES_NO = BOOLEAN, one_of("yes", "no")
"""The kinds of every key that is true or false: people write `yes` and `no`; `true` and `false` mean the same."""


class Items:
    """A list of items of one shape."""

    words, schema_type = "a list", "array"

    def __init__(self, item: ValueShape, least: int = 0) -> None:
        self.item, self.least = item, least


class Place:
    """A mapping: it may have the keys of the table that name this place, and keys of some forms (`by_form`).

    A place with a `name` is a definition of the schema, one with a `heading` a table of KEYS.md. `before` and `after`
    are kinds of values that are allowed instead of it. It may also have the keys of the place `may_be`; then all keys
    that are required there.
    """

    words, schema_type = "a mapping", "object"

    def __init__(  # noqa: PLR0913  # each is given by name where it is used
        self,
        name: str = "",
        heading: str = "",
        *,
        before: tuple[Kind, ...] = (),
        after: tuple[Kind, ...] = (),
        by_form: Mapping[Form, ValueShape] | None = None,
        least: int = 0,
        required: tuple[str, ...] = (),
        may_be: Place | None = None,
    ) -> None:
        self.name, self.heading, self.may_be = name, heading, may_be
        self.by_form, self.least, self.required = by_form or {}, least, required
        self.shape = ValueShape("", (), *before, self, *after)

    def means(self, meaning: str, examples: Sequence[Any]) -> Place:
        """Say what the mapping means, with examples, the best one first."""
        self.shape.meaning, self.shape.examples = meaning, examples
        return self


def by(form: Form, shape: ValueShape, least: int = 0, required: tuple[str, ...] = ()) -> Place:
    """Return a mapping from keys of a form to values of one shape."""
    return Place(by_form={form: shape}, least=least, required=required)


Kind: TypeAlias = Text | Whole | Plain | Items | Place


class ValueShape:
    """What a value may be: its kinds (none: anything), its meaning, and examples, the best one first."""

    def __init__(self, meaning: str, examples: Sequence[Any], *kinds: Kind) -> None:
        self.meaning, self.examples, self.kinds = meaning, examples, kinds


class Places:
    """Places where a key may appear; in the `inherited` ones it applies to all points below."""

    def __init__(self, *places: Place, inherited: tuple[Place, ...] = ()) -> None:
        self.all, self.inherited = places, inherited


class Key:
    """One key: its name, the places where it may appear, and the shape of its value, or its meaning: see `takes`.

    `required` are the places that must have it; `needs` are the keys that it requires beside it. An `identity` key
    identifies a point, so further sets do not inherit it. `of` says which points it is about: WHOLE_NUMBERS,
    NUMBERS, TEXTS, or "" for all.
    """

    def __init__(  # noqa: PLR0913  # likewise
        self,
        name: str,
        places: Place | tuple[Place, ...] | Places,
        meaning: str | ValueShape,
        *,
        required: bool | tuple[Place, ...] = (),
        needs: tuple[str, ...] = (),
        identity: bool = False,
        of: str = "",
    ) -> None:
        self.name = name
        self.shape = meaning if isinstance(meaning, ValueShape) else ValueShape(meaning, ())
        if isinstance(places, Place):
            places = (places,)
        if isinstance(places, tuple):
            places = Places(*places)
        self.places, self.inherited = places.all, places.inherited
        self.required = required if isinstance(required, tuple) else self.places if required else ()
        self.needs, self.identity, self.of = needs, identity, of

    def takes(self, examples: Sequence[Any], *kinds: Kind) -> Key:
        """Set the values that the key takes: examples, the best one first, and the kinds of values."""
        self.shape = ValueShape(self.shape.meaning, examples, *kinds)
        return self


WHOLE_NUMBERS, NUMBERS, TEXTS = "whole numbers", "numbers", "texts"


def says_yes_or_no(shape: ValueShape) -> bool:
    """Return True if `yes` and `no` mean true and false here; elsewhere they may be names."""
    return any(isinstance(kind, Text) and "yes" in kind.choices for kind in shape.kinds)
