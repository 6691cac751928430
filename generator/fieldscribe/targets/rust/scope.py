"""What the modules of this target share: the generated points of a device, and what a family adds to its crate.

A family offers a `RustFamily`: items of the crate other than points, how points travel on its bus, and tables of the
conformance program. Facts of a shape are computed once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from fieldscribe.families import family
from fieldscribe.lowered import Lowered, lower
from fieldscribe.model import Code, Device, Enum, Message, Point, Telegram
from fieldscribe.targets.identifiers import Names
from fieldscribe.targets.rust.layout import Item, Lines, arm, binding, filled, sentence
from fieldscribe.targets.rust.literals import device_type, integer, raw_type, type_name
from fieldscribe.text import rust_string


class CratePoint(NamedTuple):
    """A generated point: its name in the description and in Rust, and the type of its raw number.

    `carried` is the raw type of its enum: wider than its own if points of several types share the enum. `key` is its
    template key.
    """

    point: Point
    item: str
    name: str
    raw: str
    carried: str
    key: int

    def renamed(self, item: str, name: str) -> CratePoint:
        """Return the point with placeholders for its names; one with a computed scale keeps them, for its structs."""
        return self if self.point.scale_arguments else self._replace(item=item, name=name)

    @property
    def enum(self) -> Enum | None:
        """The enum of its values, or of its digits."""
        return self.point.named_numbers

    @property
    def factors_name(self) -> str:
        """The name of the scale's struct if it differs from that for writing, else empty."""
        needs = self.point.scale_arguments
        return f"{self.name.rstrip('_')}Factors" if needs and needs != self.point.arguments else ""

    @property
    def factors_struct(self) -> str:
        """The name of the struct of all raw numbers that the scale needs."""
        return self.factors_name or self.name

    @property
    def factors_type(self) -> str:
        """The type of the struct of all raw numbers that the scale needs."""
        return f"with::{self.factors_struct}" if self.point.scale_arguments else "()"


class CrateScope(NamedTuple):
    """The state that the points of a device share: the lowered model, the raw types of enums by name, functions.

    `device_type` is the type of the device. The telegrams are by name, with the messages that carry them.
    """

    lowered: Lowered
    enums: Mapping[str, str]
    functions: frozenset[int]
    subjects: tuple[CratePoint, ...]
    family: str
    device_type: str
    telegrams: Mapping[str, tuple[Telegram, Message | None]]


def scope_of(device: Device) -> CrateScope:
    """Return the scope of a device, with its generated points."""
    generated = [point for point in device.points if point.generated]
    enums = _enum_types(generated)
    messages = {message.name: message for message in device.messages}
    lowered = lower(device)
    keys = lowered.template_keys
    subjects = [
        CratePoint(point, item := point.item, type_name(item), *_types_of(point, enums), keys[id(point)])
        for point in generated
    ]
    return CrateScope(
        lowered,
        enums,
        frozenset(code.number for code in device.bus.functions),
        tuple(subjects),
        device.family,
        device_type(device.id),
        {telegram.name: (telegram, messages.get(telegram.message or "")) for telegram in device.telegrams},
    )


def _enum_types(points: Iterable[Point]) -> dict[str, str]:
    """Return the raw type of each enum: that of its points, or one that holds the numbers of all."""
    enums: dict[str, str] = {}
    for point in points:
        enum, raw = point.named_numbers, raw_type(point.shape)
        if enum is not None:
            known = enums.setdefault(enum.name, raw)
            if known != raw:
                enums[enum.name] = "i128" if "u64" in (known, raw) else "i64"
    return enums


def _types_of(point: Point, enums: Mapping[str, str]) -> tuple[str, str]:
    """Return the type of raw numbers, and that of the enum of the values."""
    enum, raw = point.named_numbers, raw_type(point.shape)
    return raw, raw if enum is None else enums[enum.name]


# What a family adds.


Tokens = tuple[str, ...]
"""The tokens of a row; a line may be broken between them."""

Needs = tuple[tuple[str, Tokens], ...]
"""Structs and their fields."""

Way = tuple[str, str, Needs]
"""How a point travels: the kind of vector, the function of the runner, and its arguments."""

