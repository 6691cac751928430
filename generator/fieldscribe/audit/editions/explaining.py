"""Which changed lines are explained by the description, and what is missing of the others."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from typing import TYPE_CHECKING

from fieldscribe.audit.editions.findings import Cite, Reason
from fieldscribe.audit.editions.holding import Holding, borne_by
from fieldscribe.audit.editions.telling import is_code, is_of_edition, is_prose, is_reference, is_title, turned
from fieldscribe.audit.editions.vocabulary import is_name, is_one_spelling, is_respelled
from fieldscribe.audit.editions.words import Words

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from fieldscribe.audit.citing import Claim
    from fieldscribe.audit.editions.changes import Change, Editions
    from fieldscribe.audit.editions.findings import Finding
    from fieldscribe.audit.editions.holding import Pair
    from fieldscribe.audit.editions.tracing import Trace
    from fieldscribe.audit.editions.vocabulary import Vocabulary
    from fieldscribe.audit.manual import Token

_PARTS = re.compile(r"[.,]")
_MOST = 8
"""A reason names at most so many numbers or words."""
_MOST_WEAKENED = 4
"""So many facts are told that were printed otherwise in one place: the first of them show what it is."""


class Explaining:
    """The claims of a description beside the changes of its manual."""

    def __init__(
        self,
        editions: Editions,
        traces: tuple[Trace, Trace],
        pairs: list[Pair],
        words: Vocabulary,
        passed_over: Mapping[int, str],
    ) -> None:
        self.old, self.new = traces
        self.editions, self.words = editions, words
        self.passed_over = passed_over
        self.holding = Holding(editions, traces, pairs)
        self.headings = frozenset(self.new.manual.headings)
        self.place_of = {pair.claim.subject: pair.claim.where for pair in reversed(pairs)}
        self.subjects_at: dict[int, dict[str, None]] = {}
        for extent, subjects in sorted(self.new.subjects.items(), key=lambda item: item[0].kind == "section"):
            for line in range(extent.first, extent.last + 1):
                self.subjects_at.setdefault(line, {}).update(dict.fromkeys(subjects))

    def cites(self, number: int, change: Change) -> tuple[Cite, ...]:
        """What cites a changed line: the facts that stood on its words, else the subjects, of its section last."""
        gone = {word for old, _ in change.gaps for word in old}
        come = {word for _, new in change.gaps for word in new}
        exact, whole = dict[Cite, None](), dict[Cite, None]()
        for pair in self.holding.pairs(number):
            claim = pair.claim
            bears = borne_by(self.old, pair.old) & gone or borne_by(self.new, pair.new) & come
            if bears and (not claim.beside or self._was_whole(pair, change) or self._is_whole(pair, change)):
                exact[Cite(claim.subject, claim.fact, claim.shown, claim.where)] = None
            whole[Cite(claim.subject, "", "", self.place_of[claim.subject])] = None
        named = {cite.subject for cite in exact}
        order = list(dict.fromkeys(name for line in change.new for name in self.subjects_at.get(line, ())))
        rest = [cite for cite in whole if cite.subject not in named]
        return (*exact, *sorted(rest, key=lambda cite: order.index(cite.subject) if cite.subject in order else -1))

    def reasons(self, number: int, change: Change) -> Iterator[Reason]:
        """Everything that keeps a change from being explained; what words tell, where nothing else is said."""
        reasons = list(self._by_facts(number, change))
        if not reasons and change.kind == "changed":
            meant = self._without_spellings(change)
            reasons = [*self._passed_over(meant), *self._turned(number, meant)]
        yield from reasons

    def _without_spellings(self, change: Change) -> Change:
        return replace(change, gaps=tuple(gap for gap in change.gaps if not self._is_spelling(*gap)))

    def _by_facts(self, number: int, change: Change) -> Iterator[Reason]:
        yield from (failing(pair.claim) for pair in self.holding.failing_at.get(number, ()))
        yield from islice(self._weakened(number, change), _MOST_WEAKENED)
        meant = self._without_spellings(change)
        took_words = self._took_words(meant)
        for line in change.new:
            if line not in self.new.empty:
                yield from self._numbers(line, meant)
                yield from self._names(line, meant, took_words=took_words)
        yield from self._signs(number, change)
        yield from self._units(number, change)

    def _is_spelling(self, old: range, new: range) -> bool:
        return bool(old and new) and is_one_spelling(self.editions.old.shown(old), self.editions.new.shown(new))

    def _passed_over(self, change: Change) -> Iterator[Reason]:
        """Numbers that changed in lines of which the description says that they hold none."""
        was = Counter(token.text for line in change.old for token in self.old.manual.tokens[line - 1])
        for line in change.new:
            if line not in self.new.empty:
                continue
            fresh = [token for token, words in self._new_tokens(line, change) if not self._is_known(token, words)]
            fresh = [token for token in fresh if not is_of_edition(self.editions.new.line(line), token.column)]
            has = Counter(token.text for place in change.new for token in self.new.manual.tokens[place - 1])
            if new := [token.text for token in fresh if has[token.text] != was[token.text]]:
                names = (
                    word
                    for reason in self._names(line, change, took_words=self._took_words(change))
                    for word in reason.words
                )
                yield self._list_them(new, line, "number", list(names))

    def _turned(self, number: int, change: Change) -> Iterator[Reason]:
        """Numbers in words, and words that turn a sentence round, but for those that the description followed."""
        olds, news = self.editions.old, self.editions.new
        claims = [pair.new for pair in self.holding.pairs(number) if pair.new and pair.old in self.old.missed]
        followed = set().union(*(self.new.named[claim] for claim in claims if claim not in self.new.missed))
        gaps = [(old, new) for old, new in change.gaps if followed.isdisjoint(new)]
        texts = [([olds.texts[word] for word in old], [news.texts[word] for word in new]) for old, new in gaps]
        listed = set().union(*(self.new.no_facts.get(line, ()) for line in change.new))
        told = [word for word in turned(texts) if word not in listed]
        if told:
            yield self._list_them(told, change.new[0], "word")

    def _list_them(self, texts: list[str], line: int, what: str, names: Iterable[str] = ()) -> Reason:
        """A reason that goes when `looked_through` lists what is new."""
        place = self.passed_over.get(line, "")
        if not place:
            return self._unknown(texts, line, what)
        shown = ", ".join(f"`{text}`" for text in dict.fromkeys(texts))
        said = f"looked_through passes over line {line}, where {shown} changed: {_way_out(texts, what, names)}"
        return Reason(what, said, place, words=tuple(texts))

    def listed_words(self, line: int) -> set[str]:
        """The words that the description says are no facts of a line, those of listed phrases one by one."""
        return {word for listed in self.new.no_facts.get(line, ()) for word in Words(listed).texts}

    def swapped(self, finding: Finding) -> Finding:
        """A finding of labels that changed places, which asks for something even where nothing cites them."""
        if finding.kind != "swapped" or finding.reasons or not finding.new:
            return finding
        if any(self._has_taken(cite) for cite in finding.cited_by):
            return finding
        listed = set().union(*(self.new.no_facts.get(line, ()) for line in range(finding.new[0], finding.new[1] + 1)))
        words = [word for pair in finding.words for word in pair if word not in listed]
        return replace(finding, reasons=(self._list_them(words, finding.new[0], "word"),)) if words else finding

    @staticmethod
    def _has_taken(cite: Cite) -> bool:
        return bool(cite.fact)

    def _weakened(self, number: int, change: Change) -> Iterator[Reason]:
        """Facts that were printed twice, and once otherwise now, where the new word is no news to the description."""
        pairs = self.holding.pairs(number)
        come = {word for _, new in change.gaps for word in new}
        for old, new in change.gaps:
            if not old or not new or self._is_passed_over(new) or not self._is_known_already(new, pairs):
                continue
            for pair in pairs:
                if pair.new in self.new.missed or not _is_of_numbers(pair.claim) or self._stands_anew(pair, come):
                    continue
                if self._lost_one(pair, old, new) and self._was_whole(pair, change):
                    yield _of_claim("otherwise", pair.claim, f"was printed as {self.editions.old.shown(old)} here")

    def _was_whole(self, pair: Pair, change: Change) -> bool:
        """Whether the changed lines had the label of a number, too: another place with the number is not its own."""
        if not pair.claim.beside or pair.old is None:
            return True
        words = {word for line in change.old for word in self.editions.old.of_line(line)}
        return not self.old.named[pair.old].isdisjoint(words)

    def _is_whole(self, pair: Pair, change: Change) -> bool:
        """Whether the lines have the label of a number now."""
        words = {word for line in change.new for word in self.editions.new.of_line(line)}
        return pair.new is not None and not self.new.named.get(pair.new, set()).isdisjoint(words)

    def _lost_one(self, pair: Pair, old: range, new: range) -> bool:
        """Whether a fact stood on these words of the old edition, and stands on none of those in their place."""
        return not borne_by(self.old, pair.old).isdisjoint(old) and borne_by(self.new, pair.new).isdisjoint(new)

    def _stands_anew(self, pair: Pair, come: set[int]) -> bool:
        """Whether a label stands right beside its number on a word that is new: it changed places with another."""
        if not pair.claim.beside or pair.new is None or self.new.named[pair.new].isdisjoint(come):
            return False
        return bool(self.new.sides_of(pair.new))

    def _is_passed_over(self, words: range) -> bool:
        """Whether the description says of these words that they are no fact, and means no others of the line."""
        text = self.editions.new
        line = text.line_of[words[0]]
        shown = text.shown(words)
        if any(" " in listed and self._lies_within(words, line, listed) for listed in self.new.no_facts.get(line, ())):
            return True
        kept = (word for word in text.of_line(line) if not self.editions.is_new(word))
        return shown in self.new.no_facts.get(line, ()) and shown not in {text.texts[word] for word in kept}

    def _lies_within(self, words: range, line: int, listed: str) -> bool:
        """Whether words are part of a row of numbers that is listed as a whole."""
        text = self.editions.new
        columns = {text.column_of[word] - 1 for word in words}
        at = text.line(line).find(listed)
        return at >= 0 and all(at <= column < at + len(listed) for column in columns)

    def _is_known_already(self, words: range, pairs: Iterable[Pair]) -> bool:
        """Whether one of these words bears only facts that stand elsewhere, too, where nothing changed."""
        for word in words:
            if self.editions.new.texts[word].isalnum():
                bearing = [pair for pair in pairs if word in borne_by(self.new, pair.new) and not pair.claim.optional]
                if all(self._stood_before(pair) for pair in bearing):
                    return True
        return False

    def _stood_before(self, pair: Pair) -> bool:
        if pair.old is None or pair.old in self.old.missed:
            return False
        return any(not self.editions.is_gone(word) for word in borne_by(self.old, pair.old))

    def _numbers(self, line: int, change: Change) -> Iterator[Reason]:
        """The new numbers of a line that no fact that cites it has."""
        tokens = self._new_tokens(line, change)
        unknown = [token.text for token, words in tokens if not self._is_known(token, words)]
        if unknown:
            yield self._unknown(unknown, line, "number")

    def _new_tokens(self, line: int, change: Change) -> Iterator[tuple[Token, range]]:
        for token in self.new.manual.tokens[line - 1]:
            words = self.new.words_of_token(token)
            if any(_is_new(word, change) for word in words):
                yield token, words

    def _is_known(self, token: Token, words: range) -> bool:
        line = self.editions.new.line(token.line)
        if is_reference(line, token.column) or self._opens_section(token):
            return True
        return self._is_passed_over(words) or (self.new.is_used(token) and self._fits(token, words))

    def _opens_section(self, token: Token) -> bool:
        """Whether a number is that of the section which its line opens: what stands in it is held by itself."""
        before = self.editions.new.line(token.line)[: token.column - 1]
        return token.line in self.headings and not before.strip(" #\t") and "." in token.text

    def _fits(self, token: Token, words: range) -> bool:
        """Whether what uses a number means all of it: 50 is not the 50 of 50,03, nor any number beside a frame."""
        bearing = [claim for claim in self.new.claims if not self.new.borne[claim].isdisjoint(words)]
        if not bearing or any(not self.new.named[claim].isdisjoint(words) for claim in bearing):
            return True
        numbers = {number for claim in bearing for number in (*claim.numbers, *claim.beside, *claim.between)}
        parts = {Fraction(int(part)) for part in _PARTS.split(token.text) if part.isdigit()}
        if len(_PARTS.split(token.text)) > 1:
            return parts <= numbers or not numbers.isdisjoint(_whole(token))
        digits = "".join(char for char in token.text.upper().removeprefix("0X") if char in "0123456789ABCDEF")
        in_frames = any(claim.fact == "bytes" and digits in claim.shown for claim in bearing)
        return in_frames or not numbers.isdisjoint(token.readings)

    def _signs(self, number: int, change: Change) -> Iterator[Reason]:
        """Numbers that got or lost a minus sign, where every fact that they bear has them otherwise."""
        olds, news = self.editions.old, self.editions.new
        for old, new in change.gaps:
            signed = [(word + 1, True) for word in new if news.is_minus(word)]
            signed += [(self.editions.there(word + 1), False) for word in old if olds.is_minus(word)]
            for word, has_sign in signed:
                bearing = [pair.claim for pair in self.holding.pairs(number) if word in borne_by(self.new, pair.new)]
                bearing = [claim for claim in bearing if claim.fact != "number"]  # of a code: [-01] is no minus one
                if bearing and all(("-" in claim.shown) != has_sign for claim in bearing):
                    with_or_without = "with" if has_sign else "without"
                    yield _of_claim("sign", bearing[0], f"is printed {with_or_without} a minus sign")

    def _names(self, line: int, change: Change, *, took_words: bool) -> Iterator[Reason]:
        """The new words of a line that the description does not have for what cites it."""
        manual, text = self.new.manual, self.editions.new
        subjects = self.subjects_at.get(line, {})
        if not subjects and not (manual.is_row(line) or line in self.headings):
            return
        in_numbers = {word for token in manual.tokens[line - 1] for word in self.new.words_of_token(token)}
        fresh = [word for word in text.of_line(line) if _is_new(word, change)]
        fresh = [word for word in fresh if not self._is_respelled(word, change)]
        fresh = [word for word in fresh if word not in in_numbers or is_title(text.texts[word])]
        if change.kind == "added" and not subjects and self._is_prose_section(change):
            return
        written = text.line(line)
        is_label = line in self.headings or took_words or self._has_new_numbers(line, change)
        words = [
            text.texts[word]
            for word in fresh
            if is_name(text.texts[word])
            and (is_label or is_code(text.texts[word]) or not is_prose(written, text.column_of[word]))
        ]
        listed = self.listed_words(line)
        unknown = [word for word in words if word not in listed and not self.words.has(word, subjects)]
        if unknown:
            yield self._unknown(unknown, line, "word")

    def _has_new_numbers(self, line: int, change: Change) -> bool:
        """Whether numbers came with the words: each may be one of a fact by chance."""
        tokens = (token for token, _ in self._new_tokens(line, change))
        before = self.editions.new.line(line)
        return any(not is_reference(before, token.column) for token in tokens)

    def _took_words(self, change: Change) -> bool:
        """Whether words went that a title, a label or another text of the description stood on."""
        gone = {word for old, _ in change.gaps for word in old}
        numbers = self.holding.changes_of(change.old)
        pairs = (pair for number in numbers for pair in self.holding.pairs(number))
        return any(pair.old and not self.old.named.get(pair.old, set()).isdisjoint(gone) for pair in pairs)

    def _is_prose_section(self, change: Change) -> bool:
        """Whether lines are headings and running text without numbers of their own."""
        lines = [line for line in change.new if line not in self.headings]
        numbers = any(self.new.manual.tokens[line - 1] for line in lines)
        return not numbers and not any(self.new.manual.is_row(line) for line in lines)

    def _is_respelled(self, word: int, change: Change) -> bool:
        """Whether a word is the one in whose place it stands, in another spelling or form."""
        olds, news = self.editions.old, self.editions.new
        return any(
            is_respelled(olds.texts[old[new.index(word)]], news.texts[word])
            for old, new in change.gaps
            if word in new and len(old) == len(new)
        )

    def _unknown(self, unknown: list[str], line: int, what: str) -> Reason:
        subjects = [*self.subjects_at.get(line, ())]
        shown = ", ".join(f"`{text}`" for text in dict.fromkeys(unknown[:_MOST]))
        more = " and more" if len(unknown) > _MOST else ""
        if not subjects:
            return Reason(what, f"nothing cites line {line}: {shown}{more}", words=tuple(unknown))
        said = f"no {what} of what cites line {line} is {shown}{more}"
        place = self.passed_over.get(line, "")
        if place:
            said += f"; looked_through has the line: {_way_out(unknown, what)}"
        return Reason(what, said, place or self.place_of.get(subjects[0], ""), words=tuple(unknown))

    def _units(self, number: int, change: Change) -> Iterator[Reason]:
        """Units that no longer stand in the lines."""
        olds, news = self.editions.old, self.editions.new
        gone = {olds.texts[word] for old, _ in change.gaps for word in old}
        stands = {news.texts[word] for line in change.new for word in news.of_line(line)}
        for subject in dict.fromkeys(pair.claim.subject for pair in self.holding.pairs(number)):
            unit, place = self.words.unit_of(subject)
            if gone.intersection(set(Words(unit).texts) - stands):
                yield Reason("unit", f": unit {unit} is not there", place, (subject,), (unit,))


def _way_out(texts: Iterable[str], what: str, names: Iterable[str] = ()) -> str:
    """What to write under `looked_through` where numbers or words (and names, once numbers are listed) are no facts."""
    lists = ((f"{what}s", texts), ("words", names))
    written = ", ".join(f"{key}: [{', '.join(dict.fromkeys(listed))}]" for key, listed in lists if listed)
    return f"add `{written}` there if no fact"


def _is_new(word: int, change: Change) -> bool:
    return any(word in new for _, new in change.gaps)


def _is_of_numbers(claim: Claim) -> bool:
    """Whether a claim needs the numbers, codes or bytes that bear it."""
    return not claim.optional and (bool(claim.numbers or claim.beside) or claim.anchor or claim.fact == "bytes")


def _whole(token: Token) -> frozenset[Fraction]:
    """What a number with points or commas means as a whole."""
    *_, fraction = _PARTS.split(token.text)
    digits = int("".join(_PARTS.split(token.text)))
    return frozenset((Fraction(digits, 10 ** len(fraction)), Fraction(digits))) & token.readings


def failing(claim: Claim) -> Reason:
    """The reason that a claim does not hold."""
    return _of_claim("missing", claim, "is not there")


def _of_claim(kind: str, claim: Claim, said: str) -> Reason:
    return Reason(kind, f": {claim.fact} {claim.shown} {said}", claim.where, (claim.subject,))
