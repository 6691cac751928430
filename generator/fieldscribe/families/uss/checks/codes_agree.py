"""Tasks, responses and error values of USS name each other alike on both sides."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.families.uss.facts import FAMILY
from fieldscribe.language.nodes import Map
from fieldscribe.model import Named
from fieldscribe.resolve.bus import code_list
from fieldscribe.resolve.subject import Printed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from fieldscribe.diagnostics import Span
    from fieldscribe.model import Code
    from fieldscribe.resolve.subject import Subject

_LISTS = ("answers", "refusals")


def check(subject: Subject) -> None:
    """Findings for codes that are named on one side only or do not exist, and for printed lists that disagree."""
    bus = subject.scope.bus
    if bus is None or not subject.bus_is_whole:
        return
    _named_back(subject, bus)
    _refused(subject, bus)
    for kind in FAMILY.codes:
        for code, raw, _ in _written(subject, bus, kind.section):
            _printed(subject, code, raw, kind.key)


def _written(subject: Subject, bus: Map, section: str) -> Iterator[tuple[Code, Map, Span]]:
    """Each code that is written as a mapping, with the mapping and the place of its number."""
    by_name = {code.name: code for code in subject.bus.codes(section)}
    for key, node in bus.get(section, {}).items():
        if isinstance(node, Map) and node["name"] in by_name:
            yield by_name[node["name"]], node, bus[section].key_span(key)


def _named_back(subject: Subject, bus: Map) -> None:
    """Findings for tasks and responses of which only one names the other."""
    tasks = {code.number: {*code.answers, *code.refusals} for code in subject.bus.functions}
    responses = {code.number: set(code.answers) for code in subject.bus.codes("responses")}
    for task, node, _ in _written(subject, bus, "functions"):
        for key in _LISTS:
            for number in getattr(task, key):
                if task.number not in responses.get(number, ()):
                    _one_sided(
                        subject, node.span(key), ("task", task.number), ("response", number), number in responses
                    )
    for response, node, _ in _written(subject, bus, "responses"):
        for number in response.answers:
            if response.number not in tasks.get(number, ()):
                names = ("response", response.number), ("task", number)
                _one_sided(subject, node.span("answers"), *names, number in tasks)


def _one_sided(subject: Subject, span: Span, code: tuple[str, int], other: tuple[str, int], exists: bool) -> None:
    what = "which does not name it back" if exists else "which does not exist"
    message = f"the {code[0]} {code[1]} names the {other[0]} {other[1]}, {what}"
    hint = "take one of them in both lists, and give what is printed under `printed` with an erratum"
    subject.report.error("codes-disagree", message, span, hint if exists else f"declare it, or leave it out; {hint}")


def _refused(subject: Subject, bus: Map) -> None:
    """Findings for error values of tasks that do not exist or are never refused."""
    tasks = {code.number: code for code in subject.bus.functions}
    for error, node, _ in _written(subject, bus, "exceptions"):
        for number in error.answers:
            task = tasks.get(number)
            if task is None or not task.refusals:
                what = "which does not exist" if task is None else "which is never refused"
                message = f"the error {error.number} names the task {number}, {what}"
                hint = "correct one of them, and give what is printed under `printed` with an erratum"
                subject.report.error("codes-disagree", message, node.span("answers"), hint)


def _printed(subject: Subject, code: Code, node: Map, about: str) -> None:
    """Compare the printed lists with those that were taken."""
    printed: Map = node.get("printed") or Map(node.file, node.at)
    for key in _LISTS:
        if key not in printed:
            continue
        taken = sorted(getattr(code, key))
        codes = sorted(code_list(subject.scope, printed, key))
        if codes != taken:
            message = f"the {key} {_list(codes)} are printed for the {about} {code.number}, taken are {_list(taken)}"
            named, span = Named(about, code.number), printed.span(key)
            subject.disagrees(Printed(named, key, list(printed[key]), taken, span, message))


def _list(numbers: list[int]) -> str:
    return ", ".join(map(str, numbers)) or "none"
