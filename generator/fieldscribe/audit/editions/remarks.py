"""Changes that hold no fact, told apart from those that may: what frames a manual, and how it is worded."""

from __future__ import annotations

import re
from functools import cached_property
from itertools import islice, starmap
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.findings import Finding, Place, Remark
from fieldscribe.audit.editions.parting import is_row
from fieldscribe.audit.editions.set_again import Heads, in_shared_cells, is_head_of_page
from fieldscribe.audit.editions.telling import DATE, REFERENCE, is_code, is_prose
from fieldscribe.audit.editions.vocabulary import are_respelled, is_name, is_one_spelling
from fieldscribe.audit.editions.words import Words
from fieldscribe.audit.pages import pattern, repeated

if TYPE_CHECKING:
    from collections.abc import Callable, Container, Iterable, Iterator, Sequence

    from fieldscribe.audit.editions.changes import Editions
    from fieldscribe.audit.manual import Manual

KINDS = (
    "heads_and_feet",
    "front_matter",
    "contents",
    "list_of_editions",
    "headings",
    "references",
    "repeated_heads",
    "moved",
    "wording",
)
_POINTS = re.compile(
    r"\b(?:siehe|vgl|see|refer|described|beschrieben|beschreibt|found|finden|aufgef\u00fchrt|listed|zu entnehmen)\b",
    re.IGNORECASE,
)
_AT = re.compile(
    r"\b(?:Anhang|Kapitel|Abschnitt|Seite|Handbuch|Ende|Appendix|Annex|Chapter|Section|Page|Handbook|End)\b",
    re.IGNORECASE,
)
_ALNUM = re.compile(r"[^\W_]+")
_SECTION = re.compile(r"[\s#]*[0-9]+(?:\.[0-9]+)+")
_NUMBER = re.compile(r"[0-9]+")
_SENTENCE = re.compile(r"(?:[^.!?;]|\.(?=[0-9]))*[.!]?\s*")


