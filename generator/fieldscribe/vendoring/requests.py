"""The requests of projects, for code in a language or documentation in a format, and the files for them.

Prunes the runtime headers of C to what the chosen points use.

A header is divided at its empty lines. A part that defines something is kept if the code of a kept part has one of its
names as a word, or if a text that uses the runtime has, also in a comment below its head. `fieldscribe_modbus_*` there
means all names that begin so. Lines in the condition of a feature are kept if a name that needs it is used.
"""

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fnmatch import filter as matching
from fnmatch import fnmatchcase
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from fieldscribe.code_view import for_code
from fieldscribe.diagnostics import UnclearError
from fieldscribe.model import Device
from fieldscribe.pages.site import INDEX, Shelf, site_files
from fieldscribe.resources import render, templates_dir
from fieldscribe.targets import target
from fieldscribe.targets.docs import csv_files, html_files, markdown_files, xlsx_files
from fieldscribe.targets.docs.cells import scope_of
from fieldscribe.targets.identifiers import LEFT_OUT
from fieldscribe.vendoring.selection import select

RUNTIME_NAME = re.compile(r"fieldscribe_[a-z0-9_]*\*?|FIELDSCRIBE_[A-Z0-9_]*\*?")
_FOR_USERS = {"FIELDSCRIBE_COUNT"}
"""Names that a user's program may need although no generated line uses them."""
_FEATURE = re.compile(r"#define (\w+) +/\* part: (.*) \*/")
"""A macro that the runtime is divided by beside its functions; its comment has the names that need it."""
_HEAD = re.compile(r"\A\s*/\*.*?\*/", re.DOTALL)
_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_DEFINED = re.compile(
    r"(?m)^#define (\w+)|^\} (\w+);|^typedef [^{;]*?(\w+);|^typedef [^;]*?\(\*(\w+)\)"
    r"|^(?:typedef )?(?:struct|enum) (\w+) \{|^    (FIELDSCRIBE_\w+)(?: = \w+)?,?\s*$"
    r"|^(?!#|typedef)\w[^\n(=]*?\b(fieldscribe_\w+)(?:[(\[]| =)"
)
_CONDITION = re.compile(r"#if defined\((\w+)\)")
_OPENS_C = '#ifdef __cplusplus\nextern "C" {\n#endif'
_CLOSES_C = "#ifdef __cplusplus\n}\n#endif"
_CLOSES = "#endif"
_NOTICE = "/* Only what the chosen points use: to have more, add its names to --points, or fieldscribe_* for all. */\n"


def pruned(runtime: Mapping[str, str], users: Iterable[str], words: set[str]) -> dict[str, str]:
    """Return the runtime headers without parts that neither these texts nor these words use. Raises UnclearError."""
    known = frozenset[str]().union(*(_names_of(part) for parts in _parts(runtime).values() for part in parts))
    unknown = [word for word in sorted(words) if not matching(known, word)]
    if unknown:
        raise UnclearError(f"the runtime has no `{unknown[0]}`", "`fieldscribe_*` keeps all of it")
    needed = {word for text in users for word in RUNTIME_NAME.findall(_HEAD.sub("", text))} | words | _FOR_USERS
    needed |= {name for word in needed if "*" in word for name in known if fnmatchcase(name.lower(), word.lower())}
    features = {
        match[1]: (match[1], *re.findall(r"fieldscribe_[a-z_*]+", match[2]))
        for text in runtime.values()
        for match in _FEATURE.finditer(text)
    }
    left_out: set[str] | None = None
    unused = {*features}
    while unused != left_out:
        left_out = unused
        resolved = {name: _without(text, features.keys(), left_out) for name, text in runtime.items()}
        parts = _parts(resolved)
        kept, used = _used(parts, needed)
        unused = {name for name, users_of in features.items() if not any(matching(used, each) for each in users_of)}
    texts = resolved if unused else runtime
    return {
        name: text if text == runtime[name] and kept.issuperset(parts[name]) else _joined(text, parts[name], kept)
        for name, text in texts.items()
    }


