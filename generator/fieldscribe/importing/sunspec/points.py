"""The facts of points of SunSpec in a draft; facts that a description cannot express become questions at the point."""

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction

from fieldscribe.importing.cells import unit_in
from fieldscribe.importing.draft_text import DraftPoint, Names, scalar, snake
from fieldscribe.importing.sunspec.models import Point
from fieldscribe.wording.exact import number_text

_TYPES = {
    **{f"int{bits}": f"s{bits}" for bits in (16, 32, 64)},
    **{f"{name}{bits}": f"u{bits}" for name in ("uint", "enum", "bitfield", "raw") for bits in (16, 32, 64)},
    "float32": "f32",
    "float64": "f64",
    "count": "u16",
}
"""The types of descriptions for SunSpec types of plain numbers."""
_FORMATS = {
    "sunssf": "{type: s16, range: -%d..%d}",
    "acc16": "{type: u16, special: {0FFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
    "acc32": "{type: u32, special: {0FFFFFFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
    "acc64": "{type: u64, special: {0FFFFFFFFFFFFFFFFh: ~, 0: {name: not_accumulated, no_value: yes}}}",
}
"""Those that are more."""
MOST_EXPONENT = 10
"""The scale factors of SunSpec are exponents from -10 to 10."""
_NOT_IMPLEMENTED = {
    **{f"u{bits}": f"0{'F' * (bits // 4)}h" for bits in (16, 32, 64)},
    **{f"s{bits}": f"8{'0' * (bits // 4 - 1)}h" for bits in (16, 32, 64)},
    "f32": "7FC00000h",
    "f64": "7FF8000000000000h",
}
"""The raw numbers of points that a device does not implement, by type."""
_OF_TYPES = {
    **{
        kind: f"{{special: {{{code}: {{name: not_implemented, no_value: yes}}}}}}"
        for kind, code in _NOT_IMPLEMENTED.items()
    },
    "text": "{padding: 00h}",
}
"""The facts that all points of a type share."""
_BYTES = {"eui48": ("eui48", 4), "ipaddr": ("ipv4", 2), "ipv6addr": ("ipv6", 8)}
"""Types that are bytes: their notation, and the number of their words. Of an eui48 the first word is empty."""
_WORDS = {"16": 1, "32": 2, "64": 4}
_OTHER_UNITS = (
    "Secs=s Sec=s Tms=s Tmh=h Tmd=d mSecs=ms C=°C Pct=% Degrees=° deg=° Var=var Varh=varh AH=Ah kAH=kAh WH=Wh "
    "mps=m/s meters=m ohms=ohm HPa=hPa kO=kohm W/m2=W/m² W/m^2=W/m² Vm=V/m"
)
_UNITS = dict(pair.split("=") for pair in _OTHER_UNITS.split())
"""Units that SunSpec spells differently."""
_NO_UNITS = frozenset(("cos()", "PF", "SF", "text"))
_LONGEST_NOTE, _LONGEST_UNIT = 300, 20


