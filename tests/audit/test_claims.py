"""What descriptions of messages and codes claim that the manual prints, and where: worked out by hand."""

from __future__ import annotations

from fieldscribe.audit.claims import Claim, Number
from fieldscribe.audit.claims_of_device import claims_of_codes, claims_of_entry, claims_of_settings
from fieldscribe.audit.numbers import Notation
from fieldscribe.diagnostics import Report
from fieldscribe.language.load import load
from fieldscribe.language.nodes import Map, SourceFile


def written(text: str) -> Map:
    """A mapping of a description."""
    (root,) = load(SourceFile("a.yaml", text), Report())
    assert root is not None
    return root


def lines(claim: Claim) -> tuple[tuple[int, int], ...]:
    """The lines that a claim cites."""
    return tuple(cited.lines for cited in claim.cited)


def test_a_message_claims_its_numbers_and_both_ends_of_its_bytes() -> None:
    """Bytes between the ends may be printed; other facts stand where `lines` says."""
    entry = written(
        "name: go\nat: 7\nvalue: 1\nline: 5\ntitle: Go 2\n"
        "layout: {0: FFh, 2..5: address, 6..7: raw}\nlines: {value: 9}\n"
    )
    claims = list(claims_of_entry("command", entry, Notation(written("documents: {}\n")["documents"])))
    assert {claim.subject for claim in claims} == {"command go"}
    assert [(claim.fact, claim.stated, lines(claim), claim.optional) for claim in claims] == [
        ("at", "7", ((5, 0),), False),
        ("value", "1", ((9, 0),), False),
        ("layout", "0", ((5, 0),), False),
        ("layout", "255", ((5, 0),), False),
        ("layout", "2", ((5, 0),), False),
        ("layout", "5", ((5, 0),), False),
        ("layout", "3", ((5, 0),), True),
        ("layout", "4", ((5, 0),), True),
        ("layout", "6", ((5, 0),), False),
        ("layout", "7", ((5, 0),), False),
    ]


def test_codes_that_share_a_row_may_be_printed_by_its_ends() -> None:
    """As in "2 - 9": the number itself helps to find the row again, if it stands in the code's own line."""
    codes = written(
        "2: {name: a, line: 4, max: 8}\n5: {name: b, line: 4, lines: {number: 7}, answers: [1, 3]}\n"
        "9: {name: c, line: 4, printed: {bytes: 16}}\n11: {name: d, line: 6}\n12: plain\n"
    )
    claims = list(claims_of_codes("function", codes))
    assert [(claim.subject, claim.fact, claim.stated, lines(claim)) for claim in claims] == [
        ("function 2", "number", "2", ((4, 0),)),
        ("function 2", "max", "8", ((4, 0),)),
        ("function 5", "number", "5", ((7, 0),)),
        ("function 5", "answers", "1", ((4, 0),)),
        ("function 5", "answers", "3", ((4, 0),)),
        ("function 9", "number", "9", ((4, 0),)),
        ("function 9", "printed bytes", "16", ((4, 0),)),
        ("function 11", "number", "11", ((6, 0),)),
    ]
    numbers = [claim.evidence for claim in claims if claim.fact == "number" and isinstance(claim.evidence, Number)]
    assert [sorted(number.ends) for number in numbers] == [[2, 9], [2, 9], [2, 9], []]


def test_settings_of_the_bus_are_claimed_where_lines_are_named() -> None:
    """A number by itself, a parity in either language, a code with what it means."""
    bus = written(
        "units: 1..32\nserial:\n  baud: {4: 4800}\n  parity: even\n  formats: {1: odd}\n  stop_bits: [1, 2]\n"
        "timing: {pause: 20 ms}\nlines: {units: 3, baud: 7..7, parity: 8, formats: 9, stop_bits: 5, pause: 6}\n"
    )
    claims = list(claims_of_settings(bus))
    assert [(claim.fact, claim.stated, lines(claim)) for claim in claims] == [
        ("units", "1", ((3, 0),)),
        ("units", "32", ((3, 0),)),
        ("baud", "4: 4800", ((7, 7),)),
        ("parity", "even", ((8, 0),)),
        ("formats", "1: odd", ((9, 0),)),
        ("stop_bits", "1", ((5, 0),)),
        ("stop_bits", "2", ((5, 0),)),
        ("pause", "20", ((6, 0),)),
    ]
    assert "Gerade" in next(claim.words for claim in claims if claim.fact == "parity")
    assert list(claims_of_settings(written("serial: {parity: even}\nunits: 1..32\n"))) == []
