"""No two things get one identifier in a target, and nothing takes a name that the target itself needs.

What each target makes of a name stands in `identifiers.py`. Reserved words are no clash: the targets turn them aside.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.checks.identifiers import Claim, claims
from fieldscribe.checks.prefixes import prefix_clashes

if TYPE_CHECKING:
    from fieldscribe.checks.subject import Subject


def check(subject: Subject) -> None:
    """Names that meet after mangling, old names that live on, and names that generated code needs for itself."""
    first: dict[tuple[str, str], Claim] = {}
    pairs = []
    for claim in claims(subject):
        other = first.setdefault((claim.namespace, claim.identifier), claim)
        if other is not claim:
            pairs.append((other, claim))
    told: set[frozenset[tuple[int, str]]] = set()
    for other, claim in (*pairs, *prefix_clashes(subject)):
        pair = frozenset(((id(other.holder), other.what), (id(claim.holder), claim.what)))
        if pair not in told:  # two names that meet in one language mostly meet in others too
            _report(subject, other, claim)
            told.add(pair)


def _report(subject: Subject, other: Claim, claim: Claim) -> None:
    if claim.holder is other.holder and claim.key == other.key and claim.what == other.what:
        return  # one thing in several variants
    if claim.holder is None:
        other, claim = claim, other
    if claim.holder is None:
        return
    hint = "rename one of them" if other.holder is not None else "choose another name"
    related = [] if other.holder is None else [(other.span, f"{other.what} stands here")]
    if claim.namespace == "" or claim.what == other.what:
        message = f"{claim.what} is there twice"
    else:
        message = f"{other.what} and {claim.what} would both be `{claim.identifier}` in {claim.namespace}"
    subject.report.error("name-clash", message, claim.span, hint, related)