class Facts:
    """States the facts of points, and shared facts; `exponents` bounds the magnitude of scale factors."""

    def __init__(self, exponents: int) -> None:
        self._units: dict[str, str] = {}
        self._formats = _FORMATS | {"sunssf": _FORMATS["sunssf"] % (exponents, exponents)}

    def state(self, point: Point, drafted: DraftPoint, scope: Mapping[str, DraftPoint]) -> None:
        """State the facts of a point."""
        facts, lost = drafted.facts, drafted.questions
        facts["access"] = "rw" if point.access == "RW" else "r"
        if point.type == "pad":
            facts["reserved"] = "yes"
            return
        if point.is_static:
            facts["changes"] = "never"
        note = f"{'Mandatory. ' if point.is_mandatory else ''}{point.text}".strip()
        if note:
            facts["note"] = note_of(note)
        _state_type(point, drafted)
        if point.factor is not None:
            _state_factor(point, drafted, scope)
        if len(point.unit) > _LONGEST_UNIT:
            lost.append(f"unit: {point.unit}")
        elif point.unit and point.unit not in _NO_UNITS:
            facts["unit"] = self._unit(point.unit)
        if point.symbols and point.type.startswith("bitfield"):
            facts["flags"] = _labels(point, "title: ")
        elif point.symbols and point.type.startswith("enum"):
            facts["enum"] = _labels(point, "en: ")
        elif point.symbols:
            lost.append(f"symbols of a {point.type}: {', '.join(symbol.name for symbol in point.symbols)}")

    def _unit(self, text: str) -> str:
        """Return the symbol of a unit; one that is not shipped is declared in the head."""
        text = _UNITS.get(text, text)
        known = unit_in(text)
        return scalar(known) if known else self._units.setdefault(text, scalar(text))

    def shared(self, points: Iterable[DraftPoint]) -> Iterator[str]:
        """Yield shared facts as lines of the head: facts of types, formats, and units that are not shipped."""
        stated = [point.facts for point in points]
        formats = {each["format"] for each in stated if "format" in each}
        types = {each.get("type") for each in stated} | {_FORMATS[name][7:10] for name in formats}
        if types & _OF_TYPES.keys():
            yield from ("types:", *(f"  {kind}: {fact}" for kind, fact in _OF_TYPES.items() if kind in types))
        if formats:
            yield from ("formats:", *(f"  {name}: {self._formats[name]}" for name in sorted(formats)))
        if self._units:
            yield "units:"
            yield from (f"  {unit}: {{name: {unit}, quantity: as SunSpec has it}}" for unit in self._units.values())


def empty_words(point: Point) -> int:
    """Return how many words precede the contents of a point."""
    return int(point.type == "eui48" and point.size == _BYTES["eui48"][1])


def _state_type(point: Point, drafted: DraftPoint) -> None:
    facts = drafted.facts
    kind = _TYPES.get(point.type)
    if kind and _WORDS[kind[1:]] == point.size:
        facts["type"] = kind
    elif point.type in _FORMATS and _WORDS.get(point.type[3:], 1) == point.size:
        facts["format"] = point.type
    elif point.type == "string":
        facts |= {"type": "text", "characters": str(point.size * 2)}
    elif point.type in _BYTES and _BYTES[point.type][1] == point.size:
        facts |= {"type": "bytes", "notation": _BYTES[point.type][0]}
    else:
        facts |= {"type": "~", "length": str(point.size)}
        drafted.questions.append(f"type {point.type}: {point.size} words")


def _state_factor(point: Point, drafted: DraftPoint, scope: Mapping[str, DraftPoint]) -> None:
    """State the scale: by a point that holds an exponent of 10, or by the exponent itself."""
    factor = point.factor
    if isinstance(factor, int) and abs(factor) <= MOST_EXPONENT:
        drafted.facts["scale"] = f"value = raw * {number_text(Fraction(10) ** factor)}"
    elif isinstance(factor, str) and factor in scope:
        drafted.facts["scale"] = f"value = raw * 10 ** {scope[factor].name}"
    else:
        drafted.facts["scale"] = "~"
        drafted.questions.append(f"scale factor: {factor}")


def _labels(point: Point, key: str) -> str:
    """Return the symbols of a point as the block of its enum or flags."""
    names = Names()
    lines = []
    for symbol in point.symbols:
        name = names.give(snake(symbol.name, "number"), str(symbol.number))
        title = symbol.text or symbol.name.replace("_", " ").capitalize()
        lines.append(f"\n  {symbol.number}: {{name: {scalar(name)}, {key}{scalar(title)}}}")
    return "".join(lines)


def note_of(text: str) -> str:
    """Return a note as YAML, cut off if it is long."""
    return scalar(text if len(text) <= _LONGEST_NOTE else f"{text[:_LONGEST_NOTE]} …")
