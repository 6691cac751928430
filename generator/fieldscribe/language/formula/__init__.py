"""The formula language: parses formulas and conditions into trees, and turns trees into exact linear rules."""
