"""The shapes of values that several keys share."""

from fieldscribe.language.keys import forms
from fieldscribe.schema_types import NUMBER, Items, Place, Text, ValueShape, Whole, by, one_of

LAST_LINE = 1_000_000_000

A_NAME = Text(80, forms.NAME)
NAMED = Text(form=forms.NAME)
"""A name that is declared elsewhere."""

NAME = ValueShape(
    "A name in English, in snake_case. It becomes the identifier in every language and is never reused for another "
    "thing.",
    ["base_frequency"],
    A_NAME,
)
PRINTED_NUMBER = ValueShape(
    "A number as the manual writes it: 4136, 0x1028, 1028h, H'33F, 0b0101, 0.1.", [4136, "1028h", 0.1], NUMBER, Text(64)
)
ANYTHING = ValueShape("Your own; nothing reads it.", ())


def in_language(example: str) -> ValueShape:
    """Return the shape of a text in one of several languages."""
    return ValueShape("The text in this language.", [example], Text(2000))


def in_words(example: str, *required: str) -> tuple[Text, Place]:
    """Return the kinds of a text: in English, or by language; `required` are the languages that it must have."""
    return Text(2000), by(forms.LANGUAGE, in_language(example), required=required)


TITLE = ValueShape(
    "A title: one English text, or a text for each language, with English among them.",
    [{"en": "Base frequency", "de": "Basisfrequenz"}, "Base frequency"],
    *in_words("Basisfrequenz", "en"),
)
NOTE = ValueShape(
    "A remark of your own, in English or for each language.",
    [{"en": "Takes some time."}, "Takes some time."],
    *in_words("Takes some time.", "en"),
)
LINE_OR_LINES = (Whole(1, LAST_LINE), Text(form=forms.LINES))
LINES_OF = ValueShape(
    "A line of the manual's text, several as `2553..2652`, or a list of these.",
    [215, "2553..2652", [130, 140]],
    *LINE_OR_LINES,
    Items(ValueShape("A line, or several as `2553..2652`.", [780, "2553..2652"], *LINE_OR_LINES), 1),
)
SEVERAL = Items(ValueShape("A number, or several as `11..14`.", [7, "11..14"], Whole(), Text(20)))
WORD_ORDER = one_of("high first", "low first")
DIRECTION = one_of("request", "response", "cyclic")