END = ";\n"
"""The separator of the rows of a table; no row contains it."""


@dataclass(frozen=True, slots=True)
class Snippet:
    """Lines of an example, and the items of the crate that they need in addition to those of every example."""

    lines: Lines = ()
    names: frozenset[str] = frozenset()

    def __add__(self, other: Snippet) -> Snippet:
        return Snippet(self.lines + other.lines, self.names | other.names)


class Table(NamedTuple):
    """A table of the conformance program: its function, the runner's function that it calls, its rows, and their kind.

    It answers the vectors of that kind.
    """

    name: str
    run: str
    rows: Sequence[str]
    kind: str

    @property
    def text(self) -> str:
        """The rows, each with its semicolon."""
        return f"{END.join(self.rows)}{END}"


def row_text(row: Tokens) -> str:
    """Return a row in as few lines as possible, without its semicolon."""
    return "    " + "\n    ".join(filled("", " ", row, ";"))[:-1]


def nothing(*_: object) -> tuple[()]:
    """Return an empty tuple, for families that have nothing to add."""
    return ()


class RustFamily(NamedTuple):
    """The object `IN_RUST` of the part `targets.rust` of a family.

    `context` is the context of the template `<family>.rs.j2`. `traits` are the lines by which a point implements the
    traits of its bus. `identifiers` are those of the family's own items. The conformance program gets further `ways` to
    read and write a point, further `kinds` of vectors of its points, tables of frames, and `refusals`, the kind of
    vectors for the codes of refusals. The first page of a crate imports these `names`; `telegram` is the telegram to
    which it listens, as a type, and the lines that use points of it. The crate passes these `transports` on, features
    of the runtime; its first program talks over the `line` of a device (none: it has none), and imports `line_names` of
    the runtime. `client_parameter` is the name, the default and the trait of a parameter of its clients beside the
    transport.
    """

    context: Callable[[Device], Mapping[str, object]]
    traits: Callable[[CratePoint, CrateScope], Iterable[str]] = nothing
    identifiers: Callable[[Device], Iterable[Names]] = nothing
    ways: Callable[[CratePoint, CrateScope], Iterable[Way]] = nothing
    kinds: Callable[[CratePoint, CrateScope], Iterable[str]] = nothing
    tables_of_frames: Callable[[Device], Iterable[Table]] = nothing
    refusals: str = "code"
    names: tuple[str, ...] = ()
    transports: tuple[str, ...] = ()
    line: Callable[[Device], str] = lambda _: ""
    line_names: str = ""
    client_parameter: tuple[str, str, str] | None = None
    telegram: Callable[[CrateScope], tuple[str, Snippet]] = lambda _: ("", Snippet())


def in_rust(name: str) -> RustFamily:
    """Return the part `targets.rust` of the family of that name."""
    part: RustFamily = family(name).part("targets.rust").IN_RUST
    return part


_SPACES = frozenset({"coil", "discrete", "input", "holding", "parameter", "telegram"})
"""The spaces that the runtime names."""


def space_variant(name: str) -> str:
    """Return the name of a space in the runtime's enum."""
    return name.capitalize() if name in _SPACES else f"Other({rust_string(name)})"


def space(name: str) -> str:
    """Return a space as a value of the runtime's enum."""
    return f"runtime::Space::{space_variant(name)}"


Constant = tuple[str, tuple[str, ...]]
"""The doc comment of a constant, and its lines."""


def constants(codes: Iterable[Code], type_: str, what: str = "") -> tuple[Constant, ...]:
    """Return a constant of that type for each code; `what` is the word for its number in the doc comment."""
    return tuple(
        (
            f"{sentence(code.name).rstrip('.')}: {what} {code.number}." if what else sentence(code.name),
            binding(4, Item(f"pub const {code.name.upper()}", type_), integer(code.number)),
        )
        for code in codes
    )


def code_names(codes: Iterable[Code]) -> tuple[str, ...]:
    """Return the match arms from codes to their names, each code once."""
    named = {code.number: code.name for code in reversed(tuple(codes))}
    arms = (arm(12, name.upper(), f"Some({rust_string(name)})") for _, name in sorted(named.items()))
    return tuple(line for lines in arms for line in lines)
