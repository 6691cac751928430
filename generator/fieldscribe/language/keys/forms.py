"""The forms of texts and of keys: a pattern, its name in messages, a hint, and its sign in KEYS.md."""

from fieldscribe.model import NOTATIONS, TYPE_PATTERN
from fieldscribe.schema_types import Form

_WHOLE = "(0x[0-9A-Fa-f]{1,16}|[0-9A-Fa-f]{1,16}[hH]|[Hh]'[0-9A-Fa-f]{1,16}|0b[01]{1,64}|[0-9]{1,5})"

NAME = Form(
    "^[a-z][a-z0-9]*(_[a-z0-9]+)*$",
    "a name in snake_case",
    "names are English words such as `base_frequency`: a to z, digits, single _",
    "<name>",
)
NUMBER = Form(
    "^([-+0-9]|[A-Fa-f][0-9A-Fa-f]*[hH](\\.\\.|$)|[Hh]').*$",
    "a number",
    "keys here are numbers such as 3, -1, 1Fh or 0x1F",
    "<number>",
)
BITS = Form(
    f"^{_WHOLE}(\\.\\.{_WHOLE})?$",
    "a number, or two",
    "bits and bytes are numbers: 3; several bits have the high one first: 5..4",
    "<number or high..low>",
)
SET = Form(f"^{_WHOLE}$", "the number of a set", "keys here are the numbers of the further sets, from 2 on", "<set>")
ELEMENT = Form(
    f"^{_WHOLE}(/{_WHOLE})?$",
    "an element",
    "keys here are indices (sets where there are none), or set/index: 0, 3, 2/1",
    "<index>",
)
VARIANT = Form(
    "^[a-z][a-z0-9_]*=[A-Za-z0-9_]+$",
    "a variant",
    "keys here are written axis=value, such as voltage_class=400V",
    "<axis=value>",
)
VARIANT_VALUE = Form(
    "^[A-Za-z0-9]+(_[A-Za-z0-9]+)*$", "the name of a variant", "letters, digits and single _: 400V, model_b", "<value>"
)
WRITTEN = Form(
    "^\\S(.{0,198}\\S)?$",
    "letters of codes, bits of a word, a number, or a title",
    "write the letters of codes (P), bits with the high one first (15..8), a number (0), or a title of the description",
    "<letters, bits, number or title>",
)
ACCESS = Form("^(r|w|rw|none)$", "an access", "access is r, w, rw or none", "<access>")
LANGUAGE = Form("^[a-z]{2}$", "a language", "languages have two letters: en, de, fr", "<language>")
PRIVATE = Form("^x-", "a private key", "keys of your own start with x-", "x-<anything>")
ANY = Form("", "a word", "any word is fine", "<any>")
"""Any key that the table does not have and that fits no other form."""

_LONG = _WHOLE.replace("{1,5}", "{1,18}")
WHOLE = Form(f"^[-+]?{_LONG}$", "a whole number", "write a whole number: 4136, 0x1028, 1028h, H'33F, 0b0101")
"""A whole number in a notation that YAML takes for text."""
LINES = Form(f"^{_LONG}(\\.\\.{_LONG})?$", "a line or lines", "lines are written 780, several lines 780..790")
VERSION = Form(
    "^(0|[1-9][0-9]{0,2}|[1-3][0-9]{3})(\\.(0|[1-9][0-9]{0,2})){2}$",
    "a version",
    "write three numbers, at most 3999.999.999: 1.0.0",
)
"""It fits a number of 32 bits, and Cargo accepts it."""
BYTES = Form("^[0-9A-Fa-f\\s]+$", "bytes in hexadecimal", "write two digits for each byte: 05 06 10 28")
SHA256 = Form(
    "^[0-9a-f]{64}$", "a SHA-256 checksum", "64 hexadecimal digits in small letters, as sha256sum prints them"
)
TYPE = Form(
    TYPE_PATTERN,
    "a type",
    "types are u or s with the number of bits (u16, s32, u24, s48), f32, f64, bit, text and bytes",
)
NOTATION = Form(
    f"^({'|'.join(NOTATIONS)}|time since [0-9]{{4}}-[0-9]{{2}}-[0-9]{{2}})$",
    "a notation",
    f"write one of {', '.join(NOTATIONS)}; or the date from which seconds count: time since 1970-01-01",
)
DATE_PART = Form(
    "^(year( from [0-9]{1,4})?|month|day|weekday from (sunday|monday) [01]|hour|minute|second|millisecond)$",
    "a part of a date",
    "write year, month, day, hour, minute, second or millisecond; `year from 1980` says what 0 means, `weekday from "
    "monday 1` where the numbers of weekdays begin",
    "<part>",
)
PART_PLACE = Form(
    "^(word [1-9][0-9]{0,2}|bits? [0-9]{1,2}(\\.\\.[0-9]{1,2})?( of word [1-9][0-9]{0,2})?)$",
    "the place of a part",
    "write `bits 15..8`, `bits 6..0 of word 2` or `word 3`; the words of the point count from 1",
)
WORD_ORDER = Form("^(high|low) first$", "an order", "write `high first` or `low first`")
_TIME = "[1-9][0-9]{0,5} (ms|s|min)"
TIME = Form(f"^{_TIME}$", "a time", "write a number and a unit: 500 ms, 2 s, 10 min")
RUN = Form(
    f"^(first|before write|by caller|every {_TIME})$",
    "an occasion",
    "write `first`, `before write`, `by caller` or `every 10 s`",
)
ID = Form("^[a-z][a-z0-9_]*$", "an id", "ids are written a to z, digits and _")
PART_FILE = Form(
    "^[A-Za-z0-9][A-Za-z0-9_.-]*\\.ya?ml$",
    "the name of a part",
    "parts stand beside device.yaml and end with .yaml; a part has no folder in its name",
)
