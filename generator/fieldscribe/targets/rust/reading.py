"""How a point is decoded."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fieldscribe.targets.rust.literals import integer, type_name
from fieldscribe.targets.rust.rules import count_path, decode_float
from fieldscribe.targets.rust.views import ReadView

if TYPE_CHECKING:
    from fieldscribe.targets.rust.subjects import Subject

_FUNCTIONS = {"coil": 1, "discrete": 2, "holding": 3, "input": 4}
_COUNTS = {"i32": "i64", "u32": "i64", "i64": "i64", "u64": "i128"}


def plain_count(raw: str) -> str:
    """The integer that holds any raw number of a point without a scale, and numbers beyond."""
    return _COUNTS.get(raw, "i32")


def parameter(type_: str, name: str, *, used: bool) -> str:
    """The last parameter of a function: what the point needs from others."""
    return "(): ()" if type_ == "()" else f"{'with' if used else '_'}: Self::{name}"


def read_view(subject: Subject, low: int, high: int) -> ReadView:
    """Decoding of a point whose raw numbers are written within `low..=high`."""
    point, raw, form, rule = subject.point, subject.raw, subject.form, subject.rule
    failing = narrows = False
    count_type, scaled, count = "", "", ""
    if form == "float":
        value = f"f64::from(f{point.width}::from_bits(raw))" if raw == "u32" else "f64::from_bits(raw)"
    elif form == "scaled" and rule is not None:
        value = decode_float(rule, raw)
        if point.decimals is not None:
            path = count_path(rule, point.decimals, raw, low, high)
            count_type, (scaled, count), failing, narrows = path.type, path.decode, path.overflows, path.overflows
    elif form == "scaled":
        value, failing = "", True
        if point.decimals is not None:
            count_type, count = "i64", f"decode_count::<{integer(10**point.decimals)}>"
    elif form == "text":
        value = "runtime::Text::from_words(&raw)"
    elif form == "digits":
        value = _digits(subject)
    else:
        value, count_type = _plain_value(subject), plain_count(raw)
        count = "raw" if count_type == raw else f"{count_type}::from(raw)"
    function, factors = point.places[0].function, subject.factors_type
    return ReadView(
        factors=factors,
        parameter=parameter(factors, "Factors", used=bool(factors)),
        failing=failing,
        narrows=narrows,
        value=value,
        count_type=f"runtime::Reading<{count_type}, {raw}>" if point.specials and count_type else count_type,
        scaled=scaled,
        count=count,
        function="" if function in (None, _FUNCTIONS.get(point.places[0].space)) else str(function),
        beyond=_beyond(subject),
        by_rule="decode(runtime::Raw::to_i64(raw))" if point.encodes_values else "decode_wide(i128::from(raw))",
    )


def _beyond(subject: Subject) -> str:
    most = subject.point.most_raw
    if most is None:
        return ""
    if subject.raw.startswith("u"):
        return f"raw > {integer(most)}"
    return f"!({integer(-most)}..={integer(most)}).contains(&raw)"


def _digits(subject: Subject) -> str:
    """Each digit as an entry of the enum, which may carry wider numbers than digits are."""
    enum = "" if subject.enum is None else type_name(subject.enum.name)
    raw = "raw" if subject.raw == "u16" else "u16::from(raw)"
    if subject.carried == "u16":
        return f"runtime::digits::split({raw}).map(enums::{enum}::from)"
    return f"runtime::digits::split({raw}).map(|one| enums::{enum}::from({subject.carried}::from(one)))"


def _plain_value(subject: Subject) -> str:
    if subject.enum is not None:
        wide = "raw" if subject.carried == subject.raw else f"{subject.carried}::from(raw)"
        return f"enums::{type_name(subject.enum.name)}::from({wide})"
    return f"flags::{subject.name}::from(raw)" if subject.form == "flags" else "raw"
