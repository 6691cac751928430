"""No two things get one identifier in any target, whichever is generated, and nothing takes what generated code needs.

Each target lists its names by what they are of (`targets/*/identifiers.py`); here they are only compared. What is wrong
is left out, so that a device with other findings gets these too. Reserved words are no clash: targets turn them aside.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.checks.owners import Owners, given_names

if TYPE_CHECKING:
    from fieldscribe.checks.owners import Thing
    from fieldscribe.checks.subject import Subject


def check(subject: Subject) -> None:
    """Names that meet in the description itself, then those that meet in a target."""
    told: set[frozenset[Thing]] = set()
    first: dict[tuple[str, str], Thing] = {}
    for namespace, name, thing in given_names(subject):
        other = first.setdefault((namespace, name), thing)
        if other != thing:
            _report(subject, other, thing, f"`{name}` in {namespace}", told)
    _compare_targets(subject, told)


def _compare_targets(subject: Subject, told: set[frozenset[Thing]]) -> None:
    from fieldscribe.targets import TARGETS, knows, target
    from fieldscribe.targets.identifiers import clashes

    owners, device = Owners(subject), subject.sound
    for name in (one for one in TARGETS if knows(one, device)):
        for clash in clashes(target(name).identifiers(device)):
            first, second = owners.thing(clash.first), owners.thing(clash.second)
            _report(subject, first, second, f"`{clash.name}` in {clash.namespace}", told)


def _report(subject: Subject, first: Thing, second: Thing, where: str, told: set[frozenset[Thing]]) -> None:
    """Two names that meet in one language mostly meet in others too, and are told once."""
    pair = frozenset((first, second))
    if second.place is None:
        first, second = second, first
    if pair in told or second.place is None:
        return
    told.add(pair)
    hint = "rename one of them" if first.place is not None else "choose another name"
    related = [] if first.place is None else [(first.place, f"{first.words} stands here")]
    message = f"{first.words} and {second.words} would both be {where}"
    if first.words == second.words:
        message = f"{second.words} is there twice"
    subject.report.error("name-clash", message, second.place, hint, related)
