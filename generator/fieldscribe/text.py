"""The one place where text from a description becomes a comment or a literal of some language.

Descriptions come from strangers: whatever a title holds, the result of these functions stays inside its comment or
quotes.
"""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

_PLAIN = re.compile(r"[ -~]*")
_UNQUOTED = re.compile(r"[!#-\[\]-~\xb0]+(?: [!#-\[\]-~\xb0]+)*")
"""A line that is its own text between double quotes, in most languages."""
_BARE = re.compile(r"[A-Za-z0-9_.:/+-]*")
"""What most codes and names are made of, and no language escapes."""
_CELL = re.compile(r"[0-9A-Za-z.:/(][0-9A-Za-z_ .:/()%°;=+-]*")
"""What most cells are made of: CSV quotes nothing of it, and only more than single spaces inside are folded."""
_SPACES = re.compile(r"\s+")
_QUERIES = re.compile(r"\?(?=\?)")
_NUMBERS = re.compile(r"[-+]?[0-9][-0-9.,| ]*")
_AUTOLINKS = (("://", "&#58;//"), ("www.", "www&#46;"), ("@", "&#64;"), ("$", "&#36;"))
_TYPEWRITER = str.maketrans(
    {"\u201e": '"', "\u201c": '"', "\u201d": '"', "\u2019": "'", "\u2013": "-", "\u2026": "..."}
)
"""Signs of printers that errata quote, as every editor of firmware shows them."""
_DROPPED_CATEGORIES = frozenset({"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"})


def line(text: str) -> str:
    """One clean line: white space folded; control, format (bidi), surrogate and unassigned characters dropped."""
    if text.isprintable() and "  " not in text and text[:1] != " " and text[-1:] != " ":
        return text
    if not _PLAIN.fullmatch(text):
        spaced = "".join(" " if char in "\r\n\t\v\f\x85\u2028\u2029" else char for char in text)
        text = "".join(char for char in spaced if unicodedata.category(char) not in _DROPPED_CATEGORIES)
    return _SPACES.sub(" ", text).strip()


@lru_cache(maxsize=4096)
def c_comment(text: str) -> str:
    """Text for inside a C block comment: no end or start of comment, no trigraph, no line splice."""
    if text.isalnum() and text.isascii():
        return text
    cleaned = line(text).translate(_TYPEWRITER).replace("*/", "* /").replace("/*", "/ *")
    return _QUERIES.sub("? ", cleaned).rstrip("\\ ")


@lru_cache(maxsize=4096)
def c_string(text: str) -> str:
    """A C string literal with its quotes; beyond ASCII as UTF-8 in octal escapes (they end by themselves)."""
    if text.isalnum() and text.isascii():
        return f'"{text}"'
    escaped = []
    for byte in line(text).encode():
        char = chr(byte)
        plain = " " <= char <= "~" and char not in '"\\?'
        escaped.append(char if plain else f"\\{byte:03o}")
    return '"' + "".join(escaped) + '"'


def python_string(text: str) -> str:
    """A Python string literal as formatters write it: double quotes, unless single ones need fewer escapes."""
    if _UNQUOTED.fullmatch(text):
        return f'"{text}"'
    cleaned = line(text)
    quote = "'" if cleaned.count('"') > cleaned.count("'") else '"'
    escaped = []
    for char in cleaned:
        if char in ("\\", quote):
            escaped.append("\\" + char)
        elif char.isprintable():
            escaped.append(char)
        else:
            escaped.append(f"\\U{ord(char):08x}")
    return quote + "".join(escaped) + quote


def python_doc(text: str) -> str:
    """Text for inside a triple-quoted docstring or a `#` comment."""
    if _UNQUOTED.fullmatch(text):
        return text
    return line(text).replace("\\", "\\\\").replace('"', "'")


def rust_code(text: str) -> str:
    """Text as code in a Rust `///` or `//` line, so that neither rustdoc nor clippy reads anything into it."""
    if _BARE.fullmatch(text):
        return f"`{text}`"
    return f"`{line(text).replace('`', chr(39))}`"


def rust_string(text: str) -> str:
    """A Rust string literal with its quotes."""
    if _BARE.fullmatch(text):
        return f'"{text}"'
    cleaned = line(text).replace("\\", "\\\\").replace('"', '\\"')
    if not cleaned.isprintable():
        cleaned = "".join([char if char.isprintable() else f"\\u{{{ord(char):x}}}" for char in cleaned])
    return f'"{cleaned}"'


def toml_string(text: str) -> str:
    """A TOML string with its quotes."""
    cleaned = line(text).replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join([char if char.isprintable() else f"\\U{ord(char):08X}" for char in cleaned]) + '"'


@lru_cache(maxsize=4096)
def dbc_string(text: str) -> str:
    """A string of a CAN database with its quotes: Latin-1, without what would end it or be read as an escape."""
    cleaned = line(text).replace("\\", "/").replace('"', "'")
    return '"' + cleaned.encode("latin-1", "replace").decode("latin-1") + '"'


@lru_cache(maxsize=4096)
def markdown(text: str) -> str:
    """Text for a Markdown paragraph or table cell: no markup, no HTML, no link, no cell border."""
    cleaned = line(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    for sign, entity in _AUTOLINKS:
        cleaned = cleaned.replace(sign, entity)
    return re.sub(r"([\\`*_{}\[\]()+\-!|~]|(?<!&)#)", r"\\\1", cleaned) if _needs_escape(cleaned) else cleaned


def csv_cell(text: str) -> str:
    """A cell for CSV, quoted where needed; what a spreadsheet would run as a formula starts with an apostrophe."""
    if not text or (_CELL.fullmatch(text) and "  " not in text and text[-1] != " "):
        return text
    cleaned = line(text)
    if cleaned[:1] in ("=", "+", "-", "@") and not _NUMBERS.fullmatch(cleaned):
        cleaned = "'" + cleaned
    return '"' + cleaned.replace('"', '""') + '"' if any(char in cleaned for char in ',"') else cleaned


def _needs_escape(text: str) -> bool:
    return any(char in text for char in "\\`*_{}[]()#+-!|~")
