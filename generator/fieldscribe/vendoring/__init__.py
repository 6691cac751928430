"""Delivers a device, or chosen points of it, to a project: only the files that it needs."""