def _parts(runtime: Mapping[str, str]) -> dict[str, list[str]]:
    return {name: _HEAD.sub("", text).split("\n\n") for name, text in runtime.items()}


def _used(parts: Mapping[str, Iterable[str]], needed: Collection[str]) -> tuple[set[str], set[str]]:
    """Return the parts that these names need, and all names that these parts use."""
    defined = {part: _names_of(part) for of_file in parts.values() for part in of_file}
    used, kept, size = set(needed), set[str](), -1
    while len(kept) > size:
        size = len(kept)
        kept |= {part for part, names in defined.items() if not names or names & used}
        used |= set[str]().union(*map(_words_of, kept))
    return kept, used


def _without(text: str, features: Collection[str], left_out: Collection[str]) -> str:
    """Return a header without the conditions of features, and without the lines of those that are left out."""
    lines: list[str] = []
    open_conditions: list[bool | None] = []  # of a feature: whether its lines are kept
    for line in text.split("\n"):
        condition, feature = _CONDITION.fullmatch(line), _FEATURE.fullmatch(line)
        if condition is not None and condition[1] in features:
            open_conditions.append(condition[1] not in left_out)
        elif line == "#else" and open_conditions[-1] is not None:
            open_conditions[-1] = not open_conditions[-1]
        elif line == _CLOSES and open_conditions.pop() is not None:
            continue
        else:
            if False not in open_conditions and (feature is None or feature[1] not in left_out):
                lines.append(line)
            if line.startswith("#if"):
                open_conditions.append(None)
    return "\n".join(lines)


@lru_cache(maxsize=2048)
def _words_of(part: str) -> frozenset[str]:
    """Return the names of the runtime in the code of a part."""
    return frozenset(RUNTIME_NAME.findall(_COMMENT.sub("", part)))


@lru_cache(maxsize=2048)
def _names_of(part: str) -> frozenset[str]:
    """Return the names that a part defines; none if it opens or closes conditions of others, and is always kept."""
    text = _COMMENT.sub("", part)
    if len(re.findall(r"(?m)^#if", text)) != len(re.findall(r"(?m)^#endif", text)):
        return frozenset()
    return frozenset(name for names in _DEFINED.findall(text) for name in names if name)


def _joined(whole: str, parts: Sequence[str], kept: Collection[str]) -> str:
    """Return the kept parts of a header below its head, and a notice."""
    texts = [part for part in parts if part in kept]
    texts[-1] = texts[-1].rstrip()
    for at in reversed(range(len(texts))):
        if _is_empty(texts[at], *texts[at + 1 : at + 3]):
            del texts[at : at + 2 - _is_comment(texts[at])]
    return _NOTICE + whole[: len(whole) - len(_HEAD.sub("", whole))] + "\n\n".join(texts) + "\n"


def _is_empty(part: str, following: str = _CLOSES, second: str = "") -> bool:
    """Return True for a comment with nothing below it, perhaps in a condition, and for an empty condition."""
    if _is_comment(part):
        below = second if following.startswith("#if ") and second else following
        ends = _is_comment(below) or following.startswith((_CLOSES, _CLOSES_C))
        return ends or ("/* ----" not in part and following.startswith("/*"))
    return (part, following) == (_OPENS_C, _CLOSES_C) or (following == _CLOSES and part.startswith("#if "))


def _is_comment(part: str) -> bool:
    return not _COMMENT.sub("", part).strip()


LANGUAGES = ("c", "python", "rust", "typescript")
"""The languages of code requests."""

LANGUAGE_OF = {"frames": "c", "rows": "c", "single_file": "c", "wheel": "python"}
"""The switches of code requests, each with its language."""

