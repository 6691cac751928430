"""The check, encode and decode functions of points that are numbers: each calls the cores in a single expression."""

from collections.abc import Iterator
from fractions import Fraction

from fieldscribe.arithmetic.words import INT64
from fieldscribe.model import Point
from fieldscribe.targets.c.declarations import codes_first, encoded_limits
from fieldscribe.targets.c.limits import check, known, refused
from fieldscribe.targets.c.scales import Scaled, linear
from fieldscribe.targets.c.scope import HeaderScope, PointView
from fieldscribe.targets.c.syntax import (
    INLINE,
    STATUS,
    VALUE_BOUNDS,
    Function,
    bare,
    called,
    function,
    raw_kind,
    sign_and_size,
    unsigned,
)
from fieldscribe.targets.c.word_functions import fixed_number, fixes

_POWERS = 9
"""The highest power of ten in the table of `fieldscribe_decode_power`."""


def value_type(point: Point) -> str:
    """Return the C type that passes an integer value: wider than the point, so that the value can be out of range."""
    if point.info.bits <= 16:
        return "int32_t"
    return "uint64_t" if point.type == "u64" else "int64_t"


def is_rechecked(point: Point) -> bool:
    """Return True if a number between the outer limits may still be refused."""
    return (
        point.info.floating
        or len(point.allowed.intervals) > 1
        or point.allowed.moves
        or fixes(point)
        or bool(point.specials)
    )


