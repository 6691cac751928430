"""Holding a description against the text of its manual: what it cites must stand where it says.

manual.py      the text: its lines, sections, table rows, and the numbers in them
pages.py       heads and feet of its pages
claims.py      what a description takes from the manual: facts of points (claims_of_points.py), of flags
               (claims_of_flags.py) and others (claims_of_bus.py), each with the lines that it cites (citing.py)
printed_errata.py  what errata say that the manual prints
layout/        a new text in the layout of the one that was transcribed, by the fingerprint of that one
places.py      the places that are cited, as they stand in the text
errata.py      whether the manual prints what errata say, and what the description took against it
facts.py       whether facts stand in their places: numbers (passage.py), labels (labels.py)
columns.py     what nearly all rows print in one column, siblings.py what places print equally often
comparison.py  all of it, and what is left over
auditing.py    from a text to its findings
outcome.py     the findings, as plain data
report.py      the findings for people, as lines of text or a page
"""

from fieldscribe.audit.auditing import Auditor, audit
from fieldscribe.audit.outcome import Audit

__all__ = ["Audit", "Auditor", "audit"]