class Remarks:
    """Sorts findings into those that may hold facts and remarks about those that do not."""

    def __init__(self, editions: Editions, manual: Manual, bearing: tuple[Container[int], Container[int]]) -> None:
        """Facts stand on the words `bearing` of each edition."""
        self.editions, self.manual = editions, manual
        self._below_title = self._second_line()
        heads = Heads(editions.old, bearing[0]), Heads(editions.new, bearing[1])
        self._kinds: tuple[tuple[str, Callable[[Finding], bool]], ...] = (
            ("heads_and_feet", lambda finding: is_head_of_page(finding, *heads)),
            ("front_matter", self._is_front_matter),
            ("contents", self._is_contents),
            ("list_of_editions", self._is_list_of_editions),
            ("headings", self._is_heading),
            ("references", self._is_reference),
            ("repeated_heads", self._is_repeated),
            ("moved", lambda finding: finding.kind == "moved"),
            ("wording", lambda finding: _is_wording(finding) and not self._says_less_or_more(finding)),
        )

    def sort(self, findings: Sequence[Finding]) -> tuple[list[Finding], list[Remark]]:
        """What may hold facts, in its order, and what does not, by kinds."""
        kind_of = {id(finding): "heads_and_feet" for finding in self._of_pages(findings)}
        kind_of.update((id(finding), "moved") for finding in in_shared_cells(findings, self.editions))
        for finding in findings:
            if id(finding) not in kind_of and (kind := self._kind(finding)):
                kind_of[id(finding)] = kind
        by_kind = {kind: [finding for finding in findings if kind_of.get(id(finding)) == kind] for kind in KINDS}
        by_kind["heads_and_feet"] += self._pages()
        remarks = [Remark(kind, tuple(group)) for kind, group in by_kind.items() if group]
        return [finding for finding in findings if id(finding) not in kind_of], remarks

    def _of_pages(self, findings: Sequence[Finding]) -> Iterator[Finding]:
        """Findings whose lines are heads or feet of pages, as far as no fact is lost with them."""
        findings = [finding for finding in findings if self._may_be_of_pages(finding)]
        olds, news = (
            self._page_texts.union(
                _plain(text[line - 1]) for line in repeated(text, set().union(*map(lines_of, findings)))
            )
            for text, lines_of in ((self.editions.old.lines, _old_lines), (self.editions.new.lines, _new_lines))
        )
        for finding in findings:
            was, now = _written(finding.was), _written(finding.now)
            alike = finding.kind != "changed" or list(map(pattern, was)) == list(map(pattern, now))
            if alike and (was or now) and olds.issuperset(was) and news.issuperset(now):
                yield finding

    def _may_be_of_pages(self, finding: Finding) -> bool:
        """Whether it is about lines of text, and no fact is lost with it; facts may seem to stand on it by chance."""
        if finding.kind == "moved" or finding.drafts or finding.void:
            return False
        lines = [*finding.was, *finding.now]
        if finding.kind == "changed":  # a foot may have tabs, but not the rows of a table
            lines += [self.editions.old.line(line) for line in _old_lines(finding)]
            lines += [self.editions.new.line(line) for line in _new_lines(finding)]
        loses = any(reason.kind in ("missing", "gone") for reason in finding.reasons)
        return not loses and not any(map(is_row, lines))

    @cached_property
    def _page_texts(self) -> set[str]:
        both = zip((self.editions.old.lines, self.editions.new.lines), self.editions.pages, strict=True)
        return {_plain(text[line - 1]) for text, pages in both for line in pages}

    def _pages(self) -> Iterator[Finding]:
        """The heads and feet that only one of the editions has."""
        texts = self.editions.old.lines, self.editions.new.lines
        had, has = (
            {_plain(text[line - 1]) for line in pages} for text, pages in zip(texts, self.editions.pages, strict=True)
        )
        for line in sorted(self.editions.pages[0]):
            if (shown := _plain(texts[0][line - 1])) not in has:
                yield Finding("removed", (Place((line, line), None),), (shown,), (), (0,), (), ((shown, ""),), (), ())
        for line in sorted(self.editions.pages[1]):
            if (shown := _plain(texts[1][line - 1])) not in had:
                yield Finding("added", (Place(None, (line, line)),), (), (shown,), (), (0,), (("", shown),), (), ())

    def _kind(self, finding: Finding) -> str:
        """The kind of a finding that holds no fact; "" if it may hold one."""
        if finding.void or finding.drafts:
            return ""
        if finding.explained and finding.kind == "changed" and (is_spelling(finding) or _has_same_words(finding)):
            return "wording"
        if finding.explained and finding.kind == "changed" and _points_elsewhere(finding):
            return "references"
        if any(cite.fact for cite in finding.cited_by):
            return ""
        if any(reason.kind not in ("number", "word") for reason in finding.reasons):
            return ""
        return next((kind for kind, fits in self._kinds if fits(finding)), "")

    def _says_less_or_more(self, finding: Finding) -> bool:
        """Whether a row or label lost or got words, with nothing in their place: what it says of may be another now."""
        alone = (old or new for old, new in finding.words if not (old.strip() and new.strip()))
        names = [name for words in alone for name in _ALNUM.findall(words)]
        if finding.kind == "added" or not any(is_name(name) or is_code(name) for name in names):
            return False
        if finding.kind == "changed" and not all(map(is_prose, (*finding.was, *finding.now))):
            return True
        olds = range(finding.old[0], finding.old[1] + 1) if finding.old else ()
        return any(is_row(self.editions.old.line(line)) for line in olds)

    def _second_line(self) -> int:
        """Where the second line of the old edition that has words stands now."""
        lines = (line for line in range(1, len(self.editions.old.lines) + 1) if self.editions.old.of_line(line))
        places = (self.editions.now(line) for line in islice(lines, 1, None))
        return next((place[0] for place in places if place is not None), 1)

    def _was_there(self, line: int) -> bool:
        return any(not self.editions.is_new(word) for word in self.editions.new.of_line(line))

    def _is_front_matter(self, finding: Finding) -> bool:
        """Whether it stands before all that the old edition had, but for its first line: the title may be repeated."""
        return finding.kind == "added" and finding.new is not None and finding.new[1] < self._below_title

    def _is_contents(self, finding: Finding) -> bool:
        """Whether all its lines are in a table of contents."""
        both = zip((finding.old, finding.new), self.editions.contents, strict=True)
        return all(ends is None or contents.lines.issuperset(range(ends[0], ends[1] + 1)) for ends, contents in both)

    def _is_list_of_editions(self, finding: Finding) -> bool:
        """Whether rows below a heading or a row without numbers have a date each."""
        lines = _written(finding.now or finding.was)
        rows = [line for line in lines if any(map(str.isdigit, line)) and not line.startswith("#")]
        return finding.kind in ("added", "removed") and bool(rows) and all(map(DATE.search, rows))

    def _is_heading(self, finding: Finding) -> bool:
        """Whether it is a heading over text that was there before."""
        if finding.kind != "added" or finding.new is None or finding.new[0] != finding.new[1]:
            return False
        below = (line for line in range(finding.new[1] + 1, len(self.manual) + 1) if self.editions.new.of_line(line))
        return finding.new[0] in self.manual.headings and self._was_there(next(below, 0))

    def _is_reference(self, finding: Finding) -> bool:
        """Whether it is a sentence that says where something is described."""
        if finding.kind != "added" or len(lines := _written(finding.now)) != 1:
            return False
        if any(reason.kind == "number" for reason in finding.reasons) or _SENTENCE.fullmatch(lines[0]) is None:
            return False
        return bool(_POINTS.search(lines[0]) and _AT.search(lines[0]))

    def _is_repeated(self, finding: Finding) -> bool:
        """Whether all its rows stand in the other edition, too: the head of a table, on one page more or less."""
        if finding.kind not in ("added", "removed"):
            return False
        text, other = self.editions.new, self._lines_of_old
        if finding.kind == "removed":
            text, other = self.editions.old, self._lines_of_new
        ends = ((place.new or place.old or (1, 0)) for place in finding.places)
        lines = _written(text.line(line) for first, last in ends for line in range(first, last + 1))
        may_be = finding.kind == "removed" and len(lines) > 1
        return all((may_be or is_row(line)) and _words_of(line) in other for line in lines)

    @cached_property
    def _lines_of_old(self) -> set[tuple[str, ...]]:
        return set(map(_words_of, self.editions.old.lines))

    @cached_property
    def _lines_of_new(self) -> set[tuple[str, ...]]:
        return set(map(_words_of, self.editions.new.lines))