class Writer:
    """Writes the functions of one point."""

    def __init__(self, view: PointView, scope: HeaderScope) -> None:
        self.point, self.fields, self.special, self.scope = view.point, view.fields, view.is_special, scope
        self.rule, self.scale = view.rule, view.scale
        self.name, self.macro = view.function, view.macro
        self.type, self.kind = view.raw_type, raw_kind(view.point)

    # ---- for points of every form

    def check(self) -> Function:
        """Return the function that checks whether a raw number may be written."""
        parameters = [f"{self.type} raw", *self.scope.parameters(self.point, self.point.limit_arguments)]
        status = codes_first(self.point, self.special, check(self.point, self.fields, self.scope))
        body = ("(void)raw;", f"return {status};") if status == "FIELDSCRIBE_OK" else (f"return {status};",)
        return function(STATUS, f"{self.name}_check", parameters, *body)

    def _checked(self, number: str) -> str:
        """Return the status of writing a raw number computed from a value; a value never means a special code."""
        status = called(f"{self.name}_check", number, *self.scope.passed(self.point.limit_arguments))
        if not any(special.writable for special in self.point.specials):
            return status
        return f"({self.special}({number}) ? FIELDSCRIBE_SPECIAL : {status})"

    def _encode(self, tail: str, parameter: str, *body: str, floating: bool = False) -> Function:
        parameters = [parameter, *self.scope.parameters(self.point, self.point.arguments), f"{self.type} *raw"]
        return function(STATUS, f"{self.name}_{tail}", parameters, *body, floating=floating)

    def _kept(self, inside: str, number: str, outside: str) -> str:
        """Return the statement that stores `number` if `inside` and it may be written, else returns `outside`."""
        status = self._checked(number) if is_rechecked(self.point) else "FIELDSCRIBE_OK"
        kept = f"fieldscribe_keep_{self.kind}({status}, {number}, raw)"
        return f"return {inside} ? {kept} : {outside};" if inside else f"return {kept};"

    def _whole(self, whole: str) -> tuple[str, ...]:
        """Return the statements that store a whole number, after a check if one is needed."""
        if not is_rechecked(self.point):
            return (f"return fieldscribe_store_{self.kind}({whole}, raw);",)
        number = f"({self.type})whole.number"
        status = f"fieldscribe_both(whole.status, {self._checked(number)})"
        store = f"return fieldscribe_keep_{self.kind}({status}, {number}, raw);"
        return f"const fieldscribe_whole whole = {whole};", store

    def _decode(self, tail: str, kind: str, number: str, *, floating: bool = False, fits: str = "") -> Function:
        """Return a decode function; it returns a status if decoding can fail, else the number itself.

        If `fits` is false, the count takes integers of more than 64 bits.
        """
        raw = f"{self.type} raw"
        if not self.special and not fits:
            body = f"return {number};"
            return function(f"{INLINE} {kind}", f"{self.name}_{tail}", (raw,), body, floating=floating)
        to = "count" if tail == "decode_count" else "value"
        keep = f"fieldscribe_keep_{_KEPT[kind]}({self._unless_code('FIELDSCRIBE_OK')}, {number}, {to})"
        if fits and self.scale is not None:
            keep = self._unless_code(f"{fits} ? {keep} : {self.scale.exact_count}")
        return function(STATUS, f"{self.name}_{tail}", (raw, f"{kind} *{to}"), f"return {keep};", floating=floating)

    def _unless_code(self, status: str) -> str:
        """Return the status of decoding `raw`, which may be a special code."""
        return status if not self.special else f"{self.special}(raw) ? FIELDSCRIBE_SPECIAL : {status}"

    # ---- points whose raw number is the value

    def plain(self) -> Iterator[Function]:
        """Yield the functions of a point whose raw number is the value."""
        point, kind = self.point, value_type(self.point)
        if point.writable:
            yield self._encode("encode", f"{kind} value", self._plain_body(kind))
        if point.readable:
            number = "raw" if not self.special or self.type != "bool" else "raw ? 1 : 0"
            yield self._decode("decode", "bool" if self.type == "bool" and not self.special else kind, number)

    def _plain_body(self, kind: str) -> str:
        point = self.point
        literal = unsigned if kind == "uint64_t" else bare
        low, high = point.held if fixes(point) else encoded_limits(point)
        if not is_rechecked(point):
            ends = (literal(low), literal(high)) if kind == "uint64_t" else (self.fields.low, self.fields.high)
            status = called(f"fieldscribe_encode_{self.kind}", "value", *ends, "raw")
            return f"return {known(point, status)};"
        self.scope.takes(point.arguments)
        number = fixed_number(point, "value") if fixes(point) else self._of_value(kind)
        within = {"int32_t": "within", "int64_t": "within_wide", "uint64_t": "within_u64"}[kind]
        inside = f"fieldscribe_{within}(value, {literal(low)}, {literal(high)})"
        return self._kept("" if (low, high) == VALUE_BOUNDS[kind] else inside, number, refused(point))

    def _of_value(self, kind: str) -> str:
        return "(value != 0)" if self.type == "bool" else "value" if self.type == kind else f"({self.type})value"

    # ---- points with a constant scale

    def scaled(self) -> Iterator[Function]:
        """Yield the functions of a point whose scale is known at compile time."""
        point, scale, fields = self.point, self.scale, self.fields
        assert scale is not None
        counts = point.decimals is not None
        real = "double" if scale.wide else "fieldscribe_real"
        if point.writable and counts:
            self.scope.takes(point.arguments)
            if scale.direct and not is_rechecked(point) and point.type != "u64" and scale.counts == point.outer:
                body = f"return fieldscribe_encode_{self.kind}(count, {fields.low}, {fields.high}, raw);"
            else:
                inside = f"{scale.inside}(count, {fields.first}, {fields.last})" if scale.inside else ""
                body = self._kept(inside, scale.raw_of_count, "FIELDSCRIBE_OUT_OF_RANGE")
            yield self._encode("encode_count", f"{scale.count_type} count", body)
        if point.readable and counts:
            yield self._decode("decode_count", scale.count_type, scale.count_of_raw, fits=scale.count_fits)
        if point.writable and point.encodes_values:
            self.scope.takes(point.arguments)
            yield self._encode("encode", f"{real} value", *self._rounded(scale), floating=True)
        if point.readable:
            yield self._decode("decode", real, scale.value_of_raw, floating=True)

    def _outer(self) -> str:
        """Return the limits as two arguments: their macros if a check follows, else numbers."""
        reach = encoded_limits(self.point)
        if reach != self.point.outer:
            return ", ".join(map(bare, reach))
        named = is_rechecked(self.point)
        return f"{self.macro}_RAW_MIN, {self.macro}_RAW_MAX" if named else f"{self.fields.low}, {self.fields.high}"

    def _rounded(self, scale: Scaled) -> tuple[str, ...]:
        limits = self._outer()
        kinds = ("u32", "s32") if scale.wide else ("u8", "s8", "u16", "s16")
        if self.kind in kinds and not is_rechecked(self.point):
            return (f"return fieldscribe_round_{self.kind}({scale.steps}, {limits}, raw);",)
        return self._whole(f"fieldscribe_rounded{'_wide' if scale.wide else ''}({scale.steps}, {limits})")

    # ---- points whose scale depends on other points

    def ruled(self) -> Iterator[Function]:
        """Yield the functions of a point whose scale depends on other points."""
        point = self.point
        if self.rule is not None and self.rule.text:
            yield self.rule
        places, limits = point.decimals or 0, self._outer()
        counts = point.decimals is not None
        lifts = any(case.rule.offset for case in point.scale or ())
        tens = bare(10**places) if lifts else f"{bare(5**places)}, {places}"
        if point.writable and counts:
            rule = self._rule(point.arguments)
            body_of = self._whole(f"fieldscribe_{'ruled' if lifts else 'ratio'}_count({rule}, count, {tens}, {limits})")
            yield self._encode("encode_count", "int64_t count", *body_of)
        if point.readable and counts:
            how = "count" if lifts else "ratio"
            core = self._powers() or f"fieldscribe_decode_{how}({{}}, (int64_t)raw, {tens}, count)"
            yield self._by_rule("decode_count", "int64_t *count", core)
        if point.writable and point.encodes_values:
            rule = self._rule(point.arguments)
            body_of = self._whole(f"fieldscribe_ruled_value({rule}, value, {limits})")
            yield self._encode("encode", "double value", *body_of, floating=True)
        if point.readable and point.encodes_values:
            yield self._by_rule(
                "decode", "double *value", "fieldscribe_decode_value({}, (int64_t)raw, value)", floating=True
            )
        elif point.readable:
            core = f"fieldscribe_decode_wide({{}}, {', '.join(sign_and_size(point))}, value)"
            yield self._by_rule("decode", "double *value", core, floating=True)

    def _powers(self) -> str:
        """Return the core for a scale that is only a power of ten, with few values that all fit; empty for others."""
        point, (case, *others) = self.point, self.point.scale or ()
        rule = self.scope.lowered.rule(case.rule)
        if others or len(rule.operands) != 1 or rule.offset or rule.coded or point.most_raw is not None:
            return ""
        [operand] = rule.operands
        if not operand.factor.ten_to or operand.within is None:
            return ""
        low, high = operand.within
        start = Fraction(10) ** ((low if operand.over else -high) + (point.decimals or 0)) / rule.ratio
        most = abs(start) * 10 ** (high - low) * max(map(abs, point.held))
        if operand.ends != operand.held or start.denominator != 1 or high - low > _POWERS or most > INT64[1]:
            return ""
        self.scope.takes(point.scale_arguments)
        turn, add = (1, -low) if operand.over else (-1, high)
        power = linear(self.scope.raw(operand.factor.point), turn, add, "int32_t")
        return f"fieldscribe_decode_power({linear('raw', int(start), 0, 'int64_t')}, {power}, {high - low}, count)"

    def _rule(self, arguments: tuple[str, ...]) -> str:
        """Return the call that gives the rule, in a function with these arguments."""
        assert self.rule is not None
        self.scope.takes(arguments)
        return called(self.rule.name, *self.scope.passed(self.point.scale_arguments))

    def _by_rule(self, tail: str, to: str, core: str, *, floating: bool = False) -> Function:
        point = self.point
        rule = self._rule(point.scale_arguments)
        if point.most_raw is not None:
            literal = bare(point.most_raw)
            if point.type == "u64":
                fits = f"fieldscribe_within_u64(raw, 0U, {unsigned(point.most_raw)})"
                rule = f"fieldscribe_rule_if({rule}, {fits})"
            else:
                rule = f"fieldscribe_rule_within({rule}, (int64_t)raw, {bare(-point.most_raw)}, {literal})"
        body = self._unless_code(core.format(rule))
        parameters = [f"{self.type} raw", *self.scope.parameters(point, point.scale_arguments), to]
        return function(STATUS, f"{self.name}_{tail}", parameters, f"return {body};", floating=floating)

    # ---- points that are bit patterns of floating-point numbers

    def floating(self) -> Iterator[Function]:
        """Yield the functions of a point whose raw number is the bit pattern of a floating-point number."""
        point, bits = self.point, self.point.info.bits
        real = "fieldscribe_real" if bits == 32 else "double"
        if point.has_counts:
            yield from self._counted_floats(bare(10 ** (point.decimals or 0)))
        if point.writable:
            body = self._whole(f"fieldscribe_bits_of_f{bits}(value)")
            yield self._encode("encode", f"{real} value", *body, floating=True)
        if point.readable:
            yield self._decode("decode", real, f"fieldscribe_f{bits}_of_bits(raw)", floating=True)

    def _counted_floats(self, tens: str) -> Iterator[Function]:
        """Yield the functions of an f32 point that gives the decimals of its counts."""
        point = self.point
        if point.writable:
            yield self._encode(
                "encode_count", "int64_t count", *self._whole(f"fieldscribe_f32_of_count(count, {tens})")
            )
        if point.readable:
            body = f"return {self._unless_code(f'fieldscribe_count_of_f32(raw, {tens}, count)')};"
            yield function(STATUS, f"{self.name}_decode_count", (f"{self.type} raw", "int64_t *count"), body)


_KEPT = {
    "int32_t": "s32",
    "int64_t": "s64",
    "uint64_t": "u64",
    "bool": "bool",
    "fieldscribe_real": "real",
    "double": "double",
}
