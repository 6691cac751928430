"""A manual that changed: what its new edition means for a description, line by line.

words.py        a text as words, in which layout counts for nothing (formulas.py: how formulas are set; contents.py: the
                pages of a table of contents)
matching.py     which words of the old text are which of the new one (swaps.py: of lines that changed places; rows.py:
                of cells that are broken over other lines; reading_order.py, pieces.py: pieces of a page in
                another order)
changes.py      lines that were changed, added, removed, moved (parting.py: rows that went or came, each by itself)
citations.py    what the description cites, in the lines of both editions
tracing.py      which words bear each fact
holding.py      which claims hold in the new edition, and which change keeps the others from it
explaining.py   what keeps a changed line from being explained (vocabulary.py: the description's own words;
                telling.py: what running text tells)
notes.py        which sentences of the description say what changed
drafts.py       what new rows seem to be: likeness.py (as the rows beside them are written), new_groups.py
                (the group of a new table), titles.py (English where it is known)
joining.py      what is one change for a reader: equal ones, swaps, several lines of one fact
remarks.py      what holds no fact: heads and feet of pages, words of running text, and so on
                (set_again.py: heads of new pages, entries in a cell of two rows)
comparing.py    all of it together; findings.py: as plain data; report.py: as lines
places.py       where the files cite lines; renumbering.py: writing them anew; accepting.py: recording the new edition
"""

from fieldscribe.audit.editions.citations import Citations
from fieldscribe.audit.editions.comparing import Edition, compare
from fieldscribe.audit.editions.findings import Comparison
from fieldscribe.audit.editions.renumbering import renumber

__all__ = ["Citations", "Comparison", "Edition", "compare", "renumber"]
