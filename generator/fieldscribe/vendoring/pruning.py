"""Leaves out of the runtime headers of C what no chosen point uses.

A header is divided at its empty lines. A part that defines something is kept if the code of a kept part has one of its
names as a word, or if a text that uses the runtime has, also in a comment below its head. `fieldscribe_modbus_*` there
means all names that begin so.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from fnmatch import filter as matching
from fnmatch import fnmatchcase
from functools import lru_cache

from fieldscribe.user_errors import UnclearError

RUNTIME_NAME = re.compile(r"fieldscribe_[a-z0-9_]*\*?|FIELDSCRIBE_[A-Z0-9_]*\*?")
_FOR_USERS = {"FIELDSCRIBE_COUNT"}
"""What a user's program may need though no generated line does."""
_HEAD = re.compile(r"\A\s*/\*.*?\*/", re.DOTALL)
_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_DEFINED = re.compile(
    r"(?m)^#define (\w+)|^\} (\w+);|^typedef [^{;]*?(\w+);|^typedef [^;]*?\(\*(\w+)\)"
    r"|^(?:typedef )?(?:struct|enum) (\w+) \{|^    (FIELDSCRIBE_\w+)(?: = \w+)?,?\s*$"
    r"|^(?!#|typedef)\w[^\n(=]*?\b(fieldscribe_\w+)(?:[(\[]| =)"
)
_OPENS_C = '#ifdef __cplusplus\nextern "C" {\n#endif'
_CLOSES_C = "#ifdef __cplusplus\n}\n#endif"
_CLOSES = "#endif"
_NOTICE = "/* Only what the chosen points use: to have more, add its names to --points, or fieldscribe_* for all. */\n"


def pruned(runtime: Mapping[str, str], users: Iterable[str], words: set[str]) -> dict[str, str]:
    """Return the runtime headers without what neither these texts nor these words use. Raises UnclearError."""
    parts = {name: _HEAD.sub("", text).split("\n\n") for name, text in runtime.items()}
    defined = {part: _names_of(part) for of_file in parts.values() for part in of_file}
    known = frozenset[str]().union(*defined.values())
    unknown = [word for word in sorted(words) if not matching(known, word)]
    if unknown:
        raise UnclearError(f"the runtime has no `{unknown[0]}`", "`fieldscribe_*` keeps all of it")
    used = {word for text in users for word in RUNTIME_NAME.findall(_HEAD.sub("", text))} | words | _FOR_USERS
    used |= {name for word in used if "*" in word for name in known if fnmatchcase(name.lower(), word.lower())}
    kept: set[str] = set()
    size = -1
    while len(kept) > size:
        size = len(kept)
        kept |= {part for part, names in defined.items() if not names or names & used}
        used |= set[str]().union(*map(_words_of, kept))
    return {name: _joined(runtime[name], parts[name], kept) for name in runtime}


@lru_cache(maxsize=2048)
def _words_of(part: str) -> frozenset[str]:
    """Return the names of the runtime in the code of a part."""
    return frozenset(RUNTIME_NAME.findall(_COMMENT.sub("", part)))


@lru_cache(maxsize=2048)
def _names_of(part: str) -> frozenset[str]:
    """Return what a part defines; nothing if it opens or closes the conditions of others, and is always kept."""
    text = _COMMENT.sub("", part)
    if len(re.findall(r"(?m)^#if", text)) != len(re.findall(r"(?m)^#endif", text)):
        return frozenset()
    return frozenset(name for names in _DEFINED.findall(text) for name in names if name)


def _joined(whole: str, parts: Sequence[str], kept: Collection[str]) -> str:
    """Return the kept parts of a header below its head, and a notice unless these are all."""
    texts = [part for part in parts if part in kept]
    if len(texts) == len(parts):
        return whole
    texts[-1] = texts[-1].rstrip()
    for at in reversed(range(len(texts))):
        if _is_empty(texts[at], *texts[at + 1 : at + 3]):
            del texts[at : at + 2 - _is_comment(texts[at])]
    return _NOTICE + whole[: len(whole) - len(_HEAD.sub("", whole))] + "\n\n".join(texts) + "\n"


def _is_empty(part: str, following: str = _CLOSES, second: str = "") -> bool:
    """Return True for a comment with nothing below it, if need be in a condition, and for an empty condition."""
    if _is_comment(part):
        below = second if following.startswith("#if ") and second else following
        ends = _is_comment(below) or following.startswith((_CLOSES, _CLOSES_C))
        return ends or ("/* ----" not in part and following.startswith("/*"))
    return (part, following) == (_OPENS_C, _CLOSES_C) or (following == _CLOSES and part.startswith("#if "))


def _is_comment(part: str) -> bool:
    return not _COMMENT.sub("", part).strip()
