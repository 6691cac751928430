"""A new text in the layout of the one that was transcribed, by what is kept of that one.

fingerprint.py  what is kept of a text: where its words stand, one of 64 signs for each
alignment.py    which pieces of one text are which of another (also of two whole texts: audit/editions)
stacked.py      rows whose cells are set side by side over several lines
relaid.py       the new text, line for line as the old one was; lines.py: how one line is written
"""

from fieldscribe.audit.layout.fingerprint import Fingerprint, FingerprintError
from fieldscribe.audit.layout.relaid import Relaid

__all__ = ["Fingerprint", "FingerprintError", "Relaid"]
