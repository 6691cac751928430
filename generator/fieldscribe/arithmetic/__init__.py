"""The one place of exact arithmetic: rounding, words and bit patterns, rules, and what raw numbers mean.

Only the oracle of the vectors has arithmetic of its own, so that vectors reveal a mistake made here.
"""
