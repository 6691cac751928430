"""Holding a description against the text of its manual: what it cites must stand where it says.

manual.py      the text: its lines, sections, table rows, and the numbers in them
claims.py      what a description takes from the manual, and which line it names for that
placement.py   where cited lines stand in an edition that changed
comparison.py  the two held against each other
outcome.py     what was found, as plain data
report.py      the same for people, as lines of text or a page
"""

from fieldscribe.audit.comparison import audit
from fieldscribe.audit.outcome import Audit

__all__ = ["Audit", "audit"]
