"""Helps the author of a description: starts it, formats it, and compiles it whenever it is saved."""
