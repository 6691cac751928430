"""Items for the contents of a frame: consecutive addresses, elements and words of parameters."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from fieldscribe.arithmetic.words import raw_of, reader_of, split
from fieldscribe.conversation.decode_state import (
    PARAMETER,
    DecodeState,
    Plan,
    PointPlace,
    Read,
    Step,
    named_item,
    without_variants,
)
from fieldscribe.conversation.point_items import Base
from fieldscribe.conversation.selection import absence, base_options
from fieldscribe.families import family
from fieldscribe.families.decoded_frame import AddressSpan, Element, Word
from fieldscribe.families.frame_results import Item
from fieldscribe.model import Command, Place, Point
from fieldscribe.text import counted, line
from fieldscribe.wording import address_text, fixed_text, title_text
from fieldscribe.wording.numbers import element_text, hex_text, hex_words, span_text, word_text

_MOST_WORDS = 16
"""The most words without a point that are printed."""


def span_items(state: DecodeState, span: AddressSpan) -> list[Item]:
    """Return the items of consecutive addresses; neighbours without a point are one item."""
    is_whole = span.learned and not span.written and len(span.words or ()) >= span.count
    if is_whole and not state.directory.has_selections:
        return _items_read(state, span)
    here = _SpanItems(state, span)
    if step := here.step_item():
        return [step]
    items: list[Item] = []
    unknown: list[int] = []
    for at in here.addresses:
        items_here = here.items_at(at)
        if items_here is None:
            unknown.append(at)
            continue
        items += here.unknown_items(unknown)
        unknown = []
        items += items_here
    return items + here.unknown_items(unknown)


def _items_read(state: DecodeState, span: AddressSpan) -> list[Item]:
    """Return the items of a span whose values came from the device; the plan for its addresses is made once."""
    place = span.space, span.address, span.count
    plan = state.plans.get(place) or state.planned(place, _plan(state, span))
    words, here, items = span.words or (), None, list[Item]()
    plan.teach(state, words)
    for formatter, read, at in plan.steps:
        if formatter is not None:
            items.append(formatter.item(read(words), state.settings))
        else:
            here = here or _SpanItems(state, span, taught=False)
            items += (here.items_at(at[0]) if len(at) == 1 else None) or here.unknown_items(at)
    return items


def _plan(state: DecodeState, span: AddressSpan) -> Plan:
    """Return the plan of a span; a step without a formatter has one address or several without a point."""
    here, directory = _SpanItems(state, span, taught=False), state.directory
    taught, steps, unknown = list[tuple[Point, Read]](), list[Step](), list[int]()
    for at in here.addresses:
        places = directory.places(span.space, at)
        if unknown and places:
            steps.append((None, len, tuple(unknown)))
            unknown.clear()
        if not places:
            unknown.append(at)
        beginning = [(point, place) for point, place in places if at == here.inside(place)[0]]
        whole = [(point, place) for point, place in beginning if here.is_whole(point, place)]
        reads = [reader_of(point, [address - span.address for address in place.addresses]) for point, place in whole]
        taught += [(point, read) for (point, _), read in zip(whole, reads, strict=True) if directory.teaches(point)]
        if len(whole) < len(beginning):
            steps.append((None, len, (at,)))
            continue
        for (point, place), read in zip(whole, reads, strict=True):
            steps.append((state.formatter(point, (span.space, at, len(place.addresses))), read, ()))
    return Plan(taught, steps + ([(None, len, tuple(unknown))] if unknown else []))


class _SpanItems:
    """Builds the items of one span; its points are settings for each other."""

    def __init__(self, state: DecodeState, span: AddressSpan, *, taught: bool = True) -> None:
        """`taught`: the settings that points of the span give each other are not yet known."""
        self._state, self._device, self._directory = state, state.device, state.directory
        self._space, self._start, self._written = span.space, span.address, span.written
        self._words = (span.words or ())[: span.count]
        self.addresses = range(span.address, span.address + span.count)
        self._carried = self.addresses[: len(self._words)]
        raws = [
            (point, self._raw(point, place))
            for at in (self._carried if taught else ())
            for point, place in self._places(at)
            if at == place.addresses[0] and self.is_whole(point, place) and self._directory.teaches(point)
        ]
        if raws:
            # the points of one frame are settings for each other; these are not kept
            self._state = state if span.learned else replace(state, settings=dict(state.settings), changed=set())
            self._state.learn(raws)

    def _places(self, at: int) -> list[PointPlace]:
        """Return the points at an address, without those that known selecting points exclude."""
        places, held = self._directory.places(self._space, at), self._state.settings
        if not self._directory.has_selections:
            return places
        return [one for one in places if all(held.get(name, raw) == raw for name, raw in one[0].selects)]

    def items_at(self, at: int) -> list[Item] | None:
        """Return the items that begin at an address of the span; None if nothing has this address."""
        places = self._places(at)
        items = [self._point(point, place) for point, place in places if at == self.inside(place)[0]]
        commands = self._commands(at)
        return [*items, *commands] if places or commands else None

    def step_item(self) -> Item | None:
        """Return the item of a step of a command that writes exactly these words, if no point has them."""
        if not self._written or any(map(self._places, self.addresses)):
            return None
        here = self._space, self._start, len(self._words), None
        for command in self._device.stepped_commands:
            for number, step in enumerate(command.steps, 1):
                is_here = step.write is not None and (step.space, step.address, len(step.words), step.base) == here
                given = step.arguments_in(self._words, command.arguments) if is_here else None
                if given is not None:
                    numbers = "".join(f"; {name} = {value}" for name, value in given.items())
                    subject = f"command {command.name}, step {number}"
                    text = line(f"{subject}: {title_text(command.title)}{numbers}")
                    return Item(self._space, self._start, len(self._words), text, subject=subject)
        return None

    def unknown_items(self, addresses: Sequence[int]) -> list[Item]:
        """Return the item of neighbouring addresses without a point, with their words; none for no address."""
        if not addresses:
            return []
        low, high = addresses[0], addresses[-1]
        gaps = self._device.bus.gaps.get(self._space, ())
        gap = next((gap for gap in gaps if gap[0] <= high and low <= gap[1]), None)
        unplaced = base_options(self._device.bases)
        hint = f"; other points count from a base: {unplaced}" if unplaced else ""
        closed = "" if gap is None else f"the manual closes {hex_text(gap[0])} to {hex_text(gap[1])}"
        subject = span_text(low, high)
        text = f"{subject}: no point is described here{hint}" + (f"; {closed}" if closed else "")
        if words := self._words[low - self._start : high + 1 - self._start]:
            form = "{:04X}h" if family(self._device.family).spaces[self._space] == "word" else "{}"
            more = " ..." if len(words) > _MOST_WORDS else ""
            text += f" (carries {' '.join(map(form.format, words[:_MOST_WORDS]))}{more})"
        findings = (closed,) if closed else ()
        return [Item(self._space, low, len(addresses), text, findings=findings, subject=subject)]

    def inside(self, place: Place) -> list[int]:
        """Return the addresses of a place in the span, in their order on the wire."""
        return sorted(at for at in place.addresses if at in self.addresses)

    def _is_place(self, point: Point, place: Place) -> bool:
        """Return True if the point is read here, or written here, whichever the frame does."""
        return place is (point.written if self._written else point.place)

    def is_whole(self, point: Point, place: Place) -> bool:
        return self._is_place(point, place) and all(at in self._carried for at in place.addresses)

    def _raw(self, point: Point, place: Place) -> int:
        return raw_of(point, [self._words[at - self._start] for at in place.addresses])

    def _point(self, point: Point, place: Place) -> Item:
        inside = self.inside(place)
        base = (self._space, inside[0], len(inside))
        if not self._is_place(point, place):
            right = point.written if self._written else point.place
            verb = "written" if self._written else "read"
            return named_item(point, base, finding=f"it is {verb} at {address_text(min(right.addresses))}")
        if self.is_whole(point, place):
            return self._state.value(point, base, self._raw(point, place), written=self._written)
        finding = "" if self._carried and not self._written else absence(self._device, point)
        text = ""
        if len(inside) != len(place.addresses):
            words = {at: f" = {self._words[at - self._start]:04X}h" for at in inside if at in self._carried}
            named = [word_text(place.addresses, at) + words.get(at, "") for at in place.addresses if at in inside]
            text = f"only the {', '.join(named)}"
        return named_item(point, base, text, finding=finding)

    def _commands(self, at: int) -> list[Item]:
        """Return the command that is written here; of several, the one with this value."""
        raw = self._words[at - self._start] if at in self._carried else None
        commands = self._device.commands if self._written else ()
        here = [command for command in commands if (command.space, command.address) == (self._space, at)]
        return [self._command(min(here, key=lambda command: command.value != raw), raw)] if here else []

    def _command(self, command: Command, raw: int | None) -> Item:
        wrong = command.value is not None and raw is not None and raw != command.value
        finding = f"it takes {command.value}, here is {raw}" if wrong else ""
        worn = f"the memory is rated for {command.wears} writes" if command.wears else ""
        subject, findings = f"command {command.name}", (finding,) if finding else ()
        parts = [f"{subject}: {title_text(command.title)}", finding, worn]
        text = line("; ".join(part for part in parts if part))
        return Item(self._space, command.address, 1, text, raw=raw, findings=findings, subject=subject)


def element_items(state: DecodeState, element: Element) -> Iterator[Item]:
    """Return the items of one element of a parameter."""
    points = state.directory.at(PARAMETER, element.parameter, element.index)
    base = (PARAMETER, element.parameter, max(1, element.width))
    carried = f"carries {hex_words(element.words)}"
    if element.refused:
        yield from (named_item(point, (PARAMETER, element.parameter, point.words)) for point in points)
    elif not points:
        text = element_text(element.parameter, element.index, alone=True)
        remark = f" ({carried})" if element.width or not element.in_request else ""
        yield Item(*base, f"{text}: no point is described here{remark}", subject=text)
    elif not element.in_request and (element.width == 0 or element.counts):
        text = f"{element.value} elements" if element.counts else carried
        yield from (named_item(point, base, text) for point in points)
    else:
        for point in without_variants(points, limits=element.in_request):
            yield _element_item(state, element, point, base, carried)


def _element_item(state: DecodeState, element: Element, point: Point, base: Base, carried: str) -> Item:
    if element.value is None:
        return named_item(point, base, finding=absence(state.device, point) if element.in_request else "")
    if not point.generated:
        return named_item(point, base, f"{carried}; {point.reason or 'its meaning is open'}")
    if element.width != point.words:
        return named_item(point, base, carried, finding=_width_finding(point, element))
    raw = raw_of(point, split(element.value, element.width))
    if not element.in_request:
        state.learn([(point, raw)])
    return state.value(point, base, raw, written=element.in_request)


def _width_finding(point: Point, element: Element) -> str:
    """Return the finding that a value has another number of words than the parameter."""
    words = "a double word" if point.words == 2 else counted(point.words, "word")
    text = f"the parameter is {words}, the {'task' if element.in_request else 'response'} carries {element.width}"
    return f"{text}; a device answers with a wrong data type" if element.in_request else text


def word_items(state: DecodeState, word: Word) -> Iterator[Item]:
    """Return the items of one word of a parameter."""
    points = state.directory.at(PARAMETER, word.address)
    if word.learned and word.raw is not None and points:
        state.words[word.address] = word.raw
    if word.stale:
        state.forget(word.address)
    if word.learned:
        state.learn((point, raw) for point in points if (raw := _raw(point, state.words)) is not None)
    for point in without_variants(points, limits=word.in_request):
        yield _word_item(state, word, point)
    if not points:
        carried = "" if word.raw is None else f" ({hex_words((word.raw,))})"
        subject = address_text(word.address)
        yield Item(PARAMETER, word.address, 1, f"{subject}: no point is described here{carried}", subject=subject)


def _raw(point: Point, words: dict[int, int]) -> int | None:
    """Return the number of a point; None while some of its words are unknown."""
    known = [words[at] for at in point.addresses if at in words]
    return raw_of(point, known) if len(known) == len(point.addresses) else None


def _word_item(state: DecodeState, word: Word, point: Point) -> Item:
    base = (PARAMETER, word.address, 1)
    if word.raw is None:
        return named_item(point, base, finding=absence(state.device, point))
    if len(point.addresses) == 1:
        item = state.value(point, base, raw_of(point, (word.raw,)), written=word.in_request)
        finding = _fixed_finding(point, word.raw) if word.in_request else ""
        if not finding:
            return item
        return item.but(statement=f"{item.summary}; {finding}", findings=(*item.findings, finding))
    words = {**state.words, word.address: word.raw}
    part = f"word {point.addresses.index(word.address) + 1} of {len(point.addresses)} = {hex_words((word.raw,))}"
    raw = _raw(point, words)
    if raw is None:
        return named_item(point, base, f"{part}; {sum(at not in words for at in point.addresses)} more words to come")
    item = state.value(point, base, raw)
    return item.but(statement=f"{item.summary}; here {part}")


def _fixed_finding(point: Point, word: int) -> str:
    """Return a finding if a written word lacks the constant bits beside a bit group."""
    if point.bits is None or point.fixed is None or word & point.fixed.mask == point.fixed.bits:
        return ""
    return f"the word breaks what is always written: {fixed_text(point)}"