LICENCE = "LICENSE-fieldscribe.txt"
_POINTS_IN_A_HEAD = 60
"""The most characters of a list of points; longer lists are only in the manifest."""


FORMATS = {
    "csv": "the points and their meanings as tables",
    "html": "pages to read and search, without a network",
    "markdown": "the reference as a page",
    "xlsx": "the tables, and the errata, as a workbook",
}
"""The formats of documentation, with what each holds."""


@dataclass(frozen=True, slots=True)
class CodeRequest:
    """A request for code: its language, the chosen points (empty: all), and switches.

    `name` is the name of the device in code, if it differs from the id. `frames`, `rows` and `single_file` are for C,
    `wheel` is for Python.
    """

    language: str
    points: tuple[str, ...] = ()
    name: str | None = None
    frames: bool = True
    rows: bool = False
    single_file: bool = False
    wheel: bool = False
    extra = "--wheel needs hatchling", 'pip install "fieldscribe[wheel]"'
    """The message and the hint if the library of an extra is missing."""

    @property
    def chosen(self) -> tuple[str, ...]:
        """The points, without words that name parts of the runtime of C."""
        return tuple(word for word in self.points if not RUNTIME_NAME.fullmatch(word)) or self.points

    def command(self, device: str) -> tuple[str, ...]:
        """Return the command that makes the files again, as words."""
        words = ["fieldscribe", "vendor", self.language, device]
        if self.name is not None:
            words += ["--as", self.name]
        if self.points:
            points = ",".join(self.points)
            fits = len(points) <= _POINTS_IN_A_HEAD and not any("," in point for point in self.points)
            words += ["--points", points if fits else LEFT_OUT]
        given = {"single-file": self.single_file, "no-frames": not self.frames, "rows": self.rows, "wheel": self.wheel}
        return (*words, *(f"--{switch}" for switch, is_given in given.items() if is_given))

    def as_data(self, device: str) -> dict[str, object]:
        """Return the request as the manifest records it."""
        data: dict[str, object] = {"device": device, "points": list(self.points)}
        data |= {} if self.frames else {"frames": False}
        return data | {key: True for key in ("rows", "single_file", "wheel") if getattr(self, key)}

    def contents(self, device: Device, others: Mapping[str, str] = {}) -> Iterator[tuple[str, bytes]]:
        """Yield the files: path below the folder, and bytes; for `others` see `files_of`.

        Raises UnclearError, and ModuleNotFoundError for wheels without hatchling.
        """
        texts = dict(files_of(device, self, others))
        if self.wheel:
            yield from _wheels_of(texts)
            texts = {LICENCE: texts[LICENCE]}
        for path, text in texts.items():
            yield path, text.encode()


@dataclass(frozen=True, slots=True)
class DocumentRequest:
    """A request for documentation; `language` is its format."""

    language: str
    name: None = None
    index: str = ""
    """The page that lists the device with others, if there is one."""
    extra = "--format xlsx needs XlsxWriter", 'pip install "fieldscribe[xlsx]"'
    """The message and the hint if the library of an extra is missing."""

    def command(self, device: str) -> tuple[str, ...]:
        """Return the command that makes the files again, as words."""
        return "fieldscribe", "docs", device, "--format", self.language

    def as_data(self, device: str) -> dict[str, object]:
        """Return the request as the manifest records it."""
        return {"device": device}

    def contents(self, device: Device, others: Mapping[str, str] = {}) -> Iterator[tuple[str, bytes]]:
        """Yield the files: path below the folder, and bytes.

        Raises ModuleNotFoundError for a workbook without XlsxWriter.
        """
        scope = scope_of(replace(device, command=self.command(device.id)))
        if self.language == "xlsx":
            yield from xlsx_files(scope)
            return
        if self.language == "csv":
            texts = csv_files(scope)
        elif self.language == "html":
            texts = html_files(scope, render, self.index)
        else:
            texts = markdown_files(scope, render)
        for path, text in texts:
            yield path, text.encode()


