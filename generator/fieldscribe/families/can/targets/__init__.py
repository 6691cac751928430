"""The part of this family in each target, one module each."""
