"""Fuzzing: mutated descriptions, frames through the parsers of three languages, words for the command line."""
