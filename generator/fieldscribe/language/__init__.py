"""The source language: text, YAML with places, the schema, numbers and formulas."""
