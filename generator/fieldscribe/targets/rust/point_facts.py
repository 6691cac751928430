"""The facts of a point for the runtime's macro: reading and writing it, its limits, its special codes."""

from collections.abc import Iterator

from fieldscribe.model import Bound, Limit, Point, Special
from fieldscribe.targets.rust import literals
from fieldscribe.targets.rust.layout import Item, Lines, binding, calls, filled, sentence
from fieldscribe.targets.rust.scope import Constant, CratePoint, CrateScope
from fieldscribe.targets.rust.value_forms import count_type, interval, limit_lines
from fieldscribe.text import rust_string

_WRITES = {"coil": (5, 15), "holding": (6, 16)}
_BLOCK_WIDTH = 112
_WIDTH = 100


def read_lines(subject: CratePoint) -> Lines:
    """Return the facts of reading."""
    count = count_type(subject)
    facts: list[Lines] = [(f"count {count};",)] if count else []
    facts += [(f"with {subject.factors_type};",)] if subject.point.scale_arguments else []
    return _block("read", facts)


def write_lines(subject: CratePoint, scope: CrateScope) -> Lines:
    """Return the facts of writing."""
    point, count = subject.point, count_type(subject)
    facts: list[Lines] = [(f"count {count};",)] if count else []
    facts += [(f"with with::{subject.name};",)] if point.arguments else []
    facts += [("closed true;",)] if subject.enum is not None and subject.enum.closed else []
    facts += [*_allowed(subject, scope), *_write_place(point, scope)]
    return _block("write", facts if point.encodes_values else [*facts, ("values none;",)])


def _block(name: str, facts: list[Lines]) -> Lines:
    """Return facts in one line if they fit, else each in lines of its own."""
    lines = [line for fact in facts for line in fact]
    whole = f"{name} {{ {' '.join(lines)} }}" if facts else f"{name} {{}}"
    if len(whole) <= _BLOCK_WIDTH and len(lines) == len(facts):
        return (whole,)
    return (f"{name} {{", *(f"    {line}" for line in lines), "}")


def _allowed(subject: CratePoint, scope: CrateScope) -> Iterator[Lines]:
    """Yield the facts about allowed numbers, unless the outer limits are enough."""
    point = subject.point
    if point.limit_arguments:
        yield tuple(_limits(point, scope))
    elif point.form == "float":
        if ranges := _float_ranges(point):
            yield filled("ranges [", ", ", ranges, "];")
    elif point.text is not None and point.text.is_bytes:
        yield ("check runtime::form::packed::any::<Self>;",)
    elif point.form == "text" and point.text is not None and point.text.encoding == "ascii":
        yield (f"check runtime::form::{'text' if point.text.is_plain else 'packed'}::ascii::<Self>;",)
    elif point.form == "digits" and point.digits is not None:
        yield (f"check runtime::form::digits::check::<Self, {point.digits.count}>;",)
    elif point.form != "text" and len(spans := point.allowed.fixed) > 1:
        yield filled("in [", " | ", [interval(*limits) for limits in spans], "];")


def _limits(point: Point, scope: CrateScope) -> Iterator[str]:
    """Yield the fact with a pair of ends for each range; some ends depend on other points."""
    yield "limits |with| ["
    for allowed in point.allowed.intervals:
        low, high = _end(allowed.low, scope, lower=True), _end(allowed.high, scope, lower=False)
        line = f"    ({low[0]}, {high[0]}),"
        if len(low) + len(high) == 2 and len(line) <= _BLOCK_WIDTH:
            yield line
        else:
            yield "    ("
            for end in (low, high):
                yield from (f"        {line}" for line in (*end[:-1], f"{end[-1]},"))
            yield "    ),"
    yield "];"


def _end(bound: Bound, scope: CrateScope, *, lower: bool) -> tuple[str, ...]:
    return limit_lines(bound, scope.lowered, lower=lower) if isinstance(bound, Limit) else (literals.integer(bound),)


