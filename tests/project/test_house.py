"""The house: imports go down and in no circle, and nothing outside a family's folder names a family.

What still breaks it stands in the lists below with the reason. The lists may only shrink: an entry that is no longer
needed fails, too.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import fieldscribe
from fieldscribe.families import FAMILIES
from fieldscribe.resources import templates_dir

HOUSE = Path(fieldscribe.__file__).parent

ROOMS = (
    (
        "words, places, files of the package",
        """__init__ pasted_numbers text grouping
        diagnostics schema_types safe_files resources""",
    ),
    ("the neutral model", "conditions model code_view"),
    ("exact arithmetic", "arithmetic"),
    ("words for people", "wording"),
    ("the registry of families", "families"),
    ("frames taken apart, as all families say it", "families.frame_results families.decoded_frame"),
    ("facts and frames of a family", "families.*"),
    ("the table of facts", "facts"),
    ("the facts of a bus that only a family has", "families.*.bus_facts"),
    ("the table of keys", "language.keys"),
    ("a family's own keys", "families.*.description"),
    ("text to nodes", "language"),
    ("nodes to the model", "resolve"),
    ("what a family reads of its own keys", "families.*.reading"),
    ("what compiled languages need alike", "lowered"),
    ("the registry of targets", "targets targets.identifiers"),
    ("targets", "targets.*"),
    ("what a target knows of a family", "families.*.targets"),
    ("checks", "checks"),
    ("a family's own checks", "families.*.checks"),
    ("the table of contents", "pipeline"),
    ("what talks to people", "conversation audit export differences importing search"),
    ("what a family exports alone", "families.*.dbc families.*.dbc_signals"),
    ("a simulated device", "simulation"),
    ("what a family knows of simulated devices", "families.*.simulation"),
    ("a real device", "live"),
    ("passive listening", "listening"),
    ("the lines of a family, and how it is heard there", "families.*.lines"),
    ("output", "output"),
    ("our own pages", "pages"),
    ("what a project takes", "vendoring"),
    ("a person who writes a description", "authoring"),
    ("the command line", "cli __main__"),
)
"""The rooms, lowest first, with the modules or packages in each; the longest name that fits a module counts."""

NAMES_A_FAMILY = {
    "importing.wb.templates": "the protocols of a gateway",
    "cli.importing": "CAN databases are of one",
    "importing.dbc": "CAN databases are of one",
    "listening.captures": "captures of CAN tools are of one",
    "diagnostics": "a library of Python is called as one",
    "language.keys.files": "an example of a whole file",
    "language.keys.meaning": "an example of an enum",
    "language.keys.places": "examples of whole files and messages",
    "cli.simulate": "a line may be a bus of one",
    "simulation.bench": "a line may be a bus of one",
    "simulation.servers": "a library of Python is called as one",
    "targets.python": "a library of Python is called as one",
    "targets.typescript": "a package of npm is called as one",
}
"""Modules outside the folders of families that name one, with the reason."""


def modules() -> dict[str, Path]:
    """Every module by its name below the package."""
    found = {}
    for path in sorted(HOUSE.rglob("*.py")):
        parts = list(path.relative_to(HOUSE).with_suffix("").parts)
        found[".".join(parts[:-1] if parts[-1] == "__init__" and len(parts) > 1 else parts)] = path
    return found


MODULES = modules()


@cache
def nodes(name: str) -> list[ast.AST]:
    """All that a module is made of."""
    return list(ast.walk(ast.parse(MODULES[name].read_text("utf-8"))))


@cache
def imports(name: str) -> list[str]:
    """The modules of the package that a module imports, also late and for types alone."""
    return list(_imports(name))


def _imports(name: str) -> Iterator[str]:
    for node in nodes(name):
        if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] == "fieldscribe":
            source = str(node.module).partition(".")[2]
            for one in node.names:
                inner = f"{source}.{one.name}" if source else one.name
                yield inner if inner in MODULES else source or "__init__"


@cache
def room_of(name: str) -> int:
    """The number of the room that a module lies in."""
    fitting = [
        (pattern.count("."), "*" not in pattern, number)
        for number, (_, patterns) in enumerate(ROOMS)
        for pattern in patterns.split()
        if re.fullmatch(pattern.replace(".", r"\.").replace("*", r"\w+") + r"(\.\w+)*", name)
    ]
    assert fitting, f"{name} lies in no room: say in ROOMS where it belongs"
    return max(fitting)[2]


def named_families(name: str) -> set[str]:
    """The families that a module names: in imports, in other names, or as a text that is nothing else."""
    words: set[str] = set()
    for node in nodes(name):
        words.update(_identifiers(node))
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and re.fullmatch(r"[\w./-]+", node.value):
            words.add(node.value)
    return {family for word in words for family in FAMILIES if _names(word, family)}


def _identifiers(node: ast.AST) -> Iterator[str]:
    for field in ("name", "id", "attr", "arg", "asname"):
        value = getattr(node, field, None)
        if isinstance(value, str):
            yield value
    if isinstance(node, ast.ImportFrom) and node.module:
        yield from node.module.split(".")


def _names(word: str, family: str) -> bool:
    """Whether a word has a family in it; `can` stands for one at the beginning only, else it is the verb."""
    parts = re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", word)
    lowered = [part.lower() for part in parts]
    return family in (lowered[:1] if family == "can" else lowered)


def test_every_import_goes_down() -> None:
    found = {(name, other) for name in MODULES for other in imports(name) if room_of(other) > room_of(name)}
    assert not found


def test_no_modules_import_each_other() -> None:
    needs = {name: set(imports(name)) for name in MODULES}
    try:
        TopologicalSorter(needs).prepare()
    except CycleError as error:
        raise AssertionError(f"imports in a circle: {' imports '.join(error.args[1][::-1])}") from None


def test_no_family_knows_another() -> None:
    for name in MODULES:
        own = name.split(".")[1] if name.startswith("families.") and name.split(".")[1] in FAMILIES else None
        others = {other.split(".")[1] for other in imports(name) if other.startswith("families.")} & set(FAMILIES)
        assert own is None or others <= {own}, name


def test_only_its_folder_names_a_family() -> None:
    outside = [name for name in MODULES if not (name.startswith("families.") and name.split(".")[1] in FAMILIES)]
    found = {name for name in outside if name != "families" and named_families(name)}
    assert found == set(NAMES_A_FAMILY)


_IN_A_TEMPLATE = re.compile(rf"[\"'/_:.](?:{'|'.join(FAMILIES)})[\"'/_:.]")
"""A family as a part of code; `can` between spaces is the verb."""


def test_only_its_own_templates_name_a_family() -> None:
    templates = {path.relative_to(templates_dir()).as_posix(): path for path in templates_dir().glob("*/*.j2")}
    own = {name for name in templates if re.split(r"[/._]", name)[1] in FAMILIES}
    assert {name.split("/")[0] for name in own} == {"c", "rust"}
    naming = {name for name, path in templates.items() if _IN_A_TEMPLATE.search(path.read_text("utf-8"))}
    assert naming <= own


def test_a_word_names_a_family() -> None:
    assert _names("modbus_view", "modbus")
    assert _names("CanFrame", "can")
    assert _names("UssReading", "uss")
    assert not _names("fixed_bits_can_be_written", "can")
    assert not _names("discussed", "uss")
