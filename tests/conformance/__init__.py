"""Runs the conformance vectors of a device against its generated Python package, in one small module per theme."""
