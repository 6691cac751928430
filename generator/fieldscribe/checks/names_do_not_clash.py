"""No two things get the same identifier in a target, and none gets an identifier that generated code needs.

Nor do two identifiers differ only after the characters that a language compares.

Each target lists its identifiers with their owners (`targets/*/identifiers.py`); here they are only compared. Points
that have other findings are left out. Reserved words do not clash: targets change such names themselves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.checks.distinct_names import PointKinds
from fieldscribe.checks.identifier_places import IdentifierPlaces, Named, Thing, given_names, thing_of
from fieldscribe.lowered import lower
from fieldscribe.resolve.analysis import Analysis

if TYPE_CHECKING:
    from fieldscribe.targets.identifiers import Resemblance


def check(analysis: Analysis) -> None:
    """Report equal names in the description, then equal identifiers in a target."""
    reported: set[frozenset[Thing]] = set()
    first: dict[tuple[str, str], Named] = {}
    for namespace, name, named in given_names(analysis):
        known = first.setdefault((namespace, name), named)
        if known is not named and (other := thing_of(known)) != (thing := thing_of(named)):
            _report(analysis, other, thing, f"`{name}` in {namespace}", reported)
    _compare_targets(analysis, reported)


def _compare_targets(analysis: Analysis, reported: set[frozenset[Thing]]) -> None:
    from fieldscribe.targets import TARGETS, knows, target
    from fieldscribe.targets.identifiers import clashes, resemblances

    owners, device = IdentifierPlaces(analysis), analysis.code_device
    warned: set[tuple[str, int]] = set()
    kinds = PointKinds(device, lower(device).template_keys)
    for language in [target(name) for name in TARGETS if knows(name, device)]:
        if kinds.saves_time and kinds.are_distinct(language.identifiers, language.BEFORE_POINTS):
            continue
        listed = list(language.identifiers(device))
        for clash in clashes(listed):
            first, second = owners.thing(clash.first), owners.thing(clash.second)
            _report(analysis, first, second, f"`{clash.name}` in {clash.namespace}", reported)
        for resemblance in resemblances(listed):
            _warn(analysis, resemblance, owners.thing(resemblance.first), owners.thing(resemblance.second), warned)


def _report(analysis: Analysis, first: Thing, second: Thing, where: str, reported: set[frozenset[Thing]]) -> None:
    """Report each pair once: names that clash in one language mostly clash in the others too."""
    pair = frozenset((first, second))
    if second.place is None:
        first, second = second, first
    if pair in reported or second.place is None:
        return
    reported.add(pair)
    hint = "rename one of them" if first.place is not None else "choose another name"
    related = [] if first.place is None else [(first.place, f"{first.words} stands here")]
    message = f"{first.words} and {second.words} would both be {where}"
    if first.words == second.words:
        message = f"{second.words} is there twice"
    analysis.report.error("name-clash", message, second.place, hint, related)


def _warn(
    analysis: Analysis, resemblance: Resemblance, first: Thing, second: Thing, warned: set[tuple[str, int]]
) -> None:
    """Warn of names that a compiler need not distinguish; once for all names of one place in the description."""
    place = second.place or first.place
    if place is None or (place.file, place.line) in warned:
        return
    warned.add((place.file, place.line))
    names = " and ".join(f"`{name}`" for name in resemblance.names)
    message = (
        f"{names} are equal in their first {resemblance.significant} characters, and C compilers need not compare more"
    )
    analysis.report.warning("long-names", message, place, "give it a shorter name")
