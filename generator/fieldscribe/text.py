"""Encodes text from a description as a comment or a literal of a language; no other module does.

Descriptions come from anybody. Whatever a title holds, the result stays inside its comment or its quotes.
"""

import re
import unicodedata
from functools import lru_cache

_PLAIN = re.compile(r"[ -~]*")
_UNQUOTED = re.compile(r"[!#-\[\]-~\xb0]+(?: [!#-\[\]-~\xb0]+)*")
"""A line that needs no escape between double quotes, in most languages."""
_BARE = re.compile(r"[A-Za-z0-9_.:/+-]*")
"""The characters of most codes and names, which no language escapes."""
_CELL = re.compile(r"[0-9A-Za-z.:/(][0-9A-Za-z_ .:/()%°;=+-]*")
"""The characters of most cells, which CSV does not quote."""
_SPACES = re.compile(r"\s+")
_QUERIES = re.compile(r"\?(?=\?)")
_NUMBERS = re.compile(r"[-+]?[0-9][-0-9.,| ]*")
_AUTOLINKS = (("://", "&#58;//"), ("www.", "www&#46;"), ("@", "&#64;"), ("$", "&#36;"))
_TYPEWRITER = str.maketrans(
    {"\u201e": '"', "\u201c": '"', "\u201d": '"', "\u2019": "'", "\u2013": "-", "\u2026": "..."}
)
"""Typographic characters that errata quote, and what every editor can show."""
_GERMAN = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue", "Ä": "Ae", "Ö": "Oe", "Ü": "Ue", "ß": "ss"})
_DROPPED_CATEGORIES = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


def ascii_text(text: str) -> str:
    """Return a text in ASCII: German umlauts as two letters, other letters without their accents, nothing else."""
    return unicodedata.normalize("NFKD", text.translate(_GERMAN)).encode("ascii", "ignore").decode()


def line(text: str) -> str:
    """Return one printable line: white space is folded; control, format (bidi), unassigned characters are dropped."""
    if text.isprintable() and "  " not in text and text[:1] != " " and text[-1:] != " ":
        return text
    if not _PLAIN.fullmatch(text):
        spaced = "".join(" " if char in "\r\n\t\v\f\x85\u2028\u2029" else char for char in text)
        text = "".join(char for char in spaced if unicodedata.category(char) not in _DROPPED_CATEGORIES)
    return _SPACES.sub(" ", text).strip()


