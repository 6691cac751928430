"""The formula language: exact rationals, points by name, linear rules. Text in, trees and rules out."""

from fieldscribe.language.formula.conditions import (
    AllOf,
    AnyOf,
    Comparison,
    Condition,
    Constant,
    Not,
    condition_comparisons,
    condition_names,
    parse_case,
    parse_condition,
)
from fieldscribe.language.formula.errors import FormulaError
from fieldscribe.language.formula.evaluation import evaluate
from fieldscribe.language.formula.lint import CutOff, cut_off, exact_scale
from fieldscribe.language.formula.normal import Affine, Resolve, invert, limit_rule, linear, scale_rule
from fieldscribe.language.formula.statements import constant, parse_expression, parse_range, parse_scale
from fieldscribe.language.formula.syntax import (
    Binary,
    Expression,
    Name,
    Negate,
    Number,
    Part,
    Power10,
    Range,
    Scale,
    names,
)

__all__ = [
    "Affine",
    "AllOf",
    "AnyOf",
    "Binary",
    "Comparison",
    "Condition",
    "Constant",
    "CutOff",
    "Expression",
    "FormulaError",
    "Name",
    "Negate",
    "Not",
    "Number",
    "Part",
    "Power10",
    "Range",
    "Resolve",
    "Scale",
    "condition_comparisons",
    "condition_names",
    "constant",
    "cut_off",
    "evaluate",
    "exact_scale",
    "invert",
    "limit_rule",
    "linear",
    "names",
    "parse_case",
    "parse_condition",
    "parse_expression",
    "parse_range",
    "parse_scale",
    "scale_rule",
]
