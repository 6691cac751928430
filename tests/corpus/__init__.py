"""Measures the importers on whole collections of files, which are not part of the project: `make corpus FOLDER=...`."""
