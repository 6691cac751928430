"""Exact arithmetic, once: rounding, words and patterns, rules, and what a point's raw numbers mean.

Only the oracle of the vectors computes for itself, so that a mistake here is found there.
"""