def counted(number: int, noun: str) -> str:
    """Return a number with its noun: `1 word`, `2 words`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def shortened(text: str) -> str:
    """Return a text as messages quote it: clean, on one line, at most 60 characters."""
    cleaned = line(text[:200])
    return cleaned if len(cleaned) <= 60 else f"{cleaned[:57]}..."


@lru_cache(maxsize=4096)
def c_comment(text: str) -> str:
    """Return text for a C block comment: without an end or start of a comment, trigraphs or line splices."""
    if text.isalnum() and text.isascii():
        return text
    cleaned = line(text).translate(_TYPEWRITER).replace("*/", "* /").replace("/*", "/ *")
    return _QUERIES.sub("? ", cleaned).rstrip("\\ ")


@lru_cache(maxsize=4096)
def c_string(text: str) -> str:
    """Return a C string literal with its quotes; beyond ASCII as UTF-8 in octal escapes of three digits."""
    if text.isalnum() and text.isascii():
        return f'"{text}"'
    escaped = []
    for byte in line(text).encode():
        char = chr(byte)
        plain = " " <= char <= "~" and char not in '"\\?'
        escaped.append(char if plain else f"\\{byte:03o}")
    return '"' + "".join(escaped) + '"'


def python_string(text: str) -> str:
    """Return a Python string literal as formatters write it: in single quotes if these need fewer escapes."""
    if _UNQUOTED.fullmatch(text):
        return f'"{text}"'
    cleaned = line(text).replace("\\", "\\\\")
    quote = "'" if cleaned.count('"') > cleaned.count("'") else '"'
    return quote + cleaned.replace(quote, f"\\{quote}") + quote


def python_doc(text: str) -> str:
    """Return text for a triple-quoted docstring or a `#` comment."""
    if _UNQUOTED.fullmatch(text):
        return text
    return line(text).replace("\\", "\\\\").replace('"', "'")


def rust_code(text: str) -> str:
    """Return text as code for a Rust `///` or `//` line, which rustdoc and clippy accept unchanged."""
    if _BARE.fullmatch(text):
        return f"`{text}`"
    return f"`{line(text).replace('`', chr(39))}`"


def rust_string(text: str) -> str:
    """Return a Rust string literal with its quotes."""
    if _BARE.fullmatch(text):
        return f'"{text}"'
    return f'"{_escaped(text)}"'


def _escaped(text: str) -> str:
    """Return text for a literal in double quotes of Rust, TOML or JavaScript."""
    return line(text).replace("\\", "\\\\").replace('"', '\\"')


def toml_string(text: str) -> str:
    """Return a TOML string with its quotes."""
    return f'"{_escaped(text)}"'


_SCRIPT = re.compile(r"<(?=[!/])|(?<=--)>")
"""What would end or begin an element if the code were in a page: `</script`, `<!--`, `-->`."""


def js_string(text: str) -> str:
    """Return a JavaScript string literal with its quotes, which is safe inside a page too."""
    if _BARE.fullmatch(text):
        return f'"{text}"'
    escaped = _SCRIPT.sub(lambda found: f"\\x{ord(found[0]):02x}", _escaped(text))
    return f'"{escaped}"'


def js_comment(text: str) -> str:
    """Return text for a `/** */` or `//` comment: without an end of it, tags of JSDoc, or links."""
    if _BARE.fullmatch(text):
        return text.replace("*/", "* /")
    return _SCRIPT.sub(" ", line(text).replace("*/", "* /").replace("@", "(at)").replace("{", "("))


@lru_cache(maxsize=4096)
def dbc_string(text: str) -> str:
    """Return a string of a CAN database with its quotes: Latin-1, without quotes and backslashes inside."""
    cleaned = line(text).replace("\\", "/").replace('"', "'")
    return '"' + cleaned.encode("latin-1", "replace").decode("latin-1") + '"'


@lru_cache(maxsize=4096)
def markdown(text: str) -> str:
    """Return text for a Markdown paragraph or cell: without markup, HTML, links or cell borders."""
    cleaned = line(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    for sign, entity in _AUTOLINKS:
        cleaned = cleaned.replace(sign, entity)
    return re.sub(r"([\\`*_{}\[\]()+\-!|~]|(?<!&)#)", r"\\\1", cleaned)


def html_code(text: str) -> str:
    """Return text for an HTML element or an attribute in double quotes, with its line breaks and blanks."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")


_FORMULA_SIGNS = frozenset("=+-@\uff1d\uff0b\uff0d\uff20")
"""What starts a formula in spreadsheets; some accept the full-width forms of Asian keyboards too."""


def csv_cell(text: str) -> str:
    """Return a cell of CSV, quoted if needed; what a spreadsheet would run as a formula gets an apostrophe in front."""
    if (
        not text
        or text.isidentifier()
        or text.isalnum()
        or (_CELL.fullmatch(text) and "  " not in text and text[-1] != " ")
    ):
        return text
    cleaned = line(text)
    if cleaned[:1] in _FORMULA_SIGNS and not _NUMBERS.fullmatch(cleaned):
        cleaned = "'" + cleaned
    return '"' + cleaned.replace('"', '""') + '"' if any(char in cleaned for char in ',"') else cleaned


@lru_cache(maxsize=65536)
def pascal(name: str) -> str:
    """Return `base_frequency` as `BaseFrequency`; an underscore between digits stays (`a_1_2` is `A1_2`)."""
    parts = name.split("_")
    result = parts[0].capitalize()
    for part in parts[1:]:
        joined_digits = part[:1].isdigit() and result[-1:].isdigit()
        result += ("_" if joined_digits else "") + part.capitalize()
    return result


@lru_cache(maxsize=65536)
def camel(name: str) -> str:
    """Return `base_frequency` as `baseFrequency`; underscores between digits and at the ends stay."""
    first, *parts = name.split("_")
    result = first
    for part in parts:
        joined_digits = part[:1].isdigit() and result[-1:].isdigit()
        result += ("_" if joined_digits or not part or not result else "") + (part[:1].upper() + part[1:])
    return result


@lru_cache(maxsize=65536)
def humanised(name: str) -> str:
    """Return a name as words: `base_frequency` as `Base frequency`."""
    return name.replace("_", " ").capitalize()


def upper(name: str) -> str:
    """Return `base_frequency` as `BASE_FREQUENCY`."""
    return name.upper()
