"""The classes of which the table of keys is made: where a key stands, which values it takes, and what they mean.

Plain classes, compared by identity: making them dataclasses would take longer than making the whole table.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


class Form:
    """How a text is written, or the keys of a mapping: a pattern of ECMAScript, and words for people.

    `sign` is what KEYS.md writes for such a key.
    """

    __slots__ = ("hint", "pattern", "sign", "words")

    def __init__(self, pattern: str, words: str, hint: str, sign: str = "") -> None:
        self.pattern, self.words, self.hint, self.sign = pattern, words, hint, sign


class Text:
    """Text: of at most that many characters (0: as many as a file may have), of a form, or one of some `choices`."""

    __slots__ = ("choices", "form", "longest")

    def __init__(self, longest: int = 0, form: Form | None = None, choices: tuple[str, ...] = ()) -> None:
        self.longest, self.form, self.choices = longest, form, choices


def one_of(*choices: str) -> Text:
    """One of these texts."""
    return Text(choices=choices)


class Whole:
    """A whole number within bounds, or one of some `choices`."""

    __slots__ = ("choices", "greatest", "least")

    def __init__(self, least: int | None = None, greatest: int | None = None, choices: tuple[int, ...] = ()) -> None:
        self.least, self.greatest, self.choices = least, greatest, choices


class Plain:
    """A kind without bounds: any number, true or false, or nothing."""

    __slots__ = ("word",)

    def __init__(self, word: str) -> None:
        self.word = word


NUMBER, BOOLEAN, NOTHING = Plain("number"), Plain("boolean"), Plain("null")
YES_NO = BOOLEAN, one_of("yes", "no")
"""Every key that is true or false: `yes` and `no` are the words, `true` and `false` mean the same."""


class Items:
    """A list of items of one shape."""

    __slots__ = ("item", "least")

    def __init__(self, item: Shape, least: int = 0) -> None:
        self.item, self.least = item, least


class Place:
    """A mapping: the keys of the table that say they stand here, and keys of some forms (`by_form`).

    A place with a `name` is a definition of the schema, one with a `heading` a table of KEYS.md. `before` and `after`
    are what may stand there in its stead. The keys of `may_be` stand here, too: with
    all that it requires, or none.
    """

    __slots__ = ("by_form", "heading", "least", "may_be", "name", "required", "shape")

    def __init__(  # noqa: PLR0913  # the words of an entry, by name where they are used
        self,
        name: str,
        heading: str,
        meaning: str,
        examples: Sequence[Any],
        *,
        before: tuple[Kind, ...] = (),
        after: tuple[Kind, ...] = (),
        by_form: Mapping[Form, Shape] | None = None,
        least: int = 0,
        required: tuple[str, ...] = (),
        may_be: Place | None = None,
    ) -> None:
        self.name, self.heading, self.may_be = name, heading, may_be
        self.by_form, self.least, self.required = by_form or {}, least, required
        self.shape = Shape(meaning, examples, *before, self, *after)


def by(form: Form, shape: Shape, least: int = 0, required: tuple[str, ...] = ()) -> Place:
    """A mapping from keys of a form to values of one shape."""
    return Place("", "", "", (), by_form={form: shape}, least=least, required=required)


Kind: TypeAlias = Text | Whole | Plain | Items | Place


class Shape:
    """What may stand in a spot: its kinds (none: anything), what it means, and examples, the best one first."""

    __slots__ = ("examples", "kinds", "meaning")

    def __init__(self, meaning: str, examples: Sequence[Any], *kinds: Kind) -> None:
        self.meaning, self.examples, self.kinds = meaning, examples, kinds


class Key:
    """One key: its name, where it stands, and what stands at it.

    `required` are the places that must have it, `needs` the keys that must stand beside it where they are known.
    `inherited` are the places that say it for the points below them. An `own` key tells one point from another, so that
    further sets do not take it. `of` is what a fact is about: WHOLE_NUMBERS, NUMBERS, TEXTS, or "" for any point.
    """

    __slots__ = ("inherited", "name", "needs", "of", "own", "places", "required", "shape")

    def __init__(  # noqa: PLR0913  # likewise
        self,
        name: str,
        places: Place | tuple[Place, ...],
        meaning: str | Shape,
        examples: Sequence[Any] = (),
        *kinds: Kind,
        required: bool | tuple[Place, ...] = (),
        needs: tuple[str, ...] = (),
        inherited: tuple[Place, ...] = (),
        own: bool = False,
        of: str = "",
    ) -> None:
        self.name = name
        self.shape = meaning if isinstance(meaning, Shape) else Shape(meaning, examples, *kinds)
        self.places = places if isinstance(places, tuple) else (places,)
        self.required = required if isinstance(required, tuple) else self.places if required else ()
        self.needs, self.inherited, self.own, self.of = needs, inherited, own, of


WHOLE_NUMBERS, NUMBERS, TEXTS = "whole numbers", "numbers", "texts"


def says_yes_or_no(shape: Shape) -> bool:
    """Whether `yes` and `no` are words for true and false here; elsewhere they may be names."""
    return any(isinstance(kind, Text) and "yes" in kind.choices for kind in shape.kinds)
