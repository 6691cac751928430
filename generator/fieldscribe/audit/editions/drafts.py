"""What a new row of a table seems to be: its columns are those of the nearest described row of the same form."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from unicodedata import normalize

from fieldscribe.audit.citing import OWN_PRINTED
from fieldscribe.audit.editions.findings import Draft
from fieldscribe.records import dataclass, field

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from fieldscribe.audit.editions.explaining import Pair
    from fieldscribe.audit.editions.tracing import Trace
    from fieldscribe.audit.manual import Token
    from fieldscribe.resolve.points import Resolved
    from fieldscribe.resolve.subject import Subject

_FAR = 60
"""The row that tells the columns stands within so many lines."""
_STEP = re.compile(r"([0-9]+(?:[.,][0-9]+)?)\s*([^\W\d]\S*|[%\u00b0]\S*)?")
_ACCESS = {"r": "r", "ro": "r", "r/o": "r", "w": "w", "wo": "w", "r/w": "rw", "rw": "rw"}
_LATIN = str.maketrans({"\u00e4": "ae", "\u00f6": "oe", "\u00fc": "ue", "\u00df": "ss"})
_PLAIN = re.compile(r"[A-Za-z][\w -]*")


@dataclass(frozen=True, slots=True)
class Row:
    """A line of a table: its cells, and the numbers of each."""

    line: int
    cells: list[str]
    tokens: list[list[Token]]


@dataclass(slots=True)
class Model:
    """A described row: its point, and for each fact the cell and the number there that bear it."""

    row: Row
    resolved: Resolved
    place: str
    cell_of: dict[str, int] = field(default_factory=dict)
    tokens_of: dict[str, list[tuple[int, int]]] = field(default_factory=dict)


class Drafts:
    """Makes drafts of rows that only the new edition has."""

    def __init__(self, subject: Subject, new: Trace, pairs: Iterable[Pair]) -> None:
        self.scope, self.new, self.manual = subject.scope, new, new.manual
        self.language = next((document.language for document in subject.scope.documents.values()), "en")
        points = {resolved.point.item: resolved for resolved in subject.resolved}
        self.models: dict[int, Model] = {}
        for pair in pairs:
            if pair.new is not None and pair.claim.subject in points and not pair.new.cited[0][1]:
                self._learn(pair, points[pair.claim.subject])

    def _learn(self, pair: Pair, resolved: Resolved) -> None:
        """Note where on its row a claim stands."""
        assert pair.new is not None
        line = pair.new.cited[0][0]
        row = self._row(line)
        if row is None or pair.new not in self.new.borne:
            return
        model = self.models.setdefault(line, Model(row, resolved, pair.claim.where))
        if model.resolved is not resolved:
            return
        borne = self.new.borne[pair.new]
        for cell, tokens in enumerate(row.tokens):
            hits = [place for place, token in enumerate(tokens) if borne.intersection(self.new.words_of_token(token))]
            model.tokens_of.setdefault(pair.claim.fact, []).extend((cell, place) for place in hits)
            if hits:
                model.cell_of.setdefault(pair.claim.fact, cell)
        for cell, text in enumerate(row.cells):
            if any(word and word in text for word in pair.claim.words):
                model.cell_of.setdefault(pair.claim.fact, cell)

    def _row(self, line: int) -> Row | None:
        text = self.manual.line(line)
        if not self.manual.is_row(line):
            return None
        pieces = text.split("|")[1:-1] if text.startswith("|") else text.split("\t")
        start = 1 if text.startswith("|") else 0
        tokens: list[list[Token]] = []
        for piece in pieces:
            inside = range(start + 1, start + len(piece) + 1)
            tokens.append([token for token in self.manual.tokens[line - 1] if token.column in inside])
            start += len(piece) + 1
        return Row(line, [" ".join(piece.replace("<br>", " ").split()) for piece in pieces], tokens)

    def of(self, lines: Iterable[int]) -> Iterator[Draft]:
        """The drafts of new lines that are rows of a kind that the description knows, and not points of it already."""
        for line in (line for line in lines if line not in self.models):
            row = self._row(line)
            model = None if row is None else self._nearest(row)
            if row is not None and model is not None and (facts := self._facts(row, model)):
                yield Draft(line, "a point", model.place, "\n".join(facts))

    def _nearest(self, row: Row) -> Model | None:
        near = (model for line, model in self.models.items() if abs(line - row.line) <= _FAR)
        alike = [model for model in near if len(model.row.cells) == len(row.cells) and "address" in model.cell_of]
        return min(alike, key=lambda model: (abs(model.row.line - row.line), model.row.line), default=None)

    def _facts(self, row: Row, model: Model) -> list[str]:
        """The lines of the draft; none if the row has no address where its neighbour has one."""
        address = self._address(row, model)
        if address is None:
            return []
        title = self._cell(row, model, "title") or self._words(row, model)
        facts = [f"code: {_quoted(code)}"] if (code := self._cell(row, model, "code")) else []
        facts.append(f"name: {_name_of(title or code or f'point_{address}')}")
        if title:
            titles = dict.fromkeys(("en", self.language), _quoted(title))
            facts.append("title: {" + ", ".join(f"{language}: {text}" for language, text in titles.items()) + "}")
        facts.append(f"at: {address}")
        facts += self._access(row, model)
        facts += self._range(row, model)
        facts += self._unit(row, model)
        facts.append(f"line: {row.line}")
        facts += self._printed(row, model)
        return [f"{'-' if number == 0 else ' '} {fact}" for number, fact in enumerate(facts)]

    def _cell(self, row: Row, model: Model, fact: str) -> str:
        cell = self._cell_of(model, fact)
        return "" if cell is None else row.cells[cell]

    def _words(self, row: Row, model: Model) -> str:
        """The longest cell of words alone: no other says what the row is about."""
        taken = self._cell(row, model, "code")
        cells = [text for text, tokens in zip(row.cells, row.tokens, strict=True) if not tokens and text != taken]
        return max((text for text in cells if text.casefold() not in _ACCESS), key=len, default="")

    def _cell_of(self, model: Model, fact: str) -> int | None:
        """The cell of a fact in the model, or else in the nearest row that has it and as many cells."""
        alike = [other for other in self.models.values() if len(other.row.cells) == len(model.row.cells)]
        nearest = sorted(alike, key=lambda other: abs(other.row.line - model.row.line))
        return next((other.cell_of[fact] for other in nearest if fact in other.cell_of), None)

    def _address(self, row: Row, model: Model) -> str | None:
        """The address: the same number of the row, less what the neighbour's differs from its address."""
        address = model.resolved.point.address
        if address is None:
            return None
        pairs = [
            (model.row.tokens[cell][place], self._token(row, cell, place)) for cell, place in model.tokens_of["address"]
        ]
        for beside, token in pairs:
            if token is not None and address in beside.readings:
                return token.text
        for beside, token in pairs:
            if token is not None:
                apart = min((reading - address for reading in beside.readings), key=abs)
                return str(min(token.readings) - apart)
        return None

    @staticmethod
    def _token(row: Row, cell: int, place: int) -> Token | None:
        tokens = row.tokens[cell]
        return tokens[place] if place < len(tokens) else None

    def _access(self, row: Row, model: Model) -> list[str]:
        access = next((_ACCESS[cell.casefold()] for cell in row.cells if cell.casefold() in _ACCESS), None)
        usual = model.resolved.draft.group.get("access")
        return [f"access: {access}"] if access is not None and access != usual else []

    def _range(self, row: Row, model: Model) -> list[str]:
        for key, fact in (("range", "range"), ("range_in_units", "printed range_in_units"), ("range", "printed range")):
            cell = self._cell_of(model, fact)
            numbers = [] if cell is None else [token.text.replace(",", ".") for token in row.tokens[cell]]
            if len(numbers) == 2:
                return [f"{key}: {numbers[0]}..{numbers[1]}"]
            if len(numbers) > 2:
                return [f"{key}: {', '.join(numbers)}"]
        return []

    def _unit(self, row: Row, model: Model) -> list[str]:
        """The step and the unit, from the cell where the neighbour has them."""
        unit = str(model.resolved.draft.get("unit", ""))
        cells = [self._cell_of(model, fact) for fact in ("scale", "printed resolution")]
        cells += [
            cell for cell, text in enumerate(model.row.cells) if unit and re.search(rf"(?<!\w){re.escape(unit)}", text)
        ]
        for cell in (cell for cell in cells if cell is not None):
            match = _STEP.fullmatch(row.cells[cell])
            if match and match[2] and self.scope.unit(match[2]) is not None:
                step = match[1].replace(",", ".")
                return [*([] if step == "1" else [f"scale: value = raw * {step}"]), f"unit: {_quoted(match[2])}"]
        return []

    def _printed(self, row: Row, model: Model) -> list[str]:
        """What the row prints in each numbering."""
        printed: dict[str, list[str]] = {}
        for fact, places in model.tokens_of.items():
            key = fact.removeprefix("printed ")
            if key != fact and key not in OWN_PRINTED:
                texts = (self._token(row, *place) for place in dict.fromkeys(places))
                printed[key] = list(dict.fromkeys(token.text for token in texts if token is not None))
        shown = ", ".join(f"{key}: [{', '.join(texts)}]" for key, texts in printed.items() if texts)
        return [f"printed: {{{shown}}}"] if shown else []


def _name_of(title: str) -> str:
    """A name of small letters from a title."""
    folded = normalize("NFKD", title.casefold().translate(_LATIN))
    name = "_".join(re.findall("[a-z0-9]+", folded))[:60].strip("_")
    return name if name[:1].isalpha() else f"point_{name}"


def _quoted(text: str) -> str:
    if (
        _PLAIN.fullmatch(text)
        and text == text.strip()
        and text.casefold() not in ("yes", "no", "on", "off", "true", "false", "null")
    ):
        return text
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