@dataclass(frozen=True, slots=True)
class IndexRequest:
    """A request for an index of devices, with our pages if there are any."""

    devices: tuple[Device, ...]
    shelves: tuple[Shelf, ...] = ()
    language = "html"
    name = INDEX
    extra = DocumentRequest.extra

    def as_data(self, device: str) -> dict[str, object]:
        """Return the request as the manifest records it."""
        return {"device": device, "devices": [each.id for each in self.devices], "pages": bool(self.shelves)}

    def contents(self, others: Mapping[str, str] = {}) -> Iterator[tuple[str, bytes]]:
        """Yield the files: path below the folder, and bytes."""
        pages = ("--pages",) if self.shelves else ()
        command = "fieldscribe", "docs", *(each.id for each in self.devices), *pages, "--format", self.language
        for path, text in site_files(self.devices, self.shelves, " ".join(command), render):
            yield path, text.encode()


def files_of(device: Device, request: CodeRequest, others: Mapping[str, str] = {}) -> Iterator[tuple[str, str]]:
    """Yield the files of a code request: path below the folder, and text. Raises UnclearError.

    `others` are texts by path that share the folder, and the runtime of C.
    """
    reduced = select(device, request.chosen) if request.points else device
    named = replace(for_code(reduced), id=request.name or device.id, command=request.command(device.id))
    language = target(request.language)
    ways: dict[str, Any] = {"tests": False} | ({"frames": _frames_part(request)} if request.language == "c" else {})
    copied = language.runtime(named, **ways)
    files = {path: (templates_dir() / source).read_text("utf-8") for path, source in copied}
    outputs = dict(language.outputs(named, render, **ways, **({"rows": True} if request.rows else {})))
    if request.rows and f"c/{named.id}_rows.h" not in outputs:
        raise UnclearError(f"`{device.id}` has no rows", "only devices on Modbus have")
    if request.points and request.language == "c" and not request.single_file:  # of which a program may have several
        unpruned = [text for path, text in others.items() if f"c/{path}" not in files]
        files = pruned(files, [*outputs.values(), *unpruned], set(request.points) - set(request.chosen))
    files |= outputs
    files = {path.removeprefix(f"{request.language}/"): text for path, text in files.items()}
    if request.single_file:
        from fieldscribe.targets.c.header import joined

        files = {f"{named.id}.h": joined(files, named)}
    yield from files.items()
    yield LICENCE, (templates_dir() / LICENCE).read_text("utf-8")


def _frames_part(request: CodeRequest) -> str:
    """Return the contents of the C header of frames: only calls for chosen points, unless others are chosen."""
    if not request.frames:
        return "constants"
    others = request.rows or request.single_file or request.points != request.chosen
    return "all" if others or not request.points else "calls"


def _wheels_of(texts: Mapping[str, str]) -> Iterator[tuple[str, bytes]]:
    """Yield name and bytes of a wheel for each package in these files. Raises ModuleNotFoundError without hatchling."""
    with TemporaryDirectory() as folder:
        root = Path(folder)
        for path, text in texts.items():
            (root / path).parent.mkdir(parents=True, exist_ok=True)
            (root / path).write_text(text, "utf-8", newline="\n")
        for project in sorted(root.glob("*/pyproject.toml")):
            built = _build_wheel(project.parent, root)
            yield built.name, built.read_bytes()


def _build_wheel(project: Path, out: Path) -> Path:
    """Return the wheel of a package, with the constant date of hatchling, so that its bytes are reproducible."""
    from hatchling.builders.wheel import WheelBuilder

    before = os.environ.pop("SOURCE_DATE_EPOCH", None)
    try:
        [built] = WheelBuilder(str(project)).build(directory=str(out), versions=["standard"])
    finally:
        if before is not None:
            os.environ["SOURCE_DATE_EPOCH"] = before
    return Path(built)
