"""Proofs of the C that parses and builds frames."""
