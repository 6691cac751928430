"""Holding a description against the text of its manual: what it cites must stand where it says.

manual.py      the text: its lines, sections, table rows, and the numbers in them
claims.py      what a description takes from the manual: facts of points (claims_of_points.py) and all others
               (claims_of_bus.py), each with the lines that it cites (citing.py)
printed_errata.py  what errata say that the manual prints
placement.py   where cited lines stand in a new edition of the manual
comparison.py  the claims and errata held against the text
outcome.py     the findings, as plain data
report.py      the findings for people, as lines of text or a page
"""

from fieldscribe.audit.comparison import Auditor, audit
from fieldscribe.audit.outcome import Audit

__all__ = ["Audit", "Auditor", "audit"]
