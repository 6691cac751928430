"""All descriptions use the same English word for a word of the manuals: `descriptions/glossary.yaml` says which."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
import yaml
from fieldscribe.model import Device, Titles
from fieldscribe.resources import descriptions_dir
from support.described import SHIPPED, shipped

GLOSSARY = descriptions_dir() / "glossary.yaml"
TERMS: dict[str, str | list[str]] = yaml.safe_load(GLOSSARY.read_text(encoding="utf-8"))["terms"]


def titles_of(device: Device) -> Iterator[tuple[str, Titles]]:
    """Every title of a device, with the name of what has it."""
    for group in device.groups:
        yield group.name, group.title
    for point in device.points:
        yield point.item, point.title
        for entry in point.enum.entries if point.enum else ():
            yield f"{point.item}: {entry.name}", entry.title
        for flag in point.flags:
            yield f"{point.item}: {flag.name}", flag.title
    bus = device.bus
    for code in (*bus.functions, *bus.codes("responses"), *bus.exceptions):
        yield code.name, code.title
    for command in device.commands:
        yield command.name, command.title
    for message in device.messages:
        yield message.name, message.title
    for telegram in device.telegrams:
        yield telegram.name, telegram.title


def breaches(german: str, english: str) -> list[str]:
    """The terms that a German title has and the English one does not; a longer term hides those that it contains."""
    rest, found = german.lower(), []
    for term in sorted(TERMS, key=len, reverse=True):
        if term.lower() in rest:
            rest = rest.replace(term.lower(), " ")
            words = TERMS[term]
            if not any(word.lower() in english.lower() for word in (words if isinstance(words, list) else [words])):
                found.append(term)
    return found


@pytest.mark.parametrize("name", SHIPPED)
def test_titles_use_the_words_of_the_glossary(name: str) -> None:
    titles = titles_of(shipped(name))
    pairs = dict.fromkeys((where, title["de"], title["en"]) for where, title in titles if "de" in title)
    wrong = [f"{where}: {de} / {en}: {', '.join(found)}" for where, de, en in pairs if (found := breaches(de, en))]
    assert wrong == []


OTHERWISE = {"nord_sk5xxe": {"480": "bus bit", "481": "bus bit"}}
"""What English titles call by another number: the functions of bus bits, by the word before it."""


def numbers_differ(german: str, english: str) -> bool:
    """Whether both titles have numbers, and neither has all those of the other."""
    first, second = ({*map(int, re.findall(r"\d+", title))} for title in (german, english))
    return bool(first - second and second - first)


@pytest.mark.parametrize("name", SHIPPED)
def test_titles_have_the_numbers_of_the_manual(name: str) -> None:
    device, others = shipped(name), OTHERWISE.get(name, {})
    values = [(entry.name, entry.title) for point in device.points for flag in point.flags for entry in flag.values]
    pairs = [(where, title["de"], title["en"]) for where, title in (*titles_of(device), *values) if "de" in title]
    wrong = [(where, de, en) for where, de, en in pairs if numbers_differ(de, en)]
    assert [
        each for each in wrong if not any(key in each[1] and others[key] in each[2].lower() for key in others)
    ] == []


@pytest.mark.parametrize(
    ("german", "english", "differ"),
    [
        ("Parametersatz 3", "Parameter set 3", False),
        ("Parametersatz 3", "Parameter set 30", True),
        ("Statuswort 1 (ZSW), RS232", "Source of ZSW, RS232", False),
        ("Intern", "Internal, word 11", False),
        ("Grenze 1 von 2", "Limit 1 of 3", True),
    ],
)
def test_titles_whose_numbers_differ(german: str, english: str, *, differ: bool) -> None:
    assert numbers_differ(german, english) is differ


@pytest.mark.parametrize(
    ("german", "english", "found"),
    [
        ("Generatorleistungsschalter", "Generator circuit breaker", []),
        ("Generatorleistungsschalter", "Generator switch", ["Leistungsschalter"]),
        ("Hauptsollwert", "Main setpoint", []),
        ("Sollwert 1", "Set value 1", ["Sollwert"]),
    ],
)
def test_what_breaches_the_glossary(german: str, english: str, found: list[str]) -> None:
    assert breaches(german, english) == found