def _float_ranges(point: Point) -> list[str]:
    """Return the limits as numbers of the type; empty if they are the type's own limits."""
    greatest = literals.FLOAT_GREATEST[point.width]
    ends = [[literals.nearest_float(float(end), point.width) for end in pair] for pair in point.allowed.units]
    if ends == [[-greatest, greatest]]:
        return []
    return [f"({literals.float_literal(low)}, {literals.float_literal(high)})" for low, high in ends]


def _write_place(point: Point, scope: CrateScope) -> Iterator[Lines]:
    """Yield the function and the address for writing, unless they are the usual ones."""
    single, many = _WRITES.get(point.space, (0, 0))
    usual = single if point.words == 1 else many
    if usual not in scope.functions and many in scope.functions:
        yield (f"function {many};",)


def shared_codes(scope: CrateScope) -> Iterator[dict[str, object]]:
    """Yield the codes that points share, by first point: a type with a constant for each code and a table of all."""
    first: dict[str, CratePoint] = {}
    for subject in scope.subjects:
        if subject.point.shared_codes:
            first.setdefault(subject.point.shared_codes, subject)
    for of, subject in first.items():
        item = Item("pub const CODES", f"&'static [runtime::Code<{subject.raw}>]")
        constants, table = tuple(code_constants(subject)), _table(subject, item)
        yield {"name": literals.type_name(of), "of": of, "constants": constants, "table": table}


def code_lines(subject: CratePoint) -> Iterator[str]:
    """Yield the fact about the codes of a point, its own or shared ones."""
    shared = subject.point.shared_codes
    if shared:
        yield f"codes (special::{literals.type_name(shared)}::CODES);"
    elif subject.point.specials:
        yield "codes {"
        for special in subject.point.specials:
            name, about = special.name.upper(), special.name
            ends = _literal(special.low, special, subject.raw)
            if special.low != special.high:
                name, about = f"{name} {name}_LAST", f"{about}, the first of a band"
                ends += f"..={_literal(special.high, special, subject.raw)}"
            yield f"    /// {sentence(about)}"
            yield f"    {name} = {_kind(special)}({rust_string(special.name)}, {ends});"
        yield "};"


def _kind(special: Special) -> str:
    """Return the runtime's constructor for the kind of code."""
    words = (word for word, holds in (("writable", special.writable), ("no_value", special.no_value)) if holds)
    return "_".join(words) or "new"


def code_constants(subject: CratePoint) -> Iterator[Constant]:
    """Yield a constant for each code; of a band, its first code and the last raw number."""
    for special in subject.point.specials:
        item = Item(f"pub const {special.name.upper()}", f"runtime::Special<{subject.raw}>")
        call = f"{_kind(special)}({rust_string(special.name)}, {_literal(special.low, special, subject.raw)})"
        lines = _constant(item, f"runtime::Special::{call}")
        if special.low != special.high:
            last_item = Item(f"pub const {special.name.upper()}_LAST", subject.raw)
            last = binding(4, last_item, _literal(special.high, special, subject.raw))
            yield sentence(f"{special.name}, the first of a band"), lines
            yield sentence(f"the last raw number of {special.name}"), last
        else:
            yield sentence(special.name), lines


def _table(subject: CratePoint, item: Item) -> Lines:
    items: list[tuple[str, Lines]] = []
    for special in subject.point.specials:
        name = f"Self::{special.name.upper()}"
        band = ("runtime::Code::band", (name, f"{name}_LAST"))
        items.append(("runtime::Code::one", (name,)) if special.low == special.high else band)
    return calls(4, item, items)


def _constant(item: Item, call: str) -> Lines:
    """Return the lines of a constant as rustfmt breaks them; with `rustfmt::skip` if the name itself is too long."""
    lines = binding(4, item, call)
    if all(4 + len(line) <= _WIDTH for line in (*lines, f"{item} =")):
        return lines
    return "#[rustfmt::skip] // its name is longer than a line", f"{item} = {call};"


def _literal(raw: int, special: Special, rust_type: str) -> str:
    return literals.mask(raw, rust_type) if special.hexadecimal and raw >= 0 else literals.raw_literal(raw, rust_type)
