"""The description language: YAML text to checked mappings that know their places; numbers, units and formulas."""