def _old_lines(finding: Finding) -> set[int]:
    return {line for place in finding.places if place.old for line in range(place.old[0], place.old[1] + 1)}


def _new_lines(finding: Finding) -> set[int]:
    return {line for place in finding.places if place.new for line in range(place.new[0], place.new[1] + 1)}


def is_spelling(finding: Finding) -> bool:
    """Whether words are only spelt otherwise, or signs between them."""
    return all(
        are_respelled(old, new) or is_one_spelling(old, new) or _letters(old) == _letters(new)
        for old, new in finding.words
    )


def is_reworded(finding: Finding) -> bool:
    """Whether a line says something in other words, and is not only spelt or set otherwise."""
    return finding.kind == "changed" and any(starmap(_is_reworded, finding.words))


def _is_reworded(old: str, new: str) -> bool:
    if are_respelled(old, new) or _letters(old) == _letters(new):
        return False
    return all(any(map(is_name, _ALNUM.findall(text))) for text in (old, new))


def _points_elsewhere(finding: Finding) -> bool:
    """Whether only numbers of pages, chapters, pictures are others: the finding is explained, so they are those."""
    return all(
        number and re.search(f"{REFERENCE}{re.escape(number)}(?!\\w)", " ".join(lines), re.IGNORECASE)
        for words in finding.words
        for number, lines in zip(words, (finding.was, finding.now), strict=True)
    )


def _has_same_words(finding: Finding) -> bool:
    """Whether only cells and signs stand otherwise."""
    return _ALNUM.findall(" ".join(finding.was)) == _ALNUM.findall(" ".join(finding.now))


def _letters(text: str) -> str:
    return "".join(filter(str.isalnum, text))


def _is_wording(finding: Finding) -> bool:
    """Whether it is explained, and no line with numbers came or went, nor one of which an erratum speaks."""
    if not finding.explained:
        return False
    was, now = (sorted(_NUMBER.findall(" ".join(pair[at] for pair in finding.words))) for at in (0, 1))
    if finding.kind != "changed":
        return not any(_NUMBER.search(_SECTION.sub("", line, 1)) for line in (*finding.was, *finding.now))
    return was == now or not any(cite.is_erratum for cite in finding.cited_by)


def _written(lines: Iterable[str]) -> list[str]:
    return [line for line in lines if any(map(str.isalnum, line))]


def _plain(line: str) -> str:
    return " ".join(line.split())


def _words_of(line: str) -> tuple[str, ...]:
    return tuple(Words(line).texts)
