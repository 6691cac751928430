"""Fieldscribe compiles descriptions of fieldbus devices into C, Python, Rust, documentation and vectors."""

__version__ = "0.1.0"
