"""The one place of exact arithmetic: rounding, words and bit patterns, rules, and what raw numbers mean.

Only the oracle of the vectors has its own arithmetic, so that the vectors show a mistake made here.
"""
