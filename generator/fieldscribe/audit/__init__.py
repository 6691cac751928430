"""Compares a description with the text of its manual: every cited fact must be printed where it is cited.

Plain audit: `Citations` are what a description cites, `Held` finds them in a text, `audit` lists what is missing.
Two editions: `Editions` aligns both texts, `compare` lists every line that differs, with the facts that cite it.

numbers.py, manual.py                a text: its numbers, its sections and rows, a piece of it
claims.py                            one shape of a claim, with few kinds of evidence, and how claims are made
point_claims.py, claims_of_device.py the claims of points and their flags, and all of a description
notation.py                          how the manual writes things
evidence.py, held.py                 whether a passage has the evidence; all claims in a text
plain_audit.py                       the plain audit and its findings
alignment.py, comparison.py          two texts line by line; the facts that cite lines that differ
renumbering.py                       writing new line numbers, and the new text's checksum, into the YAML
report.py                            both as text and as a page
"""

from fieldscribe.audit.comparison import Comparison, Editions
from fieldscribe.audit.held import Citations
from fieldscribe.audit.plain_audit import Audit, audit, audit_of

__all__ = ["Audit", "Citations", "Comparison", "Editions", "audit", "audit_of"]
